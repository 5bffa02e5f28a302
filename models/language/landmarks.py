"""Proper names of a map in a text: shops, streets, stations."""

import re
from collections.abc import Sequence

SHORTEST = 4  # characters; shorter names are words too often


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
