"""Neighbours of cells: as a slow reading of the rule finds them, written and read back, refused when not usable."""

import json
import lzma
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from models.sources.kitti360pose.direction import find_neighbours, save_direction
from models.sources.kitti360pose.records import PublishedCell
from tests.models.sources.conftest import MINI, make_cell, needs_mini
from tests.models.sources.published import load_cells

POINTS = ["east", "west", "north", "south", "northeast", "northwest", "southeast", "southwest"]


def cell_at(number: int, x: float, y: float, z: float = 0.0) -> PublishedCell:
    low = np.array([x, y, z])
    return replace(make_cell(number), bbox_w=np.concatenate([low, low + 30]))


def naive(cells: list[PublishedCell], grid_m: float) -> dict:
    """Each pair of cells, one after the other."""
    result: dict = {cell.id: {} for cell in cells}
    words = {-1: ("west", "south"), 0: ("", ""), 1: ("east", "north")}
    for one in cells:
        for other in cells:
            x, y = ((other.bbox_w[axis] - one.bbox_w[axis]) / grid_m for axis in range(2))
            if one is not other and x in words and y in words:
                word = words[y][1] + words[x][0]
                result[one.id][word] = other.id
    return result


@pytest.fixture
def cells() -> list[PublishedCell]:
    """A grid of 10 m with holes, at any height, and a cell that is not on it."""
    rng = np.random.default_rng(0)
    places = [(x, y) for x in range(-35, 25, 10) for y in range(105, 155, 10) if rng.random() < 0.7]
    grid = [cell_at(n, x, y, rng.uniform(0, 9)) for n, (x, y) in enumerate(places)]
    return [*grid, cell_at(999, 102.5, 107.0)]


def test_neighbours_equal_a_slow_search(cells: list[PublishedCell]) -> None:
    result = find_neighbours(cells, 10.0)
    assert result == naive(cells, 10.0)
    assert list(result) == [cell.id for cell in cells]
    assert {len(points) for points in result.values()} >= {0, 3, 5}
    assert find_neighbours(cells, 20.0) == naive(cells, 20.0)
    assert find_neighbours(cells[:1], 10.0) == {"0003_00000": {}}


def test_the_file_is_as_published(cells: list[PublishedCell], tmp_path: Path) -> None:
    path, result = tmp_path / "direction/town.json", find_neighbours(cells, 10.0)
    save_direction(path, result)
    stored = json.loads(path.read_text())
    for cell_id, points in stored.items():
        assert list(points) == POINTS
        assert {point: name for point, name in points.items() if name is not None} == result[cell_id]
    assert [p.name for p in path.parent.iterdir()] == ["town.json"]


@needs_mini
@pytest.mark.parametrize("scene", ["0003", "0010"])
def test_neighbours_in_the_sample(scene: str, tmp_path: Path) -> None:
    path = tmp_path / "cells.pkl"
    path.write_bytes(lzma.decompress((MINI / f"cells/2013_05_28_drive_{scene}_sync.pkl.xz").read_bytes()))
    cells = load_cells(path)
    result = find_neighbours(cells, 10.0)
    assert result == naive(cells, 10.0)
    assert max(len(points) for points in result.values()) == 8
