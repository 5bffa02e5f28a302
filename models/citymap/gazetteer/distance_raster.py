"""Distances from all cells of a map to objects: by grid pixel where they are near, by block elsewhere.

There are few different distances between pixels and between blocks, so a function of the distance is evaluated
for these only, and looked up for cells.
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
MARGIN_M = 300.0  # around the cells, in which objects count, too
LARGE_AREA_RADIUS_M = 20.0  # areas that reach farther from their middle have samples inside
AREA_SAMPLE_M = 9.0  # between samples inside areas
BLOCK_PX: Final = 4  # pixels on each side of a block
EXACT_REACH_M: Final = 200.0  # distances up to this are looked up by pixel
MAX_FAR_STEPS: Final = 30_000  # block distances beyond MAX_SQUARED_REACH_PX; an index has 16 bits
BLOCK_DIAGONAL: Final = 1.5  # of a block of edge 1, rounded up
CACHE_BYTES = 16 * 2**20  # of distances that are kept for the next request


@dataclass(frozen=True, slots=True, eq=False)
class GroupDistances:
    """Distances from the cells of a map to T groups of objects."""

    squares: SquaredDistances  # [T, columns, rows] of pixels, as of `squared_distances`
    blocks: SquaredDistances  # [T, ...] index into `block_steps_m` of each block
    is_near: Mask  # whether a block may have pixels near an object

    @property
    def nbytes(self) -> int:
        """Return the memory of the arrays."""
        return sum(array.nbytes for array in (self.squares, self.blocks, self.is_near))


def _cache_key(_: "DistanceRaster", groups: Sequence[Ints], lines_m: Floats | None = None) -> tuple[bytes, ...]:
    return b"" if lines_m is None else lines_m.tobytes(), *(one.tobytes() for one in groups)


class DistanceRaster:
    """The grid of the N cells of a map, with every object of a gazetteer drawn on it."""

    def __init__(self, gazetteer: Gazetteer, centers_m: Floats, spacing_m: float) -> None:
        low_m, high_m = bounding_corners(centers_m)
        west_south = low_m - MARGIN_M
        size = np.ceil((high_m + MARGIN_M - west_south) / spacing_m).astype(int) + 1
        self._blocks = tuple((-(-size // BLOCK_PX)).tolist())
        self.shape = BLOCK_PX * self._blocks[0], BLOCK_PX * self._blocks[1]  # columns and rows of pixels
        self._grid = PixelGrid(west_south[0], west_south[1], spacing_m, *self.shape)
        self.cell_pixel = pixels_at(self._grid, centers_m).astype(np.int32)  # [N] column * rows + row
        count = np.bincount(self.cell_pixel, minlength=self.shape[0] * self.shape[1])
        self._cells_in = count.astype(np.float32).reshape(self.shape)
        self._reach = min(
            BLOCK_PX + math.ceil(EXACT_REACH_M / spacing_m + BLOCK_DIAGONAL * BLOCK_PX), MAX_SQUARED_REACH_PX
        )
        across = math.ceil(math.hypot(*self._blocks))
        self._block_reach = min(across, MAX_SQUARED_REACH_PX)
        self._far_steps = min(across - self._block_reach, MAX_FAR_STEPS)
        self.steps_m = _step_lengths(self._reach) * np.float32(spacing_m)  # [S] distances between near pixels
        farther = np.arange(self._far_steps, dtype=np.float32) + np.float32(self._block_reach + 0.5)
        apart = np.concatenate([_step_lengths(self._block_reach), farther, np.array([np.inf], np.float32)])
        apart_m, near_m = apart * np.float32(BLOCK_PX * spacing_m), min(EXACT_REACH_M, self._reach * spacing_m)
        self._is_near = apart_m <= near_m + BLOCK_DIAGONAL * BLOCK_PX * spacing_m
        # [B] distances between blocks, the last inf; nearer ones are looked up by pixel
        self.block_steps_m = np.maximum(apart_m, np.float32(near_m))
        known = np.minimum(self.block_steps_m / spacing_m, self._reach)
        self._limits = (known * known).astype(np.uint16)  # greatest square that is looked up by pixel in a near block
        large, shapes = (
            gazetteer.is_area & (gazetteer.reach_m > LARGE_AREA_RADIUS_M),
            (gazetteer.segments_m, gazetteer.starts),
        )
        self._lines = draw_lines(self._grid, *shapes, np.arange(len(gazetteer)), LINE_SAMPLE_M)
        self._areas = draw_areas(self._grid, *shapes, np.flatnonzero(large), AREA_SAMPLE_M)
        self._area_starts = np.concatenate([[0], np.cumsum(large)])  # number of large areas before each object
        self._cache: LRUCache[tuple[bytes, ...], GroupDistances] = LRUCache(CACHE_BYTES, lambda item: item.nbytes)

    @cachedmethod(lambda raster: raster._cache, _cache_key)
    def distances_to(self, groups: Sequence[Ints], lines_m: Floats | None = None) -> GroupDistances:
        """Return the distances from every cell to each group of objects, and first to segments [n, 4], if given."""
        pixels = [self._object_pixels(objects) for objects in groups]
        if lines_m is not None:
            single = np.array([0, len(lines_m)]), np.zeros(1, np.int64)
            pixels.insert(0, draw_lines(self._grid, lines_m, *single, LINE_SAMPLE_M)[0])
        return self._pixel_distances(pixels)

    def distances_m(self, distances: GroupDistances, cells: Ints) -> Floats:
        """Return the metres [T, n] from some cells to the nearest object of each group."""
        column, row = np.divmod(self.cell_pixel[cells], self.shape[1])
        square, block_index = distances.squares[:, column, row], (column // BLOCK_PX, row // BLOCK_PX)
        block = distances.blocks[:, *block_index]
        limit = np.where(distances.is_near[block_index], self._limits[block], self._limits[0])
        return np.where(square <= limit, self.steps_m[np.minimum(square, limit)], self.block_steps_m[block])

    def mean_and_max(self, distances: GroupDistances, by_step: Floats, by_block: Floats) -> tuple[float, float]:
        """Return the mean and maximum (at least 0) over cells of the best group's value; arguments as `add_best`."""
        total, maximum = np.zeros(self.shape[1]), np.zeros(self.shape[1], np.float32)
        tables = distances.squares, distances.blocks, distances.is_near, self._limits, by_step, by_block
        _sum_and_max(*tables, self._cells_in, total, maximum)
        return float(total.sum()) / len(self.cell_pixel), float(maximum.max())

    def add_best(self, total: Floats, distances: GroupDistances, by_step: Floats, by_block: Floats) -> None:
        """Add the value of the best group to every pixel of `total` [columns, rows] (float32).

        Values are given for each distance of `steps_m` (`by_step` [T, S]) and of `block_steps_m` (`by_block` [T, B]).
        """
        _add_best(distances.squares, distances.blocks, distances.is_near, self._limits, by_step, by_block, total)

    def _object_pixels(self, objects: Ints) -> Ints:
        both = (
            (self._lines, objects, objects + 1),
            (self._areas, self._area_starts[objects], self._area_starts[objects + 1]),
        )
        return np.concatenate([pixel[ranges(starts[begin], starts[end])] for (pixel, starts), begin, end in both])

    def _pixel_distances(self, groups: Sequence[Ints]) -> GroupDistances:
        squares = np.stack(
            [squared_distances(column_distances(one, self.shape, self._reach), self._reach) for one in groups]
        )
        blocks = np.stack([self._block_distances(self._block_of(one)) for one in groups])
        is_near: Mask = np.logical_or.reduce(self._is_near[blocks], axis=0)
        return GroupDistances(squares, blocks, is_near)

    def _block_distances(self, pixels: Ints) -> SquaredDistances:
        """Return the index into `block_steps_m` of each block [blocks], for distances to some blocks."""
        reach, unreachable = self._block_reach, self._block_reach**2 + 1 + self._far_steps
        squares = squared_distances(column_distances(pixels, self._blocks, reach), reach)
        is_far = squares > reach**2
        if len(pixels) and is_far.any():
            empty = np.ones(self._blocks, np.bool_)
            empty.ravel()[pixels] = False
            farther = distance_transform_edt(empty)[is_far].astype(np.int64) - reach
            squares[is_far] = np.minimum(reach**2 + 1 + farther, unreachable)
        return np.minimum(squares, np.uint16(unreachable))

    def _block_of(self, pixels: Ints) -> Ints:
        column, row = np.divmod(pixels, self.shape[1])
        return column // BLOCK_PX * self._blocks[1] + row // BLOCK_PX


