import numpy as np
import pytest
import shapely

from models.citymap.geometry import pieces as pieces_module
from models.citymap.geometry.piece_rows import cut_band
from models.citymap.geometry.pieces import PieceTable
from models.citymap.geometry.solids import Solid, sample_solid
from models.citymap.geometry.tiling import (
    ALL_TILES,
    TILE_M,
    clip_to_tiles,
    split_connected,
    subtract_covers,
    tile_span,
)


def array(*geometries):
    result = np.empty(len(geometries), dtype=object)
    result[:] = geometries
    return result


def blob(rng, size):
    """An area with corners at random."""
    return shapely.convex_hull(shapely.MultiPoint(rng.uniform(-60, 60, 2) + rng.normal(size=(9, 2)) * size))


def pieces_of(solids):
    columns = np.stack(tile_span(shapely.bounds([solid.geometry for solid in solids])[:, [0, 2]]))
    return PieceTable.from_bands([cut_band(solids, (int(columns.min()), int(columns.max()) + 1))])


@pytest.mark.parametrize("seed", range(3))
def test_what_is_in_the_tiles_is_what_there_was(seed):
    rng = np.random.default_rng(seed)
    shapes = [blob(rng, size) for size in (2, 15, 40)] + [shapely.LineString(rng.uniform(-50, 50, (6, 2)))]
    shapes += [
        shapely.Point(3, 4),
        shapely.Polygon([(-20, -20), (20, -20), (20, 20), (-20, 20)], [[(-9, -9), (9, -9), (9, 9)]]),
    ]
    cut = clip_to_tiles(array(*shapes), ALL_TILES)
    middle = np.stack([cut.column, cut.row], axis=1) * TILE_M
    bounds = shapely.bounds(cut.geometry) - np.tile(middle, 2)
    assert np.abs(bounds).max() <= TILE_M / 2 + 1e-9
    for n, shape in enumerate(shapes):
        pieces = cut.geometry[cut.feature == n]
        size = shape.area or shape.length
        assert (shapely.area(pieces).sum() if shape.area else shapely.length(pieces).sum()) == pytest.approx(size)
        assert shapely.hausdorff_distance(shapely.union_all(pieces), shape) < 1e-6
    tiles = np.stack([cut.column, cut.row, cut.feature], axis=1)
    assert (np.lexsort((tiles[:, 2], tiles[:, 1], tiles[:, 0])) == np.arange(len(tiles))).all()


@pytest.mark.parametrize("seed", range(3))
def test_what_comes_first_covers_what_comes_later(seed):
    rng = np.random.default_rng(seed)
    tile = np.repeat(np.arange(5), rng.integers(1, 6, 5))
    areas = array(*(blob(rng, 30) for _ in tile))
    visible = subtract_covers(tile, areas)
    for n in range(len(tile)):
        above = [areas[m] for m in range(n) if tile[m] == tile[n]]
        naive = areas[n].difference(shapely.union_all(above)) if above else areas[n]
        assert shapely.area(visible[n]) == pytest.approx(naive.area, abs=1e-6)
        assert shapely.area(shapely.symmetric_difference(visible[n], naive)) < 1e-6


def test_parts_that_nearly_touch_hang_together():
    square = shapely.box(0, 0, 2, 2)
    near, far = shapely.box(2.5, 0, 3, 2), shapely.box(6, 0, 7, 2)
    owner, pieces = split_connected(array(shapely.MultiPolygon([far, square, near]), square, shapely.Polygon()), 2)
    assert owner.tolist() == [0, 0, 1]
    assert sorted(shapely.area(pieces[:2]).tolist()) == [2.0, 5.0]
    assert split_connected(array(shapely.Point(0, 0)), 2)[0].tolist() == []


def test_pieces_of_one_instance_are_linked_across_borders_where_they_touch():
    road = Solid(0, "ground", shapely.box(-30, -2, 30, 2))
    side = Solid(0, "ground", shapely.box(-30, 4, 30, 5.5))  # the same instance, as KITTI-360 numbers ground
    other = Solid(1, "ground", shapely.box(-30, -6, 30, -2))
    fence = Solid(2, "wall", shapely.LineString([(-30, 8), (30, 8)]), 0.0, 1.5)
    table = pieces_of([road, side, other, fence])
    middle = (table.bounds_m[:, :2] + table.bounds_m[:, 2:]) / 2
    for k in range(len(table.instance)):
        linked = table.links[table.link_starts[k] : table.link_starts[k + 1]]
        assert (table.instance[linked] == table.instance[k]).all()
        assert (np.abs(middle[linked, 1] - middle[k, 1]) <= TILE_M / 2).all()
        expected = 2 if abs(middle[k, 0]) < 25 else 1
        along = [n for n in linked if abs(middle[n, 0] - middle[k, 0]) > 1]
        assert len(along) >= (1 if expected == 1 else 2)
    both_sides = middle[table.instance == 0, 1]
    assert {round(float(y), 1) for y in both_sides} == {0.0, 4.5, 5.2}, "the side lies in two rows of tiles"


