"""Records that cannot be used are refused, by file and field."""

import pickle
import struct
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from models.errors import DataError
from models.sources.kitti360pose.files import load_poses, save_scene
from models.sources.kitti360pose.pickle_values import PickledRecord
from models.sources.kitti360pose.pickle_writer import cell_record, pose_record
from models.sources.store.files import load_data
from tests.models.sources.conftest import LONG, dump, make_cell, make_hint, make_pose, oracle
from tests.models.sources.published import load_cells


def nan(array: np.ndarray) -> np.ndarray:
    return np.where(np.arange(array.size).reshape(array.shape) == 1, np.nan, array)


BAD_CELLS = {
    "objects[1].xyz has shape": {"xyz": np.zeros((4, 2))},
    "objects[1].xyz is missing": {"xyz": ...},
    "objects[1].xyz is not an array": {"xyz": [1.0, 2.0, 3.0]},
    "objects[1].xyz is empty": {"xyz": np.zeros((0, 3))},
    "objects[1].xyz holds a number": {"xyz": np.full((8, 3), np.nan)},
    "objects[1].xyz holds a number that": {"xyz": np.full((8, 3), np.inf)},
    "objects[1].xyz has shape [8, 3] and dtype int64": {"xyz": np.zeros((8, 3), dtype=np.int64)},
    "objects[1].rgb has 3 points": {"rgb": np.zeros((3, 3))},
    "objects[1].rgb holds 0..255": {"rgb": np.linspace(0, 255, 24).reshape(8, 3)},
    "objects[1].rgb holds a number": {"rgb": nan(np.zeros((8, 3)))},
    "objects[1].label is not printable text": {"label": "\x1b[2J"},
    "objects[1].label is not printable text, but a int": {"label": 7},
    "objects[1].id is not a whole number": {"id": 1.5},
    "objects[1].instance_id is not a whole number": {"instance_id": 2**70},
    "objects has two objects of one id": {"id": 0},
    "id is not printable text": {"cell.id": ""},
    "scene_name is missing": {"cell.scene_name": ...},
    "objects is not a list": {"cell.objects": None},
    "objects is empty": {"cell.objects": []},
    "cell_size is not a length": {"cell.cell_size": float("nan")},
    "cell_size is not a length in": {"cell.cell_size": -30},
    "bbox_w has shape": {"cell.bbox_w": np.zeros(5)},
    "bbox_w is not a box": {"cell.bbox_w": np.zeros(6)},
    "bbox_w holds a number": {"cell.bbox_w": nan(np.arange(6.0))},
}


@pytest.mark.parametrize("message", BAD_CELLS)
def test_a_bad_cell_is_refused_by_file_and_field(message: str, tmp_path: Path) -> None:
    good, bad = cell_record(make_cell(0)), cell_record(make_cell(1))
    for name, value in BAD_CELLS[message].items():
        target = bad if name.startswith("cell.") else bad.fields["objects"][1]
        _set(target, name.removeprefix("cell."), value)
    path = dump(tmp_path / "town.pkl", [good, bad])
    with pytest.raises(DataError) as error:
        load_cells(path)
    assert f"{path}: cells[1].{message}" in str(error.value)


BAD_POSES = {
    "pose has shape": {"pose.pose": np.zeros(2)},
    "pose_w holds a number": {"pose.pose_w": nan(np.zeros(3))},
    "cell_id is missing": {"pose.cell_id": ...},
    "described_by is not printable text": {"pose.described_by": None},
    "descriptions is empty": {"pose.descriptions": []},
    "descriptions is not a list": {"pose.descriptions": "none"},
    "descriptions[0].direction is 'up'": {"direction": "up"},
    "descriptions[0].object_id is missing": {"object_id": ...},
    "descriptions[0].object_instance_id is no": {"object_instance_id": None},
    "descriptions[0].object_color_rgb has shape": {"object_color_rgb": np.zeros(4)},
    "descriptions[0].object_color_rgb holds": {"object_color_rgb": np.full(3, 2.0)},
    "descriptions[0].offset_center has shape": {"offset_center": np.zeros((2, 2))},
    "descriptions[0].best_offset_closest is missing": {"best_offset_closest": ...},
    "descriptions[0].is_matched is neither": {"is_matched": 1},
}


