"""Find where a file has its elements, without strays far from all others (a node at 0, 0, an exchanged coordinate)."""

from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from math import cos, radians
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
import osmium
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from models.citymap.frame import Frame
from models.citymap.types import Floats
from models.errors import MapError
from models.sources.osm.elements import read_elements
from models.sources.osm.ordering import ordered_file
from models.sources.osm.reading import SUFFIXES, explained_errors

KM_PER_DEGREE: Final = 111.2  # of latitude
MAX_SIDE_KM: Final = 1000.0  # from side to side: in a frame, metres are 0.3 % too long 500 km from the middle
FAR_KM: Final = 50.0  # from all others; a square of this size is indexed in minutes
MAX_AREA_KM2: Final = 100_000.0  # of a map: its table of tiles takes 13 GB then
EXTENT_MARGIN_DEG: Final = 1e-4  # around the objects of a map whose strays are left out, so that none is cut
UNPACKERS = {".zst": "zstd -d", ".xz": "unxz", ".zip": "unzip", ".7z": "7z x"}  # which osmium lacks
BINS_PER_DEGREE: Final = 10
BINS_AROUND: Final = 360 * BINS_PER_DEGREE
MAX_BINS: Final = 50_000  # of a file with strays; the largest map has half as many
# A larger share of the vertices is no mistake, if a map can contain it and the rest.
MAX_STRAY_SHARE: Final = 0.01
Box = tuple[float, float, float, float]  # west, south, east, north in degrees; across 180 degrees east is beyond 180


class Extent(NamedTuple):
    """Where a map is."""

    frame: Frame
    bounds: Box  # of the header or the elements
    box: Box | None  # objects outside are left out; None if there are none
    is_box_ignored: bool = False  # the file's own bounds have none of its nodes inside
    num_strays: int = 0  # elements with a part more than FAR_KM from the rest, which is left out
    farthest_stray: str = ""  # its name and position

    def warnings(self) -> Iterator[str]:
        """Yield sentences about what the user might correct."""
        if self.is_box_ignored:
            yield "none of its nodes are inside its bounds, which are ignored: correct them"
        if self.num_strays:
            yield (
                f"left out what is more than {FAR_KM:.0f} km from the rest, such as {self.farthest_stray}: "
                "remove it from the file if it is a mistake"
            )


def read_extent(path: Path) -> Extent:
    """Return where the map of a file is; only a file whose header has no usable box is read in full.

    Raise MapError if the file is missing, not usable or too large.
    """
    with ordered_file(path) as ordered:
        _check_file(ordered)
        status = ordered.stat()
        return _read_extent(ordered, status.st_size, status.st_mtime_ns)


@lru_cache(maxsize=64)  # the gazetteer needs the same
def _read_extent(path: Path, _size: int, _changed: int) -> Extent:
    box = _read_box(path)
    is_possible = box is not None and _is_possible(box)
    if box is not None and is_possible and _has_nodes_inside(path, box):
        return Extent(_centered_frame(box), box, box)
    bins = PointBins()
    for _, lon_lat in read_elements(path):
        bins.add(shapely.get_coordinates(lon_lat))
    (count, largest), *others = bins.clusters()
    everything = join_boxes([largest, *(other for _, other in others)])
    strays = sum(number for number, _ in others)
    if _is_possible(everything) and (not strays or strays > MAX_STRAY_SHARE * (count + strays)):
        return Extent(_centered_frame(everything), everything, None, is_possible)
    if strays >= count or not _is_possible(largest):
        raise _too_large(path, everything, largest)
    west, south, east, north = largest
    margin = EXTENT_MARGIN_DEG
    around = west - margin, south - margin, east + margin, north + margin
    return Extent(_centered_frame(largest), around, around, is_possible, *_find_strays(path, around))


def _has_nodes_inside(path: Path, box: Box) -> bool:
    west, south, east, north = box
    with explained_errors(path):
        nodes: Any = osmium.FileProcessor(str(path), osmium.osm.NODE)
        return any(
            south <= node.lat <= north and (west <= node.lon <= east or west <= node.lon + 360 <= east)
            for node in nodes
            if node.location.valid()
        )


def _is_possible(box: Box) -> bool:
    width_km, height_km = size_km(box)
    return max(width_km, height_km) <= MAX_SIDE_KM and width_km * height_km <= MAX_AREA_KM2


def _too_large(path: Path, extent: Box, largest: Box) -> MapError:
    """Return the error for a file that spans too much; it names the element farthest from most others."""
    width_km, height_km = size_km(extent)
    return MapError(
        f"{path}: it spans {width_km:,.0f} x {height_km:,.0f} km, but a map can be at most {MAX_SIDE_KM:,.0f} km wide "
        f"and {MAX_AREA_KM2:,.0f} square km; farthest from the rest is {_find_strays(path, largest)[1]}: "
        "remove it from the file if it is a mistake, or index a part with --within west,south,east,north"
    )