@pytest.mark.parametrize(
    ("shape", "geometry", "height"),
    [
        ("column", shapely.Point(1, 2), 6.0), ("crown", shapely.Point(1, 2), 9.0), ("box", shapely.Point(1, 2), 1.4),
        ("box", shapely.LineString([(0, 0), (4, 0)]), 1.0), ("wall", shapely.LineString([(0, 0), (9, 0)]), 2.0),
        ("outline", shapely.boundary(shapely.box(0, 0, 12, 9)), 12.0),
        ("ground", shapely.box(0.1, 0.1, 12.1, 9.1), 0.0),
    ],
)  # fmt: skip
def test_solids_are_worth_their_points(shape, geometry, height):
    solid = Solid(0, shape, geometry, 0.0, height)
    size = geometry.area if solid.form == "area" else geometry.length if solid.form == "line" else 1.0
    points = sample_solid(solid)
    assert solid.point_density * size == pytest.approx(len(points), rel=0.12)
    assert points[:, 2].max() == pytest.approx(solid.top_m if shape != "crown" else 9.0, abs=0.3)
    reach = shapely.distance(shapely.points(points[:, :2]), geometry).max()
    assert reach <= solid.radius_m * 1.5 + 1e-6


@pytest.mark.parametrize("columns", [1, 2, 3])
def test_pieces_of_some_columns_at_a_time_hang_together_as_all_do(columns, monkeypatch) -> None:
    rng = np.random.default_rng(columns)
    solids = [Solid(n % 3, "ground", blob(rng, 30), 0.0, 0.0) for n in range(9)]
    solids += [Solid(3 + n % 2, "wall", shapely.LineString(rng.uniform(-80, 80, (6, 2))), 0.0, 2.0) for n in range(4)]
    whole = pieces_of(solids)
    assert len(whole.column_starts) > 7
    assert len(whole.links)
    monkeypatch.setattr(pieces_module, "TILE_COLUMNS_PER_BLOCK", columns)
    part = pieces_of(solids)
    assert np.array_equal(part.link_starts, whole.link_starts)
    assert np.array_equal(part.links, whole.links)


@pytest.mark.parametrize("at_once", [1, 5, 17])
def test_places_to_stand_are_the_same_however_many_areas_are_looked_at_together(at_once, monkeypatch) -> None:
    rng = np.random.default_rng(at_once)
    table = pieces_of([Solid(n, "ground", blob(rng, 25), 0.0, 0.0) for n in range(6)])
    rows = np.flatnonzero(table.dimension == 2)
    whole = table.ground_lattice(rows, 2.0)
    block = np.floor(whole[:, :2] / 2.0)
    assert not whole[:, 2].any()
    assert len(np.unique(block, axis=0)) == len(whole) > 500
    monkeypatch.setattr(pieces_module, "PIECES_PER_BLOCK", at_once)
    assert np.array_equal(table.ground_lattice(rows, 2.0), whole)


def test_a_table_of_chosen_pieces_has_their_geometry_and_links() -> None:
    rng = np.random.default_rng(1)
    table = pieces_of([Solid(n, "ground", blob(rng, 40)) for n in range(6)])
    is_taken = rng.random(len(table.instance)) < 0.6
    taken, old = table.take(is_taken), np.flatnonzero(is_taken)
    assert shapely.equals(taken.geometry(np.arange(len(old))), table.geometry(old)).all()
    assert (taken.tile == table.tile[old]).all()
    for n, piece in enumerate(old):
        links = table.links[table.link_starts[piece] : table.link_starts[piece + 1]]
        expected = [int(np.searchsorted(old, link)) for link in links if is_taken[link]]
        assert taken.links[taken.link_starts[n] : taken.link_starts[n + 1]].tolist() == expected
    first = np.array([[-2, -3]]) + table.low
    rectangle = table.in_tiles(first, first + 9)[1]
    assert old[taken.in_tiles(first, first + 9)[1]].tolist() == rectangle[is_taken[rectangle]].tolist()


def test_rectangles_of_tiles_far_from_each_other_have_their_pieces() -> None:
    rng = np.random.default_rng(4)
    places = [
        shapely.transform(blob(rng, 30), lambda xy, middle=middle: xy + middle)
        for middle in rng.uniform(-4000, 4000, (5, 2))
    ]
    table = pieces_of([Solid(n, "ground", place) for n, place in enumerate(places)])
    corner = table.tile[rng.integers(0, len(table.row), 60)] + rng.integers(-9, 9, (60, 2))
    first, last = (
        np.concatenate([corner, table.low - [[900, 5]]]),
        np.concatenate([corner + 6, table.low - [[800, -5]]]),
    )
    rectangle, piece = table.in_tiles(first, last)
    inside = ((table.tile >= first[:, None]) & (table.tile <= last[:, None])).all(axis=-1)
    assert np.array_equal(np.stack([rectangle, piece]), np.stack(np.nonzero(inside)))
    assert len(piece) > 100