@pytest.mark.parametrize("message", BAD_POSES)
def test_a_bad_pose_is_refused_by_file_and_field(message: str, tmp_path: Path) -> None:
    good, bad = pose_record(make_pose(make_cell(0))), pose_record(make_pose(make_cell(1)))
    for name, value in BAD_POSES[message].items():
        target = bad if name.startswith("pose.") else bad.fields["descriptions"][0]
        _set(target, name.removeprefix("pose."), value)
    path = dump(tmp_path / "town.pkl", [good, bad])
    with pytest.raises(DataError) as error:
        load_poses(path)
    assert f"{path}: poses[1].{message}" in str(error.value)


def _set(record: PickledRecord, name: str, value: object) -> None:
    if value is ...:
        del record.fields[name]
    else:
        record.fields[name] = value


def test_a_file_holds_one_scene_and_a_cell_once(tmp_path: Path) -> None:
    twice = dump(tmp_path / "twice.pkl", [cell_record(make_cell(0)), cell_record(make_cell(0))])
    with pytest.raises(DataError, match=r"cells\[1\]\.id '0003_00000' is taken"):
        load_cells(twice)
    mixed = [make_cell(0), replace(make_cell(1), scene_name="0005")]
    with pytest.raises(DataError, match=r"cells\[1\]\.scene_name is '0005'"):
        load_cells(dump(tmp_path / "mixed.pkl", [cell_record(cell) for cell in mixed]))
    poses = [make_pose(cell) for cell in mixed]
    with pytest.raises(DataError, match=r"poses\[1\]\.scene_name is '0005'"):
        load_poses(dump(tmp_path / "poses.pkl", [pose_record(pose) for pose in poses]))


def test_one_stored_object_cannot_stand_for_many(tmp_path: Path) -> None:
    """A small pickle may refer to one object a million times."""
    record = cell_record(make_cell(0))
    path = dump(tmp_path / "cells.pkl", [record])
    # Remember the one cell and append it to the list again.
    again = pickle.LONG_BINPUT + struct.pack("<I", 99) + pickle.APPEND + pickle.BINGET + b"\x63"
    path.write_bytes(path.read_bytes()[:-2] + again + pickle.APPEND + pickle.STOP)
    assert len(oracle(path.read_bytes())) == 2
    with pytest.raises(DataError, match=r"cells\[1\] is the same object"):
        load_cells(path)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"cell_id": "0003_00009"}, r"poses\[0\]\.cell_id: cell '0003_00009' is not"),
        ({"scene_name": "0005"}, r"poses\[0\]\.scene_name: is '0005'"),
        ({"pose_w": np.array([500.0, 4e6, 1.0])}, r"poses\[0\]\.pose_w: lies 4e\+06 m"),
        ({"descriptions": (make_hint(None), make_hint(17))}, r"descriptions\[1\]\.object_id: .* has no object 17"),
    ],
)
def test_poses_that_do_not_belong_to_the_cells(change: dict, message: str, root: Path, tmp_path: Path) -> None:
    pose = replace(make_pose(make_cell(0)), **change)
    dump(root / f"poses/{LONG}.pkl", [pose_record(pose)])
    with pytest.raises(DataError, match=message) as error:
        load_data(root, "0003")
    assert f"poses/{LONG}.pkl" in str(error.value)
    with pytest.raises(DataError, match=message):
        save_scene(tmp_path / "new", "0003", [make_cell(0)], [pose])
    assert not [path for path in (tmp_path / "new").rglob("*") if path.is_file()]
