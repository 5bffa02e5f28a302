import numpy as np
import pytest
from scipy.spatial.distance import cdist

from models.citymap import points as points_module
from models.citymap.points import PointTable, bounding_corners, first_in_voxel
from models.citymap.types import CityMap, Instance


@pytest.mark.parametrize("seed", range(4))
def test_the_first_point_of_a_voxel_stays(seed) -> None:
    rng = np.random.default_rng(seed)
    xyz = (rng.normal(size=(500, 3)) * [2, 2, 0.5] + 1000).astype(np.float32)
    voxel = np.floor((xyz.astype(float) - xyz.min(axis=0) + 0.3) / 0.6)
    first = {key: row for row, key in reversed(list(enumerate(map(tuple, voxel))))}
    assert first_in_voxel(xyz, 0.6).tolist() == sorted(first.values())


def test_corners_are_the_lowest_and_the_highest_of_each_column() -> None:
    points = np.random.default_rng(0).normal(size=(50, 3)).astype(np.float32)
    low, high = bounding_corners(points)
    assert np.array_equal(low, points.min(axis=0))
    assert np.array_equal(high, points.max(axis=0))


@pytest.mark.parametrize("block", [7, 400, 10**6])
def test_neighbours_do_not_depend_on_how_many_are_found_at_once(monkeypatch, block) -> None:
    rng = np.random.default_rng(0)
    labels = ["road", "pole", "road", "wall"]
    clouds = [(rng.normal(size=(500, 3)) * [3, 3, 0.3]).astype(np.float32) for _ in labels]
    instances = tuple(Instance(n, label, cloud) for n, (label, cloud) in enumerate(zip(labels, clouds, strict=True)))
    monkeypatch.setattr(points_module, "POINTS_PER_PAIR_BLOCK", block)
    points = PointTable.from_map(CityMap("clouds", instances, frozenset({"road", "wall"}), np.zeros((1, 3))), 0.75)
    source = np.repeat(np.arange(len(points.xyz)), np.diff(points.pair_starts))
    stuff = np.flatnonzero(points.is_stuff[points.instance])
    near = cdist(points.xyz[stuff], points.xyz[stuff]) <= 0.75
    near &= points.instance[stuff][:, None] == points.instance[stuff]
    one, other = np.nonzero(np.triu(near, k=1))
    assert len(one) > 1000
    assert np.array_equal(np.column_stack([source, points.pairs]), np.column_stack([stuff[one], stuff[other]]))
