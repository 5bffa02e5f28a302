import numpy as np
import pytest
import shapely

from models.citymap.gazetteer import distance_raster
from models.citymap.gazetteer.distance_raster import BLOCK_PX, EXACT_REACH_M, MARGIN_M, DistanceRaster
from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER, build_gazetteer
from models.citymap.gazetteer.name_columns import GazetteerObject
from tests.models.citymap.gazetteer.made_town import MARKET, PARK, line, made_gazetteer, numbered, point

GRID_M = 10.0
CENTERS = np.stack(np.meshgrid(np.arange(-45, 446, GRID_M), np.arange(-45, 206, GRID_M)), axis=-1).reshape(-1, 2)


@pytest.fixture(scope="module")
def town():
    return made_gazetteer()


@pytest.fixture(scope="module")
def raster(town):
    return DistanceRaster(town, CENTERS, GRID_M)


def away(raster: DistanceRaster, objects: np.ndarray) -> np.ndarray:
    """[N] metres from all cells to the nearest of some objects."""
    [result] = raster.distances_m(raster.distances_to([objects]), np.arange(len(raster.cell_pixel)))
    return np.asarray(result)


def lines_away(raster: DistanceRaster, lines_m: np.ndarray) -> np.ndarray:
    """The same for lines."""
    [result] = raster.distances_m(raster.distances_to([], lines_m), np.arange(len(raster.cell_pixel)))
    return np.asarray(result)


def metres(shape: shapely.Geometry) -> np.ndarray:
    return np.asarray(shapely.distance(shape, shapely.points(CENTERS)))


@pytest.mark.parametrize(
    ("name", "shape"),
    [
        ("Bottino", shapely.Point(215, 92)),
        ("Whole Foods", shapely.box(*MARKET)),
        ("Chelsea Park", shapely.box(*PARK)),
        ("West 25th Street", shapely.LineString([(-50, 80), (450, 80)])),
        ("Harlem Road", shapely.LineString([(-50, 420), (450, 420)])),
    ],
)
def test_metres_are_true_to_the_grid(town, raster, name, shape) -> None:
    result, truth = away(raster, np.array([numbered(town, name)])), metres(shape)
    near = truth <= EXACT_REACH_M - GRID_M
    assert np.abs(result - truth)[near].max(initial=0.0) <= GRID_M
    assert np.abs(result - truth).max() <= np.sqrt(2) * BLOCK_PX * GRID_M, "by block"
    assert (result[~near] > EXACT_REACH_M - 2 * GRID_M).all()


@pytest.fixture(scope="module")
def wide():
    """A town of some kilometres, where some of what is meant lies far apart; and where that is."""
    rng = np.random.default_rng(1)
    centers = np.stack(np.meshgrid(np.arange(0, 4000, GRID_M), np.arange(0, 2000, GRID_M)), axis=-1).reshape(-1, 2)
    places = rng.uniform((0, 0), (4000, 2000), (6, 2))
    words, lines = [GazetteerObject(("x",))] * 6, [point(*place) for place in places]
    return DistanceRaster(build_gazetteer(words, lines, [False] * 6), centers, GRID_M), centers, places


GROUPS = np.array([0, 1, 2]), np.array([3, 4, 5])


def test_near_cells_are_true_to_the_grid_and_far_ones_to_their_block(wide) -> None:
    raster, centers, places = wide
    for group, metres_m in zip(
        GROUPS, raster.distances_m(raster.distances_to(GROUPS), np.arange(len(centers))), strict=True
    ):
        truth = np.linalg.norm(centers[:, None] - places[group], axis=2).min(axis=1)
        near = truth <= EXACT_REACH_M - GRID_M
        assert np.abs(metres_m - truth)[near].max() <= GRID_M
        assert np.abs(metres_m - truth).max() <= np.sqrt(2) * BLOCK_PX * GRID_M


@pytest.mark.parametrize(("spacing_m", "cells"), [(10.0, (1, 2000)), (1.0, (600, 3)), (50.0, (5, 300))])
def test_far_cells_are_as_far_as_they_are_on_a_map_of_any_width(spacing_m, cells) -> None:
    centers = np.stack(np.meshgrid(*(np.arange(count) * spacing_m for count in cells)), axis=-1).reshape(-1, 2)
    town = build_gazetteer([GazetteerObject(("x",))] * 2, [point(0, 0), point(9e7, 0)], [False] * 2)
    raster = DistanceRaster(town, centers, spacing_m)
    [result, nowhere] = raster.distances_m(raster.distances_to([np.array([0]), np.array([1])]), np.arange(len(centers)))
    assert np.abs(result - np.linalg.norm(centers, axis=1)).max() <= np.sqrt(2) * BLOCK_PX * spacing_m
    assert np.isinf(nowhere).all()


