"""The vocabulary: the kinds of an OpenStreetMap object, and the nouns people use for each kind."""

import json
import lzma
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, cached_property
from pathlib import Path
from types import MappingProxyType
from typing import Any

from models.citymap.kinds.brands import Brands
from models.citymap.kinds.matching import Kind, Matcher, specificity_key
from models.citymap.kinds.words import Nouns, additional_kinds, english_nouns, foreign_nouns
from models.errors import DataError

FOLDER = Path(__file__).parent
# Languages that use the names of another one.
LANGUAGE_ALIASES = {"nb": "no", "nn": "no", "zh": "zh-CN", "zh-HK": "zh-TW"}


class Vocabulary:
    """Kinds (most specific first), nouns and brands, from a folder of vendored files."""

    def __init__(self, folder: Path = FOLDER) -> None:
        self._folder = folder
        self._tables = tomllib.loads((FOLDER / "ours.toml").read_text(encoding="utf-8"))
        content = read_compressed_json(folder / "kinds.json.xz")
        self._presets: list[dict[str, Any]] = content["kinds"]
        names: Mapping[str, str] = self._tables["names"]
        presets = [Kind(row["id"], names.get(row["id"], row["name"]), row["tags"]) for row in self._presets]
        self.kinds: tuple[Kind, ...] = tuple(
            sorted((*presets, *additional_kinds(self._tables, presets)), key=specificity_key)
        )
        self._matcher = Matcher(self.kinds, self._tables["same"])
        self.version: str = content["version"]
        self.languages: tuple[str, ...] = tuple(content["languages"])
        self._nouns: dict[str, Nouns] = {}

    def kinds_of(self, tags: Mapping[str, str]) -> tuple[str, ...]:
        """Return the ids of all kinds of an object with their parents, most specific first; often empty."""
        return self._matcher.kinds_of(tags)

    def nouns(self, language: str = "en") -> Mapping[str, tuple[tuple[str, float], ...]]:
        """Return by casefolded phrase the ids of kinds with weights in (0, 1], the highest first.

        1 is the kind's name, 0.9 another name, 0.5 a mere search term (in English only). A region ("pt-BR") without its
        own names uses the language's; unknown languages have no nouns.
        """
        language = LANGUAGE_ALIASES.get(language, language)
        if language not in self.languages:
            language = language.partition("-")[0]
        if language not in self._nouns:
            self._nouns[language] = self._read_nouns(language)
        return MappingProxyType(self._nouns[language])

    def single_words(self, min_length: int) -> Iterator[tuple[str, tuple[tuple[str, float], ...]]]:
        """Yield the single-word nouns of all languages of at least some length, as `nouns`; keeps none in memory."""
        names = self._read_names()

        def is_wanted(phrase: str) -> bool:
            return len(phrase) >= min_length and " " not in phrase

        for language in self.languages:
            if language in names:
                yield from self._read_foreign(names[language], is_wanted).items()
            else:
                yield from ((noun, kinds) for noun, kinds in self.nouns(language).items() if is_wanted(noun))

    def spellings(self, brand: str) -> tuple[str, ...]:
        """Return the other spellings of a brand."""
        return self._brands.spellings(brand)

    def _read_nouns(self, language: str) -> Nouns:
        if language == "en":
            return self._read_english()
        return self._read_foreign(self._read_names().get(language, ()))

    def _read_foreign(self, rows: Sequence[str], is_wanted: Callable[[str], bool] = bool) -> Nouns:
        return foreign_nouns((row["id"] for row in self._presets), rows, is_wanted) if rows else {}

    def _read_english(self) -> Nouns:
        """Return the English nouns, including the hand-written ones, for the kinds of the folder."""
        people = tomllib.loads((FOLDER / "people.toml").read_text(encoding="utf-8"))
        presets = {row["id"]: row for row in self._presets}
        rows = [
            {
                "aliases": [],
                "terms": [],
                **presets.get(kind.id, {}),
                "id": kind.id,
                "name": kind.name,
                "tags": kind.tags,
            }
            for kind in self.kinds
        ]
        known = {kind.id for kind in self.kinds}
        nouns = english_nouns(rows, self._tables, people)
        return {
            phrase: known_rows
            for phrase, rows in nouns.items()
            if (known_rows := tuple(row for row in rows if row[0] in known))
        }

    def _read_names(self) -> dict[str, list[str]]:
        """Read names by language; not kept, because each language is read at most once."""
        return read_compressed_json(self._folder / "names.json.xz")["names"]

    @cached_property
    def _brands(self) -> Brands:
        return Brands(read_compressed_json(self._folder / "brands.json.xz")["brands"])


def read_compressed_json(path: Path) -> dict[str, Any]:
    """Read a vendored file."""
    try:
        content: dict[str, Any] = json.loads(lzma.decompress(path.read_bytes()))
    except (OSError, lzma.LZMAError, ValueError) as error:
        raise DataError(f"{path}: {error}; make it again with models.citymap.kinds.make") from error
    return content


@cache
def load_vocabulary() -> Vocabulary:
    """Load the vendored vocabulary."""
    return Vocabulary()
