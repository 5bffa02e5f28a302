"""Find the blocks of tiles that cells with enough parts can need, so that the rest of a region is not cut."""

from collections.abc import Iterator
from typing import Final

import numpy as np
import numpy.typing as npt
import shapely

from models.citymap.geometry.tiling import BLOCK_TILES, TILE_M, BlockSet, Geometries, TileSpan, block_key
from models.citymap.points import Ints
from models.citymap.types import CutRules, Floats

MIN_FEATURES: Final = 3  # of a cell; one feature may be several parts, such as a meadow on both sides of a path
DENSE_BLOCKS: Final = 6  # blocks along an edge of a square of which all are taken if there is enough for each of them
Box = tuple[int, int, int, int]  # first column and row of blocks, and those after the last


def find_rich_blocks(
    geometry: Geometries, is_walkable: npt.NDArray[np.bool_], columns: TileSpan, rules: CutRules
) -> BlockSet:
    """Return the blocks, in some columns of tiles, that may hold the centre of a cell.

    A cell has something to stand on within reach, and parts of at least `MIN_FEATURES` features. `geometry` [n] has the
    features within this reach of the columns. No block with such a cell is missing.
    """
    keys: list[Ints] = [np.zeros(0, np.int64)]
    if len(geometry):
        bounds = shapely.bounds(geometry)
        low, high = bounds[:, 1].min() - rules.reach_m, bounds[:, 3].max() + rules.reach_m
        first, last = (int(end // (BLOCK_TILES * TILE_M)) for end in (low, high))
        box = columns[0] // BLOCK_TILES, first, columns[1] // BLOCK_TILES, last + 1
        keys += _rich_parts(geometry, is_walkable, box, rules)
    return BlockSet(np.unique(np.concatenate(keys)))


def _rich_parts(geometry: Geometries, is_walkable: npt.NDArray[np.bool_], box: Box, rules: CutRules) -> Iterator[Ints]:
    """Yield the keys of blocks in a box that may hold a centre: halve the box, and clip the features to each half."""
    low_m, high_m = ((np.array(corner) * BLOCK_TILES - 0.5) * TILE_M for corner in (box[:2], box[2:]))
    near = _overlaps(shapely.bounds(geometry), low_m - rules.reach_m, high_m + rules.reach_m)
    geometry = shapely.clip_by_rect(geometry[near], *(low_m - rules.reach_m), *(high_m + rules.reach_m))
    is_left = ~shapely.is_empty(geometry)
    geometry, is_walkable = geometry[is_left], is_walkable[near][is_left]
    half_m = rules.cell_size_m / 2
    in_cells = _overlaps(shapely.bounds(geometry), low_m - half_m, high_m + half_m).sum()
    if in_cells < MIN_FEATURES or not is_walkable.any():
        return
    width, height = box[2] - box[0], box[3] - box[1]
    count = width * height
    if count == 1 or (max(width, height) <= DENSE_BLOCKS and in_cells >= rules.min_instances * count):
        column, row = np.divmod(np.arange(count), height)
        yield block_key(box[0] + column, box[1] + row)
    elif width > height:
        middle = box[0] + width // 2
        yield from _rich_parts(geometry, is_walkable, (box[0], box[1], middle, box[3]), rules)
        yield from _rich_parts(geometry, is_walkable, (middle, box[1], box[2], box[3]), rules)
    else:
        middle = box[1] + height // 2
        yield from _rich_parts(geometry, is_walkable, (box[0], box[1], box[2], middle), rules)
        yield from _rich_parts(geometry, is_walkable, (box[0], middle, box[2], box[3]), rules)


def _overlaps(bounds: Floats, low_m: Floats, high_m: Floats) -> npt.NDArray[np.bool_]:
    west, south, east, north = bounds.T
    return (west <= high_m[0]) & (east >= low_m[0]) & (south <= high_m[1]) & (north >= low_m[1])
