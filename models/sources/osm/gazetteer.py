"""Reader: OpenStreetMap -> Gazetteer (docs/formats.md, index directory)."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import osmium
import shapely

from models.citymap.frame import Frame
from models.citymap.gazetteer.gazetteer import ADDRESS, WALKED, Gazetteer, Objects, joined_segments
from models.citymap.gazetteer.name_columns import STREET, Words
from models.citymap.gazetteer.streets import Pieces, Ways, join_streets
from models.citymap.kinds.vocabulary import Vocabulary, load_vocabulary
from models.citymap.types import Floats
from models.sources.osm.map import batches_of, geometries, reading, source_id
from models.spool import Spool

NAME_KEYS = (
    "name",
    "name:en",
    "brand",
    "short_name",
    "alt_name",
    "official_name",
    "old_name",
    "loc_name",
    "addr:housename",
)
NO_STREETS = frozenset(("proposed", "construction", "bus_stop", "street_lamp", "platform", "elevator", "corridor"))
OPERATED = frozenset(("amenity", "shop", "office", "tourism", "leisure", "healthcare"))  # known by who runs them
UNBUILT = frozenset(("proposed", "construction"))
UNNAMED_WAYS = frozenset(("steps", "pedestrian", "cycleway"))  # what lines without a name are taken of
WALKED_ON = frozenset(
    (
        "footway", "pedestrian", "path", "steps", "living_street", "residential", "unclassified", "tertiary",
        "secondary", "primary", "service", "cycleway",
    )
)  # fmt: skip
SIMPLER_M = 0.5  # how far a geometry may be from the one that is mapped
MOST_NAMES = 12
_WALKED = Words((WALKED,))
_LANGUAGE = re.compile(r"(?:alt_|official_|short_|old_)?name:[a-z]{2,3}(?:[-_][A-Za-z]+)?")


@dataclass(frozen=True, slots=True)
class _Found:
    wkb: str
    words: Words
    is_area: bool
    nodes: dict[int, tuple[float, float]]  # of a piece of a street, by number: longitude and latitude


def load_gazetteer(path: Path, frame: Frame) -> Gazetteer:
    """Everything of an OpenStreetMap file that a passer-by could name.

    Args:
        path: the file that the map was read from.
        frame: of the map.

    Raises:
        MapError: it cannot be read.
    """
    objects, pieces, walked = Objects(), Pieces(), Spool()
    walked.add({"segments_m": joined_segments([])})
    for some in _read_some(path):
        found = list(zip(some, _segments_of(some, frame), strict=True))
        pieces.add([_piece(one, segments, frame) for one, segments in found if one.nodes])
        walked.add({"segments_m": joined_segments([segments for one, segments in found if one.words is _WALKED])})
        others = [(one, segments) for one, segments in found if not one.nodes and one.words is not _WALKED]
        objects.add([one.words for one, _ in others], [of for _, of in others], [one.is_area for one, _ in others])
    streets = join_streets(pieces, len(objects))
    objects.add(streets.words, streets.segments_m, [False] * len(streets.words))
    lines = walked.columns()["segments_m"]
    if len(lines) and len(objects):
        objects.add([_WALKED], [lines], [False])
    return objects.gazetteer((streets.corner_streets, streets.corners_m))


def _read_some(path: Path) -> Iterator[list[_Found]]:
    with reading(path):
        yield from batches_of(_read(osmium.FileProcessor(str(path)).with_areas(), load_vocabulary()))


def _read(processor: Any, vocabulary: Vocabulary) -> Iterator[_Found]:
    create = geometries()
    for element in processor:
        form = element.type_str()
        if form not in create or not element.tags:
            continue
        tags = {tag.k: tag.v for tag in element.tags}
        if form == "w" and tags.get("highway") in WALKED_ON and tags.get("indoor") != "yes":
            yield from _found(element, create, "w", _WALKED)
        is_street = form == "w" and "highway" in tags and tags["highway"] not in NO_STREETS and _named(tags)
        if form == "w" and not is_street and element.is_closed() and not _is_line(tags):
            continue  # it comes again as an area
        if is_street and (tags.get("indoor") == "yes" or tags.get("level", "0").startswith("-")):
            continue
        if form == "a" and (_is_line(tags) or tags.get("indoor") == "room"):
            continue
        words = _street(tags, element) if is_street else _words(tags, vocabulary, source_id(element, form))
        if words is None:
            continue
        nodes = {n.ref: (n.lon, n.lat) for n in element.nodes if n.location.valid()} if is_street else {}
        yield from _found(element, create, form, words, nodes)


def _found(
    element: Any, create: dict[str, Any], form: str, words: Words, nodes: dict[int, tuple[float, float]] | None = None
) -> Iterator[_Found]:
    try:
        yield _Found(create[form](element), words, form == "a", nodes or {})
    except (osmium.InvalidLocationError, RuntimeError):
        return  # nodes left out by the extract, or a broken ring


def _named(tags: dict[str, str]) -> bool:
    return any(key in tags for key in NAME_KEYS if key != "brand")


def _is_line(tags: dict[str, str]) -> bool:
    """Whether a closed way is a loop, not an area."""
    return ("highway" in tags and tags.get("area") != "yes") or ("barrier" in tags and len(tags) < 3)


def _street(tags: dict[str, str], element: Any) -> Words:
    return Words((STREET,), _names(tags), source_id=f"way/{element.id}")


def _words(tags: dict[str, str], vocabulary: Vocabulary, source_id: str) -> Words | None:
    """What is written of an object; None of what nobody would name."""
    if tags.get("highway") in UNBUILT:
        return None
    if (
        "highway" in tags
        and tags["highway"] not in UNNAMED_WAYS
        and source_id.startswith("way/")
        and "name" not in tags
    ):
        return None
    kinds, names = vocabulary.kinds_of(tags), _names(tags)
    number, street = tags.get("addr:housenumber"), tags.get("addr:street") or tags.get("addr:place")
    if not kinds and number and street:
        kinds = (ADDRESS,)
    if not kinds and not (names and not {"type", "route", "boundary", "addr:interpolation"} & tags.keys()):
        return None
    if kinds == ("building",) and not names and not number:
        return None  # any house; what it looks like is in the cells
    return Words(kinds, names, number, street, source_id)


def _names(tags: dict[str, str]) -> tuple[str, ...]:
    """All names of an object, each once, the one to show first."""
    keys = [*NAME_KEYS, *sorted(key for key in tags if _LANGUAGE.fullmatch(key))]
    found = [part.strip() for key in keys if key in tags for part in tags[key].split(";")]
    if not found and "operator" in tags and OPERATED & tags.keys():
        found = [tags["operator"]]
    return tuple(dict.fromkeys(name for name in found if name))[:MOST_NAMES]


def _segments_of(found: Sequence[_Found], frame: Frame) -> Iterator[Floats]:
    """[n, 4] the segments of each, metres."""
    lon_lat = shapely.from_wkb([one.wkb for one in found])
    shapes = shapely.transform(lon_lat, lambda xy: frame.from_wgs84(xy[:, 1], xy[:, 0]))
    return map(_segments, shapely.simplify(shapes, SIMPLER_M, preserve_topology=True))


def _segments(shape: shapely.Geometry) -> Floats:
    """[n, 4] the segments of a geometry's lines, rings and points."""
    parts = shapely.get_parts(shape)
    if shapely.get_dimensions(shape) == 2:
        parts = shapely.get_rings(parts)
    if shapely.get_dimensions(shape) == 0:
        points = shapely.get_coordinates(parts)
        return np.concatenate([points, points], axis=1)
    xy, line = shapely.get_coordinates(parts, return_index=True)
    goes_on = line[1:] == line[:-1]
    segments: Floats = np.concatenate([xy[:-1], xy[1:]], axis=1)[goes_on]
    return segments


def _piece(found: _Found, segments_m: Floats, frame: Frame) -> Ways:
    lon, lat = np.array(list(found.nodes.values())).T
    return Ways(found.words, np.array(list(found.nodes)), segments_m, frame.from_wgs84(lat, lon))
