import numpy as np
import pytest
from sklearn.cluster import DBSCAN

from models.citymap import cells as cells_module
from models.citymap.cells import cut_cubes, cut_parts, grid_centers
from models.citymap.map_geometry import build_geometry, cut_cells
from models.citymap.points import PointTable
from models.citymap.types import CityMap, CutRules, Instance
from models.errors import MapError


def naive_parts(city: CityMap, center: np.ndarray) -> list[tuple[int, frozenset]]:
    """Rule 4 as it reads, one instance after the other, with scikit-learn's DBSCAN."""
    rules, half = city.rules, city.rules.cell_size_m / 2
    parts = []
    for row, instance in enumerate(city.instances):
        inside = (np.abs(instance.points_m.astype(float) - center) <= half).all(axis=1)
        if instance.label not in city.stuff:
            if inside.sum() and inside.mean() >= rules.thing_share:
                parts.append((row, frozenset(range(len(inside)))))
        elif inside.any():
            rows = np.flatnonzero(inside)
            labels = DBSCAN(eps=rules.eps_m, min_samples=rules.min_samples).fit(instance.points_m[rows]).labels_
            clusters = [rows[labels == label] for label in range(labels.max() + 1)]
            parts += [(row, frozenset(c.tolist())) for c in clusters if len(c) >= rules.min_part_points]
    return parts


@pytest.mark.parametrize("n", range(8))
def test_cutting_equals_the_rules_read_literally(scan, points, n) -> None:
    center = np.random.default_rng(n).uniform(-140, 140, 3) * [1, 1, 0]
    mine = [
        (int(points.instance[rows[0]]), frozenset((rows - points.starts[points.instance[rows[0]]]).tolist()))
        for rows in cut_parts(points, center, scan.rules)
    ]
    assert sorted(mine, key=repr) == sorted(naive_parts(scan, center), key=repr)
    assert len(mine) > 3


@pytest.mark.parametrize("seed", range(4))
def test_centres_are_the_points_of_the_grid_within_reach_of_a_location(seed, monkeypatch) -> None:
    """Clusters of locations kilometres apart, as villages in a valley are."""
    rng, rules = np.random.default_rng(seed), CutRules()
    villages_m = rng.uniform(-3000, 3000, (3, 1, 3)) + rng.uniform(-40, 40, (3, 6, 3))
    locations_m = villages_m.reshape(-1, 3)
    low, high = locations_m[:, :2].min(axis=0) - rules.reach_m, locations_m[:, :2].max(axis=0) + rules.reach_m
    x, y = (
        np.arange(np.ceil(a / rules.grid_m), b / rules.grid_m) * rules.grid_m for a, b in zip(low, high, strict=True)
    )
    all_m = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    inside = ((all_m >= low + rules.reach_m - rules.grid_m) & (all_m <= high - rules.reach_m + rules.grid_m)).all(
        axis=1
    )
    away_m = np.linalg.norm(all_m[:, None] - locations_m[:, :2], axis=-1)
    expected = all_m[inside & (away_m.min(axis=1) <= rules.reach_m)]
    monkeypatch.setattr(cells_module, "GRID_POINTS_PER_BLOCK", 50)
    centers_m = grid_centers(locations_m, rules)
    assert np.array_equal(centers_m[:, :2], expected)
    nearest = np.linalg.norm(expected[:, None] - locations_m[:, :2], axis=-1).argmin(axis=1)
    assert np.array_equal(centers_m[:, 2], locations_m[nearest, 2])


def ragged_city(seed: int) -> CityMap:
    """Clouds at random, so that DBSCAN meets noise, border points and several clusters."""
    rng = np.random.default_rng(seed)
    clouds = [(rng.normal(size=(300, 3)) * [4, 4, 0.3]).astype(np.float32) for _ in range(4)]
    instances = tuple(Instance(i, "terrain", cloud) for i, cloud in enumerate(clouds))
    rules = CutRules(min_part_points=8, min_instances=1)
    return CityMap("ragged", instances, frozenset({"terrain"}), np.zeros((1, 3)), rules=rules)


@pytest.mark.parametrize("seed", range(6))
def test_ragged_stuff_is_split_as_scikit_learn_does(seed) -> None:
    city = ragged_city(seed)
    points = PointTable.from_map(city, city.rules.eps_m)
    center = np.array([13.0, 12.0, 0.0])  # most of the clouds are outside
    mine = [
        (int(points.instance[rows[0]]), frozenset((rows - points.starts[points.instance[rows[0]]]).tolist()))
        for rows in cut_parts(points, center, city.rules)
    ]
    assert mine == naive_parts(city, center)


