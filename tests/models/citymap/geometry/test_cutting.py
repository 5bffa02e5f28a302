"""Parts of cubes against shapely, one instance after the other, and against the same town as points."""

import numpy as np
import pytest
import shapely
from scipy.cluster.hierarchy import DisjointSet

from models.citymap.geometry import cutting
from models.citymap.geometry.solids import GROUND_SPACING_M, crown_reach_m
from models.citymap.geometry.tiling import TOUCHING_M
from models.citymap.map_geometry import ScannedPieceGeometry, build_geometry


def naive_parts(city, center):
    """(instance, worth, box, closest) of what lies in a cube, read literally."""
    pieces, rules = city.pieces, city.rules
    half = rules.cell_size_m / 2
    square = shapely.box(*(center[:2] - half), *(center[:2] + half))
    position, result = shapely.Point(center[:2]), []
    for i, instance in enumerate(city.instances):
        mine = np.flatnonzero(pieces.instance == i)
        geometry = pieces.geometry(mine)
        inside = shapely.intersection(geometry, square)
        size = shapely.area(geometry) + shapely.length(geometry) * (shapely.area(geometry) == 0)
        share = (shapely.area(inside) + shapely.length(inside) * (shapely.area(geometry) == 0)) / np.maximum(size, 1e-9)
        share = np.where(size > 0, share, ~shapely.is_empty(inside))
        point_count = pieces.point_count[mine] * share
        if instance.label not in city.stuff:
            if point_count.sum() and point_count.sum() >= rules.thing_share * pieces.point_count[mine].sum():
                metres = shapely.distance(geometry, position).min()
                crown = crown_reach_m(np.array([metres]), pieces.crown_m[mine[:1]])[0]
                result.append((i, pieces.point_count[mine].sum(), None, metres - crown))
            continue
        there = np.flatnonzero(point_count > 0)
        sets = DisjointSet(there.tolist())
        for a in there:
            for b in there:
                if a < b and shapely.dwithin(
                    inside[a],
                    inside[b],
                    TOUCHING_M if pieces.tile[mine[a]].tolist() == pieces.tile[mine[b]].tolist() else 1e-6,
                ):
                    sets.merge(a, b)
        for part in sets.subsets():
            rows = sorted(part)
            if point_count[rows].sum() >= rules.min_part_points:
                box = shapely.total_bounds(inside[rows])
                result.append((i, point_count[rows].sum(), box, shapely.distance(inside[rows], position).min()))
    return result


@pytest.mark.parametrize("seed", range(6))
def test_cubes_are_what_shapely_cuts(city, geometry, seed):
    center = np.random.default_rng(seed).uniform(-140, 140, (1, 3)) * [1, 1, 0]
    if seed < 2:
        center = np.round(center / 10) * 10  # a cell of the grid, whose borders are those of tiles
    parts, naive = geometry.cut(center), naive_parts(city, center[0])
    mine = sorted(zip(parts.instance.tolist(), parts.count.tolist(), strict=True))
    assert [i for i, _ in mine] == sorted(i for i, *_ in naive)
    assert [point_count for _, point_count in mine] == pytest.approx(
        [w for _, w in sorted((i, w) for i, w, *_ in naive)], abs=1
    )
    away = np.linalg.norm((parts.closest_m - center)[:, :2], axis=1)
    order = np.lexsort((parts.count, parts.instance))
    naive.sort(key=lambda row: (row[0], row[1]))
    assert away[order] == pytest.approx([row[3] for row in naive], abs=1e-3)
    for row, (*_, box, _) in zip(order, naive, strict=True):
        if box is not None:
            mine_box = np.concatenate([parts.low_m[row, :2], parts.high_m[row, :2]])
            assert mine_box == pytest.approx(box, abs=1e-3)


