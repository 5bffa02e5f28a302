"""Instances around positions, compared with shapely and a disjoint set one after the other."""

import numpy as np
import pytest
import shapely
from scipy.cluster.hierarchy import DisjointSet

from models.citymap.geometry.closest_points import MIN_GROUP_SHARE, closest_instances
from models.citymap.geometry.segments import STEP_M
from models.citymap.geometry.solids import THING, crown_reach_m
from models.citymap.geometry.tiling import TILE_M

REACH_M, WAY_STEP_M = 15.0, 15.0 / 127


def naive_groups(table, rules, center):
    """Pieces that count as one thing around a cell."""
    half = rules.cell_size_m / 2 - 0.001
    low, high = (np.floor((center + side * half) / TILE_M + 0.5) for side in (-1, 1))
    inner = ((table.tile >= low) & (table.tile <= high)).all(axis=1)
    near = np.flatnonzero(
        (table.bounds_m[:, :2] < center + 40).all(axis=1) & (table.bounds_m[:, 2:] > center - 40).all(axis=1)
    ).tolist()
    sets, is_thing = DisjointSet(near), table.form == THING
    for k in near:
        for other in table.links[table.link_starts[k] : table.link_starts[k + 1]]:
            if other in sets and inner[k] == inner[other]:
                sets.merge(k, other)
    for k in near:
        for other in near:
            if is_thing[k] and is_thing[other] and table.instance[k] == table.instance[other]:
                sets.merge(k, other)
    groups = [sorted(part) for part in sets.subsets()]
    inside = [part for part in groups if inner[part[0]] or is_thing[part[0]]]
    joined = [list(part) for part in inside]
    for part in groups:
        if part in inside:
            continue
        touched = [
            n for k in part for other in table.links[table.link_starts[k] : table.link_starts[k + 1]]
            for n, those in enumerate(inside) if other in those
        ]  # fmt: skip
        if touched:
            joined[touched[-1]] += part
        else:
            joined.append(part)
    alone = {
        n: [table.instance[part[0]] for part in joined].count(table.instance[joined[n][0]]) for n in range(len(joined))
    }
    return [
        np.array(part)
        for n, part in enumerate(joined)
        if is_thing[part[0]]
        or table.point_count[part].sum() >= MIN_GROUP_SHARE * rules.min_part_points
        or alone[n] == 1
    ]


@pytest.mark.parametrize("seed", range(4))
def test_ways_are_those_of_shapely_to_what_hangs_together(city, cells, seed) -> None:
    table, rng = city.pieces, np.random.default_rng(seed)
    rows = rng.choice(len(cells), 3, replace=False)
    points = np.concatenate([cells.center_m[row, :2] + rng.uniform(-5, 5, (4, 2)) for row in rows])
    starts = np.array([0, 4, 8, 12])
    point, instance, way = closest_instances(
        table, city.rules, cells.center_m[rows], points, starts, REACH_M, WAY_STEP_M
    )
    assert (np.diff(point) >= 0).all()
    for n, row in enumerate(rows):
        groups = naive_groups(table, city.rules, cells.center_m[row, :2])
        for p in range(starts[n], starts[n + 1]):
            mine, naive = point == p, []
            for part in groups:
                away = shapely.distance(table.geometry(part), shapely.Point(points[p]))
                metres = (away - crown_reach_m(away, table.crown_m[part])).min()
                if metres <= REACH_M:
                    naive.append((int(table.instance[part[0]]), metres))
            metres = np.hypot(*way[mine].T.astype(float)) * WAY_STEP_M
            assert (np.diff((way[mine].astype(int) ** 2).sum(axis=1)) >= 0).all(), "the nearest first"
            result = sorted(zip(instance[mine].tolist(), metres.tolist(), strict=True))
            assert [i for i, _ in result] == [i for i, _ in sorted(naive)]
            assert [m for _, m in result] == pytest.approx([m for _, m in sorted(naive)], abs=0.75 * WAY_STEP_M)
            for i, (east, north) in zip(instance[mine], way[mine] * WAY_STEP_M, strict=True):
                whole = table.geometry(np.flatnonzero(table.instance == i))
                there = shapely.Point(points[p] - [east, north])
                reach = 1.5 * table.crown_m[table.instance == i].max() + WAY_STEP_M + STEP_M
                assert shapely.distance(whole, there).min() <= reach


def test_no_position_has_nothing_around_it(city, cells) -> None:
    result = closest_instances(
        city.pieces, city.rules, cells.center_m[:2], np.zeros((0, 2)), np.zeros(3, int), 15.0, 0.1
    )
    assert [len(part) for part in result] == [0, 0, 0]
