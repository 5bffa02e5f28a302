"""Pickles are data: nothing in them is executed, nothing that they claim is allocated.

FUZZ_MUTATIONS sets how many mutated pickles are tried.
"""

import copyreg
import io
import os
import pickle
import struct
import subprocess
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from models.errors import DataError
from models.sources.kitti360pose.files import iter_cells, load_poses
from models.sources.kitti360pose.pickle_values import RECORD_MODULE
from models.sources.kitti360pose.pickle_writer import cell_record, pose_record
from models.sources.kitti360pose.records import PublishedCell
from tests.models.sources.conftest import LONG, dump, make_cell, make_pose, reference_pickle
from tests.models.sources.published import load_cells


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
MUTATIONS = int(os.environ.get("FUZZ_MUTATIONS", "1000"))


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
    ("call of a class", "calls something other than an array"): lambda _: crafted(
        named("numpy", "ndarray"), b"K\x05\x85R"
    ),
    ("call of a record", "calls something other than an array"): lambda _: crafted(named(RECORD_MODULE, "Cell"), b")R"),
    ("record of a dtype", "makes something other than a record"): lambda _: crafted(named("numpy", "dtype"), b")\x81"),
    ("subclass of array", "an array that is not"): lambda _: crafted(
        named(MULTIARRAY, "_reconstruct"), named(RECORD_MODULE, "Cell"), b"K\0\x85C\x01b\x87R"
    ),
    ("state of a class", "sets the state of"): lambda _: crafted(named(RECORD_MODULE, "Cell"), b"}\x8c\x01aK\x01sb"),
    ("state of slots", "sets the state of"): lambda _: crafted(named(RECORD_MODULE, "Cell"), b")\x81N}\x86b"),
    ("append to a record", "appends to something other than a list"): lambda _: crafted(
        named(RECORD_MODULE, "Cell"), b")\x81K\x01a"
    ),
    ("set items of a record", "sets names in something other than a dict"): lambda _: crafted(
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
    ("text", "not a pickle"): lambda _: b"hello, world\n" * 10,
    ("a list of numbers", "[0] is no"): lambda _: pickle.dumps([1, 2, 3], protocol=4),
    ("a dict", "is not a list"): lambda _: pickle.dumps({"cells": []}, protocol=4),
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
    with pytest.raises(DataError, match=r"cells\[0\] is not a Cell, but a Pose"):
        load_cells(root / f"poses/{LONG}.pkl")
    with pytest.raises(DataError, match=r"poses\[0\] is not a Pose, but a Cell"):
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


def test_cells_are_written_and_read_one_at_a_time(tmp_path: Path) -> None:
    tracemalloc.start()
    try:
        path = dump(tmp_path / "cells.pkl", (cell_record(make_cell(n, 3, 20_000)) for n in range(20)))
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
        for position in rng.integers(len(data), size=rng.integers(1, 6)):
            changed[position] = rng.integers(256)
    elif kind == 2:
        source = (data, other)[rng.integers(2)]
        position, start, size = rng.integers(len(data)), rng.integers(len(source)), rng.integers(1, 60)
        changed[position : position + rng.integers(60)] = source[start : start + size]
    else:  # one operation for another, where harm would come from
        position = rng.integers(2, len(data))
        changed[position] = rng.choice(np.frombuffer(b"RbiocP\x81\x82\x83\x84\x92\x93\x94h0.", dtype=np.uint8))
    return bytes(changed)


@pytest.mark.slow
def test_mutated_pickles(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
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
    for n in range(MUTATIONS):
        load, data = ((load_cells, cells), (load_poses, poses), (load_cells, theirs), (load_poses, poses))[n % 4]
        path.write_bytes(mutate(data, evil, rng))
        try:
            result = load(path)
        except DataError:
            refused += 1
            continue
        assert result
        if isinstance(result[0], PublishedCell):
            assert all(np.isfinite(item.xyz).all() and len(item.xyz) for cell in result for item in cell.objects)
    assert MUTATIONS / 2 < refused < MUTATIONS
