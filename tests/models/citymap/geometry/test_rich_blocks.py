import itertools

import numpy as np
import pytest
import shapely

from models.citymap.geometry.piece_rows import cut_band
from models.citymap.geometry.rich_blocks import MIN_FEATURES, find_rich_blocks
from models.citymap.geometry.segments import STEP_M, snap
from models.citymap.geometry.solids import Solid
from models.citymap.geometry.tiling import BLOCK_TILES, TILE_M, BlockSet, block_key, clip_to_tiles
from models.citymap.types import CutRules

RULES = CutRules()
COLUMNS = (-24, 48)


def random_features(seed):
    """Houses and paths in a few places, and one forest over everything."""
    rng = np.random.default_rng(seed)
    places = rng.uniform(-200, 440, (4, 2))
    houses = [shapely.box(*(p := places[n % 4] + rng.normal(0, 20, 2)), *(p + 6)) for n in range(24)]
    paths = [shapely.LineString(place + rng.normal(0, 30, (3, 2))).buffer(1) for place in places]
    forest = shapely.Point(100, 100).buffer(900, quad_segs=500)
    geometry = np.array([*houses, *paths, forest], dtype=object)
    return geometry, np.arange(len(geometry)) // len(houses) == 1  # paths and the forest: people walk in it


def blocks_of(*tiles):
    column, row = np.array(tiles).T // BLOCK_TILES
    return BlockSet(np.unique(block_key(column, row)))


@pytest.mark.parametrize("seed", range(4))
def test_no_block_is_missing_that_may_hold_a_centre(seed) -> None:
    geometry, is_walkable = random_features(seed)
    is_walkable[-1] = False
    blocks = find_rich_blocks(geometry, is_walkable, COLUMNS, RULES)
    count, tiles = 0, list(itertools.product(range(*COLUMNS), range(-30, 60)))
    column, row = np.array(tiles).T
    for tile, is_rich in zip(tiles, blocks.contains(column, row), strict=True):
        center = np.array(tile) * TILE_M
        cube = shapely.box(*(center - RULES.cell_size_m / 2), *(center + RULES.cell_size_m / 2))
        near_path = shapely.distance(shapely.Point(center), geometry[is_walkable]).min() <= RULES.reach_m
        may_be = near_path and shapely.intersects(cube, geometry).sum() >= MIN_FEATURES
        count += may_be
        assert is_rich or not may_be
    assert count
    assert len(blocks.keys) * BLOCK_TILES**2 < len(tiles) / 2, "most of the forest is left out"


def test_nothing_is_rich_without_anything_to_stand_on() -> None:
    geometry, _ = random_features(0)
    nobody = np.zeros(len(geometry), np.bool_)
    assert not len(find_rich_blocks(geometry, nobody, COLUMNS, RULES).keys)
    assert not len(find_rich_blocks(geometry[:0], nobody[:0], COLUMNS, RULES).keys)


def test_blocks_have_neighbours_rows_and_tiles() -> None:
    blocks = blocks_of((-1, -1), (8, 5))
    assert blocks.rows((-4, 0)).tolist() == [-4, -3, -2, -1]
    assert blocks.rows((-4, 12)).tolist() == [-4, -3, -2, -1, 4, 5, 6, 7]
    assert not len(blocks.rows((0, 8)))
    assert blocks.contains(np.array([-4, -5, 11, 8]), np.array([-1, -1, 7, 8])).tolist() == [True, False, True, False]
    around = blocks.with_neighbours()
    assert len(around.keys) == 2 * 9
    assert around.contains(np.array([-8, 3, 4]), np.array([-8, 3, 0])).all()
    assert BlockSet.concatenate([blocks, blocks]).keys.tolist() == blocks.keys.tolist()


@pytest.mark.parametrize("seed", range(3))
def test_pieces_in_blocks_are_those_of_the_whole(seed) -> None:
    geometry, _ = random_features(seed)
    solids = [Solid(n, "ground", shape) for n, shape in enumerate(geometry)]
    solids += [Solid(len(solids) + n, "column", shapely.Point(10 * n, 10 * n), 0.0, 4.0) for n in range(40)]
    blocks = blocks_of(*((n, n) for n in range(0, 40, 9)), (-20, 30))
    whole, part = cut_band(solids, COLUMNS), cut_band(solids, COLUMNS, blocks)
    expected = whole.take(np.flatnonzero(blocks.contains(whole.column, whole.row)))
    for name in ("column", "row", "instance", "bounds_m", "point_count", "sizes", "segments"):
        assert (getattr(part, name) == getattr(expected, name)).all(), name
    assert 0 < len(part.column) < len(whole.column) / 3


def test_a_tile_sees_few_vertices_of_a_large_area(monkeypatch) -> None:
    forest = shapely.Point(0, 0).buffer(5000, quad_segs=20_000)
    clipped, clip = [], shapely.clip_by_rect
    monkeypatch.setattr(
        shapely, "clip_by_rect", lambda g, *box: clipped.extend(shapely.get_num_coordinates(g)) or clip(g, *box)
    )
    cut = clip_to_tiles(np.array([forest]), (480, 504), blocks_of((490, 0), (490, 4), (495, -3)))
    assert len(cut.column)
    assert clipped[0] == shapely.get_num_coordinates(forest)
    assert max(clipped[1:]) < 1000


def test_a_whole_tile_is_snapped_as_any_other_area() -> None:
    tile = shapely.clip_by_rect(np.array([shapely.box(-100, -100, 500, 500)]), 45, 75, 55, 85)
    expected = shapely.set_precision(shapely.set_precision(tile, STEP_M), 0.0)
    assert shapely.get_coordinates(snap(tile)).tolist() == shapely.get_coordinates(expected).tolist()
