from dataclasses import replace

import numpy as np
import pytest
from sklearn.cluster import DBSCAN

from models.citymap.colours import KITTI360_PALETTE
from models.citymap.hints import round_robin
from models.citymap.types import CutRules
from models.errors import DataError
from models.sources.kitti360.prepare import (
    choose_locations,
    cut_cells,
    describe_positions,
    grid_centers,
    prepare_scene,
    scene_points,
)
from models.sources.kitti360.raw import RawScene
from models.sources.kitti360.rules import PrepareConfig
from models.sources.kitti360pose.records import PublishedHint
from tests.models.sources.raw_scenes import town


@pytest.fixture(scope="module", params=[0, 1])
def raw(request) -> RawScene:
    return town(request.param)


def naive_parts(raw: RawScene, center: np.ndarray) -> list:
    """Rule 4 as it reads, one instance after the other."""
    parts = []
    for instance in raw.instances:
        inside = (np.abs(instance.points_m.astype(float) - center) <= 15).all(axis=1)
        if instance.label not in raw.stuff:
            if inside.mean() >= 1 / 3:
                parts.append((instance, np.arange(len(inside))))
        elif inside.any():
            rows = np.flatnonzero(inside)
            labels = DBSCAN(eps=0.75, min_samples=5).fit(instance.points_m[rows].astype(float)).labels_
            clusters = [rows[labels == label] for label in range(labels.max() + 1)]
            parts += [(instance, cluster) for cluster in clusters if len(cluster) >= 250]
    return parts


def naive_centers(locations: np.ndarray) -> list[tuple]:
    """Steps of ten metres from the whole part of the least to that of the greatest, within 30 m of a location."""
    (x0, y0), (x1, y1) = ([int(v) for v in bound[:2]] for bound in (locations.min(axis=0), locations.max(axis=0)))
    centers = []
    for x in range(x0, x1, 10):
        for y in range(y0, y1, 10):
            distance = np.hypot(*(locations[:, :2] - [x, y]).T)
            if distance.min() <= 30:
                centers.append((x, y, locations[distance.argmin(), 2]))
    return centers


def test_centres_are_a_grid_at_the_height_of_the_nearest_location(raw) -> None:
    locations = choose_locations(raw, PrepareConfig())
    detour = np.vstack([locations, [[5.5, 77.7, 9.0]]])
    for places in (locations, detour):
        assert [tuple(c) for c in grid_centers(places, PrepareConfig())] == naive_centers(places)
    assert len({c[2] for c in naive_centers(detour)}) > 5
    assert len(naive_centers(detour)) < 10 * 8, "some are out of reach"


def test_cells_equal_the_rules_read_literally(raw) -> None:
    config = PrepareConfig()
    centers = grid_centers(choose_locations(raw, config), config)
    cells = cut_cells(raw, scene_points(raw, config), centers, config, lambda cubes: None)
    expected = {f"town_{n:05d}": naive_parts(raw, center) for n, center in enumerate(centers)}
    expected = {name: parts for name, parts in expected.items() if len(parts) >= 6}
    assert [cell.id for cell in cells] == list(expected)
    assert len(cells) < len(centers), "some are dropped, and their numbers with them"
    for cell in cells:
        low = centers[int(cell.id[-5:])] - 15
        assert cell.bbox_w == pytest.approx(np.array([*low, *(low + 30)]), abs=1e-12)
        assert [item.id for item in cell.objects] == list(range(len(cell.objects)))
        for item, (instance, rows) in zip(cell.objects, expected[cell.id], strict=True):
            assert (item.instance_id, item.label) == (instance.id, instance.label)
            assert np.array_equal(item.xyz, (instance.points_m[rows] - low) / 30)
            assert np.array_equal(item.rgb, instance.rgb[rows])


def naive_strategy(nearby: list[dict], strategy: str) -> list[dict]:
    """Six of what is seen: the nearest, or by turns from each class or direction."""
    if strategy == "closest":
        return sorted(nearby, key=lambda s: s["distance"])[:6]
    pools: dict = {}
    for s in nearby:
        pools.setdefault(s["label" if strategy == "class" else "direction"], []).append(s)
    turns = max(map(len, pools.values()))
    return [pool[turn] for turn in range(turns) for pool in pools.values() if turn < len(pool)][:6]


def naive_direction(x: float, y: float) -> str:
    if (x**2 + y**2) ** 0.5 < 1.5:
        return "on-top"
    if abs(x) > abs(y):
        return "east" if x > 0 else "west"
    return "north" if y > 0 else "south"


