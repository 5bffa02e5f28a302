"""The published layout: every value as stored, nothing executed, every problem named with file and field."""

import copyreg
import io
import lzma
import os
import pickle
import pickletools
import struct
import subprocess
import sys
import tracemalloc
import types
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
import pytest

from models.city.kitti360pose import (
    iter_cells,
    list_scenes,
    load_cells,
    load_poses,
    load_scene,
    save_scene,
    select_scenes,
    short_name,
)
from models.city.published import PublishedCell, PublishedHint, PublishedObject, PublishedPose
from models.city.published_standins import RECORD_MODULE, RECORDS, Record
from models.city.published_writer import RecordPickler, cell_record, pose_record
from models.errors import DataError

MINI = Path(__file__).parents[4] / "shared/data/k360-mini"
needs_mini = pytest.mark.skipif(not MINI.is_dir(), reason="../shared/data/k360-mini is not on this machine")
LONG = "2013_05_28_drive_0003_sync"


class Anything:
    """What the oracle makes of the reference package's classes."""


def oracle(data: bytes, names: set[tuple[str, str]] | None = None):
    """A plain unpickle that trusts its input, to compare with."""
    kinds = {kind: type(kind, (Anything,), {}) for kind in RECORDS}

    class Permissive(pickle.Unpickler):
        def find_class(self, module: str, name: str):
            if names is not None:
                names.add((module, name))
            return kinds[name] if module == RECORD_MODULE else super().find_class(module, name)

    return Permissive(io.BytesIO(data)).load()


def assert_as_stored(ours: object, theirs: object) -> None:
    """Every field of ours is what the oracle read; a float64 vector may come from any dtype."""
    value: Any
    stored: Any
    for field in fields(ours):
        value, stored = getattr(ours, field.name), getattr(theirs, field.name, None)
        if isinstance(value, tuple):
            assert len(value) == len(stored)
            for a, b in zip(value, stored, strict=True):
                assert_as_stored(a, b)
        elif isinstance(value, np.ndarray):
            assert value.shape == stored.shape
            assert value.dtype == stored.dtype
            assert np.array_equal(value, stored), field.name
        else:
            assert value == stored, field.name
            assert not isinstance(value, np.generic)


def assert_same(a: object, b: object) -> None:
    """Two published records are equal, dtypes included."""
    assert type(a) is type(b)
    if isinstance(a, list | tuple):
        assert len(a) == len(b)
        for x, y in zip(a, b, strict=True):
            assert_same(x, y)
    elif is_dataclass(a):
        for field in fields(a):
            assert_same(getattr(a, field.name), getattr(b, field.name))
    elif isinstance(a, np.ndarray):
        assert a.dtype == b.dtype
        assert np.array_equal(a, b)
    else:
        assert a == b


def make_cell(number: int = 0, num_objects: int = 3, num_points: int = 7) -> PublishedCell:
    rng = np.random.default_rng(number)
    objects = tuple(
        PublishedObject(
            n,
            1000 + n,
            rng.uniform(-0.2, 1.2, (num_points + n, 3)),
            (rng.integers(0, 256, (num_points + n, 3)) / 255).astype(np.float32),
            ["building", "pole", "trash bin"][n % 3],
        )
        for n in range(num_objects)
    )
    low = np.array([10.0 * number, 20.0, -5.0])
    return PublishedCell(f"0003_{number:05d}", "0003", objects, 30.0, np.concatenate([low, low + 30]))


def make_hint(object_id: int | None) -> PublishedHint:
    matched = object_id is not None
    best = np.array([0.1, -0.2]) if matched else None
    colour = np.array([0.4, 0.41, 0.39], dtype=np.float32)
    offsets = np.array([0.1, 0.2]), np.array([0.05, 0.1]), np.array([0.4, 0.5])
    return PublishedHint(
        object_id, 1000 + (object_id or 0), "building", colour, "gray-green", "on-top", *offsets, best, best, matched
    )


def make_pose(cell: PublishedCell) -> PublishedPose:
    offset = np.array([0.3, 0.4, 0.5])
    world = offset * cell.cell_size + cell.bbox_w[:3]
    return PublishedPose(offset, world, cell.id, cell.scene_name, "closest", (make_hint(1), make_hint(None)))


@pytest.fixture
def root(tmp_path: Path) -> Path:
    cells = [make_cell(0), make_cell(1)]
    save_scene(tmp_path / "data", "0003", cells, [make_pose(cell) for cell in cells])
    return tmp_path / "data"


def dump(path: Path, records: list[Record]) -> Path:
    with path.open("wb") as file:
        RecordPickler(file).dump(records)
    return path


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
    assert names == {(RECORD_MODULE, kind) for kind in RECORDS} | numpy_names
    assert all(opcode.proto <= 4 for part in data for opcode, _, _ in pickletools.genops(part))


