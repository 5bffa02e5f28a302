import fcntl
import hashlib
import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from safetensors import SafetensorError
from safetensors.numpy import load, save

from models.files import (
    TEMP_PREFIX,
    file_records,
    map_arrays,
    new_directory,
    open_atomic,
    remove_abandoned,
    replace_file,
    save_safetensors,
)


def mode(path):
    return path.stat().st_mode & 0o777


def test_a_file_is_replaced_only_when_all_is_written(tmp_path) -> None:
    path = tmp_path / "deep" / "a"
    replace_file(path, b"old")
    with open_atomic(path) as file:
        file.write(b"new")
        file.flush()
        assert path.read_bytes() == b"old"
    assert path.read_bytes() == b"new"
    (tmp_path / "plain").write_text("")
    assert mode(path) == mode(tmp_path / "plain"), "as the user lets others read new files"


def test_a_link_leads_to_the_new_content_and_the_mode_stays(tmp_path) -> None:
    (tmp_path / "real").write_bytes(b"old")
    (tmp_path / "real").chmod(0o600)
    (tmp_path / "link").symlink_to("real")
    replace_file(tmp_path / "link", b"new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_bytes() == b"new"
    assert mode(tmp_path / "real") == 0o600


def test_threads_may_write_one_file_at_once(tmp_path) -> None:
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(lambda n: replace_file(tmp_path / "a", b"%d" % n), range(200)))
    assert [path.name for path in tmp_path.iterdir()] == ["a"]