def test_descriptions_equal_the_rules_read_literally(raw) -> None:
    config = PrepareConfig(copies=2)
    cells, poses = prepare_scene(raw, config, np.random.default_rng(5))
    centers = np.array([cell.bbox_w[:3] + 15 for cell in cells])
    positions = list(dict.fromkeys(tuple(pose.pose_w) for pose in poses))
    assert len(positions) >= 8
    split = False
    for position in map(np.array, positions):
        nearby = []
        for instance, rows in naive_parts(raw, position):
            xyz = instance.points_m[rows].astype(float)
            distance = np.linalg.norm(xyz - position, axis=1)
            offset = (position - xyz[distance.argmin()])[:2]
            nearby.append({"id": instance.id, "label": instance.label, "distance": distance.min(), "offset": offset,
                         "direction": naive_direction(*offset), "center": (position - xyz.mean(axis=0))[:2],
                         "rgb": instance.rgb[rows].mean(axis=0)})  # fmt: skip
        nearby = [s for s in nearby if s["distance"] <= 15]
        expected = []
        for strategy in ("closest", "class", "direction"):
            chosen = naive_strategy(nearby, strategy)
            if {s["id"] for s in chosen} not in [{s["id"] for s in earlier} for _, earlier in expected]:
                expected.append((strategy, chosen))
        mine = [pose for pose in poses if tuple(pose.pose_w) == tuple(position)]
        assert [pose.described_by for pose in mine] == [strategy for strategy, _ in expected]
        best = cells[np.linalg.norm(centers - position, axis=1).argmin()]
        for pose, (_, chosen) in zip(mine, expected, strict=True):
            assert pose.cell_id == best.id
            assert pose.pose * 30 + best.bbox_w[:3] == pytest.approx(position)
            for hint, s in zip(pose.descriptions, chosen, strict=True):
                assert_said(hint, s)
                split |= assert_matched(hint, pose.pose, [i for i in best.objects if i.instance_id == s["id"]])
    assert split, "some hint is matched to one of several parts of its instance"


def assert_said(hint: PublishedHint, nearby: dict) -> None:
    assert (hint.object_instance_id, hint.object_label) == (nearby["id"], nearby["label"])
    assert hint.direction == nearby["direction"]
    assert hint.offset_closest * 30 == pytest.approx(nearby["offset"], abs=1e-6)
    assert hint.offset_center * 30 == pytest.approx(nearby["center"], abs=1e-6)
    assert hint.object_color_rgb == pytest.approx(nearby["rgb"], abs=1e-6)
    assert hint.object_color_text == KITTI360_PALETTE.word(nearby["rgb"])


def assert_matched(hint: PublishedHint, pose: np.ndarray, items: list) -> bool:
    """Check that the best part was chosen; return True if there were several."""
    assert hint.is_matched == bool(items)
    if not items:
        assert (hint.object_id, hint.best_offset_center, hint.best_offset_closest) == (None, None, None)
        assert hint.closest_point == pytest.approx(0.5 - hint.offset_closest)  # units of the cube around the pose
        return False
    closest = [i.xyz[np.linalg.norm(i.xyz - pose, axis=1).argmin()] for i in items]
    gaps = [np.linalg.norm((pose - point)[:2] - hint.offset_closest) for point in closest]
    part = int(np.argmin(gaps))
    assert hint.object_id == items[part].id
    assert hint.closest_point == pytest.approx(closest[part][:2])
    assert hint.best_offset_closest == pytest.approx((pose - closest[part])[:2])
    assert hint.best_offset_center == pytest.approx((pose - items[part].xyz.mean(axis=0))[:2])
    return len(items) > 1


def test_of_cells_equally_near_the_first_is_the_best(raw) -> None:
    flat = replace_trajectory(raw, raw.trajectory_m * [1, 1, 0] + [0, 0, 1])
    config, points = PrepareConfig(), scene_points(flat, PrepareConfig())
    centers = grid_centers(choose_locations(flat, config), config)
    cells = cut_cells(flat, points, np.vstack([centers, centers + np.array([0, 10, 0])]), config, lambda cubes: None)
    centers = np.array([cell.bbox_w[:3] + 15 for cell in cells])
    poses = describe_positions(flat, points, cells, centers + np.array([5, 5, 0]), config)
    assert len(poses) > 12
    for pose in poses:
        assert pose.cell_id == cells[np.linalg.norm(centers - pose.pose_w, axis=1).argmin()].id


