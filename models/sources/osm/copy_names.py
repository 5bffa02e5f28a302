"""Names in the copies of a tiled city: streets get new ones, other objects swap names within their kind."""

import re
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from models.sources.osm.gazetteer import NON_STREET_HIGHWAYS

# The first of these keys that an element has is its kind.
MAIN_KEYS: Final = (
    "amenity", "shop", "tourism", "office", "leisure", "healthcare", "craft", "historic", "club", "public_transport",
    "railway", "highway", "natural", "waterway", "man_made", "building", "landuse", "boundary", "place", "route",
    "type",
)  # fmt: skip
STREET_RELATIONS: Final = ("street", "associatedStreet")
STREET_KEY: Final = re.compile(r".*:street|addr:place")  # keys whose values are names of streets
TRANSLATED_STREET_KEY: Final = re.compile(r"addr:(?:street|place):.+")
NAME_KEY: Final = re.compile(r"(?:.*[:_])?name(?::.*)?|brand(?::.*)?")
SYLLABLES: Final = tuple(c + v for c in "bdfghjklmnprstvz" for v in "aeiou")
SYLLABLES_PER_NAME: Final = 4
NAME_STEP: Final = 15_485_863  # coprime to the number of words, so that no two numbers share a name

Tags = dict[str, str]
Element = tuple[str, int]  # osmium's letter and the number
Kind = tuple[str, str]


@dataclass(frozen=True, slots=True)
class ExtractNames:
    """The names of an extract, collected element by element."""

    streets: dict[str, int] = field(default_factory=dict)  # numbers of streets by name in lower case
    # Name tags of other objects, by kind (main key and value)
    others: dict[Kind, dict[Element, Tags]] = field(default_factory=dict)

    def add(self, element: Element, tags: Mapping[str, str]) -> None:
        """Add the names of one element."""
        for key, value in tags.items():
            if _is_street_key(key):
                self._add_street(value)
        name_tags = _name_tags(tags)
        if name_tags and is_street(element, tags):
            self._add_street(_street_name(name_tags))
        elif name_tags:
            self.others.setdefault(_main_tag(tags), {})[element] = name_tags

    def _add_street(self, name: str) -> None:
        self.streets.setdefault(name.casefold(), len(self.streets))

    def in_copy(self, copy: int) -> "CopyNames":
        """Return the names of a copy, from 1 on; its number seeds which objects swap names."""
        swapped: dict[Element, Tags] = {}
        for kind, named in self.others.items():
            rng = np.random.default_rng([copy, zlib.crc32("=".join(kind).encode())])
            order, bundles = rng.permutation(len(named)), list(named.values())
            swapped.update({element: bundles[n] for element, n in zip(named, order.tolist(), strict=True)})
        return CopyNames(self, copy, swapped)


@dataclass(frozen=True, slots=True)
class CopyNames:
    """The names in a copy."""

    names: ExtractNames  # of the extract
    copy: int  # its number, from 1
    swapped: dict[Element, Tags]  # the name tags of each object in this copy

    def tags(self, element: Element, tags: Tags) -> Tags:
        """Return the tags of an element in this copy; `element` is as in the extract."""
        name_tags = _name_tags(tags)
        copied = {
            key: self.street(value) if _is_street_key(key) else value
            for key, value in tags.items()
            if key not in name_tags and not TRANSLATED_STREET_KEY.fullmatch(key)
        }
        if name_tags and is_street(element, tags):
            return copied | {"name": self.street(_street_name(name_tags))}
        return copied | self.swapped[element] if name_tags else copied

    def street(self, name: str) -> str:
        """Return the made-up name of a street of the extract; no other street of any copy has it."""
        number = (self.copy - 1) * len(self.names.streets) + self.names.streets[name.casefold()]
        return f"{_made_up_word(number)} Street"


def is_street(element: Element, tags: Mapping[str, str]) -> bool:
    """Whether a named element is (a piece of) a street or a square that addresses can refer to."""
    if element[0] == "n":
        return False
    is_way = tags.get("highway", "bus_stop") not in NON_STREET_HIGHWAYS
    return is_way or tags.get("place") == "square" or tags.get("type") in STREET_RELATIONS


def _is_street_key(key: str) -> bool:
    return key != "ref:street" and STREET_KEY.fullmatch(key) is not None


def _name_tags(tags: Mapping[str, str]) -> Tags:
    """Return the tags with names of an element, in any language, and of its chain."""
    return {key: value for key, value in tags.items() if NAME_KEY.fullmatch(key)}


def _street_name(name_tags: Tags) -> str:
    return name_tags.get("name") or next(iter(name_tags.values()))


def _main_tag(tags: Mapping[str, str]) -> Kind:
    key = next((key for key in MAIN_KEYS if key in tags), "")
    return key, tags.get(key, "")


def _made_up_word(number: int) -> str:
    rest, word = number * NAME_STEP % len(SYLLABLES) ** SYLLABLES_PER_NAME, ""
    for _ in range(SYLLABLES_PER_NAME):
        rest, syllable = divmod(rest, len(SYLLABLES))
        word += SYLLABLES[syllable]
    return word.capitalize()