def _find_strays(path: Path, box: Box) -> tuple[int, str]:
    """Return the number of elements with a part outside a box, and the name and position of the farthest."""
    west, south, east, north = box
    middle, half = np.array([west + east, south + north]) / 2, np.array([east - west, north - south]) / 2
    count, greatest, text = 0, -1.0, ""
    for elements, lon_lat in read_elements(path):
        vertices, owner = shapely.get_coordinates(lon_lat, return_index=True)
        away = np.abs(vertices - middle)
        away[:, 0] = np.minimum(away[:, 0] % 360, -away[:, 0] % 360)
        count += len(np.unique(owner[(away > half).any(axis=1)]))
        number = int(away.max(axis=1).argmax())
        if away[number].max() > greatest:
            greatest, (longitude, latitude) = float(away[number].max()), vertices[number].tolist()
            text = f"{elements[owner[number]].source_id} at latitude {latitude:.7g}, longitude {longitude:.7g}"
    return count, text


def _centered_frame(box: Box) -> Frame:
    west, south, east, north = box
    return Frame(origin_lat=round((south + north) / 2, 7), origin_lon=round(_longitude((west + east) / 2), 7))


def _longitude(degrees: float) -> float:
    return degrees - 360 if degrees > 180 else degrees


def _check_file(path: Path) -> None:
    if not path.is_file():
        raise MapError(f"{path}: no such file; give the path of an .osm.pbf or .osm file")
    if not path.name.lower().endswith(SUFFIXES):
        unpack = next(
            (f"{tool} {path.name}" for end, tool in UNPACKERS.items() if path.name.lower().endswith(end)), None
        )
        advice = f"; unpack it first: {unpack}" if unpack else ""
        raise MapError(f"{path}: not an OpenStreetMap file by its name; expected one of {', '.join(SUFFIXES)}{advice}")
    if path.stat().st_size == 0:
        raise MapError(f"{path}: the file is empty; download it again")


def _read_box(path: Path) -> Box | None:
    with explained_errors(path):
        box = osmium.io.Reader(str(path), osmium.osm.NOTHING).header().box()
    if not box.valid():
        return None
    west, east = box.bottom_left.lon, box.top_right.lon
    if east - west > 180:
        west, east = east, west + 360  # it crosses 180 degrees, and osmium has exchanged its sides
    return (west, box.bottom_left.lat, east, box.top_right.lat) if west < east else None


class PointBins:
    """The number and bounds of points in bins of a tenth of a degree."""

    def __init__(self) -> None:
        self._rows = dict[int, list[float]]()  # count, west, south, east, north by row * BINS_AROUND + column

    def add(self, lon_lat: Floats) -> None:
        """Add points [n, 2] in degrees."""
        lon_lat = np.column_stack([(lon_lat[:, 0] + 180) % 360 - 180, lon_lat[:, 1]])
        column, row = np.floor((lon_lat + np.array([180, 90])) * BINS_PER_DEGREE).astype(np.int64).T
        numbers, which, counts = np.unique(row * BINS_AROUND + column, return_inverse=True, return_counts=True)
        low, high = np.full((len(numbers), 2), np.inf), np.full((len(numbers), 2), -np.inf)
        np.minimum.at(low, which, lon_lat)
        np.maximum.at(high, which, lon_lat)
        rows = np.column_stack([counts, low, high]).tolist()
        for number, row in zip(numbers.tolist(), rows, strict=True):
            self._rows[number] = _join([row, self._rows[number]]) if number in self._rows else row

    def clusters(self) -> list[tuple[int, Box]]:
        """Return the number of points and the box of each group more than about FAR_KM apart, the largest first.

        All longitudes are counted from the same one, so those on the other side of 180 degrees are beyond it.
        """
        numbers, rows = np.array(list(self._rows)), np.array(list(self._rows.values()))
        row, column = np.divmod(numbers, BINS_AROUND)
        occupied = np.unique(column)
        # count longitudes from behind the widest gap, so that no group is on both ends
        gaps = np.diff(occupied, append=occupied[0] + BINS_AROUND)
        origin = occupied[(int(gaps.argmax()) + 1) % len(occupied)]
        east = (column - origin) % BINS_AROUND
        shift = origin + east - column  # in bins
        rows[:, [1, 3]] += (shift / BINS_PER_DEGREE)[:, None]
        rows[:, [1, 3]] -= 360 * (rows[:, 1].min() >= 180)
        latitude = row / BINS_PER_DEGREE - 90
        position_km = np.column_stack([east * np.cos(np.radians(latitude)), row]) / BINS_PER_DEGREE * KM_PER_DEGREE
        group = np.zeros(len(rows), np.int64)
        if len(rows) <= MAX_BINS:
            pairs = cKDTree(position_km).query_pairs(FAR_KM, output_type="ndarray")
            graph = coo_array((np.ones(len(pairs), np.bool_), tuple(pairs.T)), shape=(len(rows), len(rows)))
            group = connected_components(graph, directed=False)[1]
        joined = [_join(rows[group == number].tolist()) for number in range(int(group.max()) + 1)]
        return sorted(((int(count), (west, south, east, north)) for count, west, south, east, north in joined))[::-1]


def _join(rows: Sequence[list[float]]) -> list[float]:
    count, west, south, east, north = zip(*rows, strict=True)
    return [sum(count), min(west), min(south), max(east), max(north)]


def join_boxes(boxes: Iterable[Box]) -> Box:
    """Return the box of boxes whose longitudes are counted in the same way."""
    west, south, east, north = zip(*boxes, strict=True)
    return min(west), min(south), max(east), max(north)


def size_km(box: Box) -> tuple[float, float]:
    """Return the width and height of a box."""
    west, south, east, north = box
    return (east - west) * KM_PER_DEGREE * cos(radians((south + north) / 2)), (north - south) * KM_PER_DEGREE
