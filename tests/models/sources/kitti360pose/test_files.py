"""The published layout: every value as stored, nothing executed, every problem named with file and field."""

import lzma
import pickletools
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from models.errors import DataError
from models.sources.kitti360pose.files import list_scenes, load_poses, save_scene, select_scenes, short_name
from models.sources.kitti360pose.pickle_values import RECORD_CLASSES, RECORD_MODULE
from models.sources.kitti360pose.pickle_writer import pose_record
from models.sources.store.files import load_data
from tests.models.sources.conftest import (
    LONG,
    MINI,
    assert_as_stored,
    assert_same,
    dump,
    make_cell,
    make_pose,
    needs_mini,
    oracle,
    reference_pickle,
)
from tests.models.sources.published import load_cells, load_scene


@needs_mini
@pytest.mark.parametrize("scene", ["0003", "0010"])
def test_every_value_of_the_sample_is_as_stored(scene: str, tmp_path: Path) -> None:
    name = f"2013_05_28_drive_{scene}_sync"
    stored = {
        "cells": lzma.decompress((MINI / f"cells/{name}.pkl.xz").read_bytes()),
        "poses": (MINI / f"poses/{name}.pkl").read_bytes(),
    }
    for part, data in stored.items():
        (tmp_path / part).mkdir()
        (tmp_path / part / f"{name}.pkl").write_bytes(data)
    ours = load_scene(tmp_path, scene)
    assert ours.name == name
    for mine, part in ((ours.cells, "cells"), (ours.poses, "poses")):
        theirs = oracle(stored[part])
        assert len(mine) == len(theirs) > 50
        for a, b in zip(mine, theirs, strict=True):
            assert_as_stored(a, b)


@needs_mini
def test_the_sample_written_again_is_the_same_to_the_reference_code(tmp_path: Path) -> None:
    poses = load_poses(MINI / f"poses/{LONG}.pkl")
    dump(tmp_path / "poses.pkl", [pose_record(pose) for pose in poses])
    for pose, theirs in zip(poses, oracle((tmp_path / "poses.pkl").read_bytes()), strict=True):
        assert_as_stored(pose, theirs)
        for hint, their_hint in zip(pose.descriptions, theirs.descriptions, strict=True):
            assert hint.is_matched == hasattr(their_hint, "object_id") == hasattr(their_hint, "best_offset_center")


def test_what_is_written_is_read_back(root: Path) -> None:
    scene = load_scene(root, "0003")
    cells = [make_cell(0), make_cell(1)]
    assert scene.name == LONG
    assert_same(scene.cells, cells)
    assert_same(scene.poses, [make_pose(cell) for cell in cells])
    assert sorted(str(p.relative_to(root)) for p in root.rglob("*.*")) == [f"cells/{LONG}.pkl", f"poses/{LONG}.pkl"]


def test_the_reference_code_would_load_what_is_written(root: Path) -> None:
    names: set[tuple[str, str]] = set()
    data = (root / f"cells/{LONG}.pkl").read_bytes(), (root / f"poses/{LONG}.pkl").read_bytes()
    cells, poses = (oracle(part, names) for part in data)
    for cell in cells:
        assert_as_stored(make_cell(int(cell.id[-5:])), cell)
    assert [pose.cell_id for pose in poses] == [cell.id for cell in cells]
    # numpy._core is not there before numpy 1.26, which researchers' environments have.
    numpy_names = {("numpy.core.multiarray", "_reconstruct"), ("numpy", "ndarray"), ("numpy", "dtype")}
    assert names == {(RECORD_MODULE, kind) for kind in RECORD_CLASSES} | numpy_names
    assert all(opcode.proto <= 4 for part in data for opcode, _, _ in pickletools.genops(part))