def _step_lengths(reach: int) -> Floats:
    """Return the square roots [S] (float32) of all whole numbers up to the square of a reach."""
    return np.sqrt(np.arange(reach**2 + 1)).astype(np.float32)


@compiled
def _sum_and_max(
    squares: SquaredDistances, blocks: SquaredDistances, is_near: Mask, limits: SquaredDistances, by_step: Floats,
    by_block: Floats, cells: Floats, total: Floats, maximum: Floats,
) -> None:  # fmt: skip
    """Add up rows [rows] over columns, and raise their maxima; see `DistanceRaster.mean_and_max`."""
    line, limit, beyond = _column_buffers(squares)
    for x in range(squares.shape[1]):
        if x % BLOCK_PX == 0:
            _fill_blocks(blocks, is_near, limits, by_block, x // BLOCK_PX, limit, beyond)
        _fill_best(squares, by_step, x, limit, beyond, line)
        for y in range(len(line)):
            total[y] += line[y] * cells[x, y]
            maximum[y] = max(maximum[y], line[y] if cells[x, y] > 0.0 else np.float32(0.0))


@compiled
def _add_best(
    squares: SquaredDistances, blocks: SquaredDistances, is_near: Mask, limits: SquaredDistances, by_step: Floats,
    by_block: Floats, total: Floats,
) -> None:  # fmt: skip
    """Add the best value to every pixel; see `DistanceRaster.add_best`."""
    line, limit, beyond = _column_buffers(squares)
    for x in range(len(total)):
        if x % BLOCK_PX == 0:
            _fill_blocks(blocks, is_near, limits, by_block, x // BLOCK_PX, limit, beyond)
        _fill_best(squares, by_step, x, limit, beyond, line)
        for y in range(len(line)):
            total[x, y] += line[y]


@compiled
def _column_buffers(squares: SquaredDistances) -> tuple[Floats, SquaredDistances, Floats]:
    """Return buffers for a column of pixels [rows], and for the values of the blocks that it passes [T, rows]."""
    groups, rows = squares.shape[0], squares.shape[2]
    return np.empty(rows, np.float32), np.empty((groups, rows), np.uint16), np.empty((groups, rows), np.float32)


@compiled
def _fill_blocks(
    blocks: SquaredDistances, is_near: Mask, limits: SquaredDistances, by_block: Floats, x: int,
    limit: SquaredDistances, beyond: Floats,
) -> None:  # fmt: skip
    for t in range(len(blocks)):
        for y in range(limit.shape[1]):
            block = blocks[t, x, y // BLOCK_PX]
            limit[t, y] = limits[block] if is_near[x, y // BLOCK_PX] else limits[0]
            beyond[t, y] = by_block[t, block]


@compiled
def _fill_best(
    squares: SquaredDistances, by_step: Floats, x: int, limit: SquaredDistances, beyond: Floats, line: Floats
) -> None:
    """Fill in the best group's value for a column of pixels; written so that the compiler vectorises it."""
    for t in range(len(squares)):
        square, step_values, maximum, block_values = squares[t, x], by_step[t], limit[t], beyond[t]
        for y in range(len(line)):
            value = step_values[min(square[y], maximum[y])]
            value = value if square[y] <= maximum[y] else block_values[y]
            line[y] = value if t == 0 else max(line[y], value)
