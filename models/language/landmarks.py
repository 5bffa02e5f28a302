"""Proper names of a map in a text: shops, streets, stations."""

import re
import unicodedata
from collections.abc import Sequence

from rapidfuzz import fuzz, process

SHORTEST = 4  # characters; shorter names are words too often
SHORTEST_MISSPELT = 6  # of these, one letter in six may be wrong
LIKE = 85.0  # of 100, rapidfuzz.fuzz.ratio


class Landmarks:
    """The names of a map's instances, found in texts whole, whatever their case.

    Args:
        names: of each instance, None for those without.
    """

    def __init__(self, names: Sequence[str | None]) -> None:
        self._instances: dict[str, list[int]] = {}
        for number, name in enumerate(names):
            if name and len(name) >= SHORTEST and not name.isdigit():
                self._instances.setdefault(name.casefold(), []).append(number)
        self._plain = [_plain(name) for name in self._instances]
        longest_first = sorted(self._instances, key=len, reverse=True)
        self._pattern = (
            re.compile(rf"(?<!\w)(?:{'|'.join(map(re.escape, longest_first))})(?!\w)") if longest_first else None
        )

    def find(self, text: str) -> list[tuple[int, int, list[int]]]:
        """(start, end, instances) of each name in a text, in its order."""
        folded = text.casefold()
        if self._pattern is None or len(folded) != len(text):
            return []
        return [(m.start(), m.end(), self._instances[m[0]]) for m in self._pattern.finditer(folded)]

    def meant_by(self, noun: str) -> list[int]:
        """Instances whose name a noun is or holds; else those whose name it is but for a letter or an accent."""
        found = self.find(noun)
        if found:
            return [number for _, _, instances in found for number in instances]
        plain = _plain(noun)
        if len(plain) < SHORTEST_MISSPELT:
            return []
        like = process.extractOne(plain, self._plain, scorer=fuzz.ratio, score_cutoff=LIKE)
        return [] if like is None else list(self._instances.values())[like[2]]


def _plain(name: str) -> str:
    """A name in lower case, without accents and its article."""
    letters = unicodedata.normalize("NFKD", name.casefold())
    return "".join(c for c in letters if not unicodedata.combining(c)).removeprefix("the ").strip()
