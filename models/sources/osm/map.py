"""Read OpenStreetMap (.osm.pbf, .osm) into a CityMap with extruded geometry (docs/formats.md, OpenStreetMap).

Footprints, lines and nodes are read as mapped and raised as `classes.toml` says. Colours come from colour, material and
surface tags.
"""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import chain, islice
from math import cos, radians
from pathlib import Path
from typing import Any, Final, TypeVar

import numpy as np
import osmium
import shapely

from models.citymap.colours import BASIC_PALETTE
from models.citymap.frame import Frame
from models.citymap.geometry.tiling import Geometries
from models.citymap.points import Ints
from models.citymap.types import CityMap, CutRules, Floats
from models.errors import MapError
from models.sources.extras.layer import ExtraLayer
from models.sources.osm.classes import OsmClass, find_class, load_classes
from models.sources.osm.feature_strips import FeatureStrips
from models.sources.osm.features import Feature, build_feature
from models.sources.osm.imported_map import ImportedMap
from models.spool import spool_directory

STUFF_SHAPES = ("outline", "wall", "ground")
SUFFIXES = (".osm.pbf", ".pbf", ".osm", ".osm.bz2", ".osm.gz")
ATTRIBUTION = "© OpenStreetMap contributors, ODbL 1.0"
MIN_PART_POINTS = 24  # of a part of stuff: 6 m2 of ground
ELEMENTS_PER_BATCH = 20_000
LOCATION_SPACING_M = 2.0  # between locations where a person can stand, about
KM_PER_DEGREE: Final = 111.2  # of latitude
MAX_AREA_KM2: Final = 100_000.0  # of a map: its table of tiles takes 13 GB then
MAX_SIDE_KM: Final = 1000.0  # from side to side: in a frame, metres are 0.3 % too long 500 km from the middle
Element = TypeVar("Element")
LINEAR_KEYS = ("highway", "railway", "barrier", "tunnel", "bridge")  # closed ways of these are loops, not areas


@dataclass(frozen=True, slots=True)
class _Element:
    wkb: str
    osm_class: OsmClass
    order: int
    tags: dict[str, str]
    source_id: str


Box = tuple[float, float, float, float]  # west, south, east, north in degrees; across 180 degrees east is beyond 180
Batch = tuple[list[_Element], Geometries]  # with the geometry of each, in degrees


def load_osm(path: Path, name: str | None = None, extras: Sequence[ExtraLayer] = ()) -> CityMap:
    """Read an OpenStreetMap file into a city map, in a local frame at the middle of the extract.

    Its default name is the file's up to the first dot. `extras` join it. Raise MapError if the file is missing, not
    usable or too large.
    """
    frame, box = read_frame_and_box(path)
    used = dict.fromkeys(item.osm_class for layer in extras for item in layer.objects if item.osm_class is not None)
    classes = (*load_classes(), *(row for row in used if row not in load_classes()))
    features = chain(read_features(path, frame, box), _extra_features(extras, classes, frame))
    with spool_directory() as directory:
        strips = FeatureStrips(directory, features, classes)
        if not strips.numbers:
            raise MapError(f"{path}: it has nothing inside its own bounds; download it again, or correct its bounds")
        return _city_map(name or path.name.split(".")[0], strips, frame)


def read_frame_and_box(path: Path) -> tuple[Frame, Box | None]:
    """Return the frame of a file's map, and its header's box; only a file without a possible box is read in full."""
    box = _read_box(path)
    if box is not None and _is_possible(box):
        return _centered_frame(box), box
    bounds = _total_bounds(_read_elements(path))
    if not _is_possible(bounds):
        raise _too_large(path, bounds)
    return _centered_frame(bounds), None


def read_features(path: Path, frame: Frame, box: Box | None) -> Iterator[list[Feature]]:
    """Yield the features of a file, in metres and clipped to a box if given, in batches; errors as `load_osm`."""
    for elements, lon_lat in _read_elements(path):
        yield list(_build_features(elements, lon_lat, frame, box))


def _extra_features(extras: Sequence[ExtraLayer], classes: Sequence[OsmClass], frame: Frame) -> Iterator[list[Feature]]:
    """Yield the features of a city's own data, with their rows in `classes`, in batches."""
    number = {row: n for n, row in enumerate(classes)}
    objects = ((item, item.osm_class) for layer in extras for item in layer.objects if item.osm_class is not None)
    for batch in batched(objects):
        elements = [_Element("", row, number[row], dict(item.tags), item.source_id) for item, row in batch]
        yield list(_build_features(elements, np.array([item.geometry for item, _ in batch]), frame, None))


