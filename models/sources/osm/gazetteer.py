"""Read the gazetteer of an OpenStreetMap file (docs/formats.md, index directory)."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain
from math import cos, radians
from pathlib import Path
from typing import Any

import numpy as np
import osmium
import shapely
import shapely.affinity

from models.citymap.frame import Frame
from models.citymap.gazetteer.gazetteer import (
    ADDRESS_KIND,
    WALKED_KIND,
    Gazetteer,
    GazetteerBuilder,
    concatenate_segments,
)
from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject
from models.citymap.gazetteer.streets import StreetPiece, StreetPieces, join_streets
from models.citymap.kinds.vocabulary import Vocabulary, load_vocabulary
from models.citymap.types import Floats
from models.sources.extras.layer import ExtraLayer
from models.sources.osm.addresses import read_address, read_codes, read_streets, with_street
from models.sources.osm.extent import MAX_SIDE_KM
from models.sources.osm.incomplete import IncompleteAreas, known_line
from models.sources.osm.ordering import ordered_file
from models.sources.osm.reading import batched, explained_errors, geometry_factories, located_elements, source_id
from models.sources.osm.reading_counts import ReadingCounts
from models.sources.osm.tags import read_tags
from models.spool import Spool

NAME_KEYS = (
    "name", "name:en", "brand", "short_name", "alt_name", "official_name", "old_name", "loc_name",
)  # fmt: skip
METERS_PER_DEGREE = 111_200.0  # of latitude
HOUSE_NAME_KEY = "addr:housename"  # an address for those in the house: the name of a building without another
# Settlements and districts that are points in the map become circles. Radii in metres, set by hand
DISTRICT_RADII_M = {
    "city": 4000.0, "town": 1500.0, "borough": 1500.0, "suburb": 700.0, "village": 600.0, "quarter": 400.0,
    "neighbourhood": 300.0, "hamlet": 250.0, "locality": 150.0, "isolated_dwelling": 100.0,
}  # fmt: skip
NON_STREET_HIGHWAYS = frozenset(
    ("proposed", "construction", "bus_stop", "street_lamp", "platform", "elevator", "corridor")
)
# Without a name, an object with one of these is known by its operator
OPERATOR_NAMED_KEYS = frozenset(("amenity", "shop", "office", "tourism", "leisure", "healthcare"))
UNBUILT_HIGHWAYS = frozenset(("proposed", "construction"))
UNNAMED_HIGHWAYS = frozenset(("steps", "pedestrian", "cycleway"))  # streets without a name are left out, except these
WALKED_HIGHWAYS = frozenset(
    (
        "footway", "pedestrian", "path", "steps", "living_street", "residential", "unclassified", "tertiary",
        "secondary", "primary", "service", "cycleway",
    )
)  # fmt: skip
PLACES_WITH_OUTLINE = frozenset(("square", "city_block", "islet", "plot"))  # values of "place"
CUT_REASON = "a part is not in the file"
SIMPLIFY_TOLERANCE_M = 0.5  # greatest distance of a geometry from the mapped one
ROAD_REF_HIGHWAYS = frozenset(("motorway", "trunk", "primary", "secondary"))  # known by their reference if unnamed
MAX_NAMES = 12  # of an object; some have a name in each of a hundred languages
_WALKED_OBJECT = GazetteerObject((WALKED_KIND,))
_LANGUAGE = re.compile(r"(?:alt_|official_|short_|old_)?name:[a-z]{2,3}(?:[-_][A-Za-z]+)?")


@dataclass(frozen=True, slots=True)
class _OsmObject:
    wkb: str
    object: GazetteerObject
    is_area: bool
    nodes: dict[int, tuple[float, float]]  # of a piece of a street, by id: longitude and latitude


def load_gazetteer(
    path: Path, frame: Frame, counts: ReadingCounts | None = None, extras: Sequence[ExtraLayer] = ()
) -> Gazetteer:
    """Read all objects of a map's file that a passer-by could name; raise MapError if it cannot be read.

    `counts` are increased, and `extras` join.
    """
    with ordered_file(path) as ordered:
        return _load_gazetteer(ordered, frame, counts or ReadingCounts(), extras)


def _load_gazetteer(path: Path, frame: Frame, counts: ReadingCounts, extras: Sequence[ExtraLayer]) -> Gazetteer:
    objects, pieces, walked = GazetteerBuilder(), StreetPieces(), Spool()
    walked.add({"segments_m": concatenate_segments([])})
    for batch in chain(_read_batches(path, counts), batched(_extra_objects(extras))):
        with_segments = _with_segments(batch, frame)
        pieces.add([_street_piece(item, segments, frame) for item, segments in with_segments if item.nodes])
        lines = [segments for item, segments in with_segments if item.object is _WALKED_OBJECT]
        walked.add({"segments_m": concatenate_segments(lines)})
        others = [row for row in with_segments if not row[0].nodes and row[0].object is not _WALKED_OBJECT]
        objects.add([i.object for i, _ in others], [segments for _, segments in others], [i.is_area for i, _ in others])
    streets = join_streets(pieces, len(objects))
    objects.add(streets.objects, streets.segments_m, [False] * len(streets.objects))
    walked_m = walked.columns()["segments_m"]
    if len(walked_m) and len(objects):
        objects.add([_WALKED_OBJECT], [walked_m], [False])
    return objects.build((streets.corner_streets, streets.corners_m))


def _read_batches(path: Path, counts: ReadingCounts) -> Iterator[list[_OsmObject]]:
    with explained_errors(path), located_elements(path) as processor:
        yield from batched(_read(processor.with_areas(), path, load_vocabulary(), counts))


def _read(processor: Any, path: Path, vocabulary: Vocabulary, counts: ReadingCounts) -> Iterator[_OsmObject]:
    create, incomplete, streets = geometry_factories(), IncompleteAreas(), read_streets(path)
    for element in processor:
        form = element.type_str()
        if not element.tags:
            continue
        tags = with_street(read_tags(element.tags), source_id(element, form), streets)
        if form == "w" and tags.get("highway") in WALKED_HIGHWAYS and tags.get("indoor") != "yes":
            yield from _with_geometry(element, create, "w", _WALKED_OBJECT)
        is_street = form == "w" and _is_street(tags)
        if form == "a":
            incomplete.note_area(element)
        if form == "r" or (form == "w" and element.is_closed() and not _is_line(tags)):
            incomplete.expect(element, tags)
            if not is_street:
                continue  # osmium yields it again as an area
        if is_street and (tags.get("indoor") == "yes" or tags.get("level", "0").startswith("-")):
            continue
        if form == "a" and not _is_outdoor_area(tags):
            continue
        item = _street_object(tags, element) if is_street else _object(tags, vocabulary, source_id(element, form))
        if item is None:
            continue
        nodes = {n.ref: (n.lon, n.lat) for n in element.nodes if n.location.valid()} if is_street else {}
        placed = list(_with_geometry(element, create, form, item, nodes, counts))
        if placed and item.names:
            counts.add_names(item.names[0], tags)
        yield from placed
    yield from _read_incomplete(incomplete, path, vocabulary, counts)


def _read_incomplete(
    incomplete: IncompleteAreas, path: Path, vocabulary: Vocabulary, counts: ReadingCounts
) -> Iterator[_OsmObject]:
    for area in incomplete.read(path):
        item = _object(area.tags, vocabulary, area.source_id) if _is_outdoor_area(area.tags) else None
        if item is None:
            continue
        if _is_region(area.tags) and not area.is_area:
            counts.dropped["too little of the border is in the file to tell what is inside"] += 1
            continue
        if area.is_cut:
            counts.cut[CUT_REASON] += 1
        else:
            counts.repaired["the outline crosses itself or is open"] += 1
        if item.names:
            counts.add_names(item.names[0], area.tags)
        yield _OsmObject(shapely.to_wkb(area.shape, hex=True), item, area.is_area, {})


def _extra_objects(extras: Sequence[ExtraLayer]) -> Iterator[_OsmObject]:
    """Yield the objects of a city's own data."""
    vocabulary = load_vocabulary()
    for item in chain.from_iterable(layer.objects for layer in extras):
        known = _object(dict(item.tags), vocabulary, item.source_id, item.label)
        if known is not None:
            is_area = shapely.get_dimensions(item.geometry) == 2
            yield _OsmObject(shapely.to_wkb(item.geometry, hex=True), known, is_area, {})


