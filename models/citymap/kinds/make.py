"""Write the vendored vocabulary from the published packages of the tagging schema and the brand index.

    npm pack @openstreetmap/id-tagging-schema name-suggestion-index
    mkdir schema brands
    tar xzf openstreetmap-id-tagging-schema-*.tgz -C schema --strip-components 1
    tar xzf name-suggestion-index-*.tgz -C brands --strip-components 1
    python -m models.citymap.kinds.make --schema schema --brands brands

The same packages give the same bytes. The service does not need this module.
"""

import argparse
import json
import lzma
import re
import tomllib
from collections.abc import Iterable, Mapping
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from models.citymap.kinds.brands import normalize_name
from models.errors import DataError
from models.files import replace_file

FOLDER = Path(__file__).parent
# Tags of a brand that hold its names, and those that hold its kind.
NAME_TAGS = re.compile(r"(name|brand|alt_name|short_name|official_name|brand:short)(:[a-z]{2,3}(-[A-Za-z]+)?)?")
KIND_TAGS = ("amenity", "shop", "cuisine", "leisure", "tourism", "office", "healthcare", "craft", "beauty", "clothes")
Json = dict[str, Any]


def read_json(path: Path) -> Json:
    """Read a JSON file of a package."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise DataError(f"{path}: {error}; is this the unpacked package?") from error
    if not isinstance(content, dict):
        raise DataError(f"{path}: an object was expected")
    return content


def package_source(package: Path) -> Json:
    """Return the name, version and licence of a package."""
    about = read_json(package / "package.json")
    return {key: about[key] for key in ("name", "version", "license")}


def select_presets(presets: Json, selection: Json) -> Json:
    """Return the presets that a passer-by could mention, in order of id; presets with equal tags are merged."""
    kinds: dict[str, Any] = {}
    by_tags: dict[str, str] = {}
    for key in sorted(presets, key=lambda key: ("-" in key, len(key), key)):
        tags = presets[key]["tags"]
        group = key.partition("/")[0]
        if group not in selection["groups"] or any(fnmatchcase(key, pattern) for pattern in selection["drop"]):
            continue
        if not tags or (key not in selection["roots"] and key == group):
            continue
        equal = by_tags.setdefault(json.dumps(tags, sort_keys=True), key)
        kinds.setdefault(equal, {"tags": tags, "presets": []})["presets"].append(key)
    return dict(sorted(kinds.items()))


def split_phrases(field: str, separator: str = "\n") -> list[str]:
    """Return the phrases of a translated field, in lower case and without text in brackets."""
    bare = re.sub(r"[((][^))]*[))]?", "", field.lower())
    result = [phrase for part in bare.split(separator) for phrase in expand_slashes(" ".join(part.split()))]
    grounds = [phrase.removesuffix(" grounds") for phrase in result if phrase.endswith(" grounds")]
    return [phrase for phrase in (*grounds, *result) if phrase]


def expand_slashes(phrase: str) -> list[str]:
    """Return the alternatives of a phrase with a slash: "bag/luggage store" gives "bag store" and "luggage store"."""
    parts = [part.split() for part in phrase.split("/") if part.strip()]
    if len(parts) < 2:
        return [phrase]
    first, last = parts[0], parts[-1]
    if len(first) == 1 and len(last) > 1:
        parts = [[*part, last[-1]] if len(part) == 1 else part for part in parts]
    elif len(first) > 1:
        parts = [[*first[:-1], *part] if len(part) == 1 else part for part in parts]
    return [" ".join(part) for part in parts]


def resolve_translation(key: str, presets: Json, translation: Json) -> Json:
    """Return the translation of a preset; some presets refer to another one's name."""
    reference = re.fullmatch(r"\{(.+)\}", presets[key].get("name", ""))
    own: Json = translation.get(key, {})
    return {**translation.get(reference[1], {}), **own} if reference else own


def read_translations(schema: Path, language: str) -> Json:
    """Read the names of the presets in a language."""
    content = read_json(schema / "dist" / "translations" / f"{language}.min.json")
    return content[language].get("presets", {}).get("presets", {})


def unique(items: Iterable[str]) -> list[str]:
    """Return the items without repeats, in their order."""
    return list(dict.fromkeys(items))


def names_and_aliases(translations: Iterable[Json]) -> tuple[list[str], list[str]]:
    """Return the names and aliases in the translations of a kind."""
    translations = list(translations)
    names = unique(phrase for one in translations for phrase in split_phrases(one.get("name", "")))
    aliases = unique(phrase for one in translations for phrase in split_phrases(one.get("aliases", "")))
    return names, [alias for alias in aliases if alias not in names]


