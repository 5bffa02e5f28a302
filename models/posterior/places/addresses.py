"""The addresses of a map as people write them: "350 W 42nd St", "Bulevardi 12 b"."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from models.citymap.gazetteer.name_columns import GazetteerObject
from models.citymap.points import Ints
from models.language.mentions.name_table import NUMBER_SEPARATOR
from models.language.mentions.names import ORDINAL, plain_words
from models.posterior.places.name_index import NameIndex
from models.strings import Column, Postings, StringArray

_NUMBER: Final = re.compile(r"\d+")
_NONE: Final = np.zeros(0, np.int64)


@dataclass(frozen=True, slots=True, eq=False)
class Addresses:
    """An index of addresses; each has a column of a table."""

    shown: StringArray  # [K] "350 West 42nd Street"
    objects: Ints  # [E] an object with an address
    column: Ints  # [E] its column; objects with the same address share it
    streets: NameIndex  # of all addresses
    by_street: Postings  # from a column of `streets`, NUMBER_SEPARATOR and a number to the column
    by_number: Postings  # from a number to columns

    @classmethod
    def build(cls, words: Sequence[GazetteerObject]) -> "Addresses":
        """Build the index of objects; an object has one address per house number, and none without a street."""
        rows = [
            (n, number.replace(" ", ""), item.street)
            for n, item in enumerate(words)
            if item.street
            for number in item.numbers
        ]
        streets = NameIndex.build([(street,) for _, _, street in rows], are_streets=True)
        columns, shown = dict[tuple[int, str], int](), list[str]()
        column = []
        for (_, number, street), street_column in zip(rows, streets.column.tolist(), strict=True):
            column.append(columns.setdefault((street_column, number), len(columns)))
            if column[-1] == len(shown):
                shown.append(f"{number} {street}")
        by_street = Postings.from_pairs(
            (f"{street}{NUMBER_SEPARATOR}{number}", n) for (street, number), n in columns.items()
        )
        by_number = Postings.from_pairs((number, n) for (_, number), n in columns.items())
        objects = np.array([n for n, _, _ in rows], np.int32)
        return cls(StringArray.from_strings(shown), objects, np.array(column, np.int32), streets, by_street, by_number)

    def __len__(self) -> int:
        return len(self.shown)

    def columns(self, name: str) -> dict[str, Column]:
        """Return the arrays that `from_columns` reads."""
        columns = {f"{name}.objects": self.objects, f"{name}.column": self.column} | self.shown.columns(f"{name}.shown")
        columns |= self.by_street.columns(f"{name}.by_street") | self.by_number.columns(f"{name}.by_number")
        return columns | self.streets.columns(f"{name}.streets")

    @classmethod
    def from_columns(cls, columns: Mapping[str, Column], name: str) -> "Addresses":
        """Restore the index from the arrays of `columns`."""
        by_street, by_number = (Postings.from_columns(columns, f"{name}.{kind}") for kind in ("by_street", "by_number"))
        streets = NameIndex.from_columns(columns, f"{name}.streets", are_streets=True)
        objects, column = columns[f"{name}.objects"], columns[f"{name}.column"]
        return cls(StringArray.from_columns(columns, f"{name}.shown"), objects, column, streets, by_street, by_number)

    def find(self, address: str) -> Ints:
        """Return the columns [k] that an address may mean; a number alone is looked up in all streets.

        A number that a street lacks means its nearest numbers on the same side; none past the end of the street.
        """
        words, columns = plain_words(address), list[int]()
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
                numbers = {
                    known: int(rows[0]) for known, rows in self.by_street.with_prefix(f"{street}{NUMBER_SEPARATOR}")
                }
                columns.extend([numbers[number]] if number in numbers else _nearest_numbers(number, numbers))
            if columns:
                return np.array(columns)
        return _NONE

    def _street(self, words: tuple[str, ...]) -> list[int]:
        """Return the streets of the longest prefix that names any; a town or a flat may follow."""
        for end in range(len(words), 0, -1):
            if len(streets := self.streets.find(" ".join(words[:end]))):
                return [int(street) for street in streets]
        return []


def _nearest_numbers(number: str, numbers: Mapping[str, int]) -> list[int]:
    """Return the columns of the nearest numbers on the same side; none past the end."""
    wanted = _digits(number)
    side = [(_digits(known), column) for known, column in numbers.items()]
    below = [value for value, _ in side if 0 <= value <= wanted and value % 2 == wanted % 2]
    above = [value for value, _ in side if value >= wanted and value % 2 == wanted % 2]
    nearest = {max(below), min(above)} if below and above else set[int]()
    return [column for value, column in side if value in nearest]


def _digits(number: str) -> int:
    """Return the leading digits of a house number; -1 without any."""
    digits = _NUMBER.match(number)
    return int(digits.group()) if digits else -1