def reference_pickle(cell: PublishedCell, protocol: int) -> bytes:
    """A cell as the reference package pickles it: its classes, numpy scalars, arrays in any order of bytes and axes."""
    names = ["datapreparation", "datapreparation.kitti360pose", RECORD_MODULE]
    modules = {name: types.ModuleType(name) for name in names}
    kinds = {kind: type(kind, (), {"__module__": RECORD_MODULE}) for kind in RECORDS}
    modules[RECORD_MODULE].__dict__.update(kinds)

    def made(kind: str, source: object, **changes: object):
        record = kinds[kind]()
        record.__dict__ = {field.name: getattr(source, field.name) for field in fields(source)} | changes
        return record

    objects = [
        made("Object3d", o, instance_id=np.int32(o.instance_id), xyz=np.asfortranarray(o.xyz), closest_point=None)
        for o in cell.objects
    ]
    box = cell.bbox_w.astype(">f8")
    theirs = made("Cell", cell, objects=objects, cell_size=np.float64(30), bbox_w=box)
    with mock.patch.dict(sys.modules, modules):
        return pickle.dumps([theirs], protocol=protocol)


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
    load_scene(root, "0003")
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
        load_scene(root, "0003")


def nan(array: np.ndarray) -> np.ndarray:
    return np.where(np.arange(array.size).reshape(array.shape) == 1, np.nan, array)


