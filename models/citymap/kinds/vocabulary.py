"""The vocabulary: what kind of thing an OpenStreetMap object is, and by which nouns people call that kind."""

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

HERE = Path(__file__).parent
# Languages that go by another one's names.
LANGUAGE_ALIASES = {"nb": "no", "nn": "no", "zh": "zh-CN", "zh-HK": "zh-TW"}
VOCABULARY_FILES = ("kinds.json.xz", "names.json.xz", "brands.json.xz", "LICENCES.md")


class Vocabulary:
    """Kinds, nouns and brands, of one folder of vendored files.

    Attributes:
        version: of the packages it was made from.
        kinds: all kinds, most specific first.
        languages: for which there are nouns.
    """

    def __init__(self, folder: Path = HERE) -> None:
        self._folder = folder
        self._ours = tomllib.loads((HERE / "ours.toml").read_text(encoding="utf-8"))
        content = read_compressed_json(folder / "kinds.json.xz")
        self._presets: list[dict[str, Any]] = content["kinds"]
        names: Mapping[str, str] = self._ours["names"]
        presets = [Kind(row["id"], names.get(row["id"], row["name"]), row["tags"]) for row in self._presets]
        self.kinds: tuple[Kind, ...] = tuple(
            sorted((*presets, *additional_kinds(self._ours, presets)), key=specificity_key)
        )
        self._matcher = Matcher(self.kinds, self._ours["same"])
        self.version: str = content["version"]
        self.languages: tuple[str, ...] = tuple(content["languages"])
        self._nouns: dict[str, Nouns] = {}

    def kinds_of(self, tags: Mapping[str, str]) -> tuple[str, ...]:
        """Ids of all kinds that an object is, most specific first, with their parents; none if nobody would name it."""
        return self._matcher.kinds_of(tags)

    def nouns(self, language: str = "en") -> Mapping[str, tuple[tuple[str, float], ...]]:
        """What people call kinds.

        Args:
            language: "fi", "pt-BR"; of a region without names of its own, the language's. Unknown ones have no nouns.

        Returns:
            By casefolded phrase the ids of kinds with weights in (0, 1], the plainest first: 1 is the kind's name, 0.9
            another name, 0.5 a mere search term (in English only).
        """
        language = LANGUAGE_ALIASES.get(language, language)
        if language not in self.languages:
            language = language.partition("-")[0]
        if language not in self._nouns:
            self._nouns[language] = self._read_nouns(language)
        return MappingProxyType(self._nouns[language])

    def single_words(self, least: int) -> Iterator[tuple[str, tuple[tuple[str, float], ...]]]:
        """As `nouns`, those of one word of all languages, at least so long; what is read for it is let go of."""
        names = self._read_names()

        def is_wanted(phrase: str) -> bool:
            return len(phrase) >= least and " " not in phrase

        for language in self.languages:
            if language in names:
                yield from self._read_foreign(names[language], is_wanted).items()
            else:
                yield from ((noun, kinds) for noun, kinds in self.nouns(language).items() if is_wanted(noun))

    def brand(self, name: str) -> tuple[str, ...]:
        """Ids of the kinds that a brand's places are, by any spelling of its name; none if it is unknown."""
        return tuple(dict.fromkeys(key for tags in self._brands.tags(name) for key in self.kinds_of(tags)))

    def spellings(self, brand: str) -> tuple[str, ...]:
        """The other spellings of a brand."""
        return self._brands.spellings(brand)

    def _read_nouns(self, language: str) -> Nouns:
        if language == "en":
            return self._read_english()
        return self._read_foreign(self._read_names().get(language, ()))

    def _read_foreign(self, rows: Sequence[str], is_wanted: Callable[[str], bool] = bool) -> Nouns:
        return foreign_nouns((row["id"] for row in self._presets), rows, is_wanted) if rows else {}

    def _read_english(self) -> Nouns:
        """English nouns, with those written by hand; a folder of few kinds leaves out what is said of others."""
        people = tomllib.loads((HERE / "people.toml").read_text(encoding="utf-8"))
        said = {row["id"]: row for row in self._presets}
        rows = [
            {"aliases": [], "terms": [], **said.get(kind.id, {}), "id": kind.id, "name": kind.name, "tags": kind.tags}
            for kind in self.kinds
        ]
        known = {kind.id for kind in self.kinds}
        nouns = english_nouns(rows, self._ours, people)
        return {
            phrase: kept for phrase, rows in nouns.items() if (kept := tuple(row for row in rows if row[0] in known))
        }

    def _read_names(self) -> dict[str, list[str]]:
        """By language; not kept, as each language is read once at most."""
        found: dict[str, list[str]] = read_compressed_json(self._folder / "names.json.xz")["names"]
        return found

    @cached_property
    def _brands(self) -> Brands:
        content = read_compressed_json(self._folder / "brands.json.xz")
        return Brands(content["tags"], content["brands"])


def read_compressed_json(path: Path) -> dict[str, Any]:
    """The content of a vendored file."""
    try:
        content: dict[str, Any] = json.loads(lzma.decompress(path.read_bytes()))
    except (OSError, lzma.LZMAError, ValueError) as error:
        raise DataError(f"{path}: {error}; make it again with models.citymap.kinds.make") from error
    return content


@cache
def load_vocabulary() -> Vocabulary:
    """The vendored vocabulary."""
    return Vocabulary()