def read_bounds(path: Path) -> Box:
    """Return the box of a file: its header's, or that of its elements; errors as `load_osm`."""
    box = read_frame_and_box(path)[1]
    return _total_bounds(_read_elements(path)) if box is None else box


def _build_features(
    elements: Sequence[_Element], lon_lat: Geometries, frame: Frame, box: Box | None
) -> Iterator[Feature]:
    geometries = shapely.transform(lon_lat, lambda xy: frame.from_wgs84(xy[:, 1], xy[:, 0]))
    if box:
        west, south, east, north = box
        corners = frame.from_wgs84(np.array([south, north]), np.array([west, east]))
        geometries = shapely.clip_by_rect(geometries, *corners[0], *corners[1])
    for element, geometry in zip(elements, geometries, strict=True):
        if not shapely.is_empty(geometry):
            yield build_feature(element.osm_class, element.order, element.tags, element.source_id, geometry)


def _total_bounds(batches: Iterable[Batch]) -> Box:
    low, high = np.full(3, np.inf), np.full(3, -np.inf)  # longitude from -180, longitude from 0, latitude
    for _, geometry in batches:
        longitude, latitude = shapely.get_coordinates(geometry).T
        ends = np.stack([longitude, longitude % 360, latitude])
        low, high = np.minimum(low, ends.min(axis=1)), np.maximum(high, ends.max(axis=1))
    across_180 = int(high[0] - low[0] > 180 > high[1] - low[1])
    return float(low[across_180]), float(low[2]), float(high[across_180]), float(high[2])


def _size_km(box: Box) -> tuple[float, float]:
    west, south, east, north = box
    return (east - west) * KM_PER_DEGREE * cos(radians((south + north) / 2)), (north - south) * KM_PER_DEGREE


def _is_possible(box: Box) -> bool:
    width_km, height_km = _size_km(box)
    return max(width_km, height_km) <= MAX_SIDE_KM and width_km * height_km <= MAX_AREA_KM2


def _too_large(path: Path, box: Box) -> MapError:
    """Return the error for a file that spans too much; it names the element farthest from the others."""
    names, points, element = list[str](), list[Floats](), list[Ints]()
    for elements, lon_lat in _read_elements(path):
        vertices, owner = shapely.get_coordinates(lon_lat, return_index=True)
        points.append(vertices)
        element.append(len(names) + owner)
        names += [each.source_id for each in elements]
    lon_lat_deg = np.concatenate(points)
    if box[2] > 180:
        lon_lat_deg[:, 0] %= 360
    farthest = int(np.abs(lon_lat_deg - np.median(lon_lat_deg, axis=0)).max(axis=1).argmax())
    name, (longitude, latitude) = names[int(np.concatenate(element)[farthest])], lon_lat_deg[farthest].tolist()
    width_km, height_km = _size_km(box)
    return MapError(
        f"{path}: it spans {width_km:,.0f} x {height_km:,.0f} km, but a map can be at most {MAX_SIDE_KM:,.0f} km wide "
        f"and {MAX_AREA_KM2:,.0f} square km; farthest from the rest is {name} "
        f"at latitude {latitude:.7g}, longitude {_longitude(longitude):.7g}: "
        "remove it from the file if it is a mistake, or index a part with --within west,south,east,north"
    )


def _centered_frame(box: Box) -> Frame:
    west, south, east, north = box
    return Frame(origin_lat=round((south + north) / 2, 7), origin_lon=round(_longitude((west + east) / 2), 7))


def _longitude(degrees: float) -> float:
    return degrees - 360 if degrees > 180 else degrees


def _read_box(path: Path) -> Box | None:
    if not path.is_file():
        raise MapError(f"{path}: no such file; give the path of an .osm.pbf or .osm file")
    if not path.name.lower().endswith(SUFFIXES):
        raise MapError(f"{path}: not an OpenStreetMap file by its name; expected one of {', '.join(SUFFIXES)}")
    if path.stat().st_size == 0:
        raise MapError(f"{path}: the file is empty; download it again")
    with explained_errors(path):
        box = osmium.io.Reader(str(path)).header().box()
    if not box.valid():
        return None
    west, east = box.bottom_left.lon, box.top_right.lon
    if east - west > 180:
        west, east = east, west + 360  # it crosses 180 degrees, and osmium has exchanged its sides
    return (west, box.bottom_left.lat, east, box.top_right.lat) if west < east else None


