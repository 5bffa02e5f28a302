"""The lines and rings of pieces as segments, small enough to keep those of a city."""

from typing import Final

import numpy as np
import numpy.typing as npt
import shapely

from models.citymap.geometry.tiling import TILE_M, Geometries
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats
from models.compiled import compiled

STEP_M: Final = 2e-4  # of stored coordinates, which are seen from the middle of the tile
Steps = npt.NDArray[np.int16]


def snap(geometry: Geometries) -> Geometries:
    """Geometries whose coordinates are as they are stored, valid still; empty what is too thin for that."""
    found: Geometries = shapely.set_precision(shapely.set_precision(geometry, STEP_M), 0.0)  # 0: of later results
    return found


def to_segments(geometry: Geometries, tile: Ints) -> tuple[Ints, Steps]:
    """Segments of pieces.

    Args:
        geometry: [K] in its tile each, `snap`.
        tile: [K, 2] column and row.

    Returns:
        [K + 1] starts and [S, 4] x and y of both ends; of a point both are the same.
    """
    dimensions = shapely.get_dimensions(geometry)
    geometry = shapely.orient_polygons(geometry)
    segments, of = [], []
    for dimension in range(3):
        rows = np.flatnonzero(dimensions == dimension)
        parts, part_of = shapely.get_parts(geometry[rows], return_index=True)
        if dimension == 2:
            parts, ring_of = shapely.get_rings(parts, return_index=True)
            part_of = part_of[ring_of]
        xy, line = shapely.get_coordinates(parts, return_index=True)
        first = np.arange(len(xy)) if dimension == 0 else np.flatnonzero(line[1:] == line[:-1])
        segments.append(np.concatenate([xy[first], xy[first if dimension == 0 else first + 1]], axis=1))
        of.append(rows[part_of[line[first]]])
    owner = np.concatenate(of)
    order = np.argsort(owner, kind="stable")
    starts = np.searchsorted(owner[order], np.arange(len(geometry) + 1))
    local_m = np.concatenate(segments)[order] - np.tile(tile[owner[order]] * TILE_M, 2)
    return starts, np.round(local_m / STEP_M).astype(np.int16)


def to_geometry(starts: Ints, segments: Steps, tile: Ints, dimension: Ints, pieces: Ints) -> Geometries:
    """Some pieces again, from all segments.

    Args:
        starts: see `to_segments`.
        segments: likewise.
        tile: [K, 2] column and row.
        dimension: [K] 0 for points, 1 for lines, 2 for areas.
        pieces: [n] which.
    """
    begin, end = starts[pieces], starts[pieces + 1]
    of = np.repeat(np.arange(len(pieces)), end - begin)
    ends = segments[ranges(begin, end)]
    ends_m: Floats = ends * STEP_M + np.tile(tile[pieces][of] * TILE_M, 2)
    found = np.empty(len(pieces), dtype=object)
    is_point = dimension[pieces] == 0
    rows = np.flatnonzero(is_point[of])
    shapely.multipoints(shapely.points(ends_m[rows, :2]), indices=of[rows], out=found)
    rows = np.flatnonzero(dimension[pieces][of] == 1)
    lines = shapely.linestrings(ends_m[rows].reshape(-1, 2, 2))
    shapely.multilinestrings(lines, indices=of[rows], out=found)
    rows = np.flatnonzero(dimension[pieces][of] == 2)
    _fill_areas(ends_m[rows], ring_starts(ends[rows]), of[rows], found)
    return found


@compiled
def ring_starts(ends: Steps) -> Ints:
    """Rows of segments at which rings begin: a ring ends where it began, which others may share."""
    begins = np.empty(len(ends), np.int64)
    count, first, is_closed = 0, 0, True
    for s in range(len(ends)):
        if is_closed:
            begins[count], first, count = s, s, count + 1
        is_closed = ends[s, 2] == ends[first, 0] and ends[s, 3] == ends[first, 1]
    return begins[:count].copy()


def _fill_areas(ends_m: Floats, begins: Ints, of: Ints, found: Geometries) -> None:
    """Fill in areas from their rings: shells turn one way and holes the other, as `to_segments` has them."""
    ring = np.repeat(np.arange(len(begins)), np.diff(np.append(begins, len(of))))
    rings = shapely.linearrings(ends_m[:, :2], indices=ring)
    polygons, owner = shapely.polygons(rings), of[begins]
    is_shell = shapely.is_ccw(rings)
    shapely.multipolygons(polygons[is_shell], indices=owner[is_shell], out=found)
    holes = np.full(len(found), shapely.MultiPolygon(), dtype=object)
    shapely.multipolygons(polygons[~is_shell], indices=owner[~is_shell], out=holes)
    rows = np.unique(owner[~is_shell])
    found[rows] = shapely.difference(found[rows], holes[rows])
