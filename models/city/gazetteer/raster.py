"""How far every cell of a map is from some objects, to the cells' grid where they are near, and else by block.

A name is near few of a city's cells: only these are looked at one by one, and for all others a distance transform of
blocks will do, of which there are a sixteenth as many.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt
from cachetools import LRUCache, cachedmethod
from scipy.ndimage import distance_transform_edt

from models.city.gazetteer.gazetteer import Gazetteer
from models.city.gazetteer.nearest import columns_away, pixels_away, pixels_of
from models.city.points import Ints, ranges
from models.city.types import Floats
from models.compiled import compiled, longer

SAMPLED_M = 6.0  # between samples of lines
MARGIN_M = 300.0  # round the cells, in which objects count too
LARGE_M = 20.0  # areas that reach farther have samples inside
LATTICE_M = 9.0  # between these
BLOCK: Final = 4  # cells to each side
NEAR_M: Final = 200.0  # as far as cells are looked at one by one
DIAGONAL: Final = 1.5  # of a block, rounded up
KEPT_BYTES = 16 * 2**20  # of distances that were asked for lately
Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Away:
    """How far the cells of a map are from T groups of objects.

    Attributes:
        block_of: [N] block of each cell.
        blocks: [T, P] metres from the middle of each block to the block of the nearest object; inf if there is none.
        rows: [R] cells that are looked at one by one, each once.
        metres: [T, R] metres from each of these to the nearest, to the grid.
    """

    block_of: Ints
    blocks: Floats
    rows: Ints
    metres: Floats

    def at(self, cells: Ints) -> Floats:
        """[T, n] metres of some cells."""
        number = np.full(len(self.block_of), -1, np.int64)
        number[self.rows] = np.arange(len(self.rows))
        found, row = self.blocks[:, self.block_of[cells]], number[cells]
        found[:, row >= 0] = self.metres[:, row[row >= 0]]
        return found

    @property
    def nbytes(self) -> int:
        """What it takes, beside what all of a raster have."""
        return self.blocks.nbytes + self.rows.nbytes + self.metres.nbytes


def _asked(_: "Raster", groups: Sequence[Ints], lines_m: Floats | None = None) -> tuple[bytes, ...]:
    """What distances are remembered by."""
    return b"" if lines_m is None else lines_m.tobytes(), *(one.tobytes() for one in groups)


class Raster:
    """The cells' grid, with every object of a gazetteer on it.

    Args:
        gazetteer: of the map.
        centers_m: [N, 2] of the cells.
        spacing_m: of their grid.
    """

    def __init__(self, gazetteer: Gazetteer, centers_m: Floats, spacing_m: float) -> None:
        self.spacing_m = spacing_m
        self._low = centers_m.min(axis=0) - MARGIN_M
        size = np.ceil((centers_m.max(axis=0) + MARGIN_M - self._low) / spacing_m).astype(int) + 1
        self._blocks = tuple((-(-size // BLOCK)).tolist())
        self.shape = BLOCK * self._blocks[0], BLOCK * self._blocks[1]
        cell = self.pixels(centers_m)
        self._cell = np.full(self.shape, -1, np.int32)  # of each pixel; of several cells in one the last
        self._cell.ravel()[cell] = np.arange(len(cell))
        self.block_of = self._block(cell).astype(np.int32)
        self.cells_in = np.bincount(self.block_of, minlength=self._blocks[0] * self._blocks[1])
        self._pixel, self._starts = self._drawn(gazetteer)
        self._lately: LRUCache[tuple[bytes, ...], Away] = LRUCache(KEPT_BYTES, lambda away: away.nbytes)

    def pixels(self, points_m: Floats) -> Ints:
        """[n] pixel of points [n, 2], -1 outside."""
        found: Ints = pixels_of(points_m, self._low, self.spacing_m, self.shape)
        return found

    def _drawn(self, gazetteer: Gazetteer) -> tuple[Ints, Ints]:
        """[S] int32 pixels on every object's lines and inside large areas; starts [O + 1]."""
        if not len(gazetteer):
            return np.zeros(0, np.int32), np.zeros(1, np.int64)
        lines = gazetteer.segments_m
        steps = np.ceil(np.hypot(*(lines[:, 2:] - lines[:, :2]).T) / SAMPLED_M).astype(int) + 1
        owner = np.repeat(np.repeat(np.arange(len(gazetteer)), np.diff(gazetteer.starts)), steps)
        large = np.flatnonzero(gazetteer.is_area & (gazetteer.reach_m > LARGE_M))
        inside, number = lattice(lines, gazetteer.starts, large, LATTICE_M)
        drawn = [self.pixels(points).astype(np.int32) for points in (along(lines, steps), inside)]
        of = np.concatenate([owner, number])
        order = np.argsort(of, kind="stable")
        return np.concatenate(drawn)[order], np.searchsorted(of[order], np.arange(len(gazetteer) + 1))

    @cachedmethod(lambda raster: raster._lately, _asked)
    def away(self, groups: Sequence[Ints], lines_m: Floats | None = None) -> Away:
        """How far every cell is from each group of objects, and from segments [n, 4], if any, which are the first."""
        drawn = [] if lines_m is None else [self.pixels(along(lines_m, _steps(lines_m)))]
        drawn += [self._pixel[ranges(self._starts[some], self._starts[some + 1])] for some in groups]
        return self._away([pixels[pixels >= 0] for pixels in drawn])

    def _away(self, groups: Sequence[Ints]) -> Away:
        """The same of pixels."""
        blocks = np.stack([self._metres_of_blocks(pixels) for pixels in groups])
        reach_m = NEAR_M + DIAGONAL * BLOCK * self.spacing_m
        is_near = blocks.min(axis=0).reshape(self._blocks) <= reach_m
        near = _pixels_near(is_near, self._cell)
        rows = self._cell.ravel()[near].astype(np.int64)
        far = blocks[:, self.block_of[rows]]
        reach = BLOCK + math.ceil(reach_m / self.spacing_m)
        away = np.stack([pixels_away(columns_away(pixels, self.shape, reach), near, reach) for pixels in groups])
        metres = away * np.float32(self.spacing_m)
        metres = np.where(metres <= NEAR_M, metres, np.minimum(metres, np.maximum(far, NEAR_M)))
        return Away(self.block_of, blocks, rows, metres)

    def _metres_of_blocks(self, pixels: Ints) -> Floats:
        if not len(pixels):
            return np.full(self._blocks[0] * self._blocks[1], np.inf, np.float32)
        empty = np.ones(self._blocks, np.bool_)
        empty.ravel()[self._block(pixels)] = False
        metres: Floats = distance_transform_edt(empty).astype(np.float32).ravel() * np.float32(BLOCK * self.spacing_m)
        return metres

    def _block(self, pixels: Ints) -> Ints:
        """[n] block of each pixel."""
        column, row = np.divmod(pixels, self.shape[1])
        block: Ints = column // BLOCK * self._blocks[1] + row // BLOCK
        return block


