"""How far every cell of a map is from some objects, to the cells' grid where they are near, and else by block.

A name is near few of a city's cells: only these are looked at one by one, and for all others a distance transform of
blocks will do, of which there are a sixteenth as many.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from cachetools import LRUCache, cachedmethod
from scipy.ndimage import distance_transform_edt

from models.city.gazetteer.drawing import Grid, Mask, draw_areas, draw_lines, pixels_of
from models.city.gazetteer.gazetteer import Gazetteer
from models.city.gazetteer.nearest import columns_away, pixels_away
from models.city.points import Ints, ranges
from models.city.types import Floats
from models.compiled import compiled

SAMPLED_M = 6.0  # between samples of lines
MARGIN_M = 300.0  # round the cells, in which objects count too
LARGE_M = 20.0  # areas that reach farther have samples inside
LATTICE_M = 9.0  # between these
BLOCK: Final = 4  # cells to each side
NEAR_M: Final = 200.0  # as far as cells are looked at one by one
DIAGONAL: Final = 1.5  # of a block, rounded up
KEPT_BYTES = 16 * 2**20  # of distances that were asked for lately


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
        west_south = centers_m.min(axis=0) - MARGIN_M
        size = np.ceil((centers_m.max(axis=0) + MARGIN_M - west_south) / spacing_m).astype(int) + 1
        self._blocks = tuple((-(-size // BLOCK)).tolist())
        shape = BLOCK * self._blocks[0], BLOCK * self._blocks[1]
        self._grid = Grid(west_south[0], west_south[1], spacing_m, *shape)
        cell = pixels_of(self._grid, centers_m)
        self._cell = np.full(shape, -1, np.int32)  # of each pixel; of several cells in one the last
        self._cell.ravel()[cell] = np.arange(len(cell))
        self.block_of = self._block(cell).astype(np.int32)
        self.cells_in = np.bincount(self.block_of, minlength=self._blocks[0] * self._blocks[1])
        large, shapes = gazetteer.is_area & (gazetteer.reach_m > LARGE_M), (gazetteer.segments_m, gazetteer.starts)
        self._lines = draw_lines(self._grid, *shapes, np.arange(len(gazetteer)), SAMPLED_M)
        self._insides = draw_areas(self._grid, *shapes, np.flatnonzero(large), LATTICE_M)
        self._area = np.concatenate([[0], np.cumsum(large)])  # large ones before each object
        self._lately: LRUCache[tuple[bytes, ...], Away] = LRUCache(KEPT_BYTES, lambda away: away.nbytes)

    @cachedmethod(lambda raster: raster._lately, _asked)
    def away(self, groups: Sequence[Ints], lines_m: Floats | None = None) -> Away:
        """How far every cell is from each group of objects, and from segments [n, 4], if any, which are the first."""
        drawn = [self._drawn(some) for some in groups]
        if lines_m is not None:
            one = np.array([0, len(lines_m)]), np.zeros(1, np.int64)
            drawn.insert(0, draw_lines(self._grid, lines_m, *one, SAMPLED_M)[0])
        return self._away(drawn)

    def _drawn(self, objects: Ints) -> Ints:
        """[n] pixels of some objects."""
        both = (self._lines, objects, objects + 1), (self._insides, self._area[objects], self._area[objects + 1])
        return np.concatenate([pixel[ranges(starts[begin], starts[end])] for (pixel, starts), begin, end in both])

    def _away(self, groups: Sequence[Ints]) -> Away:
        """The same of pixels."""
        blocks = np.stack([self._metres_of_blocks(pixels) for pixels in groups])
        reach_m = NEAR_M + DIAGONAL * BLOCK * self._grid.spacing_m
        is_near = blocks.min(axis=0).reshape(self._blocks) <= reach_m
        near = _pixels_near(is_near, self._cell)
        rows = self._cell.ravel()[near].astype(np.int64)
        far = blocks[:, self.block_of[rows]]
        reach = BLOCK + math.ceil(reach_m / self._grid.spacing_m)
        away = np.stack([pixels_away(columns_away(pixels, self._cell.shape, reach), near, reach) for pixels in groups])
        metres = away * np.float32(self._grid.spacing_m)
        metres = np.where(metres <= NEAR_M, metres, np.minimum(metres, np.maximum(far, NEAR_M)))
        return Away(self.block_of, blocks, rows, metres)

    def _metres_of_blocks(self, pixels: Ints) -> Floats:
        if not len(pixels):
            return np.full(self._blocks[0] * self._blocks[1], np.inf, np.float32)
        empty = np.ones(self._blocks, np.bool_)
        empty.ravel()[self._block(pixels)] = False
        metres: Floats = distance_transform_edt(empty).astype(np.float32).ravel() * np.float32(
            BLOCK * self._grid.spacing_m
        )
        return metres

    def _block(self, pixels: Ints) -> Ints:
        """[n] block of each pixel."""
        column, row = np.divmod(pixels, self._grid.rows)
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
