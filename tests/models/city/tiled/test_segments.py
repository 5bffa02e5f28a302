import numpy as np
import shapely

from models.city.tiled.segments import STEP_M


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