@compiled
def _pixels_near(is_near: Mask, cell: Ints) -> Ints:
    """[R] the pixels of some blocks that have a cell, ascending."""
    near, count = np.empty(cell.size, np.int64), 0
    for x in range(cell.shape[0]):
        for y in range(cell.shape[1]):
            if is_near[x // BLOCK, y // BLOCK] and cell[x, y] >= 0:
                near[count] = x * cell.shape[1] + y
                count += 1
    return near[:count].copy()


def _steps(lines_m: Floats) -> Ints:
    """[n] samples of each of some segments [n, 4]."""
    long_m = np.hypot(*(lines_m[:, 2:] - lines_m[:, :2]).T)
    steps: Ints = np.maximum(1, np.ceil(long_m / SAMPLED_M)).astype(np.int64) + 1
    return steps


@compiled
def along(lines_m: Floats, steps: Ints) -> Floats:
    """Points [S, 2] along segments [n, 4], so many of each."""
    points, count = np.empty((steps.sum(), 2)), 0
    for n in range(len(lines_m)):
        x1, y1, x2, y2 = lines_m[n].astype(np.float64)
        for k in range(steps[n]):
            share = k / max(steps[n] - 1, 1)
            points[count, 0], points[count, 1] = x1 + share * (x2 - x1), y1 + share * (y2 - y1)
            count += 1
    return points


@compiled
def lattice(segments_m: Floats, starts: Ints, areas: Ints, apart_m: float) -> tuple[Floats, Ints]:
    """Points [n, 2] in rows and columns inside some areas, and [n] which of the objects each is in.

    Args:
        segments_m: of all objects, see `Gazetteer`.
        starts: likewise.
        areas: some of them.
        apart_m: between rows, and between columns.
    """
    count, points, of = 0, np.empty((1024, 2)), np.empty(1024, np.int64)
    for number in areas:
        ends = segments_m[starts[number] : starts[number + 1]].astype(np.float64)
        low_x, high_x = min(ends[:, 0].min(), ends[:, 2].min()), max(ends[:, 0].max(), ends[:, 2].max())
        low_y, high_y = min(ends[:, 1].min(), ends[:, 3].min()), max(ends[:, 1].max(), ends[:, 3].max())
        xs = np.arange(low_x + apart_m / 2, high_x, apart_m)
        ys = np.arange(low_y + apart_m / 2, high_y, apart_m)
        is_in = _inside(xs, ys, ends)
        for column in range(len(xs)):
            for row in range(len(ys)):
                if is_in[column, row]:
                    if count == len(of):
                        points, of = longer(points), longer(of)
                    points[count, 0], points[count, 1], of[count] = xs[column], ys[row], number
                    count += 1
    return points[:count].copy(), of[:count].copy()


@compiled
def _inside(xs: Floats, ys: Floats, ends: Floats) -> Mask:
    """[columns, rows] whether the points of a lattice are inside rings, as `is_inside`; an edge is met once a row."""
    is_in = np.zeros((len(xs), len(ys)), np.bool_)
    for row in range(len(ys)):
        is_odd = np.zeros(len(xs) + 1, np.bool_)  # where the number of edges to the east changes
        for s in range(len(ends)):
            x1, y1, x2, y2 = ends[s]
            if (y1 > ys[row]) != (y2 > ys[row]):
                before = np.searchsorted(xs, x1 + (ys[row] - y1) * (x2 - x1) / (y2 - y1))  # columns west of it
                is_odd[before] = not is_odd[before]
        crossed = False
        for column in range(len(xs) - 1, -1, -1):
            crossed = crossed != is_odd[column + 1]
            is_in[column, row] = crossed
    return is_in
