from dataclasses import replace

import numpy as np
import pytest
import shapely

from models.citymap.geometry.pieces import PieceTable
from models.citymap.geometry.segments import STEP_M, ring_starts, segments_of, snap, to_geometry, to_segments
from models.citymap.geometry.tiling import TILE_M


def test_pieces_are_put_together_again_from_their_segments(city) -> None:
    table = city.pieces
    pieces = np.random.default_rng(0).integers(0, len(table.instance), 400)
    result = table.geometry(pieces)
    dimension = table.dimension[pieces]
    assert {0, 2} <= set(dimension.tolist())
    assert (shapely.get_dimensions(result) == dimension).all()
    assert shapely.is_valid(result).all()
    area = dimension == 2
    assert np.allclose(shapely.bounds(result[area]), table.bounds_m[pieces][area], atol=2 * STEP_M)
    for geometry, piece in zip(result, pieces.tolist(), strict=True):
        owner = slice(*table.segment_starts[[piece, piece + 1]])
        segments = to_segments(np.array([geometry]), table.tile[[piece]])[1]
        assert sorted(_undirected(segments)) == sorted(_undirected(table.segments[owner]))


def test_a_table_of_a_file_finds_the_same_tiles(city) -> None:
    """Whoever makes a table knows the tiles of its pieces, whoever opens one finds them when they are asked for."""
    opened = PieceTable.from_columns(city.pieces.columns())
    assert "tile" not in vars(opened)
    assert np.array_equal(opened.tile, city.pieces.tile)
    assert opened.tile.dtype == city.pieces.tile.dtype


def test_instances_are_numbered_anew(city) -> None:
    numbers = np.unique(city.pieces.instance)
    table = replace(city.pieces, instance=2 * city.pieces.instance + 7).renumber_instances(2 * numbers + 7)
    assert np.array_equal(table.instance, city.pieces.instance)
    assert np.array_equal(table.tile, city.pieces.tile)


def _undirected(segments: np.ndarray) -> list[tuple[tuple[int, int], ...]]:
    return [tuple(sorted(((x1, y1), (x2, y2)))) for x1, y1, x2, y2 in segments.tolist()]


def again(*polygons: shapely.Polygon) -> np.ndarray:
    geometry = snap(np.array(polygons, dtype=object))
    tile, pieces = np.zeros((len(polygons), 2), np.int64), np.arange(len(polygons))
    return to_geometry(*to_segments(geometry, tile), tile, shapely.get_dimensions(geometry), pieces)


def test_rings_that_meet_where_they_begin_are_two() -> None:
    """A courtyard whose corner is one of the house's, each ring told from there."""
    house, yard = [(0, 0), (4, 0), (4, 4)], [(0, 0), (1, 2), (2, 1)]
    ends = [[*a, *b] for ring in (house, yard) for a, b in zip(ring, ring[1:] + ring[:1], strict=True)]
    assert ring_starts(np.array(ends, np.int16)).tolist() == [0, 3]
    touching = shapely.Polygon([(0, 0), (4, 0), (4, 4), (0, 4)], [yard])
    assert again(touching)[0].area == pytest.approx(touching.area)


def test_what_is_thinner_than_a_step_is_nothing_and_spoils_nothing() -> None:
    sliver = shapely.Polygon([(0, 0), (3, 0), (0, STEP_M / 9)])
    assert shapely.is_empty(snap(np.array([sliver])))[0]
    house = shapely.MultiPolygon([sliver, shapely.box(1, 1, 3, 3)])
    [result] = again(house)
    assert result.area == pytest.approx(4)


def test_a_piece_that_is_its_tile_has_no_segments_and_is_put_together_all_the_same() -> None:
    half = TILE_M / 2
    whole, yard = shapely.box(-half, -half, half, half), [(0, 0), (1, 0), (1, 1)]
    pieces = [whole, shapely.Polygon(whole.exterior, [yard]), shapely.box(-half, -half, half, 0), whole]
    geometry = snap(shapely.transform(np.array(pieces), lambda xy: xy + np.array([70, -20])))
    tile, rows = np.tile([7, -2], (4, 1)), np.arange(4)
    starts, segments = to_segments(geometry, tile)
    assert np.diff(starts).tolist() == [0, 7, 4, 0]
    assert shapely.equals(to_geometry(starts, segments, tile, np.full(4, 2), rows), geometry).all()
    owner, ends = segments_of(starts, segments, rows[::-1])
    assert owner.tolist() == [0] * 4 + [1] * 4 + [2] * 7 + [3] * 4
    assert np.array_equal(ends[:4], ends[-4:])
