"""The addresses of a map as people write them: "350 W 42nd St", "Bulevardi 12 b"."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from models.citymap.gazetteer.name_columns import GazetteerObject
from models.citymap.points import Ints
from models.language.mentions.name_table import NUMBER_SEPARATOR
from models.language.mentions.names import plain_words
from models.language.mentions.streets import ORDINAL
from models.posterior.places.name_index import NameIndex
from models.strings import Column, Postings, StringArray

_NUMBER: Final = re.compile(r"\d+")
_NONE: Final = np.zeros(0, np.int64)


@dataclass(frozen=True, slots=True, eq=False)
class Addresses:
    """An index of addresses; each has a column of a table.

    Attributes:
        shown: [K] "350 West 42nd Street".
        objects: [E] the object of each address of one.
        column: [E] its column; objects of one address share it.
        streets: of all addresses.
        by_street: from a column of `streets`, NUMBER_SEPARATOR and a number to the column.
        by_number: from a number to columns.
    """

    shown: StringArray
    objects: Ints
    column: Ints
    streets: NameIndex
    by_street: Postings
    by_number: Postings

    @classmethod
    def build(cls, words: Sequence[GazetteerObject]) -> "Addresses":
        """Build the index of objects; an object has one address per house number, and none without a street."""
        rows = [
            (n, number.replace(" ", ""), some.street)
            for n, some in enumerate(words)
            if some.street
            for number in some.numbers
        ]
        streets = NameIndex.build([(street,) for _, _, street in rows], are_streets=True)
        columns, shown = dict[tuple[int, str], int](), list[str]()
        column = []
        for (_, number, street), of in zip(rows, streets.column.tolist(), strict=True):
            column.append(columns.setdefault((of, number), len(columns)))
            if column[-1] == len(shown):
                shown.append(f"{number} {street}")
        by_street = Postings.from_pairs((f"{of}{NUMBER_SEPARATOR}{number}", n) for (of, number), n in columns.items())
        by_number = Postings.from_pairs((number, n) for (_, number), n in columns.items())
        objects = np.array([n for n, _, _ in rows], np.int32)
        return cls(StringArray.from_strings(shown), objects, np.array(column, np.int32), streets, by_street, by_number)

    def __len__(self) -> int:
        return len(self.shown)

    def columns(self, name: str) -> dict[str, Column]:
        """Return the arrays that `from_columns` reads."""
        found = {f"{name}.objects": self.objects, f"{name}.column": self.column} | self.shown.columns(f"{name}.shown")
        found |= self.by_street.columns(f"{name}.by_street") | self.by_number.columns(f"{name}.by_number")
        return found | self.streets.columns(f"{name}.streets")

    @classmethod
    def from_columns(cls, columns: Mapping[str, Column], name: str) -> "Addresses":
        """Restore the index from the arrays of `columns`."""
        by_street, by_number = (Postings.from_columns(columns, f"{name}.{kind}") for kind in ("by_street", "by_number"))
        streets = NameIndex.from_columns(columns, f"{name}.streets", are_streets=True)
        objects, column = columns[f"{name}.objects"], columns[f"{name}.column"]
        return cls(StringArray.from_columns(columns, f"{name}.shown"), objects, column, streets, by_street, by_number)

    def find(self, said: str) -> Ints:
        """Return the columns [k] that an address may mean; a number alone is looked up in all streets.

        A number that a street lacks means its nearest numbers on the same side; none past the end of the street.
        """
        words, found = plain_words(said), list[int]()
        for n, number in enumerate(words):
            if not number[0].isdecimal() or ORDINAL.fullmatch(number):
                continue
            before, behind = words[:n], words[n + 1 :]
            streets = self._street(behind)
            if not streets and behind and len(behind[0]) == 1 and behind[0].isalpha():
                number, behind = number + behind[0], behind[1:]  # noqa: PLW2901  # "12 b" is one number
                streets = self._street(behind)
            if not before and not behind:
                return self.by_number.find(number)
            for street in streets or self._street(before):
                there = {known: int(of[0]) for known, of in self.by_street.with_prefix(f"{street}{NUMBER_SEPARATOR}")}
                found.extend([there[number]] if number in there else _beside(number, there))
            if found:
                return np.array(found)
        return _NONE

    def _street(self, said: tuple[str, ...]) -> list[int]:
        """Return the streets of the longest prefix that names any; a town or a flat may follow."""
        for end in range(len(said), 0, -1):
            if len(streets := self.streets.find(" ".join(said[:end]))):
                return [int(street) for street in streets]
        return []


def _beside(number: str, numbers: Mapping[str, int]) -> list[int]:
    """Return the columns of the nearest numbers on the same side; none past the end."""
    wanted = _digits(number)
    side = [(_digits(known), column) for known, column in numbers.items()]
    below = [value for value, _ in side if 0 <= value <= wanted and value % 2 == wanted % 2]
    above = [value for value, _ in side if value >= wanted and value % 2 == wanted % 2]
    nearest = {max(below), min(above)} if below and above else set[int]()
    return [column for value, column in side if value in nearest]


def _digits(number: str) -> int:
    """Return the leading digits of a house number; -1 without any."""
    found = _NUMBER.match(number)
    return int(found.group()) if found else -1
