"""Chains of shops, restaurants and the like, by any spelling of their names."""

import re
import unicodedata
from collections.abc import Iterable, Mapping
from typing import Final

_SEPARATORS: Final = re.compile(r"[\W_]+")


def normalize_name(name: str) -> str:
    """A name without case, accents, spaces and punctuation; "&" is "and"."""
    letters = unicodedata.normalize("NFKD", name.casefold().replace("&", "and"))
    return _SEPARATORS.sub("", letters)


class Brands:
    """Brands by their spellings.

    Args:
        tags: sets of tags that brands have.
        brands: of each brand the places of its tags in `tags`, and its spellings, the usual one first.
    """

    def __init__(self, tags: list[dict[str, str]], brands: Iterable[tuple[list[int], list[str]]]) -> None:
        self._tags = tags
        self._brands = list(brands)
        self._by_spelling: dict[str, list[int]] = {}
        for place, (_, spellings) in enumerate(self._brands):
            for spelling in spellings:
                self._by_spelling.setdefault(normalize_name(spelling), []).append(place)

    def tags(self, name: str) -> list[Mapping[str, str]]:
        """The sets of tags that places of a brand have; none if it is unknown."""
        found = [self._tags[number] for place in self._places(name) for number in self._brands[place][0]]
        return [tags for number, tags in enumerate(found) if tags not in found[:number]]

    def spellings(self, name: str) -> tuple[str, ...]:
        """The other spellings of a brand; none if it is unknown."""
        found = dict.fromkeys(spelling for place in self._places(name) for spelling in self._brands[place][1])
        return tuple(spelling for spelling in found if normalize_name(spelling) != normalize_name(name))

    def _places(self, name: str) -> list[int]:
        """Where the brands of a name are; those whose usual spelling it is come first, others only without them."""
        form = normalize_name(name)
        places = self._by_spelling.get(form, [])
        usual = [place for place in places if normalize_name(self._brands[place][1][0]) == form]
        return usual or places
