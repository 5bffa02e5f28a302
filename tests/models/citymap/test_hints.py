from collections import defaultdict

import numpy as np
import pytest
import shapely

from models.citymap.hints import (
    STRATEGIES,
    build_hint_table,
    choose_hints,
    describe_poses,
    direction_index,
    sample_positions,
)
from models.citymap.regions import split_regions
from models.citymap.types import DIRECTIONS


@pytest.mark.parametrize(
    ("offset", "direction"),
    [
        ((0, 5), "north"),
        ((0, -5), "south"),
        ((5, 0), "east"),
        ((-5, 1), "west"),
        ((1, -1), "on-top"),
        ((1.6, 0), "east"),
        ((3, 4), "north"),
    ],
)
def test_direction(offset, direction) -> None:
    assert DIRECTIONS[direction_index(np.array(offset, dtype=float))] == direction


@pytest.fixture(scope="module")
def poses(city, geometry, cells):
    positions = sample_positions(city.locations_m, 25.0, np.random.default_rng(0))
    return describe_poses(city, geometry, cells, positions)


def test_hints_are_true(city, poses) -> None:
    pieces = city.pieces
    for pose in poses:
        position = shapely.Point(pose.position_m[:2])
        for hint in pose.description.hints:
            instance = city.instances[hint.instance_id]
            assert hint.label == instance.label
            lines = shapely.shortest_line(position, pieces.geometry(np.flatnonzero(pieces.instance == instance.id)))
            offset = pose.position_m[:2] - shapely.get_coordinates(lines)[1::2]
            metres = np.linalg.norm(offset, axis=1)
            # Clipped stuff may be described by another part of it, so any near piece may have the closest point.
            assert hint.direction in {DIRECTIONS[d] for d in direction_index(offset[metres <= 20])}
            if instance.label not in city.stuff:
                assert hint.direction == DIRECTIONS[direction_index(offset[metres.argmin()])]
            expected = None if instance.rgb is None else city.palette.word(instance.rgb)
            assert hint.colour == expected


def test_an_instance_without_colour_is_described_without(poses) -> None:
    hints = [h for p in poses for h in p.description.hints]
    assert {h.colour for h in hints if h.label == "tree"} == {None}
    assert {h.colour for h in hints if h.label == "bench"} == {"green"}


def test_best_cell_is_the_nearest(cells, poses) -> None:
    for pose in poses[::7]:
        distance = np.linalg.norm(cells.center_m - pose.position_m, axis=1)
        assert cells.ids[distance.argmin()] == pose.cell_id
        assert distance.min() <= 15


def test_descriptions_of_a_position_differ(poses) -> None:
    mentioned = [(tuple(p.position_m), frozenset(h.instance_id for h in p.description.hints)) for p in poses]
    assert len(set(mentioned)) == len(mentioned)
    assert {p.strategy for p in poses} == set(STRATEGIES)
    assert {len(p.description.hints) for p in poses} == {6}


def test_strategies_against_a_naive_round_robin(city, geometry) -> None:
    positions = sample_positions(city.locations_m, 60.0, np.random.default_rng(1))
    parts = geometry.cut(positions)
    table = build_hint_table(city.palette, parts, positions)
    labels = np.unique([i.label for i in city.instances], return_inverse=True)[1]
    away = defaultdict(list)  # of the parts of an instance
    for cube, instance, closest in zip(parts.cube, parts.instance, parts.closest_m, strict=True):
        away[cube, instance].append(np.hypot(*(closest - positions[cube])[:2]))
    for n in range(len(positions)):
        rows = list(range(table.starts[n], table.starts[n + 1]))
        nearest = {instance: iter(sorted(away[n, instance])) for instance in set(table.instance[rows].tolist())}
        distances = [next(nearest[instance]) for instance in table.instance[rows].tolist()]
        assert distances == sorted(distances)
        assert max(distances, default=0) <= 15
        for strategy, key in (
            ("class", lambda r: labels[table.instance[r]]),
            ("direction", lambda r: table.direction[r]),
        ):
            pools: dict = {}
            for row in rows:
                pools.setdefault(key(row), []).append(row)
            expected = []
            while any(pools.values()):
                expected += sorted(pool.pop(0) for pool in pools.values() if pool)
            assert choose_hints(table, n, labels, strategy, 6).tolist() == expected[:6]
        assert choose_hints(table, n, labels, "closest", 6).tolist() == rows[:6]


def test_sampling_is_seeded_and_spread(city) -> None:
    one, two = (sample_positions(city.locations_m, 10.0, np.random.default_rng(3)) for _ in range(2))
    assert np.array_equal(one, two)
    assert len(np.unique(np.floor(one[:, :2] / 10), axis=0)) == len(one)


def test_regions_share_no_cell_and_no_point(cells, city) -> None:
    regions = split_regions(cells)
    tables = {name: region.cells(cells) for name, region in regions.items()}
    ids = [set(t.ids) for t in tables.values()]
    assert all(ids)
    assert not ids[0] & ids[1] | ids[0] & ids[2] | ids[1] & ids[2]
    reach = {
        n: (t.center_m[:, 0].min() - t.size_m / 2, t.center_m[:, 0].max() + t.size_m / 2) for n, t in tables.items()
    }
    assert reach["train"][1] <= reach["val"][0]
    assert reach["val"][1] <= reach["test"][0]
    for name, region in regions.items():
        x = region.locations(city.locations_m)[:, 0]
        assert x.min() - 15 >= region.west_m
        assert x.max() + 15 < region.east_m, name
