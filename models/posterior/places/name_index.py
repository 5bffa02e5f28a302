"""Look up the names of a map without case and accents, in other languages and in short forms of streets."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from models.citymap.points import Ints
from models.language.mentions.names import full_words, plain_words, street_forms
from models.strings import Column, Postings, StringArray


@dataclass(frozen=True, slots=True, eq=False)
class NameIndex:
    """An index of names; each has a column of a table."""

    are_streets: bool  # streets are also known by forms such as "W 25th St" and "25th"
    shown: StringArray  # [K] the name to show of each column
    column: Ints  # column of each object
    whole: Postings  # from plain names to columns
    part: Postings  # from other forms of a street's name to columns

    @classmethod
    def build(cls, names: Sequence[tuple[str, ...]], *, are_streets: bool) -> "NameIndex":
        """Build the index of objects by their names, the one to show first; equal first names share a column."""
        columns, shown = dict[str, int](), list[str]()
        column = [columns.setdefault(_plain(all_names[0], are_streets), len(columns)) for all_names in names]
        for all_names, number in zip(names, column, strict=True):
            if number == len(shown):
                shown.append(all_names[0])
        named = [(name, number) for all_names, number in zip(names, column, strict=True) for name in all_names]
        whole = Postings.from_pairs((_plain(name, are_streets), number) for name, number in named)
        part = Postings.from_pairs(_forms(named) if are_streets else ())
        return cls(are_streets, StringArray.from_strings(shown), np.array(column, np.int32), whole, part)

    def __len__(self) -> int:
        return len(self.shown)

    def find(self, name: str) -> Ints:
        """Return the columns [k] that a name may mean; short forms count only without a whole name."""
        plain = _plain(name, self.are_streets)
        return self.whole.find(plain) if plain in self.whole else self.part.find(plain)

    def columns(self, name: str) -> dict[str, Column]:
        """Return the arrays that `from_columns` reads."""
        columns = {f"{name}.column": self.column} | self.shown.columns(f"{name}.shown")
        return columns | self.whole.columns(f"{name}.whole") | self.part.columns(f"{name}.part")

    @classmethod
    def from_columns(cls, columns: Mapping[str, Column], name: str, *, are_streets: bool) -> "NameIndex":
        """Restore the index from the arrays of `columns`."""
        whole, part = (Postings.from_columns(columns, f"{name}.{kind}") for kind in ("whole", "part"))
        shown = StringArray.from_columns(columns, f"{name}.shown")
        return cls(are_streets, shown, columns[f"{name}.column"], whole, part)


def _plain(name: str, are_streets: bool) -> str:
    """Normalize a name; one without letters and digits stays as it is."""
    words = plain_words(name)
    return " ".join(full_words(words) if are_streets else words) or name


def _forms(named: Sequence[tuple[str, int]]) -> Iterator[tuple[str, int]]:
    for name, number in named:
        for form, _ in street_forms(name):
            yield " ".join(form), number
