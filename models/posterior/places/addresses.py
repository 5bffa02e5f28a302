"""The addresses of a map as people write them: "350 W 42nd St", "Bulevardi 12 b"."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from models.citymap.gazetteer.name_columns import GazetteerObject
from models.citymap.points import Ints
from models.language.mentions.abbreviations import written_out
from models.language.mentions.house_numbers import match_number, number_alone, number_beside, plain_number
from models.language.mentions.name_table import NUMBER_SEPARATOR
from models.language.mentions.names import Word, split_words
from models.posterior.places.name_index import NameIndex
from models.strings import Column, Postings, StringArray

_HALF: Final = re.compile(r"(?<=\d) (?=\d/\d)")  # of "891 1/2"; the map's numbers have no blanks
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
        address = _HALF.sub("", address)
        alone = number_alone(address)
        if alone is not None:
            return self.by_number.find(plain_number(alone))
        words = split_words(address)
        for count in range(len(words), 0, -1):
            for first in range(len(words) - count + 1):
                part = words[first : first + count]
                number = number_beside(address, part[0].start, part[-1].end)
                columns = self._columns(number.number, part) if number is not None else []
                if columns:
                    return np.array(columns)
        letters = address.casefold()  # the map may have what is no number
        return np.array([n for n, shown in enumerate(self.shown[:]) if shown.casefold() == letters], np.int64)

    def _columns(self, number: str, street: Sequence[Word]) -> list[int]:
        """Return the columns of a number in the streets of a name."""
        name, columns = tuple(word.plain for word in street), list[int]()
        readings = (" ".join(words) for words in (name, *written_out(name)))
        rows = next((rows for reading in readings if len(rows := self.streets.find(reading))), _NONE)
        for row in rows.tolist():
            known = {one: int(n[0]) for one, n in self.by_street.with_prefix(f"{row}{NUMBER_SEPARATOR}")}
            match = match_number(number, known)
            if match is not None:
                neighbours = (one for _, numbers in match.between for one in numbers)
                columns += [known[one] for one in (*match.numbers, *neighbours)]
        return columns
