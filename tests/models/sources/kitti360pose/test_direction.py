"""Neighbours of cells: as a slow reading of the rule finds them, written and read back, refused when not usable."""

import json
import lzma
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from models.errors import DataError
from models.sources.kitti360pose.direction import find_neighbours, load_direction, save_direction
from models.sources.kitti360pose.files import load_cells
from models.sources.kitti360pose.records import PublishedCell
from tests.models.sources.conftest import MINI, make_cell, needs_mini

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


def test_the_file_is_as_published_and_read_back(cells: list[PublishedCell], tmp_path: Path) -> None:
    path, result = tmp_path / "direction/town.json", find_neighbours(cells, 10.0)
    save_direction(path, result)
    assert load_direction(path, result) == result
    stored = json.loads(path.read_text())
    for cell_id, points in stored.items():
        assert list(points) == POINTS
        assert {point: name for point, name in points.items() if name is not None} == result[cell_id]
    assert [p.name for p in path.parent.iterdir()] == ["town.json"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "content: Invalid JSON"),
        ('{"0003_00000": {"east": nul', "content: Invalid JSON"),
        ("[" * 100_000, "content: Invalid JSON"),
        ("\udcff", "content: Invalid JSON"),
        ("[]", "content: Input should be an object; expected cell id ->"),
        ('{"0003_00000": null}', "'0003_00000': Input should be an object"),
        ('{"0003_00000": {"up": null}}', "'0003_00000'.'up'"),
        ('{"0003_00000": {"east": 1}}', "'0003_00000'.'east': Input should be a valid string"),
        ('{"0003_00000": {"east": "0003_00007"}}', "'0003_00000'.east: no cell '0003_00007' in this scene; cells and"),
        ('{"0003_00007": {}}', "'0003_00007': no cell '0003_00007' in this scene"),
        ('{"\\u001b[2J": {}}', r"'\x1b[2J': no cell"),
        ('{"0003_00001": {}}', "'0003_00000': missing, and 0 more"),
    ],
)
def test_a_file_that_is_not_usable(text: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "town.json"
    path.write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(DataError) as error:
        load_direction(path, ["0003_00000", "0003_00001"])
    assert f"{path}: {message}" in str(error.value)


def test_a_file_that_is_missing(tmp_path: Path) -> None:
    with pytest.raises(DataError, match=r"town\.json: no neighbours for this scene; the file is missing"):
        load_direction(tmp_path / "town.json", [])
    with pytest.raises(DataError, match="cannot be opened"):
        load_direction(tmp_path, [])


def test_points_of_the_compass_may_be_left_out(tmp_path: Path) -> None:
    path = tmp_path / "town.json"
    path.write_text('{"a": {"east": "b"}, "b": {}}')
    assert load_direction(path, ["a", "b"]) == {"a": {"east": "b"}, "b": {}}


@needs_mini
@pytest.mark.parametrize("scene", ["0003", "0010"])
def test_neighbours_in_the_sample(scene: str, tmp_path: Path) -> None:
    path = tmp_path / "cells.pkl"
    path.write_bytes(lzma.decompress((MINI / f"cells/2013_05_28_drive_{scene}_sync.pkl.xz").read_bytes()))
    cells = load_cells(path)
    result = find_neighbours(cells, 10.0)
    assert result == naive(cells, 10.0)
    assert max(len(points) for points in result.values()) == 8
    save_direction(tmp_path / "direction.json", result)
    assert load_direction(tmp_path / "direction.json", [cell.id for cell in cells]) == result