def _read_elements(path: Path) -> Iterator[Batch]:
    keys = sorted({key for row in load_classes() for key, _ in row.required})
    is_empty = True
    with explained_errors(path):
        processor = osmium.FileProcessor(str(path)).with_areas().with_filter(osmium.filter.KeyFilter(*keys))
        for batch in batched(_classify(processor)):
            is_empty = False
            yield batch, shapely.from_wkb([element.wkb for element in batch])
    if is_empty:
        raise MapError(
            f"{path}: it has no building, street, tree or other known object; "
            "take an extract of an inhabited place, or extend models/sources/osm/classes.toml"
        )


def batched(elements: Iterator[Element]) -> Iterator[list[Element]]:
    """Yield elements in batches, because those of a file do not fit in memory."""
    while batch := list(islice(elements, ELEMENTS_PER_BATCH)):
        yield batch


@contextmanager
def explained_errors(path: Path) -> Iterator[None]:
    """Raise a MapError that names the file if osmium fails in the block."""
    try:
        yield
    except (RuntimeError, ValueError, OSError, osmium.InvalidLocationError) as error:
        raise MapError(
            f"{path}: cannot be read as OpenStreetMap ({error}); download it again, it may be cut short"
        ) from error


def geometry_factories() -> dict[str, Any]:
    """Return, by osmium's letter of an element type, the function that makes its geometry: a point, a line or areas."""
    factory = osmium.geom.WKBFactory()
    return {"n": factory.create_point, "w": factory.create_linestring, "a": factory.create_multipolygon}


def source_id(element: Any, kind: str) -> str:
    """Return the source of an element, "way/1234"; `kind` is osmium's letter."""
    if kind == "a":
        return f"{'way' if element.from_way() else 'relation'}/{element.orig_id()}"
    return f"{'node' if kind == 'n' else 'way'}/{element.id}"


def _classify(processor: Any) -> Iterator[_Element]:
    create = geometry_factories()
    for element in processor:
        kind = element.type_str()
        if kind not in create:
            continue
        if kind == "n" and not element.location.valid():
            raise ValueError(f"node {element.id} has coordinates out of range")
        tags = {tag.k: tag.v for tag in element.tags}
        if not _is_visible(tags):
            continue
        match = find_class(tags)
        if match is None or not _is_wanted(element, kind, match[1], tags):
            continue
        try:
            wkb = create[kind](element)
        except (osmium.InvalidLocationError, RuntimeError):
            continue  # nodes left out by the extract, or a broken ring: this element has no geometry here
        yield _Element(wkb, match[1], match[0], tags, source_id(element, kind))


def _is_visible(tags: dict[str, str]) -> bool:
    """Whether a passer-by at ground level can see an element; cellars, subways and rooms are hidden."""
    layer, level = tags.get("layer", "0"), tags.get("level", "0")
    underground = layer.startswith("-") or tags.get("location") in ("underground", "indoor")
    return not underground and tags.get("indoor", "no") == "no" and "0" in level.replace(";", ",").split(",")


def _is_wanted(element: Any, kind: str, row: OsmClass, tags: dict[str, str]) -> bool:
    """Whether to use this form of an element: osmium yields a closed way as a way and as an area."""
    if kind == "n":
        return row.shape in ("column", "crown", "box") or row.label == "crossing"
    if row.shape in ("column", "crown"):
        return False
    linear = row.shape == "wall" or (row.required[0][0] in LINEAR_KEYS and tags.get("area") != "yes")
    if kind == "w":
        return linear if element.is_closed() else row.shape != "outline"
    return not linear or (row.shape != "wall" and not element.from_way())


def _city_map(name: str, strips: FeatureStrips, frame: Frame) -> CityMap:
    rules = CutRules(min_part_points=MIN_PART_POINTS)
    imported = ImportedMap.from_strips(strips, rules)
    locations = imported.pieces.ground_lattice(
        np.flatnonzero(imported.is_walkable[imported.pieces.instance]), LOCATION_SPACING_M
    )
    if not len(locations):
        raise MapError(f"{name}: it has no street, path or square, so nobody can stand there; take a larger extract")
    return CityMap(
        name=name,
        instances=imported.instances,
        stuff=frozenset(row.label for row in load_classes() if row.shape in STUFF_SHAPES),
        locations_m=locations,
        frame=frame,
        palette=BASIC_PALETTE,
        rules=rules,
        attribution=ATTRIBUTION,
        outlines=imported.outlines,
        pieces=imported.pieces,
    )
