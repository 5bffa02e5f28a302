"""How far every cell of a map is from some objects, to the cells' grid where they are near, and else by block.

Distances on the grid are few, and so are blocks: what is made of distances is made of these, and looked up for cells.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from cachetools import LRUCache, cachedmethod
from scipy.ndimage import distance_transform_edt

from models.citymap.gazetteer.distance_transform import (
    MAX_SQUARED_REACH_PX,
    SquaredDistances,
    column_distances,
    squared_distances,
)
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.gazetteer.rasterize import Mask, PixelGrid, draw_areas, draw_lines, pixels_at
from models.citymap.points import Ints, bounding_corners, ranges
from models.citymap.types import Floats
from models.compiled import compiled

LINE_SAMPLE_M = 6.0  # between samples of lines
MARGIN_M = 300.0  # round the cells, in which objects count too
LARGE_AREA_RADIUS_M = 20.0  # areas that reach farther have samples inside
AREA_SAMPLE_M = 9.0  # between these
BLOCK_PX: Final = 4  # cells to each side
EXACT_REACH_M: Final = 200.0  # as far as cells are looked at one by one
MAX_FAR_STEPS: Final = 30_000  # blocks beyond MOST_SQUARED
BLOCK_DIAGONAL: Final = 1.5  # of a block, rounded up
CACHE_BYTES = 16 * 2**20  # of distances that were asked for lately


@dataclass(frozen=True, slots=True, eq=False)
class GroupDistances:
    """How far the cells of a map are from T groups of objects.

    Attributes:
        squares: [T, columns, rows] of `squared_distances`, of pixels.
        blocks: [T, ...] the same of blocks.
        is_near: of each block, whether pixels of it may be near.
    """

    squares: SquaredDistances
    blocks: SquaredDistances
    is_near: Mask

    @property
    def nbytes(self) -> int:
        """What it takes."""
        return sum(array.nbytes for array in (self.squares, self.blocks, self.is_near))


def _cache_key(_: "DistanceRaster", groups: Sequence[Ints], lines_m: Floats | None = None) -> tuple[bytes, ...]:
    """What distances are remembered by."""
    return b"" if lines_m is None else lines_m.tobytes(), *(one.tobytes() for one in groups)


class DistanceRaster:
    """The cells' grid, with every object of a gazetteer on it.

    Args:
        gazetteer: of the map.
        centers_m: [N, 2] of the cells.
        spacing_m: of their grid.

    Attributes:
        shape: columns and rows of pixels.
        cell_pixel: [N] int32 pixel of each cell, column * rows + row.
        steps_m: [S] the distances between near pixels.
        block_steps_m: [B] those between blocks, the last inf.
    """

    def __init__(self, gazetteer: Gazetteer, centers_m: Floats, spacing_m: float) -> None:
        low_m, high_m = bounding_corners(centers_m)
        west_south = low_m - MARGIN_M
        size = np.ceil((high_m + MARGIN_M - west_south) / spacing_m).astype(int) + 1
        self._blocks = tuple((-(-size // BLOCK_PX)).tolist())
        self.shape = BLOCK_PX * self._blocks[0], BLOCK_PX * self._blocks[1]
        self._grid = PixelGrid(west_south[0], west_south[1], spacing_m, *self.shape)
        self.cell_pixel = pixels_at(self._grid, centers_m).astype(np.int32)
        count = np.bincount(self.cell_pixel, minlength=self.shape[0] * self.shape[1])
        self._cells_in = count.astype(np.float32).reshape(self.shape)
        self._reach = min(
            BLOCK_PX + math.ceil(EXACT_REACH_M / spacing_m + BLOCK_DIAGONAL * BLOCK_PX), MAX_SQUARED_REACH_PX
        )
        across = math.ceil(math.hypot(*self._blocks))
        self._block_reach = min(across, MAX_SQUARED_REACH_PX)
        self._far_steps = min(across - self._block_reach, MAX_FAR_STEPS)
        self.steps_m = _step_lengths(self._reach) * np.float32(spacing_m)
        farther = np.arange(self._far_steps, dtype=np.float32) + np.float32(self._block_reach + 0.5)
        apart = np.concatenate([_step_lengths(self._block_reach), farther, np.array([np.inf], np.float32)])
        apart_m, near_m = apart * np.float32(BLOCK_PX * spacing_m), min(EXACT_REACH_M, self._reach * spacing_m)
        self._is_near = apart_m <= near_m + BLOCK_DIAGONAL * BLOCK_PX * spacing_m
        self.block_steps_m = np.maximum(apart_m, np.float32(near_m))  # what is nearer, pixels tell of
        known = np.minimum(self.block_steps_m / spacing_m, self._reach)
        self._limits = (known * known).astype(np.uint16)  # squares up to which pixels of a near block tell
        large, shapes = (
            gazetteer.is_area & (gazetteer.reach_m > LARGE_AREA_RADIUS_M),
            (gazetteer.segments_m, gazetteer.starts),
        )
        self._lines = draw_lines(self._grid, *shapes, np.arange(len(gazetteer)), LINE_SAMPLE_M)
        self._areas = draw_areas(self._grid, *shapes, np.flatnonzero(large), AREA_SAMPLE_M)
        self._area_starts = np.concatenate([[0], np.cumsum(large)])  # large ones before each object
        self._cache: LRUCache[tuple[bytes, ...], GroupDistances] = LRUCache(CACHE_BYTES, lambda away: away.nbytes)

    @cachedmethod(lambda raster: raster._cache, _cache_key)
    def distances_to(self, groups: Sequence[Ints], lines_m: Floats | None = None) -> GroupDistances:
        """How far every cell is from each group of objects, and from segments [n, 4], if any, which are the first."""
        drawn = [self._object_pixels(some) for some in groups]
        if lines_m is not None:
            one = np.array([0, len(lines_m)]), np.zeros(1, np.int64)
            drawn.insert(0, draw_lines(self._grid, lines_m, *one, LINE_SAMPLE_M)[0])
        return self._pixel_distances(drawn)

    def distances_m(self, away: GroupDistances, cells: Ints) -> Floats:
        """[T, n] metres from some cells to the nearest of each group."""
        column, row = np.divmod(self.cell_pixel[cells], self.shape[1])
        square, at = away.squares[:, column, row], (column // BLOCK_PX, row // BLOCK_PX)
        block = away.blocks[:, *at]
        known = np.where(away.is_near[at], self._limits[block], self._limits[0])
        found: Floats = np.where(square <= known, self.steps_m[np.minimum(square, known)], self.block_steps_m[block])
        return found

    def mean_and_max(self, away: GroupDistances, by_step: Floats, by_block: Floats) -> tuple[float, float]:
        """The mean over cells of what the best of the groups is, and the most, which are at least 0; as `add`."""
        total, most = np.zeros(self.shape[1]), np.zeros(self.shape[1], np.float32)
        given = away.squares, away.blocks, away.is_near, self._limits, by_step, by_block
        _sum_and_max(*given, self._cells_in, total, most)
        return float(total.sum()) / len(self.cell_pixel), float(most.max())

    def add_best(self, total: Floats, away: GroupDistances, by_step: Floats, by_block: Floats) -> None:
        """Add to every pixel what the best of the groups is there.

        Args:
            total: [columns, rows] float32.
            away: of the groups.
            by_step: [T, S] float32 for each distance of `steps_m`.
            by_block: [T, B] float32 for each distance of `block_steps_m`.
        """
        _add_best(away.squares, away.blocks, away.is_near, self._limits, by_step, by_block, total)

    def _object_pixels(self, objects: Ints) -> Ints:
        """[n] pixels of some objects."""
        both = (
            (self._lines, objects, objects + 1),
            (self._areas, self._area_starts[objects], self._area_starts[objects + 1]),
        )
        return np.concatenate([pixel[ranges(starts[begin], starts[end])] for (pixel, starts), begin, end in both])

    def _pixel_distances(self, groups: Sequence[Ints]) -> GroupDistances:
        """The same of pixels."""
        squares = np.stack(
            [squared_distances(column_distances(one, self.shape, self._reach), self._reach) for one in groups]
        )
        blocks = np.stack([self._block_distances(self._block_of(one)) for one in groups])
        is_near: Mask = np.logical_or.reduce(self._is_near[blocks], axis=0)
        return GroupDistances(squares, blocks, is_near)

    def _block_distances(self, drawn: Ints) -> SquaredDistances:
        """[blocks] the row of `block_steps_m` of each block, from some blocks."""
        reach, nowhere = self._block_reach, self._block_reach**2 + 1 + self._far_steps
        squares = squared_distances(column_distances(drawn, self._blocks, reach), reach)
        is_far = squares > reach**2
        if len(drawn) and is_far.any():
            empty = np.ones(self._blocks, np.bool_)
            empty.ravel()[drawn] = False
            farther = distance_transform_edt(empty)[is_far].astype(np.int64) - reach
            squares[is_far] = np.minimum(reach**2 + 1 + farther, nowhere)
        found: SquaredDistances = np.minimum(squares, np.uint16(nowhere))
        return found

    def _block_of(self, pixels: Ints) -> Ints:
        """[n] block of each pixel."""
        column, row = np.divmod(pixels, self.shape[1])
        block: Ints = column // BLOCK_PX * self._blocks[1] + row // BLOCK_PX
        return block


def _step_lengths(reach: int) -> Floats:
    """[S] float32 the roots of all whole numbers up to the square of a reach."""
    return np.sqrt(np.arange(reach**2 + 1)).astype(np.float32)


@compiled
def _sum_and_max(
    squares: SquaredDistances, blocks: SquaredDistances, is_near: Mask, limits: SquaredDistances, by_step: Floats,
    by_block: Floats, cells: Floats, total: Floats, most: Floats,
) -> None:  # fmt: skip
    """Add up rows [rows] over columns, and raise the most of each; see `DistanceRaster.mean_and_max`."""
    line, limit, beyond = _column_buffers(squares)
    for x in range(squares.shape[1]):
        if x % BLOCK_PX == 0:
            _fill_blocks(blocks, is_near, limits, by_block, x // BLOCK_PX, limit, beyond)
        _fill_best(squares, by_step, x, limit, beyond, line)
        for y in range(len(line)):
            total[y] += line[y] * cells[x, y]
            most[y] = max(most[y], line[y] if cells[x, y] > 0.0 else np.float32(0.0))


@compiled
def _add_best(
    squares: SquaredDistances,
    blocks: SquaredDistances,
    is_near: Mask,
    limits: SquaredDistances,
    by_step: Floats,
    by_block: Floats,
    total: Floats,
) -> None:
    """See `DistanceRaster.add_best`."""
    line, limit, beyond = _column_buffers(squares)
    for x in range(len(total)):
        if x % BLOCK_PX == 0:
            _fill_blocks(blocks, is_near, limits, by_block, x // BLOCK_PX, limit, beyond)
        _fill_best(squares, by_step, x, limit, beyond, line)
        for y in range(len(line)):
            total[x, y] += line[y]


@compiled
def _column_buffers(squares: SquaredDistances) -> tuple[Floats, SquaredDistances, Floats]:
    """Room for a column of pixels [rows], and for what the blocks that it passes have [T, rows]."""
    groups, rows = squares.shape[0], squares.shape[2]
    return np.empty(rows, np.float32), np.empty((groups, rows), np.uint16), np.empty((groups, rows), np.float32)


@compiled
def _fill_blocks(
    blocks: SquaredDistances,
    is_near: Mask,
    limits: SquaredDistances,
    by_block: Floats,
    x: int,
    limit: SquaredDistances,
    beyond: Floats,
) -> None:
    """Fill in what a column of blocks has."""
    for t in range(len(blocks)):
        for y in range(limit.shape[1]):
            block = blocks[t, x, y // BLOCK_PX]
            limit[t, y] = limits[block] if is_near[x, y // BLOCK_PX] else limits[0]
            beyond[t, y] = by_block[t, block]


@compiled
def _fill_best(
    squares: SquaredDistances, by_step: Floats, x: int, limit: SquaredDistances, beyond: Floats, line: Floats
) -> None:
    """Fill in what the best of the groups is at a column of pixels; the processor takes many of them at once."""
    for t in range(len(squares)):
        square, of_step, most, of_block = squares[t, x], by_step[t], limit[t], beyond[t]
        for y in range(len(line)):
            value = of_step[min(square[y], most[y])]
            value = value if square[y] <= most[y] else of_block[y]
            line[y] = value if t == 0 else max(line[y], value)
