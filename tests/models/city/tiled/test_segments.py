import numpy as np
import pytest
import shapely

from models.city.tiled.segments import STEP_M, geometry_of, ring_starts, segments_of, snapped


def test_pieces_are_put_together_again_from_their_segments(city) -> None:
    table = city.pieces
    pieces = np.random.default_rng(0).permutation(len(table.instance))[:400]
    stored = type(table).of_columns(table.columns())
    again, whole = stored.geometry(pieces), table.whole[pieces]
    assert stored.whole is None
    assert (shapely.get_dimensions(again) == shapely.get_dimensions(whole)).all()
    assert {0, 2} <= set(shapely.get_dimensions(whole).tolist())
    assert shapely.hausdorff_distance(again, whole).max() < STEP_M
    assert np.allclose(shapely.area(again), shapely.area(whole), atol=0.02)


def test_a_table_without_geometry_cuts_the_same_parts(city, bodies, cells) -> None:
    stored = type(bodies)(type(city.pieces).of_columns(city.pieces.columns()), bodies.rgb, bodies.shapes, bodies.rules)
    one, other = bodies.cut(cells.center_m[:60]), stored.cut(cells.center_m[:60])
    assert (one.instance == other.instance).all()
    assert np.abs(one.count - other.count).max() <= 1
    assert np.allclose(one.closest_m, other.closest_m, atol=2 * STEP_M)
    assert np.allclose(one.low_m, other.low_m, atol=2 * STEP_M)


def again(*polygons: shapely.Polygon) -> np.ndarray:
    geometry = snapped(np.array(polygons, dtype=object))
    tile, pieces = np.zeros((len(polygons), 2), np.int64), np.arange(len(polygons))
    return geometry_of(*segments_of(geometry, tile), tile, shapely.get_dimensions(geometry), pieces)


def test_rings_that_meet_where_they_begin_are_two() -> None:
    """A courtyard whose corner is one of the house's, each ring told from there."""
    house, yard = [(0, 0), (4, 0), (4, 4)], [(0, 0), (1, 2), (2, 1)]
    ends = [[*a, *b] for ring in (house, yard) for a, b in zip(ring, ring[1:] + ring[:1], strict=True)]
    assert ring_starts(np.array(ends, np.int16)).tolist() == [0, 3]
    touching = shapely.Polygon([(0, 0), (4, 0), (4, 4), (0, 4)], [yard])
    assert again(touching)[0].area == pytest.approx(touching.area)


def test_what_is_thinner_than_a_step_is_nothing_and_spoils_nothing() -> None:
    sliver = shapely.Polygon([(0, 0), (3, 0), (0, STEP_M / 9)])
    assert shapely.is_empty(snapped(np.array([sliver])))[0]
    house = shapely.MultiPolygon([sliver, shapely.box(1, 1, 3, 3)])
    [found] = again(house)
    assert found.area == pytest.approx(4)
