"""The lines and rings of pieces as compact segments, so that those of a city fit in memory."""

from typing import Final

import numpy as np
import numpy.typing as npt
import shapely

from models.citymap.geometry.tiling import TILE_M, Geometries
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats
from models.compiled import compiled

STEP_M: Final = 2e-4  # unit of the stored coordinates, relative to the middle of the tile
TILE_CORNERS: Final = ((-1, 1), (1, 1), (1, -1), (-1, -1), (-1, 1))  # in halves of an edge
TILE_EDGE_STEPS: Final = round(TILE_M / 2 / STEP_M)  # from the middle of a tile to its edge
Steps = npt.NDArray[np.int16]
# As `to_segments` finds them, so that no distance depends on whether they are stored
TILE_EDGES: Final = TILE_EDGE_STEPS * np.array(
    [(-1, 1, -1, -1), (-1, -1, 1, -1), (1, -1, 1, 1), (1, 1, -1, 1)], np.int16
)


def snap(geometry: Geometries) -> Geometries:
    """Return valid geometries with coordinates as they are stored; too thin ones become empty."""
    snapped = geometry.copy()
    is_tile = (shapely.area(geometry) == TILE_M**2) & (shapely.get_num_coordinates(geometry) == len(TILE_CORNERS))
    # The order of corners that `set_precision` returns, which takes ten times as long.
    middle = shapely.bounds(geometry[is_tile])[:, :2] + TILE_M / 2
    snapped[is_tile] = shapely.polygons(middle[:, None] + TILE_M / 2 * np.array(TILE_CORNERS))
    rest = shapely.set_precision(geometry[~is_tile], STEP_M)
    snapped[~is_tile] = shapely.set_precision(rest, 0.0)  # precision 0 for later operations
    return snapped


def to_segments(geometry: Geometries, tile: Ints) -> tuple[Ints, Steps]:
    """Return the starts [K + 1] and segments [S, 4] (x and y of both ends) of pieces after `snap`.

    `tile` [K, 2] is their column and row. A point has two equal ends. A piece without segments is its whole tile, as
    most of a forest is; `segments_of` adds its edges.
    """
    dimensions = shapely.get_dimensions(geometry)
    geometry = shapely.orient_polygons(geometry)
    segments, owners = [], []
    for dimension in range(3):
        rows = np.flatnonzero(dimensions == dimension)
        parts, part_of = shapely.get_parts(geometry[rows], return_index=True)
        if dimension == 2:
            parts, ring_of = shapely.get_rings(parts, return_index=True)
            part_of = part_of[ring_of]
        xy, line = shapely.get_coordinates(parts, return_index=True)
        first = np.arange(len(xy)) if dimension == 0 else np.flatnonzero(line[1:] == line[:-1])
        segments.append(np.concatenate([xy[first], xy[first if dimension == 0 else first + 1]], axis=1))
        owners.append(rows[part_of[line[first]]])
    owner = np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    owner = owner[order]
    local_m = np.concatenate(segments)[order] - np.tile(tile[owner] * TILE_M, 2)
    steps = np.round(local_m / STEP_M).astype(np.int16)
    starts = np.searchsorted(owner, np.arange(len(geometry) + 1))
    is_stored = ~_are_tiles(starts, steps)[owner]
    return np.concatenate([[0], np.cumsum(is_stored)])[starts], steps[is_stored]


def _are_tiles(starts: Ints, segments: Steps) -> npt.NDArray[np.bool_]:
    """Return whether the segments of each piece [K] are the edges of its tile, in this order."""
    are_tiles = np.diff(starts) == len(TILE_EDGES)
    rows = starts[:-1][are_tiles, None] + np.arange(len(TILE_EDGES))
    are_tiles[are_tiles] = (segments[rows] == TILE_EDGES).all(axis=(1, 2))
    return are_tiles


def segments_of(starts: Ints, segments: Steps, pieces: Ints) -> tuple[Ints, Steps]:
    """Return the position in `pieces` [n] and ends [S, 4] of each of their segments, with the edges of whole tiles."""
    begin, end = starts[pieces], starts[pieces + 1]
    is_tile = begin == end
    sizes = np.where(is_tile, len(TILE_EDGES), end - begin)
    owner = np.repeat(np.arange(len(pieces)), sizes)
    ends = np.empty((len(owner), 4), np.int16)
    ends[~is_tile[owner]] = segments[ranges(begin, end)]
    ends[is_tile[owner]] = np.tile(TILE_EDGES, (is_tile.sum(), 1))
    return owner, ends


def to_geometry(starts: Ints, segments: Steps, tile: Ints, dimension: Ints, pieces: Ints) -> Geometries:
    """Rebuild the geometries of pieces [n] from all segments; a dimension is 0 for points, 1 for lines, 2 for areas."""
    owner, ends = segments_of(starts, segments, pieces)
    ends_m: Floats = ends * STEP_M + np.tile(tile[pieces][owner] * TILE_M, 2)
    result = np.empty(len(pieces), dtype=object)
    is_point = dimension[pieces] == 0
    rows = np.flatnonzero(is_point[owner])
    shapely.multipoints(shapely.points(ends_m[rows, :2]), indices=owner[rows], out=result)
    rows = np.flatnonzero(dimension[pieces][owner] == 1)
    lines = shapely.linestrings(ends_m[rows].reshape(-1, 2, 2))
    shapely.multilinestrings(lines, indices=owner[rows], out=result)
    rows = np.flatnonzero(dimension[pieces][owner] == 2)
    _fill_areas(ends_m[rows], ring_starts(ends[rows]), owner[rows], result)
    return result


@compiled
def ring_starts(ends: Steps) -> Ints:
    """Return the rows of segments at which rings begin: a ring ends at its first point, which others may share."""
    begins = np.empty(len(ends), np.int64)
    count, first, is_closed = 0, 0, True
    for s in range(len(ends)):
        if is_closed:
            begins[count], first, count = s, s, count + 1
        is_closed = ends[s, 2] == ends[first, 0] and ends[s, 3] == ends[first, 1]
    return begins[:count].copy()


def _fill_areas(ends_m: Floats, begins: Ints, segment_owner: Ints, result: Geometries) -> None:
    """Fill in areas from their rings: shells and holes turn opposite ways, as `to_segments` stores them."""
    ring = np.repeat(np.arange(len(begins)), np.diff(np.append(begins, len(segment_owner))))
    rings = shapely.linearrings(ends_m[:, :2], indices=ring)
    polygons, owner = shapely.polygons(rings), segment_owner[begins]
    is_shell = shapely.is_ccw(rings)
    shapely.multipolygons(polygons[is_shell], indices=owner[is_shell], out=result)
    holes = np.full(len(result), shapely.MultiPolygon(), dtype=object)
    shapely.multipolygons(polygons[~is_shell], indices=owner[~is_shell], out=holes)
    rows = np.unique(owner[~is_shell])
    result[rows] = shapely.difference(result[rows], holes[rows])
