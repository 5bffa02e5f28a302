"""Several pieces of one instance around a position: KITTI-360 gives all ground of a class one number."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from models.citymap.map_geometry import build_geometry, cut_cells
from models.citymap.types import CityMap, CutRules, Instance
from models.posterior.neighbours.neighbours import STEP_M
from models.posterior.neighbours.scan_index import ScanNeighbourIndex
from models.sources.source import MapSource

LEFT, RIGHT = np.array([0.2, 0.2, 0.2]), np.array([0.8, 0.8, 0.8])
ROAD_M = 8.0  # between the sidewalks


def paved(west: float, east: float, south: float, north: float, rgb: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Ground as points 0.25 m apart, and their colours."""
    x, y = np.meshgrid(np.arange(west, east, 0.25), np.arange(south, north, 0.25))
    xyz = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)]).astype(np.float32)
    return xyz, np.tile(rgb, (len(xyz), 1)).astype(np.float32)


def street(*pieces: tuple[np.ndarray, np.ndarray]) -> tuple[CityMap, MapSource]:
    """A street along x with both sidewalks, further pieces, and a pole; all sidewalk is one instance."""
    half = ROAD_M / 2
    north, south = paved(-60, 60, half, half + 2, LEFT), paved(-60, 60, -half - 2, -half, RIGHT)
    joined = [np.concatenate(column) for column in zip(north, south, *pieces, strict=True)]
    pole = np.array([[0, 0, z] for z in np.arange(0, 5, 0.1)], dtype=np.float32)
    instances = Instance(8000, "sidewalk", *joined), Instance(17001, "pole", pole)
    rules = CutRules(min_instances=1)
    positions_m = np.array([[x, 0.0, 0.0] for x in np.arange(-30, 31, 5)])
    city = CityMap("street", instances, frozenset({"sidewalk"}), positions_m, rules=rules)
    bodies = build_geometry(city)
    return city, MapSource(Path("street"), city, bodies, cut_cells(city, bodies))


def rows_at(around: ScanNeighbourIndex, source: MapSource, x: float, y: float) -> np.ndarray:
    """Rows of the sidewalk at the node nearest to a position."""
    node = ((around.nodes_m - [x, y]) ** 2).sum(axis=1).argmin()
    rows = np.arange(around.starts[node], around.starts[node + 1])
    is_sidewalk = source.geometry().part_instances[around.part[rows]] == 0
    return rows[is_sidewalk]


def test_both_sidewalks_are_known_between_them() -> None:
    _, source = street()
    around = ScanNeighbourIndex.build(source.geometry(), source.data.cells)
    rows = rows_at(around, source, 0.0, 1.5)
    offset_m = around.offset[rows] * STEP_M
    assert offset_m[:, 1] == pytest.approx([1.5 - ROAD_M / 2, 1.5 + ROAD_M / 2 + 0.25], abs=2 * STEP_M)
    assert np.abs(offset_m[:, 0]) == pytest.approx([0, 0], abs=0.25 + STEP_M)
    assert around.whole[rows].all()
    shown = source.data.cells.parts
    owner = np.repeat(np.arange(len(source.data.cells)), np.diff(around.cell_starts))
    node = np.searchsorted(around.starts, rows[0], side="right") - 1
    assert (shown.cube[around.part[rows]] == owner[node]).all(), "each is a part of the owner's cube"
    assert shown.rgb[around.part[rows]].mean(axis=1) == pytest.approx([LEFT[0], RIGHT[0]], abs=0.01)


def test_sidewalks_that_meet_behind_the_corner_are_two_pieces_and_beside_it_one() -> None:
    _, source = street(paved(20, 22, -ROAD_M / 2, ROAD_M / 2, LEFT))  # they meet at x = 20
    around = ScanNeighbourIndex.build(source.geometry(), source.data.cells)
    assert len(rows_at(around, source, -6.0, 0.0)) == 2
    assert len(rows_at(around, source, 18.0, 0.0)) == 1


def test_too_small_a_piece_is_none() -> None:
    _, source = street(paved(0, 1, -0.5, 0.5, LEFT))
    around = ScanNeighbourIndex.build(source.geometry(), source.data.cells)
    assert len(rows_at(around, source, 0.0, 1.5)) == 2
    bodies = replace(source.geometry(), min_part_points=10)
    assert len(rows_at(ScanNeighbourIndex.build(bodies, source.data.cells), source, 0.0, 1.5)) == 3


def test_pieces_far_apart_and_instances_in_one_piece_are_as_they_were() -> None:
    city, source = street()
    bodies = source.geometry()
    around = ScanNeighbourIndex.build(bodies, source.data.cells)
    for x, y in ((-20.0, 12.0), (20.0, -9.0), (0.0, 0.0)):
        node = ((around.nodes_m - [x, y]) ** 2).sum(axis=1).argmin()
        rows = rows_at(around, source, x, y)
        xyz = city.instances[0].points_m[:, :2]
        away = np.linalg.norm(xyz - around.nodes_m[node], axis=1).min()
        assert np.hypot(*(around.offset[rows[0]] * STEP_M)) == pytest.approx(away, abs=STEP_M)
