"""Chains of shops, restaurants and the like, found by any spelling of their names."""

import re
import unicodedata
from collections.abc import Sequence
from typing import Final

_SEPARATORS: Final = re.compile(r"[\W_]+")


def normalize_name(name: str) -> str:
    """Return a name without case, accents, spaces and punctuation; "&" becomes "and"."""
    letters = unicodedata.normalize("NFKD", name.casefold().replace("&", "and"))
    return _SEPARATORS.sub("", letters)


class Brands:
    """Brands, found by any of their spellings, of which the usual one is first."""

    def __init__(self, brands: Sequence[Sequence[str]]) -> None:
        self._brands = brands
        self._by_spelling: dict[str, list[int]] = {}
        for row, spellings in enumerate(self._brands):
            for spelling in spellings:
                self._by_spelling.setdefault(normalize_name(spelling), []).append(row)

    def spellings(self, name: str) -> tuple[str, ...]:
        """Return the other spellings of a brand; empty if it is unknown."""
        all_spellings = dict.fromkeys(spelling for row in self._rows(name) for spelling in self._brands[row])
        return tuple(spelling for spelling in all_spellings if normalize_name(spelling) != normalize_name(name))

    def _rows(self, name: str) -> list[int]:
        """Return the rows of the brands of a name; those whose usual spelling it is exclude the others."""
        form = normalize_name(name)
        rows = self._by_spelling.get(form, [])
        with_usual_spelling = [row for row in rows if normalize_name(self._brands[row][0]) == form]
        return with_usual_spelling or rows