def test_what_is_looked_up_is_what_each_cell_would_have(wide) -> None:
    raster, centers, _ = wide
    away, cells = raster.distances_to(GROUPS), np.arange(len(centers))
    far = np.float32([[600.0], [900.0]])
    by_step, by_block = (np.exp(-steps / far) for steps in (raster.steps_m, raster.block_steps_m))
    each = np.exp(-raster.distances_m(away, cells) / far).max(axis=0)
    total = np.full(raster.shape, 2.0, np.float32)
    raster.add_best(total, away, by_step, by_block)
    np.testing.assert_array_equal(total.ravel()[raster.cell_pixel], 2 + each)
    mean, most = raster.mean_and_max(away, by_step, by_block)
    assert (mean, most) == (pytest.approx(each.mean(), rel=1e-6), each.max())


def test_the_nearest_of_several_counts(town, raster) -> None:
    objects = np.array([numbered(town, "Bottino"), numbered(town, "Elmo")])
    each = [away(raster, objects[n : n + 1]) for n in range(2)]
    assert (away(raster, objects) == np.minimum(*each)).all()


def test_lines_that_are_no_objects(raster) -> None:
    lines = np.concatenate([line((33, 7), (210, 160)), point(400, 5)])
    truth = np.minimum(metres(shapely.LineString([(33, 7), (210, 160)])), metres(shapely.Point(400, 5)))
    assert np.abs(lines_away(raster, lines) - truth).max() <= GRID_M


def test_the_hole_of_an_area_is_not_in_it() -> None:
    holed = np.concatenate(
        [
            line((0, 0), (200, 0), (200, 200), (0, 200), (0, 0)),
            line((50, 50), (150, 50), (150, 150), (50, 150), (50, 50)),
        ]
    )
    courtyard = build_gazetteer([GazetteerObject(("x",))], [holed], [True])
    centers = np.array([(100.0, 100.0), (25.0, 100.0)])
    middle, inside = away(DistanceRaster(courtyard, centers, 5.0), np.array([0]))
    assert middle == pytest.approx(50, abs=5)
    assert inside <= 10


def test_what_is_off_the_grid_is_infinitely_far() -> None:
    far = build_gazetteer([GazetteerObject(("x",))] * 2, [point(9000, 0), point(445 + MARGIN_M / 2, 0)], [False] * 2)
    raster = DistanceRaster(far, CENTERS, GRID_M)
    assert np.isinf(away(raster, np.array([0]))).all()
    assert away(raster, np.array([1])).min() == pytest.approx(MARGIN_M / 2, abs=GRID_M), "in the margin"
    assert np.isinf(lines_away(raster, point(9000, 0))).all()


def test_a_map_where_nothing_is_named() -> None:
    raster = DistanceRaster(EMPTY_GAZETTEER, CENTERS, GRID_M)
    assert lines_away(raster, point(0, 0)).shape == (len(CENTERS),)


def test_asked_again_it_says_the_same(town, monkeypatch) -> None:
    raster = DistanceRaster(town, CENTERS, GRID_M)
    most = 5 * max(raster.distances_to([np.array([n])]).nbytes for n in range(5)) // 2
    monkeypatch.setattr(distance_raster, "CACHE_BYTES", most)
    raster = DistanceRaster(town, CENTERS, GRID_M)
    first = [away(raster, np.array([n])).copy() for n in range(5)]
    assert 2 <= len(raster._cache) < 5
    assert sum(remaining.nbytes for remaining in raster._cache.values()) <= most, "no more than was allowed"
    assert all((away(raster, np.array([n])) == was).all() for n, was in enumerate(first))


def test_what_is_larger_than_all_that_is_kept_is_found_and_not_kept(town, raster, monkeypatch) -> None:
    monkeypatch.setattr(distance_raster, "CACHE_BYTES", 100)
    small = DistanceRaster(town, CENTERS, GRID_M)
    assert (away(small, np.array([0])) == away(raster, np.array([0]))).all()
    assert not small._cache