def test_positions_are_locations_moved_by_whole_metres(raw) -> None:
    _, poses = prepare_scene(raw, PrepareConfig(copies=9), np.random.default_rng(0))
    locations = choose_locations(raw, PrepareConfig())
    moves = []
    for position in {tuple(pose.pose_w) for pose in poses}:
        move = position - locations
        whole = (np.abs(move - np.round(move)) < 1e-9).all(axis=1) & (move > -1e-9).all(axis=1) & (move < 14.5).all(1)
        assert whole.any()
        moves.append(np.round(move[whole][0]).astype(int))
    assert np.max(moves, axis=0).tolist() == [14, 14, 0]
    assert np.min(moves) == 0


def test_locations_are_spaced_and_near_a_thing(raw) -> None:
    far = replace_trajectory(raw, np.vstack([raw.trajectory_m, [[32.0, 500.0, 1.0]]]))
    locations = choose_locations(far, PrepareConfig())
    gaps = np.linalg.norm(locations[:, None] - locations[None], axis=2) + np.eye(len(locations)) * 99
    assert gaps.min() >= 10
    assert np.linalg.norm(far.trajectory_m[:-1, None] - locations[None], axis=2).min(axis=1).max() < 10
    assert locations[:, 1].max() < 100
    assert len(choose_locations(far, PrepareConfig(thing_reach_m=600))) == len(locations) + 1


def replace_trajectory(raw: RawScene, trajectory_m: np.ndarray) -> RawScene:
    return RawScene(raw.name, raw.instances, raw.stuff, trajectory_m)


@pytest.mark.slow
def test_every_option_of_the_poses_counts(raw) -> None:
    def poses_of(**options) -> list:
        return prepare_scene(raw, replace(PrepareConfig(copies=1), **options), np.random.default_rng(1))[1]

    standard = poses_of()
    assert {pose.described_by for pose in poses_of(strategies=("class",))} == {"class"}
    assert {len(pose.descriptions) for pose in poses_of(num_hints=4)} == {4}
    assert len(poses_of(copies=3)) > 2 * len(standard)
    assert len(poses_of(spacing_m=20.0)) < len(standard)
    assert len(poses_of(best_cell_reach_m=4.0)) < len(standard)
    assert len(poses_of(hint_reach_m=9.0)) < len(standard)
    unmoved = {tuple(pose.pose_w) for pose in poses_of(shift_divisor=1e9)}
    assert unmoved <= {tuple(location) for location in choose_locations(raw, PrepareConfig())}
    text = [hint.direction for pose in poses_of(on_top_share=0.5) for hint in pose.descriptions]
    assert set(text) == {"on-top"}
    assert {pose.cell_id for pose in poses_of(cut=CutRules(grid_m=30.0))} < {f"town_{n:05d}" for n in range(12)}


def test_the_same_seed_gives_the_same_scene_and_progress_ends(raw) -> None:
    steps: list = []
    one = prepare_scene(raw, PrepareConfig(), np.random.default_rng(3), lambda *position: steps.append(position))[1]
    two = prepare_scene(raw, PrepareConfig(), np.random.default_rng(3))[1]
    assert [tuple(p.pose_w) for p in one] == [tuple(p.pose_w) for p in two]
    done = [done for done, _ in steps]
    assert done == sorted(done)
    assert steps[-1][0] == steps[-1][1]


def test_a_trajectory_of_another_frame_is_refused(raw) -> None:
    moved = replace_trajectory(raw, raw.trajectory_m + 5000.0)
    with pytest.raises(DataError, match=r"'town': field 'trajectory': no pose within 15.0 m of a thing.*same frame"):
        prepare_scene(moved, PrepareConfig(), np.random.default_rng(0))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"cut": CutRules(min_instances=99)}, "field 'cells': none of .* has 99 instances"),
        ({"num_hints": 99}, "field 'poses': none of .* has 99 instances"),
        ({"spacing_m": 500.0}, "field 'trajectory': its locations span"),
    ],
)
def test_a_scene_without_cells_or_poses_is_refused(raw, change, message) -> None:
    with pytest.raises(DataError, match=message):
        prepare_scene(raw, replace(PrepareConfig(), **change), np.random.default_rng(0))


@pytest.mark.parametrize("seed", range(5))
def test_round_robin_equals_taking_turns(seed) -> None:
    keys = np.random.default_rng(seed).integers(0, 5, 23)
    pools: dict = {}
    for position, key in enumerate(keys.tolist()):
        pools.setdefault(key, []).append(position)
    expected = []
    while any(pools.values()):
        expected += [pool.pop(0) for pool in pools.values() if pool]
    assert round_robin(keys).tolist() == expected
