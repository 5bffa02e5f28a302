"""Counts of what is in an OpenStreetMap file, and of what reading it changed."""

import re
import unicodedata
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Final

LANGUAGE_KEY: Final = re.compile(r"name:([a-z]{2,3})(?:[-_][A-Za-z]+)?")  # "name:zh-Hant", but not "name:etymology"


@dataclass(frozen=True, slots=True)
class ReadingCounts:
    """Counts that reading a file increases. A reason completes "3 objects were cut: ..."."""

    cut: Counter[str] = field(default_factory=Counter)  # objects that lost a part, by reason
    dropped: Counter[str] = field(default_factory=Counter)  # objects left out, by reason
    repaired: Counter[str] = field(default_factory=Counter)  # by reason
    scripts: Counter[str] = field(default_factory=Counter)  # first names of elements, by script
    languages: Counter[str] = field(default_factory=Counter)  # elements with a name tagged in a language

    extras: Counter[str] = field(default_factory=Counter)  # objects of a city's own data, by file and kind

    def add_names(self, name: str, tags: Mapping[str, str]) -> None:
        """Count the script of an element's first name, and the languages of all its names."""
        if script := script_of(name):
            self.scripts[script] += 1
        languages = {match[1] for key in tags if key.startswith("name:") and (match := LANGUAGE_KEY.fullmatch(key))}
        self.languages.update(languages)


def script_of(name: str) -> str | None:
    """Return the script of the first letter of a name, such as "latin"; None without letters."""
    return next((_script(letter) for letter in name if letter.isalpha()), None)


@cache
def _script(letter: str) -> str:
    return unicodedata.name(letter, "unknown").split()[0].split("-")[0].lower()