BAD_CELLS = {
    "objects[1].xyz has shape": {"xyz": np.zeros((4, 2))},
    "objects[1].xyz is missing": {"xyz": ...},
    "objects[1].xyz is no array": {"xyz": [1.0, 2.0, 3.0]},
    "objects[1].xyz is empty": {"xyz": np.zeros((0, 3))},
    "objects[1].xyz holds a number": {"xyz": np.full((8, 3), np.nan)},
    "objects[1].xyz holds a number that": {"xyz": np.full((8, 3), np.inf)},
    "objects[1].xyz has shape [8, 3] and dtype int64": {"xyz": np.zeros((8, 3), dtype=np.int64)},
    "objects[1].rgb has 3 points": {"rgb": np.zeros((3, 3))},
    "objects[1].rgb holds 0..255": {"rgb": np.linspace(0, 255, 24).reshape(8, 3)},
    "objects[1].rgb holds a number": {"rgb": nan(np.zeros((8, 3)))},
    "objects[1].label is no printable text": {"label": "\x1b[2J"},
    "objects[1].label is no printable text, but a int": {"label": 7},
    "objects[1].id is no whole number": {"id": 1.5},
    "objects[1].instance_id is no whole number": {"instance_id": 2**70},
    "objects has two objects of one id": {"id": 0},
    "id is no printable text": {"cell.id": ""},
    "scene_name is missing": {"cell.scene_name": ...},
    "objects is no list": {"cell.objects": None},
    "objects is empty": {"cell.objects": []},
    "cell_size is no length": {"cell.cell_size": float("nan")},
    "cell_size is no length in": {"cell.cell_size": -30},
    "bbox_w has shape": {"cell.bbox_w": np.zeros(5)},
    "bbox_w is no box": {"cell.bbox_w": np.zeros(6)},
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
    "described_by is no printable text": {"pose.described_by": None},
    "descriptions is empty": {"pose.descriptions": []},
    "descriptions is no list": {"pose.descriptions": "none"},
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


def _set(record: Record, name: str, value: object) -> None:
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
        load_scene(root, "0003")
    assert f"poses/{LONG}.pkl" in str(error.value)
    with pytest.raises(DataError, match=message):
        save_scene(tmp_path / "new", "0003", [make_cell(0)], [pose])
    assert not [path for path in (tmp_path / "new").rglob("*") if path.is_file()]


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


class Evil:
    """Pickles to a call."""

    def __init__(self, function, *args) -> None:
        self.call = function, args

    def __reduce__(self):
        return self.call


class Persistent(pickle.Pickler):
    def persistent_id(self, obj: object):
        return "a file" if isinstance(obj, Evil) else None


def persistent_pickle() -> bytes:
    file = io.BytesIO()
    Persistent(file, protocol=4).dump([Evil(print)])
    return file.getvalue()


def extension_pickle() -> bytes:
    copyreg.add_extension("posix", "getcwd", 240)
    try:
        return pickle.dumps([Evil(os.getcwd)], protocol=4)
    finally:
        copyreg.remove_extension("posix", "getcwd", 240)


MULTIARRAY = "numpy._core.multiarray"


def crafted(*parts: bytes) -> bytes:
    return b"".join([pickle.PROTO + b"\x04", *parts, pickle.STOP])


def named(module: str, name: str) -> bytes:
    return b"c" + f"{module}\n{name}\n".encode()


ARRAY = named(MULTIARRAY, "_reconstruct") + named("numpy", "ndarray") + b"K\0\x85C\x01b\x87R"
STATE = b"(K\x01K\x01\x85" + named("numpy", "dtype") + b"\x8c\x02f8\x89\x88\x87R\x89C\x08" + b"\0" * 8 + b"t"
HOSTILE = {
    ("os.system", "asks for 'posix.system'"): lambda mark: pickle.dumps([Evil(os.system, f"touch {mark}")], protocol=4),
    ("os.system, protocol 0", "operation"): lambda mark: pickle.dumps([Evil(os.system, f"touch {mark}")], protocol=0),
    ("os.system, protocol 3", "asks for 'posix.system'"): lambda mark: pickle.dumps(
        [Evil(os.system, f"touch {mark}")], protocol=3
    ),
    ("eval", "asks for 'builtins.eval'"): lambda mark: pickle.dumps(
        [Evil(eval, f"open({str(mark)!r}, 'w')")], protocol=4
    ),
    ("subprocess", "asks for 'subprocess.Popen'"): lambda mark: pickle.dumps(
        [Evil(subprocess.Popen, ["touch", str(mark)])], protocol=4
    ),
    ("in an object array", "a dtype that is not"): lambda mark: pickle.dumps(
        np.array([Evil(os.system, f"touch {mark}")], dtype=object), protocol=4
    ),
    ("dtype of objects", "a dtype that is not"): lambda _: pickle.dumps(np.zeros(3, dtype=object), protocol=4),
    ("dtype with fields", "a dtype that is not"): lambda _: pickle.dumps(
        np.zeros(3, dtype=[("a", "O"), ("b", "f8")]), protocol=4
    ),
    ("scalar of objects", "a dtype that is not"): lambda _: crafted(
        named(MULTIARRAY, "scalar"), named("numpy", "dtype"), b"\x8c\x02O8\x89\x88\x87R", b"C\x08" + b"\1" * 8, b"\x86R"
    ),
    ("attribute of an allowed name", "asks for 'numpy.ndarray.__class__'"): lambda _: crafted(
        b"\x8c\x05numpy\x8c\x11ndarray.__class__\x93"
    ),
    ("call of a class", "calls what is no array"): lambda _: crafted(named("numpy", "ndarray"), b"K\x05\x85R"),
    ("call of a record", "calls what is no array"): lambda _: crafted(named(RECORD_MODULE, "Cell"), b")R"),
    ("record of a dtype", "makes what is no record"): lambda _: crafted(named("numpy", "dtype"), b")\x81"),
    ("subclass of array", "an array that is not"): lambda _: crafted(
        named(MULTIARRAY, "_reconstruct"), named(RECORD_MODULE, "Cell"), b"K\0\x85C\x01b\x87R"
    ),
    ("state of a class", "sets the state of"): lambda _: crafted(named(RECORD_MODULE, "Cell"), b"}\x8c\x01aK\x01sb"),
    ("state of slots", "sets the state of"): lambda _: crafted(named(RECORD_MODULE, "Cell"), b")\x81N}\x86b"),
    ("append to a record", "appends to what is no list"): lambda _: crafted(
        named(RECORD_MODULE, "Cell"), b")\x81K\x01a"
    ),
    ("set items of a record", "sets names in what is no dict"): lambda _: crafted(
        named(RECORD_MODULE, "Cell"), b")\x81K\x01K\x02s"
    ),
    ("array without values", ""): lambda _: crafted(
        b"]", named(RECORD_MODULE, "Cell"), b")\x81}\x8c\x06bbox_w", ARRAY, b"sba"
    ),
    ("array built twice", "an array that is not"): lambda _: crafted(ARRAY, STATE, b"b", STATE, b"b"),
    ("persistent id", "operation b'Q'"): lambda _: persistent_pickle(),
    ("extension code", r"operation b'\x82'"): lambda _: extension_pickle(),
    ("instance operation", "operation b'S'"): lambda mark: f"(S'touch {mark}'\nios\nsystem\n.".encode(),
    ("nothing", "cut short"): lambda _: b"",
    ("only a stop", "broken"): lambda _: b".",
    ("text", "no pickle"): lambda _: b"hello, world\n" * 10,
    ("a list of numbers", "[0] is no"): lambda _: pickle.dumps([1, 2, 3], protocol=4),
    ("a dict", "is no list"): lambda _: pickle.dumps({"cells": []}, protocol=4),
    ("no cells", "holds no"): lambda _: pickle.dumps([], protocol=4),
}


@pytest.mark.parametrize(("name", "message"), HOSTILE)
def test_a_hostile_pickle_is_refused_and_nothing_is_run(name: str, message: str, tmp_path: Path) -> None:
    mark, path = tmp_path / "executed", tmp_path / "cells.pkl"
    path.write_bytes(HOSTILE[name, message](mark))
    for load in (load_cells, load_poses):
        with pytest.raises(DataError) as error:
            load(path)
        assert str(path) in str(error.value)
        assert message in str(error.value)
    assert not mark.exists()


def test_the_hostile_pickles_do_run_when_trusted(tmp_path: Path) -> None:
    """Or the test above would prove nothing."""
    mark = tmp_path / "executed"
    pickle.loads(pickle.dumps([Evil(os.system, f"touch {mark}")], protocol=4))
    assert mark.exists()


def test_poses_are_no_cells(root: Path) -> None:
    with pytest.raises(DataError, match=r"cells\[0\] is no Cell, but a Pose"):
        load_cells(root / f"poses/{LONG}.pkl")
    with pytest.raises(DataError, match=r"poses\[0\] is no Pose, but a Cell"):
        load_poses(root / f"cells/{LONG}.pkl")


GREAT = {
    "bytes": b"\x8e" + struct.pack("<Q", 1 << 36),
    "bytearray": b"\x96" + struct.pack("<Q", 1 << 36),
    "text": b"\x8d" + struct.pack("<Q", 1 << 36),
    "short text": b"X" + struct.pack("<I", 0xFFFFFFFF),
    "frame": b"\x95" + struct.pack("<Q", 1 << 62),
    "memo": b"]r" + struct.pack("<I", 0xFFFFFFF0),
    "array": ARRAY
    + b"(K\x01J\xff\xff\xff\x7fJ\xff\xff\xff\x7f\x86"
    + named("numpy", "dtype")
    + b"\x8c\x02f8\x89\x88\x87R\x89C\x08"
    + b"\0" * 8
    + b"tb",
}


@pytest.mark.parametrize("claim", GREAT)
def test_what_a_pickle_claims_is_not_allocated(claim: str, tmp_path: Path) -> None:
    path = tmp_path / "cells.pkl"
    path.write_bytes(crafted(GREAT[claim]))
    tracemalloc.start()
    try:
        with pytest.raises(DataError, match=r"cut short|do not fit its shape|holds no cells"):
            load_cells(path)
        assert tracemalloc.get_traced_memory()[1] < 10e6
    finally:
        tracemalloc.stop()


def test_cells_are_read_one_at_a_time(tmp_path: Path) -> None:
    path = dump(tmp_path / "cells.pkl", (cell_record(make_cell(n, 3, 20_000)) for n in range(20)))
    tracemalloc.start()
    try:
        for _ in iter_cells(path):
            pass
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert path.stat().st_size > 40e6
    assert peak < 12e6


def mutate(data: bytes, other: bytes, rng: np.random.Generator) -> bytes:
    """Flip some bytes, cut the end off, or put in a piece of this or another pickle."""
    kind = rng.integers(4)
    if kind == 0:
        return data[: rng.integers(len(data))]
    changed = bytearray(data)
    if kind == 1:
        for at in rng.integers(len(data), size=rng.integers(1, 6)):
            changed[at] = rng.integers(256)
    elif kind == 2:
        source = (data, other)[rng.integers(2)]
        at, start, size = rng.integers(len(data)), rng.integers(len(source)), rng.integers(1, 60)
        changed[at : at + rng.integers(60)] = source[start : start + size]
    else:  # one operation for another, where harm would come from
        at = rng.integers(2, len(data))
        changed[at] = rng.choice(np.frombuffer(b"RbiocP\x81\x82\x83\x84\x92\x93\x94h0.", dtype=np.uint8))
    return bytes(changed)


def test_ten_thousand_mutated_pickles(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each is refused with DataError or is valid data; nothing is executed."""

    def executed(*args: object, **kwargs: object):
        raise SystemExit(f"a pickle executed something: {args}")

    small = make_cell(0, num_objects=2, num_points=2)
    cells = dump(tmp_path / "cells.pkl", [cell_record(small)]).read_bytes()
    poses = dump(tmp_path / "poses.pkl", [pose_record(make_pose(small))]).read_bytes()
    theirs = reference_pickle(small, 4)
    evil = pickle.dumps([Evil(os.system, "true"), Evil(eval, "1")], protocol=4)
    for target in ("os.system", "os.popen", "subprocess.Popen.__init__", "builtins.eval"):
        monkeypatch.setattr(target, executed)
    rng = np.random.default_rng(0)
    path, refused = tmp_path / "mutated.pkl", 0
    for n in range(10_000):
        load, data = ((load_cells, cells), (load_poses, poses), (load_cells, theirs), (load_poses, poses))[n % 4]
        path.write_bytes(mutate(data, evil, rng))
        try:
            found = load(path)
        except DataError:
            refused += 1
            continue
        assert found
        if isinstance(found[0], PublishedCell):
            assert all(np.isfinite(item.xyz).all() and len(item.xyz) for cell in found for item in cell.objects)
    assert 5_000 < refused < 10_000
