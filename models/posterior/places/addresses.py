"""The house numbers of a map as people say them: "350 W 42nd St", "Bulevardi 12 b"."""

import re
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from models.city.gazetteer.gazetteer import Words
from models.city.points import Ints
from models.language.places.names import plain_words
from models.language.places.streets import ORDINAL
from models.posterior.places.spelt import Spelt

_NUMBER: Final = re.compile(r"\d+")
_NONE: Final = np.zeros(0, np.int64)


class Addresses:
    """Columns of a table, one an address, and what they are found by.

    Args:
        words: of each object; those without number or street have no address, those with several have as many.

    Attributes:
        shown: [K] "350 West 42nd Street".
        objects: [E] the object of each address of one.
        column: [E] its column; objects of one address share it.
    """

    def __init__(self, words: Sequence[Words]) -> None:
        rows = [
            (n, number.replace(" ", ""), some.street)
            for n, some in enumerate(words)
            if some.street
            for number in some.numbers
        ]
        self._streets = Spelt([(street,) for _, _, street in rows], are_streets=True)
        self.objects: Ints = np.array([n for n, _, _ in rows], np.int64)
        self._by_street: dict[int, dict[str, int]] = {}
        column, shown = [], list[str]()
        for (_, number, street), of in zip(rows, self._streets.column.tolist(), strict=True):
            numbers = self._by_street.setdefault(of, {})
            if number not in numbers:
                numbers[number] = len(shown)
                shown.append(f"{number} {street}")
            column.append(numbers[number])
        self.column: Ints = np.array(column, np.int64)
        self.shown = tuple(shown)

    def __len__(self) -> int:
        return len(self.shown)

    def find(self, said: str) -> Ints:
        """[k] the columns that somebody may mean: of a number without a street, in all streets.

        A number that a street has not is the same with another letter, or else those beside it; none past its end.
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
                return np.array([of[number] for of in self._by_street.values() if number in of], np.int64)
            for street in streets or self._street(before):
                numbers = self._by_street[street]
                found.extend([numbers[number]] if number in numbers else _beside(number, numbers))
            if found:
                return np.array(found)
        return _NONE

    def _street(self, said: tuple[str, ...]) -> list[int]:
        """The streets of the longest words that name some; what follows may be a town or a flat."""
        for end in range(len(said), 0, -1):
            if len(streets := self._streets.find(" ".join(said[:end]))):
                return [int(street) for street in streets]
        return []


def _beside(number: str, numbers: Mapping[str, int]) -> list[int]:
    """The columns of a street's numbers that are nearest to one, on its side; none past the end."""
    wanted = _digits(number)
    side = [(_digits(known), column) for known, column in numbers.items()]
    below = [value for value, _ in side if 0 <= value <= wanted and value % 2 == wanted % 2]
    above = [value for value, _ in side if value >= wanted and value % 2 == wanted % 2]
    nearest = {max(below), min(above)} if below and above else set[int]()
    return [column for value, column in side if value in nearest]


def _digits(number: str) -> int:
    """The number that a house number begins with; -1 if it begins with none."""
    found = _NUMBER.match(number)
    return int(found.group()) if found else -1
