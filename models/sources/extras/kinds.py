"""The kind of the objects in a file: tags of OpenStreetMap, or a word that becomes a label of its own."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import shapely

from models.citymap.gazetteer.gazetteer import ADDRESS_KIND, WALKED_KIND
from models.citymap.gazetteer.name_columns import STREET_KIND
from models.citymap.kinds.matching import ANY_VALUE, Kind
from models.citymap.kinds.vocabulary import load_vocabulary
from models.errors import DataError
from models.sources.osm.classes import OsmClass, find_class

# Keys whose meaning of a value counts first ("fountain" is amenity=fountain, not waterway=fountain); buildings last
KEYS: Final = (
    "amenity", "shop", "leisure", "tourism", "highway", "natural", "man_made", "emergency", "public_transport",
    "railway", "barrier", "healthcare", "office", "craft", "historic",
)  # fmt: skip
STREETS: Final = frozenset(
    (
        "motorway", "trunk", "primary", "secondary", "tertiary", "unclassified", "residential", "living_street",
        "pedestrian", "service", "road", "track", "footway", "path", "steps", "cycleway", "bridleway", "corridor",
    )
)  # fmt: skip
RESERVED: Final = (ADDRESS_KIND, STREET_KIND, WALKED_KIND)
LABEL: Final = re.compile(r"[^\W_](?:[\w' -]{0,38}[^\W_])?")
LABEL_HEIGHT_M: Final = 1.0  # of objects whose class is not in classes.toml
ADVICE: Final = "give a value of OpenStreetMap (waste_basket), a tag (amenity=waste_basket) or a plain word"


@dataclass(frozen=True, slots=True)
class ObjectKind:
    """The kind of all objects of a file."""

    tags: Mapping[str, str]  # empty for a label of its own
    label: str | None = None  # None if tags give the label

    def __str__(self) -> str:
        """Return the tags, or the label."""
        return self.label or ", ".join(f"{key}={value}" for key, value in self.tags.items())

    @classmethod
    def parse(cls, text: str) -> "ObjectKind":
        """Parse "waste_basket", "amenity=waste_basket", "waste basket" or any other word.

        Raise DataError if it is an unknown tag, a street, or no word.
        """
        key, equals, value = (part.strip() for part in text.partition("="))
        if equals:
            tags = {key: value}
            if not load_vocabulary().kinds_of(tags) and find_class(tags) is None:
                raise DataError(f"--kind {text}: no such kind is known; {ADVICE}")
        else:
            forms = (text, text.removesuffix("s"), text.removesuffix("es"))
            known = next(filter(None, map(_known_kind, forms)), None)
            if known is None:
                return cls._of_label(text)
            tags = {key: "yes" if value == ANY_VALUE else value for key, value in known.tags.items()}
        if tags.get("highway") in STREETS:
            raise DataError(f"--kind {text}: streets and paths are read from the map; give another kind")
        return cls(tags)

    @classmethod
    def _of_label(cls, text: str) -> "ObjectKind":
        label = " ".join(text.replace("_", " ").lower().split())
        if not LABEL.fullmatch(label) or label in RESERVED:
            raise DataError(f"--kind {text[:80]!r}: not a kind; {ADVICE}")
        return cls({}, label)

    def osm_class(self, geometry: shapely.Geometry) -> OsmClass | None:
        """Return the class of an object; None if passers-by know it by its name or kind alone, such as a shop."""
        row = find_class(self.tags)
        if row is None and self.label is None:
            return None
        dimensions = int(shapely.get_dimensions(geometry))
        if row is not None and (row[1].shape in SHAPES[dimensions]):
            return row[1]
        # The class is drawn for another geometry: a playground that is a point, a row of lamps that is a line
        label, height_m = (self.label or "", 0.0) if row is None else (row[1].label, row[1].height_m)
        return OsmClass(label, "wall" if dimensions else "box", (), height_m or LABEL_HEIGHT_M)


SHAPES: Final = {0: ("column", "crown", "box"), 1: ("wall", "ground"), 2: ("outline", "wall", "ground", "box")}


def _known_kind(text: str) -> Kind | None:
    """Return the kind of a value of OpenStreetMap, or that a noun means; None if it is unknown."""
    vocabulary = load_vocabulary()
    value, noun = "_".join(text.lower().split()), " ".join(text.replace("_", " ").casefold().split())
    meant = {kind for kind, weight in vocabulary.nouns().get(noun, ()) if weight == 1.0}
    kinds = [kind for kind in vocabulary.kinds if list(kind.tags.values()) == [value]]
    kinds += [kind for kind in vocabulary.kinds if kind.id in meant]
    return min(kinds, key=_key_rank, default=None)


def _key_rank(kind: Kind) -> int:
    first = kind.id.partition("/")[0]
    return KEYS.index(first) if first in KEYS else len(KEYS) + (first == "building")
