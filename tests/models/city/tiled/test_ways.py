import numpy as np
import pytest
import shapely

from models.city.tiled.ways import ways_to_groups


def test_ways_are_those_of_shapely(city):
    table, rng = city.pieces, np.random.default_rng(0)
    points = rng.uniform(-120, 120, (60, 2))
    points[:10] = shapely.get_coordinates(shapely.centroid(table.geometry[shapely.area(table.geometry) > 20][:10]))
    piece = np.flatnonzero(rng.random(len(table.instance)) < 0.6)
    group_starts = np.append(np.sort(rng.choice(np.arange(1, len(piece)), 70, replace=False)), len(piece))
    group_starts = np.concatenate([[0], group_starts])
    groups = len(group_starts) - 1
    cell_groups, point_starts = np.array([0, 30, 30, groups]), np.array([0, 25, 40, 60])
    point, group, way = ways_to_groups(table, points, point_starts, piece, group_starts, cell_groups, 25.0)
    found = {(p, g): w for p, g, w in zip(point.tolist(), group.tolist(), way, strict=True)}
    assert len(found) == len(point) > 50
    for n in range(3):
        for p in range(point_starts[n], point_starts[n + 1]):
            for g in range(groups):
                geometry = table.geometry[piece[group_starts[g] : group_starts[g + 1]]]
                metres = shapely.distance(geometry, shapely.Point(points[p])).min()
                if not cell_groups[n] <= g < cell_groups[n + 1] or metres > 25.0:
                    assert (p, g) not in found
                    continue
                assert np.hypot(*found[p, g]) == pytest.approx(metres, abs=1e-6)
                there = shapely.Point(points[p] - found[p, g])
                assert shapely.distance(geometry, there).min() < 1e-6