def _with_geometry(
    element: Any,
    create: dict[str, Any],
    form: str,
    item: GazetteerObject,
    nodes: dict[int, tuple[float, float]] | None = None,
    counts: ReadingCounts | None = None,
) -> Iterator[_OsmObject]:
    """Yield an object with its geometry, of a way its known part; nothing if nothing is known."""
    counts = counts or ReadingCounts()
    radius_m = DISTRICT_RADII_M.get(element.tags.get("place", "")) if form == "n" else None
    try:
        wkb = create[form](element) if radius_m is None else _circle(element, radius_m)
    except (osmium.InvalidLocationError, RuntimeError):  # nodes that the extract left out, or a broken ring
        line = known_line(element) if form == "w" else None
        if line is None:
            # what is left of an area comes later
            counts.dropped["no part of it is in the file"] += form != "a"
            return
        counts.cut[CUT_REASON] += 1
        wkb = shapely.to_wkb(line, hex=True)
    yield _OsmObject(wkb, item, form == "a" or radius_m is not None, nodes or {})


def _circle(node: Any, radius_m: float) -> str:
    """Return the circle around a node in degrees."""
    degrees = radius_m / METERS_PER_DEGREE
    scale = cos(radians(node.location.lat))
    circle = shapely.affinity.scale(shapely.Point(node.location.lon, node.location.lat).buffer(degrees), 1 / scale, 1)
    return str(shapely.to_wkb(circle, hex=True))