def test_the_summary_of_parts(scan, points) -> None:
    center = np.array([[7.0, -12.0, 0.0]])
    parts = cut_cubes(points, center, scan.rules)
    members_of = cut_parts(points, center[0], scan.rules)
    assert len(members_of) == len(parts.instance) > 3
    for row, members in zip(np.argsort(parts.instance, kind="stable"), members_of, strict=True):
        xyz = points.xyz[members]
        assert parts.count[row] == len(xyz)
        assert (parts.low_m[row] == xyz.min(axis=0)).all()
        assert (parts.high_m[row] == xyz.max(axis=0)).all()
        closest = np.linalg.norm(xyz - center[0], axis=1).min()
        assert np.linalg.norm(parts.closest_m[row] - center[0]) == pytest.approx(closest, abs=1e-4)


def test_processes_give_what_one_gives(scan, points, monkeypatch) -> None:
    centers = grid_centers(scan.locations_m, scan.rules)
    many = cut_cubes(points, centers, scan.rules)
    monkeypatch.setattr(cells_module, "CUBES_PER_TASK", 10**6)
    one = cut_cubes(points, centers, scan.rules)
    for name in ("starts", "instance", "count", "low_m", "closest_m", "rgb"):
        assert np.array_equal(getattr(many, name), getattr(one, name), equal_nan=True)


def test_colours_of_points_are_averaged_over_the_part() -> None:
    rgb = np.linspace(0, 1, 300)[:, None].repeat(3, axis=1).astype(np.float32)
    city = ragged_city(0)
    clouds = tuple(Instance(i.id, i.label, i.points_m, rgb) for i in city.instances[:1])
    city = CityMap("c", clouds, city.stuff, city.locations_m, rules=city.rules)
    points = PointTable.from_map(city, 0.75)
    parts = cut_cubes(points, np.zeros((1, 3)), city.rules)
    members = cut_parts(points, np.zeros(3), city.rules)
    assert parts.rgb[0] == pytest.approx(rgb[members[0]].mean(axis=0), abs=1e-5)


def test_the_grid_is_regular_and_within_reach(city) -> None:
    centers = grid_centers(city.locations_m, city.rules)
    assert (centers[:, :2] % city.rules.grid_m == 0).all()
    distance = np.linalg.norm(centers[:, None, :2] - city.locations_m[None, ::7, :2], axis=2).min(axis=1)
    assert distance.max() <= city.rules.reach_m + 15


def test_a_grid_is_the_same_however_much_of_it_is_looked_at_together(city, monkeypatch) -> None:
    whole = grid_centers(city.locations_m, city.rules)
    monkeypatch.setattr(cells_module, "GRID_POINTS_PER_BLOCK", 7)
    assert np.array_equal(grid_centers(city.locations_m, city.rules), whole)


def test_the_rows_of_all_cubes_but_empty_ones_are_not_copied(scan, points) -> None:
    centers = grid_centers(scan.locations_m, scan.rules)
    centers = np.concatenate([centers[:9], centers[:1] + 1e5, centers[9:]])
    parts = cut_cubes(points, centers, scan.rules)
    remaining = np.flatnonzero(np.diff(parts.starts))
    assert 9 not in remaining
    taken = parts.take(remaining)
    assert taken.instance is parts.instance
    assert np.array_equal(np.diff(taken.starts), np.diff(parts.starts)[remaining])
    assert len(parts.take(remaining[:-1]).instance) == parts.starts[remaining[-1]]
    assert parts.take(remaining[::-1]).instance.tolist() != parts.instance.tolist()


def test_cells_are_numbered_and_rich_enough(city, cells) -> None:
    sizes = np.diff(cells.parts.starts)
    assert sizes.min() >= city.rules.min_instances
    assert cells.ids[:2] == ("tinytown_00000", "tinytown_00001")
    part = cells.take(np.array([5, 2]))
    assert part.ids == (cells.ids[5], cells.ids[2])
    assert (
        part.parts.instance
        == np.concatenate([cells.parts.instance[cells.parts.starts[n] : cells.parts.starts[n + 1]] for n in (5, 2)])
    ).all()


def test_a_map_too_poor_for_cells_says_so() -> None:
    city = ragged_city(0)
    poor = CityMap("poor", city.instances[:2], city.stuff, city.locations_m)
    with pytest.raises(MapError, match="has 6 instances"):
        cut_cells(poor, build_geometry(poor))
