import numpy as np
import pytest
import shapely

from models.citymap.gazetteer.closest_points import PointGroups, find_closest_points, select_objects
from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER, Gazetteer, build_gazetteer
from models.citymap.gazetteer.name_columns import GazetteerObject
from tests.models.citymap.gazetteer.made_town import line, point, ring

BOX = ring(10, 10, 30, 20)
HOLED = np.concatenate([ring(0, 0, 90, 90), ring(30, 30, 60, 60)])
FAR = 1e4


def way(shape: np.ndarray, position: tuple[float, float], area: bool = False, reach: float = FAR) -> list[float] | None:
    """The way from a position to one object."""
    around = PointGroups.from_groups(np.array([position], dtype=float), np.zeros(1, np.int64))
    result = find_closest_points(around, shape, np.array([0, len(shape)]), np.array([area]), reach)
    return result.offset_m[0].tolist() if len(result.target) else None


@pytest.mark.parametrize(
    ("shape", "position", "area", "expected"),
    [
        (point(3, 4), (0, 0), False, [3, 4]),
        (point(3, 4), (3, 4), False, [0, 0]),
        (line((0, 0), (10, 0)), (4, 5), False, [0, -5]),
        (line((0, 0), (10, 0)), (14, 3), False, [-4, -3]),
        (line((0, 0), (10, 0), (10, 10)), (12, 7), False, [-2, 0]),
        (np.concatenate([line((0, 0), (1, 0)), line((50, 0), (60, 0))]), (48, 0), False, [2, 0]),
        (BOX, (5, 15), True, [5, 0]),
        (BOX, (14, 15), True, [0, 0]),
        (BOX, (14, 15), False, [-4, 0]),
        (HOLED, (10, 45), True, [0, 0]),
        (HOLED, (32, 45), True, [-2, 0]),
        (np.concatenate([ring(0, 0, 9, 9), ring(50, 0, 59, 9)]), (55, 3), True, [0, 0]),
    ],
)
def test_ways(shape, position, area, expected) -> None:
    assert way(shape, position, area) == pytest.approx(expected, abs=1e-9)


def test_what_is_beyond_reach_is_left_out() -> None:
    assert way(point(30, 40), (0, 0), reach=49.9) is None
    assert way(point(30, 40), (0, 0), reach=50.0) == pytest.approx([30, 40])
    assert way(ring(-500, -500, 500, 500), (0, 0), area=True, reach=10.0) == [0, 0], "inside, far from every edge"


def test_an_area_is_no_way_off_for_those_inside_only_of_a_wide_group() -> None:
    points = np.array([(-300.0, 0.0), (0.0, 0.0), (300.0, 0.0)])
    result = find_closest_points(
        PointGroups.from_groups(points, np.zeros(3, np.int64)),
        ring(-200, -9, 200, 9),
        np.array([0, 4]),
        np.array([True]),
        150,
    )
    assert result.point.tolist() == [0, 1, 2]
    assert result.offset_m == pytest.approx(np.array([(100, 0), (0, 0), (-100, 0)]))


def random_town(rng: np.random.Generator) -> tuple[Gazetteer, list[shapely.Geometry]]:
    shapes, segments, is_area = [], [], []
    for n in range(60):
        x, y = rng.uniform(0, 500, 2)
        if n % 3 == 0:
            shapes.append(shapely.Point(x, y))
            segments.append(point(x, y))
        elif n % 3 == 1:
            pieces = [
                rng.uniform(-40, 40, (4, 2)) + np.array([x, y]),
                rng.uniform(-40, 40, (3, 2)) + np.array([x + 90, y]),
            ]
            shapes.append(shapely.MultiLineString(pieces))
            segments.append(np.concatenate([line(*piece) for piece in pieces]))
        else:
            turn = np.sort(rng.uniform(0, 2 * np.pi, 9))
            outer = np.stack([np.cos(turn), np.sin(turn)], axis=1) * rng.uniform(10, 60, (9, 1)) + (x, y)
            shapes.append(shapely.Polygon(outer))
            segments.append(line(*outer, outer[0]))
        is_area.append(n % 3 == 2)
    return build_gazetteer([GazetteerObject(("x",))] * len(shapes), segments, is_area), shapes


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("groups", [1, 7, 80])
def test_ways_are_those_of_shapely(seed, groups) -> None:
    rng = np.random.default_rng(seed)
    town, shapes = random_town(rng)
    points = rng.uniform(-100, 700, (80, 2))
    group = np.sort(rng.integers(groups, size=80))
    objects = rng.permutation(len(town))[:40]
    result = find_closest_points(PointGroups.from_groups(points, group), *select_objects(town, objects), 120.0)
    truth = np.array([[shapely.distance(shapes[o], position) for o in objects] for position in shapely.points(points)])
    measured = np.full(truth.shape, np.inf)
    measured[result.point, result.target] = result.distance_m
    assert len(result.target) == len(set(zip(result.point.tolist(), result.target.tolist(), strict=True))), (
        "each pair once"
    )
    assert np.allclose(np.where(truth <= 119.99, truth, 0), np.where(truth <= 119.99, measured, 0), atol=1e-3)
    assert np.isinf(measured[truth > 120.01]).all()
    ends = points[result.point] + result.offset_m
    off = [
        shapely.distance(shapes[objects[o]], shapely.Point(position))
        for o, position in zip(result.target, ends, strict=True)
    ]
    assert np.max(off) < 1e-3, "a way ends at the object"


def test_no_objects_and_no_points_have_no_ways() -> None:
    around = PointGroups.from_groups(np.zeros((1, 2)), np.zeros(1, np.int64))
    assert not len(find_closest_points(around, *select_objects(EMPTY_GAZETTEER, np.zeros(0, np.int64)), FAR).target)
    town = build_gazetteer([GazetteerObject(("x",))], [point(0, 0)], [False])
    assert not len(find_closest_points(around, *select_objects(town, np.zeros(0, np.int64)), FAR).target)


def test_groups_hold_their_points() -> None:
    points = np.array([(0.0, 0.0), (6.0, 8.0), (100.0, 0.0), (50.0, 50.0), (50.0, 51.0)])
    around = PointGroups.from_groups(points, np.array([0, 0, 3, 5, 5]))
    assert around.starts.tolist() == [0, 2, 3, 5]
    assert around.centers_m.tolist() == [[3, 4], [100, 0], [50, 50.5]]
    assert around.radius_m == 5.0
