"""Against what the reference preparation made: cells and poses of two scenes, and the raw data they are from."""

import lzma
import pickle
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

from models.sources.kitti360.prepare import choose_locations, describe_positions, prepare_scene, scene_points
from models.sources.kitti360.raw import RawScene, load_raw_scene
from models.sources.kitti360.rules import PrepareConfig
from models.sources.kitti360pose.records import PublishedHint

MINI = Path(__file__).parents[4].parent / "shared/data/k360-mini"


class Record:
    """Stands in for the classes of the reference package."""


class Stored(pickle.Unpickler):
    def find_class(self, module: str, name: str):
        if module.startswith("numpy"):
            return super().find_class(module.replace("numpy.core", "numpy._core"), name)
        return type(name, (Record,), {})


def stored(kind: str, scene: str):
    path = MINI / kind / f"2013_05_28_drive_{scene}_sync.pkl"
    with lzma.open(f"{path}.xz") if kind == "cells" else path.open("rb") as file:
        return Stored(file).load()


@pytest.fixture(scope="module", params=["0003", "0010"])
def mini(request) -> tuple[str, RawScene]:
    if not MINI.exists():
        pytest.skip(f"{MINI} is not here: it holds what the reference preparation makes of two scenes")
    return request.param, load_raw_scene(MINI / "raw", request.param)


@pytest.mark.slow
def test_the_reference_cells_and_descriptions_come_out(mini) -> None:
    scene, raw = mini
    config = PrepareConfig(copies=2)
    cells, _ = prepare_scene(raw, config, np.random.default_rng(0))
    theirs = stored("cells", scene)
    assert [cell.id for cell in cells] == [cell.id for cell in theirs]
    for mine, cell in zip(cells, theirs, strict=True):
        assert (mine.scene_name, mine.cell_size) == (cell.scene_name, cell.cell_size)
        assert np.array_equal(mine.bbox_w, cell.bbox_w)
        for item, reference in zip(mine.objects, cell.objects, strict=True):
            assert (item.id, item.instance_id) == (reference.id, reference.instance_id)
            assert item.label == reference.label
            assert np.array_equal(item.xyz, reference.xyz)
            assert np.array_equal(item.rgb, reference.rgb)
    reference_poses = stored("poses", scene)
    positions = np.array(list(dict.fromkeys(tuple(pose.pose_w) for pose in reference_poses)))
    poses = describe_positions(raw, scene_points(raw, config), cells, positions, config)
    for ours, pose in zip(poses, reference_poses, strict=True):
        assert (ours.cell_id, ours.described_by) == (pose.cell_id, pose.described_by)
        assert ours.pose == pytest.approx(pose.pose, abs=1e-12)
        for hint, description in zip(ours.descriptions, pose.descriptions, strict=True):
            for field in fields(PublishedHint):
                value, reference = getattr(hint, field.name), getattr(description, field.name, None)
                if isinstance(reference, np.ndarray):
                    assert value == pytest.approx(reference, abs=1e-6), field.name
                else:
                    assert value == reference, field.name


def test_the_reference_positions_are_ones_we_could_draw(mini) -> None:
    scene, raw = mini
    locations = choose_locations(raw, PrepareConfig())
    for pose in stored("poses", scene):
        moves = pose.pose_w - locations
        assert any(np.abs(m - np.round(m)).max() < 1e-9 and m.min() >= 0 and m.max() <= 14 for m in moves)