def english_kinds(schema: Path, selected: Json, presets: Json) -> list[Json]:
    """Return the kinds with their English words; words from other variants of English become aliases."""
    english = read_translations(schema, "en")
    folder = schema / "dist" / "translations"
    variants = [
        read_translations(schema, path.name[: -len(".min.json")]) for path in sorted(folder.glob("en-*.min.json"))
    ]
    kinds = []
    for key, kind in selected.items():
        translations = [resolve_translation(preset, presets, english) for preset in kind["presets"]]
        names, aliases = names_and_aliases(translations)
        variant_names, variant_aliases = names_and_aliases(
            resolve_translation(preset, presets, variant) for variant in variants for preset in kind["presets"]
        )
        if not names:
            raise DataError(f"preset {key} has no English name")
        terms = unique(phrase for one in translations for phrase in split_phrases(one.get("terms", ""), ","))
        aliases = [
            alias for alias in unique([*names[1:], *aliases, *variant_names, *variant_aliases]) if alias != names[0]
        ]
        terms = [term for term in terms if term not in (names[0], *aliases)]
        kinds.append({"id": key, "name": names[0], "tags": kind["tags"], "aliases": aliases, "terms": terms})
    return kinds


def names_by_language(schema: Path, selected: Json, presets: Json, languages: list[str]) -> Json:
    """Return, by language and in the order of the kinds, names and aliases; "" for a kind without names."""
    words = {}
    for language in languages:
        if not (schema / "dist" / "translations" / f"{language}.min.json").exists():
            continue
        translation = read_translations(schema, language)
        rows = [
            names_and_aliases(resolve_translation(preset, presets, translation) for preset in kind["presets"])
            for kind in selected.values()
        ]
        words[language] = ["\n".join(names) + ("\t" + "\n".join(aliases) if aliases else "") for names, aliases in rows]
    return words


def brand_spellings(item: Mapping[str, Any]) -> list[str]:
    """Return all spellings of a brand, the main one first."""
    tags = item["tags"]
    main_name = (
        tags.get("brand:en") or tags.get("brand") or tags.get("name") or tags.get("operator") or item["displayName"]
    )
    more = [name for key in sorted(tags) if NAME_TAGS.fullmatch(key) for name in tags[key].split(";")]
    by_form: dict[str, str] = {}
    for name in (main_name, *more, *item.get("matchNames", [])):
        by_form.setdefault(normalize_name(name), name.strip())
    return [name for form, name in by_form.items() if form]


def merge_brands(index: Json, brandless: list[str]) -> list[list[str]]:
    """Return the spellings of each brand, merged where brands are the same."""
    merged: dict[str, list[str]] = {}
    for path in sorted(index):
        tree, _, branch = path.partition("/")
        if tree != "brands" or branch in brandless:
            continue
        for item in index[path]["items"]:
            names = brand_spellings(item)
            if names and any(key in item["tags"] for key in KIND_TAGS):
                merged.setdefault(item["tags"].get("brand:wikidata") or normalize_name(names[0]), []).extend(names)
    rows = []
    for names in merged.values():
        by_form = {normalize_name(name): name for name in reversed(names)}
        rows.append([by_form[form] for form in unique(map(normalize_name, names))])
    return sorted(rows)


def write_vocabulary(schema: Path, brands: Path, out: Path) -> None:
    """Write the vendored files into a folder."""
    selection = tomllib.loads((FOLDER / "selection.toml").read_text(encoding="utf-8"))
    presets = read_json(schema / "dist" / "presets.min.json")
    selected = select_presets(presets, selection)
    sources = [package_source(schema), package_source(brands)]
    names_abroad = names_by_language(schema, selected, presets, selection["languages"])
    kinds = {
        "version": ", ".join(f"{about['name'].rpartition('/')[2]} {about['version']}" for about in sources),
        "sources": sources,
        "languages": ["en", *names_abroad],
        "kinds": english_kinds(schema, selected, presets),
    }
    names = {"source": sources[0], "names": names_abroad}
    index = read_json(brands / "dist" / "json" / "nsi.min.json")["nsi"]
    chains = {"source": sources[1], "brands": merge_brands(index, selection["brandless"])}
    for file, content in (("kinds", kinds), ("names", names), ("brands", chains)):
        text = json.dumps(content, ensure_ascii=False, separators=(",", ":"))
        replace_file(out / f"{file}.json.xz", lzma.compress(text.encode(), preset=9 | lzma.PRESET_EXTREME))
    texts = [
        f"# {about['name']} {about['version']} ({about['license']})\n\n{(package / 'LICENSE.md').read_text().strip()}\n"
        for package, about in zip((schema, brands), sources, strict=True)
    ]
    head = "The vendored files of this folder (`*.json.xz`) are made from these packages.\n\n"
    replace_file(out / "LICENCES.md", (head + "\n".join(texts)).encode())


def main() -> None:
    """Run the command line."""
    parser = argparse.ArgumentParser(description="Write the vendored vocabulary from the published packages.")
    parser.add_argument("--schema", type=Path, required=True, help="unpacked tagging schema")
    parser.add_argument("--brands", type=Path, required=True, help="unpacked brand index")
    parser.add_argument("--out", type=Path, default=FOLDER, help="folder of the vendored files")
    arguments = parser.parse_args()
    write_vocabulary(arguments.schema, arguments.brands, arguments.out)


if __name__ == "__main__":
    main()