def test_the_town_as_geometry_is_nearly_the_town_as_points(city, scan, geometry, cells):
    rows = np.arange(0, len(cells), 5)
    one, other = geometry.cut(cells.center_m[rows]), build_geometry(scan).cut(cells.center_m[rows])
    assert len(one.instance) == pytest.approx(len(other.instance), rel=0.02)
    shared = 0.0
    for n in range(len(rows)):
        a, b = (part.instance[part.starts[n] : part.starts[n + 1]] for part in (one, other))
        shared += len(np.intersect1d(a, b)) / len(np.union1d(a, b))
    assert shared / len(rows) > 0.93
    labels = np.array([instance.label for instance in city.instances])
    building, theirs = (part.count[labels[part.instance] == "building"] for part in (one, other))
    assert building.mean() == pytest.approx(theirs.mean(), rel=0.05)


def test_processes_give_what_one_gives(geometry, cells, monkeypatch):
    many = geometry.cut(cells.center_m)
    monkeypatch.setattr(cutting, "CUBES_PER_TASK", 64)
    one = geometry.cut(cells.center_m)
    for name in ("starts", "instance", "count", "low_m", "high_m", "closest_m", "rgb"):
        assert np.array_equal(getattr(many, name), getattr(one, name), equal_nan=True)


def test_cubes_of_few_parts_are_left_empty_for_whom_they_are_too_few(geometry, cells):
    parts = geometry.cut(cells.center_m)
    sizes = np.diff(parts.starts)
    least = int(np.median(sizes)) + 1
    rich = geometry.cut(cells.center_m, min_parts=least)
    remaining = np.flatnonzero(sizes >= least)
    assert 0 < len(remaining) < len(cells)
    assert np.array_equal(np.diff(rich.starts), np.where(sizes >= least, sizes, 0))
    assert np.array_equal(rich.closest_m, parts.take(remaining).closest_m)


def test_no_cube_and_empty_cubes_have_no_parts(geometry):
    assert geometry.cut(np.zeros((0, 3))).starts.tolist() == [0]
    far = geometry.cut(np.array([[1e5, 0.0, 0.0], [0.0, -1e5, 0.0]]))
    assert far.starts.tolist() == [0, 0, 0]
    assert far.low_m.shape == (0, 3)


def test_what_is_nearest_in_a_scan_is_one_of_its_points(geometry, cells):
    centers = cells.center_m[::9]
    known, scanned = geometry.cut(centers), ScannedPieceGeometry(geometry).cut(centers)
    assert (scanned.instance == known.instance).all()
    metres = [np.linalg.norm((parts.closest_m - centers[parts.cube])[:, :2], axis=1) for parts in (known, scanned)]
    flat = scanned.low_m[:, 2] == scanned.high_m[:, 2]
    assert (metres[1] >= metres[0] - 1e-3)[flat].all()
    assert (metres[1] <= metres[0] + 2 * GROUND_SPACING_M)[flat].all()
    assert (scanned.closest_m[flat] % GROUND_SPACING_M == 0).all()
    away = np.linalg.norm((scanned.closest_m - known.closest_m)[:, :2], axis=1)
    assert away[flat].max() > GROUND_SPACING_M, "along an edge it is off by more"


def test_points_are_sampled_of_each_part(geometry, cells):
    rows = np.array([3, 40, 7])
    samples = geometry.sample(cells.center_m, rows)
    parts = geometry.cut(cells.center_m[rows])
    assert samples.shape == (len(parts.instance), 256, 6)
    assert np.abs(samples[:, :, :3]).max() <= 1.0 + 1e-6
    size = np.ptp(samples[:, :, :3], axis=1)
    flat = (parts.high_m - parts.low_m)[:, 2] == 0
    assert (size[flat, 2] == 0).all()
    assert (size[~flat, 2] > 0).all()
    known = ~np.isnan(parts.rgb).any(axis=1)
    assert np.allclose(samples[known, 0, 3:], parts.rgb[known])
    assert (samples[~known, :, 3:] == -1).all()
