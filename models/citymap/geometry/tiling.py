"""Cut the features of a map into pieces, a tile at a time: clip, subtract covers, join."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from models.citymap.points import Ints, ranges
from models.citymap.types import Floats

Geometries = npt.NDArray[np.object_]
TileSpan = tuple[int, int]  # first column or row of tiles, and the one after the last
ALL_TILES: Final = (-(2**31), 2**31)
TILE_M = 10.0  # the spacing of the grid of cells: a tile is the square around a centre
BEYOND_MAP_M = 1e9  # larger than every coordinate
BLOCK_TILES: Final = 4  # what a cell and its hints can reach ends in the next block
MAX_ROW: Final = 1 << 31
NO_KEY: Final = np.iinfo(np.int64).max
TILE_SLACK_M = 1e-3  # by which a piece that fills its tile may stand over
TOUCHING_M = 0.75  # parts this near are connected (rule 4)


@dataclass(frozen=True, slots=True)
class BlockSet:
    """Square blocks of tiles, `BLOCK_TILES` along an edge."""

    keys: Ints  # [B] ascending, see `block_key`

    @classmethod
    def concatenate(cls, sets: Sequence["BlockSet"]) -> "BlockSet":
        """Return the union of several sets."""
        return cls(np.unique(np.concatenate([np.zeros(0, np.int64), *(each.keys for each in sets)])))

    def with_neighbours(self) -> "BlockSet":
        """Return the set with the eight blocks around each."""
        column, row = np.meshgrid(np.arange(-1, 2), np.arange(-1, 2))
        return BlockSet(np.unique(self.keys[:, None] + block_key(column.ravel(), row.ravel())))

    def contains(self, column: Ints, row: Ints) -> npt.NDArray[np.bool_]:
        """Return whether each tile [n] is in one of the blocks."""
        key = block_key(column // BLOCK_TILES, row // BLOCK_TILES)
        return np.append(self.keys, NO_KEY)[np.searchsorted(self.keys, key)] == key

    def rows(self, columns: TileSpan) -> Ints:
        """Return the rows of tiles, ascending, in which some columns of tiles have a block."""
        first, after = columns[0] // BLOCK_TILES, (columns[1] - 1) // BLOCK_TILES + 1
        begin, end = np.searchsorted(self.keys, block_key(np.array([first, after]), -MAX_ROW))
        row = np.unique((self.keys[begin:end] + MAX_ROW) % (2 * MAX_ROW) - MAX_ROW)
        return (row[:, None] * BLOCK_TILES + np.arange(BLOCK_TILES)).ravel()


def block_key(column: Ints, row: Ints | int) -> Ints:
    """Return one integer [n] for each block, ascending from west to east, then south to north."""
    return column.astype(np.int64) * (2 * MAX_ROW) + row


@dataclass(frozen=True, slots=True, eq=False)
class Clipped:
    """Features clipped to tiles, F rows in order of tile, then feature."""

    column: Ints  # [F] tile: its middle is at (column, row) * TILE_M
    row: Ints
    feature: Ints  # [F] index of the feature
    geometry: Geometries  # [F] the part in the tile


def clip_to_tiles(geometry: Geometries, band: TileSpan, blocks: BlockSet | None = None) -> Clipped:
    """Clip geometries [n] to the tiles of some columns, of these to the tiles of `blocks` if given."""
    feature: Ints = np.arange(len(geometry))
    if blocks is not None:
        geometry, feature = _clip_to_runs(geometry, blocks.rows(band))
    column, source, strips = _cut_along_axis(geometry, 0, band)
    is_wanted = None if blocks is None else lambda strip, row: blocks.contains(column[strip], row)
    row, strip, pieces = _cut_along_axis(strips, 1, ALL_TILES, is_wanted)
    order = np.argsort(column[strip], kind="stable")
    strip = strip[order]
    return Clipped(column[strip], row[order], feature[source[strip]], pieces[order])


def tile_span(ends_m: Floats) -> tuple[Ints, Ints]:
    """Return the first and last column (or row) of tiles for intervals [n, 2]."""
    first, last = (np.floor(ends / TILE_M + 0.5).astype(np.int64) for ends in ends_m.T)
    return first, last


def _clip_to_runs(geometry: Geometries, rows: Ints) -> tuple[Geometries, Ints]:
    """Clip geometries [n] to runs of consecutive rows of tiles; return the pieces, and the geometry of each.

    A forest of thousands of vertices is clipped once here, instead of for each of its tiles.
    """
    low, high = tile_span(shapely.bounds(geometry)[:, [1, 3]])
    pieces, sources = [geometry[:0]], [low[:0]]
    runs = np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1) if len(rows) else []
    for begin, end in [(int(run[0]), int(run[-1])) for run in runs]:
        source = np.flatnonzero((low <= end) & (high >= begin))
        piece, is_cut = geometry[source], (low[source] < begin) | (high[source] > end)
        south, north = (begin - 0.5) * TILE_M, (end + 0.5) * TILE_M
        piece[is_cut] = shapely.clip_by_rect(piece[is_cut], -BEYOND_MAP_M, south, BEYOND_MAP_M, north)
        is_left = ~shapely.is_empty(piece)
        pieces.append(piece[is_left])
        sources.append(source[is_left])
    return np.concatenate(pieces), np.concatenate(sources)


def _cut_along_axis(
    geometry: Geometries,
    axis: int,
    span: TileSpan,
    is_wanted: Callable[[Ints, Ints], npt.NDArray[np.bool_]] | None = None,
) -> tuple[Ints, Ints, Geometries]:
    """Return (band, row of `geometry`, piece) of geometries [n] along one axis, in order of band, then geometry.

    `is_wanted` chooses among rows and bands [m].
    """
    low, high = tile_span(shapely.bounds(geometry)[:, [axis, axis + 2]])
    is_whole = low == high
    low = np.maximum(low, span[0])
    after = np.maximum(np.minimum(high + 1, span[1]), low)
    source = np.repeat(np.arange(len(geometry)), after - low)
    band = ranges(low, after)
    if is_wanted is not None:
        chosen = is_wanted(source, band)
        source, band = source[chosen], band[chosen]
    order = np.argsort(band, kind="stable")
    source, band = source[order], band[order]
    pieces = geometry[source]
    is_cut = ~is_whole[source]
    for number, begin, end in _runs(band):
        rows = begin + np.flatnonzero(is_cut[begin:end])
        if len(rows):
            near, beyond = (number - 0.5) * TILE_M, (number + 0.5) * TILE_M
            box = (
                (near, -BEYOND_MAP_M, beyond, BEYOND_MAP_M)
                if axis == 0
                else (-BEYOND_MAP_M, near, BEYOND_MAP_M, beyond)
            )
            pieces[rows] = shapely.clip_by_rect(pieces[rows], *box)
    is_left = ~shapely.is_empty(pieces)
    return band[is_left], source[is_left], pieces[is_left]


def _runs(values: Ints) -> Iterator[tuple[int, int, int]]:
    first = np.flatnonzero(np.diff(values, prepend=values[:1] - 1))
    ends = np.append(first, len(values))[1:]
    yield from zip(values[first].tolist(), first.tolist(), ends.tolist(), strict=True)


def join_pieces(group: Ints, geometry: Geometries) -> tuple[Ints, Geometries]:
    """Join the geometries of each group: return the row of its first, and the union; `group` ascends."""
    first = np.flatnonzero(np.diff(group, prepend=-1))
    sizes = np.diff(np.append(first, len(group)))
    joined = geometry[first]
    for size in np.unique(sizes[sizes > 1]).tolist():
        same_size = np.flatnonzero(sizes == size)
        table = geometry[first[same_size, None] + np.arange(size)]
        joined[same_size] = shapely.union_all(table, axis=1)
    return first, joined


def subtract_covers(tile: Ints, geometry: Geometries) -> Geometries:
    """Return the part of each area that the areas before it in its tile do not cover; `tile` ascends."""
    first = np.flatnonzero(np.diff(tile, prepend=-1))
    before = np.arange(len(tile)) - np.repeat(first, np.diff(np.append(first, len(tile))))
    below = np.repeat(np.arange(len(tile)), before)
    above = ranges(np.arange(len(tile)) - before, np.arange(len(tile)))
    overlap = _boxes_overlap(geometry[below], geometry[above])
    below, above = below[overlap], above[overlap]
    overlap = shapely.intersects(geometry[below], geometry[above])
    below, above = below[overlap], above[overlap]
    visible = geometry.copy()
    turn = np.arange(len(below)) - np.searchsorted(below, below)
    for number in range(turn.max(initial=-1) + 1):
        rows = np.flatnonzero(turn == number)
        visible[below[rows]] = shapely.difference(visible[below[rows]], geometry[above[rows]])
    return visible


def _boxes_overlap(one: Geometries, other: Geometries) -> npt.NDArray[np.bool_]:
    a, b = shapely.bounds(one), shapely.bounds(other)
    return (a[:, 0] < b[:, 2]) & (b[:, 0] < a[:, 2]) & (a[:, 1] < b[:, 3]) & (b[:, 1] < a[:, 3])


def split_connected(geometry: Geometries, dimensions: int) -> tuple[Ints, Geometries]:
    """Return (row of `geometry`, piece) for each connected piece; parts within TOUCHING_M are connected."""
    parts, source = shapely.get_parts(geometry, return_index=True)
    # A polygon that is only touched leaves a line or a point, a covered one nothing.
    right = (shapely.get_dimensions(parts) == dimensions) & ~shapely.is_empty(parts)
    parts, source = parts[right], source[right]
    count = np.bincount(source, minlength=len(geometry))
    first = np.cumsum(count) - count
    several = np.repeat(np.flatnonzero(count > 1), count[count > 1])
    nth = np.flatnonzero((count > 1)[source]) - first[several]
    left = np.repeat(first[several] + nth, nth)
    right = ranges(first[several], first[several] + nth)
    near = shapely.dwithin(parts[left], parts[right], TOUCHING_M)
    graph = coo_array((np.ones(near.sum()), (left[near], right[near])), shape=(len(parts),) * 2)
    cluster = connected_components(graph, directed=False)[1]
    order = np.lexsort((cluster, source))
    new = np.flatnonzero(np.diff(cluster[order], prepend=-1))
    sizes = np.diff(np.append(new, len(order)))
    pieces = parts[order[new]]
    for n in np.flatnonzero(sizes > 1).tolist():
        several_parts = parts[order[new[n] : new[n] + sizes[n]]]
        pieces[n] = shapely.multipolygons(several_parts) if dimensions == 2 else shapely.multilinestrings(several_parts)
    return source[order[new]], pieces
