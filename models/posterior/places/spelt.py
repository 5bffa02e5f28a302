"""The names of a map as people spell them: without case and accents, in other languages, a street's in short."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Final

import numpy as np

from models.city.points import Ints
from models.language.places.names import plain_words
from models.language.places.streets import forms_of, full_words

_NONE: Final = np.zeros(0, np.int64)


class Spelt:
    """Columns of a table, one a name, and what they are found by.

    Args:
        names: of each object all its names, the one to show first; objects whose first are alike share a column.
        are_streets: whether they are of streets, which are also known by forms such as "W 25th St" and "25th".

    Attributes:
        shown: [K] the name to show of each column.
        column: [objects] of each.
    """

    def __init__(self, names: Sequence[tuple[str, ...]], *, are_streets: bool) -> None:
        self._are_streets = are_streets
        columns = dict[str, int]()
        self.column: Ints = np.array([columns.setdefault(self._plain(some[0]), len(columns)) for some in names], int)
        shown = dict[int, str]()
        for some, column in zip(names, self.column.tolist(), strict=True):
            shown.setdefault(column, some[0])
        self.shown = tuple(shown.values())
        self._whole = _found((self._plain(name), n) for some, n in self._rows(names) for name in some)
        forms = ((" ".join(form), n) for some, n in self._rows(names) for name in some for form, _ in forms_of(name))
        self._part = _found(forms) if are_streets else {}

    def __len__(self) -> int:
        return len(self.shown)

    def find(self, name: str) -> Ints:
        """[k] the columns that a name may mean, whole names before parts of them; none if the map has not got it."""
        plain = self._plain(name)
        return self._whole.get(plain, self._part.get(plain, _NONE))

    def _rows(self, names: Sequence[tuple[str, ...]]) -> Iterator[tuple[tuple[str, ...], int]]:
        return zip(names, self.column.tolist(), strict=True)

    def _plain(self, name: str) -> str:
        """In one form; as it stands where it has neither letter nor digit."""
        words = plain_words(name)
        return " ".join(full_words(words) if self._are_streets else words) or name


def _found(pairs: Iterable[tuple[str, int]]) -> Mapping[str, Ints]:
    found = dict[str, dict[int, None]]()
    for plain, number in pairs:
        found.setdefault(plain, {})[number] = None
    return {plain: np.array(list(numbers)) for plain, numbers in found.items()}
