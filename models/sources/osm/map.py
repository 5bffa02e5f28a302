"""Reader: OpenStreetMap (.osm.pbf, .osm) -> CityMap.

A real map with extruded geometry, not LiDAR (docs/formats.md, OpenStreetMap): footprints, lines and nodes are read as
mapped and raised as `classes.toml` says. Colours come from colour, material and surface tags.
"""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import islice
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
from models.sources.osm.classes import OsmClass, find_class, load_classes
from models.sources.osm.feature_strips import FeatureStrips
from models.sources.osm.features import Feature, build_feature
from models.sources.osm.imported_map import ImportedMap
from models.spool import scratch

STUFF_SHAPES = ("outline", "wall", "ground")
SUFFIXES = (".osm.pbf", ".pbf", ".osm", ".osm.bz2", ".osm.gz")
ATTRIBUTION = "© OpenStreetMap contributors, ODbL 1.0"
MIN_PART_POINTS = 24  # 6 m2 of ground
ELEMENTS_PER_BATCH = 20_000  # elements
LOCATION_SPACING_M = 2.0  # between places to stand, about
KM_PER_DEGREE: Final = 111.2  # of latitude
MOST_KM2: Final = 100_000.0  # of a map: its table of tiles takes 13 GB then
MOST_KM: Final = 1000.0  # from side to side: in a frame, metres are 0.3 % too long 500 km from the middle
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


def load_osm(path: Path, name: str | None = None) -> CityMap:
    """Read an OpenStreetMap file into a city map, in a local frame at the middle of the extract.

    Args:
        path: .osm.pbf, .pbf, .osm, .osm.gz or .osm.bz2.
        name: name of the map; the file's name up to the first dot by default.

    Raises:
        MapError: the file is missing, empty, cut short, no OpenStreetMap, too large, or nothing in it is usable.
    """
    frame, box = read_frame_and_box(path)
    with scratch() as directory:
        strips = FeatureStrips(directory, read_features(path, frame, box))
        if not strips.numbers:
            raise MapError(
                f"{path}: nothing of it lies in the box that it names; download it again, or mend its bounds"
            )
        return _city_map(name or path.name.split(".")[0], strips, frame)


def read_frame_and_box(path: Path) -> tuple[Frame, Box | None]:
    """Return the frame of a file's map, and the box that the file says, if it says one that a map can have.

    A file with such a box is not read.
    """
    box = _read_box(path)
    if box is not None and _is_possible(box):
        return _centered_frame(box), box
    bounds = _total_bounds(_read_elements(path))
    if not _is_possible(bounds):
        raise _too_large(path, bounds)
    return _centered_frame(bounds), None


def read_features(path: Path, frame: Frame, box: Box | None) -> Iterator[list[Feature]]:
    """What a file has in a box, if there is one, in metres, some at a time; errors as `load_osm`."""
    for elements, lon_lat in _read_elements(path):
        yield list(_build_features(elements, lon_lat, frame, box))


def _build_features(
    elements: Sequence[_Element], lon_lat: Geometries, frame: Frame, box: Box | None
) -> Iterator[Feature]:
    """What of some elements lies in a box, if there is one."""
    geometry_factories = shapely.transform(lon_lat, lambda xy: frame.from_wgs84(xy[:, 1], xy[:, 0]))
    if box:
        west, south, east, north = box
        corners = frame.from_wgs84(np.array([south, north]), np.array([west, east]))
        geometry_factories = shapely.clip_by_rect(geometry_factories, *corners[0], *corners[1])
    for e, g in zip(elements, geometry_factories, strict=True):
        if not shapely.is_empty(g):
            yield build_feature(e.osm_class, e.order, e.tags, e.source_id, g)


def read_frame(path: Path) -> Frame:
    """The frame of a file's map, for which a file that says its box is not read; arguments and errors as `load_osm`."""
    return read_frame_and_box(path)[0]


def _total_bounds(batches: Iterable[Batch]) -> Box:
    """Return the box round some geometry."""
    low, high = np.full(3, np.inf), np.full(3, -np.inf)  # longitude from -180, longitude from 0, latitude
    for _, geometry in batches:
        longitude, latitude = shapely.get_coordinates(geometry).T
        ends = np.stack([longitude, longitude % 360, latitude])
        low, high = np.minimum(low, ends.min(axis=1)), np.maximum(high, ends.max(axis=1))
    across_180 = int(high[0] - low[0] > 180 > high[1] - low[1])
    return float(low[across_180]), float(low[2]), float(high[across_180]), float(high[2])


def _size_km(box: Box) -> tuple[float, float]:
    """Return the width and height of a box."""
    west, south, east, north = box
    return (east - west) * KM_PER_DEGREE * cos(radians((south + north) / 2)), (north - south) * KM_PER_DEGREE