def _is_outdoor_area(tags: dict[str, str]) -> bool:
    return not _is_line(tags) and tags.get("indoor") != "room"


def _is_region(tags: dict[str, str]) -> bool:
    """Whether people know an area by what is inside, because nothing marks its outline."""
    return "boundary" in tags or tags.get("place", "square") not in PLACES_WITH_OUTLINE


def _is_street(tags: dict[str, str]) -> bool:
    highway = tags.get("highway")
    if highway in ROAD_REF_HIGHWAYS and "ref" in tags:
        return True
    return highway is not None and highway not in NON_STREET_HIGHWAYS and _has_name(tags)


def _has_name(tags: dict[str, str]) -> bool:
    return any(key in tags for key in NAME_KEYS if key != "brand")


def _is_line(tags: dict[str, str]) -> bool:
    """Whether a closed way is a loop, not an area."""
    return ("highway" in tags and tags.get("area") != "yes") or ("barrier" in tags and len(tags) < 3)


def _street_object(tags: dict[str, str], element: Any) -> GazetteerObject:
    names = _names(tags) or tuple(part.strip() for part in tags["ref"].split(";"))
    return GazetteerObject((STREET_KIND,), names, source_id=source_id(element, "w"), codes=read_codes(tags))


def _object(
    tags: dict[str, str], vocabulary: Vocabulary, source_id: str, own_kind: str | None = None
) -> GazetteerObject | None:
    """Return the kinds, names and address of an object; None if nobody would name it.

    `own_kind` replaces the kinds that its tags give.
    """
    if tags.get("highway") in UNBUILT_HIGHWAYS:
        return None
    if (
        "highway" in tags
        and tags["highway"] not in UNNAMED_HIGHWAYS
        and source_id.startswith("way/")
        and "name" not in tags
    ):
        return None
    kinds, names = (own_kind,) if own_kind else vocabulary.kinds_of(tags), _names(tags)
    number, street = read_address(tags)
    if not kinds and number and street:
        kinds = (ADDRESS_KIND,)
    if not kinds and not (names and not {"type", "route", "boundary", "addr:interpolation"} & tags.keys()):
        return None
    if kinds == ("building",) and not names and not number:
        return None  # an ordinary house; the cells have it
    return GazetteerObject(kinds, names, number, street, source_id, read_codes(tags))


def _names(tags: dict[str, str]) -> tuple[str, ...]:
    """Return all names of an object without repeats, the one to show first."""
    keys = [*NAME_KEYS, *sorted(key for key in tags if _LANGUAGE.fullmatch(key))]
    names = [part.strip() for key in keys if key in tags for part in tags[key].split(";")]
    if not names and "building" in tags:
        names = [tags.get(HOUSE_NAME_KEY, "")]
    if not names and "operator" in tags and OPERATOR_NAMED_KEYS & tags.keys():
        names = [tags["operator"]]
    return tuple(dict.fromkeys(name for name in names if name))[:MAX_NAMES]


def _with_segments(batch: Sequence[_OsmObject], frame: Frame) -> list[tuple[_OsmObject, Floats]]:
    """Return objects with their segments, without those that are too far away to be in the map."""
    lon_lat = shapely.from_wkb([item.wkb for item in batch])
    shapes = shapely.transform(lon_lat, lambda xy: frame.from_wgs84(xy[:, 1], xy[:, 0]))
    is_near = (np.abs(shapely.bounds(shapes)) < MAX_SIDE_KM * 1000).all(axis=1)
    simple = shapely.simplify(shapes[is_near], SIMPLIFY_TOLERANCE_M, preserve_topology=True)
    near = [batch[row] for row in np.flatnonzero(is_near).tolist()]
    return list(zip(near, map(_segments, simple), strict=True))


def _segments(shape: shapely.Geometry) -> Floats:
    """Return the segments [n, 4] of a geometry's lines, rings and points."""
    parts = shapely.get_parts(shape)
    if shapely.get_dimensions(shape) == 2:
        parts = shapely.get_rings(parts)
    if shapely.get_dimensions(shape) == 0:
        points = shapely.get_coordinates(parts)
        return np.concatenate([points, points], axis=1)
    xy, line = shapely.get_coordinates(parts, return_index=True)
    goes_on = line[1:] == line[:-1]
    return np.concatenate([xy[:-1], xy[1:]], axis=1)[goes_on]


def _street_piece(item: _OsmObject, segments_m: Floats, frame: Frame) -> StreetPiece:
    lon, lat = np.array(list(item.nodes.values())).T
    return StreetPiece(item.object, np.array(list(item.nodes)), segments_m, frame.from_wgs84(lat, lon))