@pytest.mark.parametrize(("protocol", "core"), [(3, b"core"), (3, b"_core"), (4, b"_core"), (5, b"_core")])
def test_pickles_of_every_protocol_and_numpy(protocol: int, core: bytes, tmp_path: Path) -> None:
    cell = make_cell(num_points=200)
    data = reference_pickle(cell, protocol)
    assert b"numpy._core." in data
    path = tmp_path / "cells.pkl"
    # In protocol 3 the module's name stands in a line, which may change its length.
    path.write_bytes(data.replace(b"cnumpy._core.", b"cnumpy." + core + b".") if protocol == 3 else data)
    assert_same(load_cells(path), [cell])


def test_the_reference_package_is_never_imported(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "datapreparation", None)  # an import of it would raise
    load_data(root, "0003")
    assert RECORD_MODULE not in sys.modules


def test_scenes_by_long_and_short_names(root: Path) -> None:
    save_scene(root, "my_town", [replace(make_cell(5), scene_name="town")], [])
    assert list_scenes(root) == (LONG, "my_town")
    assert short_name(LONG) == "0003"
    assert short_name("my_town") == "my_town"
    available = list_scenes(root)
    for split, expected in {
        None: available,
        "test": (LONG,),
        "0003": (LONG,),
        LONG: (LONG,),
        "my_town, 0003": ("my_town", LONG),
        "0003,0003": (LONG,),
    }.items():
        assert select_scenes(available, split, root) == expected


def test_the_standard_splits_hold_the_published_scenes() -> None:
    available = [f"2013_05_28_drive_{n:04d}_sync" for n in (0, 2, 3, 4, 5, 6, 7, 9, 10)]
    expected = {
        "train": ["0000", "0002", "0004", "0006", "0007"],
        "val": ["0010"],
        "test": ["0003", "0005", "0009"],
    }
    for split, scenes in expected.items():
        assert [short_name(scene) for scene in select_scenes(available, split, Path())] == scenes


@pytest.mark.parametrize("split", ["val", "0005", "0003,0005", "", ","])
def test_a_missing_scene_is_named(root: Path, split: str) -> None:
    with pytest.raises(DataError, match=LONG):
        select_scenes(list_scenes(root), split, root)


def test_two_scenes_of_one_short_name_are_not_guessed_between() -> None:
    with pytest.raises(DataError, match="give the whole name"):
        select_scenes(["2013_05_28_drive_0003_sync", "2014_05_28_drive_0003_sync"], "0003", Path())


def test_missing_files_are_named(root: Path) -> None:
    for load in (load_cells, load_poses):
        with pytest.raises(DataError, match=r"nowhere\.pkl.*missing"):
            load(root / "nowhere.pkl")
        with pytest.raises(DataError, match="cannot be opened"):
            load(root)
    with pytest.raises(DataError, match="cells: no scene"):
        list_scenes(root / "cells")


def test_cells_without_poses_are_cells(root: Path) -> None:
    save_scene(root, "0003", [make_cell()], [])
    assert [cell.id for cell in load_cells(root / f"cells/{LONG}.pkl")] == ["0003_00000"]
    with pytest.raises(DataError, match=rf"poses/{LONG}\.pkl.*no poses"):
        load_poses(root / f"poses/{LONG}.pkl")


def test_a_failed_write_leaves_the_scene_as_it_was(root: Path) -> None:
    before = {path: path.read_bytes() for path in root.rglob("*.pkl")}

    def cells():
        yield make_cell(0)
        raise RuntimeError("the disk is full")

    with pytest.raises(RuntimeError):
        save_scene(root, "0003", cells(), [])
    assert {path: path.read_bytes() for path in root.rglob("*") if path.is_file()} == before


@pytest.mark.parametrize("scene", ["", "../0003", "a/b", "."])
def test_a_scene_is_written_below_the_root_only(scene: str, tmp_path: Path) -> None:
    with pytest.raises(DataError, match="cannot be the name of a scene"):
        save_scene(tmp_path, scene, [make_cell(0)], [])