def _is_possible(box: Box) -> bool:
    width_km, height_km = _size_km(box)
    return max(width_km, height_km) <= MOST_KM and width_km * height_km <= MOST_KM2


def _too_large(path: Path, box: Box) -> MapError:
    """Return the error for a file that spans too much, which names the element farthest from the others."""
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
        f"{path}: it spans {width_km:,.0f} x {height_km:,.0f} km, but a map can be at most {MOST_KM:,.0f} km wide and "
        f"{MOST_KM2:,.0f} square km; farthest from the rest is {name} "
        f"at latitude {latitude:.7g}, longitude {_longitude(longitude):.7g}: "
        "remove it from the file if it is a mistake, or index a part with --within west,south,east,north"
    )


def _centered_frame(box: Box) -> Frame:
    """Return the frame at the middle of a box."""
    west, south, east, north = box
    return Frame(origin_lat=round((south + north) / 2, 7), origin_lon=round(_longitude((west + east) / 2), 7))


def _longitude(degrees: float) -> float:
    """Return a longitude from -180 to 180 degrees."""
    return degrees - 360 if degrees > 180 else degrees


def _read_box(path: Path) -> Box | None:
    """Return the box that an extract says, if it says one."""
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
    """The elements of the file that belong to a class, some at once."""
    keys = sorted({key for row in load_classes() for key, _ in row.required})
    is_empty = True
    with explained_errors(path):
        processor = osmium.FileProcessor(str(path)).with_areas().with_filter(osmium.filter.KeyFilter(*keys))
        for batch in batched(_classify(processor)):
            is_empty = False
            yield batch, shapely.from_wkb([element.wkb for element in batch])
    if is_empty:
        raise MapError(
            f"{path}: no building, street, tree or other known object in it; "
            "take an extract of an inhabited place, or extend models/sources/osm/classes.toml"
        )


def batched(elements: Iterator[Element]) -> Iterator[list[Element]]:
    """Elements of a file, some at once: what is read of all of them would take much room."""
    while batch := list(islice(elements, ELEMENTS_PER_BATCH)):
        yield batch


@contextmanager
def explained_errors(path: Path) -> Iterator[None]:
    """Say so where a file is broken."""
    try:
        yield
    except (RuntimeError, ValueError, OSError, osmium.InvalidLocationError) as error:
        raise MapError(
            f"{path}: cannot be read as OpenStreetMap ({error}); download it again, it may be cut short"
        ) from error


def geometry_factories() -> dict[str, Any]:
    """By osmium's letter of an element what makes its geometry: a point, a line or areas."""
    factory = osmium.geom.WKBFactory()
    return {"n": factory.create_point, "w": factory.create_linestring, "a": factory.create_multipolygon}


def source_id(element: Any, kind: str) -> str:
    """Where an element comes from, "way/1234"; `kind` is osmium's letter."""
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
    """Whether a passer-by at ground level can see an element; cellars, subways and rooms cannot be seen."""
    layer, level = tags.get("layer", "0"), tags.get("level", "0")
    underground = layer.startswith("-") or tags.get("location") in ("underground", "indoor")
    return not underground and tags.get("indoor", "no") == "no" and "0" in level.replace(";", ",").split(",")


def _is_wanted(element: Any, kind: str, row: OsmClass, tags: dict[str, str]) -> bool:
    """Whether to take this spelling of an element: a closed way comes as a way and as an area."""
    if kind == "n":
        return row.shape in ("column", "crown", "box") or row.label == "crossing"
    if row.shape in ("column", "crown"):
        return False
    linear = row.shape == "wall" or (row.required[0][0] in LINEAR_KEYS and tags.get("area") != "yes")
    if kind == "w":
        return linear if element.is_closed() else row.shape != "outline"
    return not linear or (row.shape != "wall" and not element.from_way())


def _city_map(name: str, strips: FeatureStrips, frame: Frame) -> CityMap:
    imported = ImportedMap.from_strips(strips)
    locations = imported.pieces.ground_lattice(
        np.flatnonzero(imported.is_walkable[imported.pieces.instance]), LOCATION_SPACING_M
    )
    imported.pieces.forget()
    if not len(locations):
        raise MapError(f"{name}: no street, path or square in it, so there is no place to stand; take a larger extract")
    return CityMap(
        name=name,
        instances=imported.instances,
        stuff=frozenset(row.label for row in load_classes() if row.shape in STUFF_SHAPES),
        locations_m=locations,
        frame=frame,
        palette=BASIC_PALETTE,
        rules=CutRules(min_part_points=MIN_PART_POINTS),
        attribution=ATTRIBUTION,
        outlines=imported.outlines,
        pieces=imported.pieces,
    )