def test_a_failure_leaves_the_old_file_and_no_scrap(tmp_path) -> None:
    replace_file(tmp_path / "a", b"old")
    for name in ("a", "b"):
        with pytest.raises(ZeroDivisionError), open_atomic(tmp_path / name) as file:
            file.write(b"half" * (file.write(b"half") // 0))
    assert [path.name for path in tmp_path.iterdir()] == ["a"]
    assert (tmp_path / "a").read_bytes() == b"old"


def test_a_file_that_cannot_be_flushed_is_not_put_in_place(tmp_path, monkeypatch) -> None:
    def full_disk(*_):
        raise OSError("no space left")

    monkeypatch.setattr("os.fsync", full_disk)
    with pytest.raises(OSError, match="no space"):
        replace_file(tmp_path / "a", b"new")
    with pytest.raises(OSError, match="no space"), new_directory(tmp_path / "d") as directory:
        (directory / "a").write_text("new")
    assert not list(tmp_path.iterdir())


def test_a_directory_appears_whole_and_readable(tmp_path) -> None:
    out = tmp_path / "deep" / "out"
    with new_directory(out) as directory:
        (directory / "inner").mkdir(mode=0o700)
        (directory / "inner" / "a").write_bytes(b"a")
        (directory / "inner" / "a").chmod(0o600)
        assert not out.exists()
    assert (out / "inner" / "a").read_bytes() == b"a"
    assert [mode(path) for path in (out, out / "inner", out / "inner" / "a")] == [0o755, 0o755, 0o644]
    assert [path.name for path in out.parent.iterdir()] == ["out"]


def test_a_failure_leaves_no_directory(tmp_path) -> None:
    with pytest.raises(IsADirectoryError), new_directory(tmp_path / "out") as directory:
        directory.write_text("half")
    assert not list(tmp_path.iterdir())


def test_records_are_sizes_and_sums(tmp_path) -> None:
    (tmp_path / "b").write_bytes(b"bytes")
    (tmp_path / "a").write_bytes(b"")
    records = file_records(tmp_path)
    assert list(records) == ["a", "b"]
    assert (records["b"].bytes, records["b"].sha256) == (5, hashlib.sha256(b"bytes").hexdigest())


@pytest.mark.parametrize("write", ["new_directory(path)", "open_atomic(path)"])
def test_what_a_killed_process_left_is_removed_and_what_another_fills_is_not(tmp_path, write) -> None:
    script = "import sys, time; from pathlib import Path; from models.files import new_directory, open_atomic\n"
    script += f"path = Path(sys.argv[1])\nwith {write}:\n    print(flush=True); time.sleep(60)"
    running = []
    for name in ("killed", "alive"):
        command = [sys.executable, "-c", script, tmp_path / name]
        running.append(subprocess.Popen(command, stdout=subprocess.PIPE, text=True))
        running[-1].stdout.readline()
    assert len(list(tmp_path.iterdir())) == 2
    running[0].kill()
    running[0].communicate()
    replace_file(tmp_path / "own", b"")
    [_, alive] = sorted(path.name for path in tmp_path.iterdir())[::-1]
    assert alive.startswith(TEMP_PREFIX)
    running[1].kill()
    running[1].communicate()
    with new_directory(tmp_path / "new"):
        pass
    assert {path.name for path in tmp_path.iterdir()} == {"own", "new"}


@pytest.mark.parametrize("write", [new_directory, open_atomic])
def test_what_is_taken_for_abandoned_before_it_was_locked_is_begun_again(tmp_path, monkeypatch, write) -> None:
    lock, calls = fcntl.flock, []

    def cleaned_first(descriptor, how):
        if how == fcntl.LOCK_EX:
            calls.append(descriptor)
            if len(calls) == 1:
                remove_abandoned(tmp_path)
        lock(descriptor, how)

    monkeypatch.setattr("fcntl.flock", cleaned_first)
    with write(tmp_path / "a"):
        pass
    assert len(calls) == 2
    assert [path.name for path in tmp_path.iterdir()] == ["a"]


def test_metadata_of_a_safetensors_file_is_in_order_and_the_rest_as_it_was(tmp_path) -> None:
    tensors = {"a": np.arange(7, dtype=np.int16), "b": np.ones((2, 3))}
    metadata = {"ä": "1", "z": "Ōmiya\u2028 大宮 🚉", "b": '"3" \\ \x01\x1f\x7f\b\f\n\r\t/'}
    blobs = set()
    for items in (metadata.items(), reversed(metadata.items()), metadata.items()):
        save_safetensors(tensors, dict(items), tmp_path / "a")
        blobs.add((tmp_path / "a").read_bytes())
    [blob] = blobs
    assert map_arrays(tmp_path / "a")[1] == metadata
    size = int.from_bytes(blob[:8], "little")
    assert list(json.loads(blob[8 : 8 + size])["__metadata__"]) == ["b", "z", "ä"]
    assert size % 8 == 0
    for name, tensor in load(blob).items():
        assert (tensor == tensors[name]).all()
        assert tensor.dtype == tensors[name].dtype


ARRAYS = {
    "wide": np.arange(6, dtype=np.int64).reshape(2, 3),
    "half": np.array([0.5, -2.0], np.float16),
    "bytes": np.array([1, 255], np.uint8),
    "is": np.array([True, False, True]),
    "single": np.array([[1.5]], np.float32),
    "none": np.zeros((0, 4), np.float64),
    "small": np.array([-3], np.int8),
}


def test_mapped_arrays_are_those_that_were_saved(tmp_path) -> None:
    save_safetensors(ARRAYS, {"model": "x"}, tmp_path / "a")
    arrays, facts = map_arrays(tmp_path / "a")
    assert facts == {"model": "x"}
    assert set(arrays) == set(ARRAYS)
    for name, array in ARRAYS.items():
        assert (arrays[name].dtype, arrays[name].shape) == (array.dtype, array.shape)
        assert (arrays[name] == array).all()
        assert arrays[name].flags.aligned
        assert type(arrays[name]) is np.ndarray


def test_what_is_written_into_a_mapped_array_does_not_reach_the_file(tmp_path) -> None:
    (tmp_path / "a").write_bytes(before := save(ARRAYS))
    arrays, facts = map_arrays(tmp_path / "a")
    assert facts == {}
    arrays["wide"][:] = 7
    assert (arrays["wide"] == 7).all()
    assert (tmp_path / "a").read_bytes() == before


@pytest.mark.parametrize("length", [0, 4, 60, -1])
def test_a_file_cut_short_is_not_mapped(tmp_path, length) -> None:
    (tmp_path / "a").write_bytes(save(ARRAYS)[:length])
    with pytest.raises(SafetensorError):
        map_arrays(tmp_path / "a")
    with pytest.raises(OSError, match="a"):
        map_arrays(tmp_path / "nothing")
