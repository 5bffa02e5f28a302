"""Files that a disk, or a copy, has not kept as they were written."""

import random
import re
import resource
import shutil
from contextlib import contextmanager

import numpy as np
import pytest

from index.build.artifact import open_version, read_aliases
from index.stores.faiss_store import FaissStore
from models.errors import IndexBroken

PLACES = 6  # in each file


@pytest.fixture
def copy(index_dir, tmp_path):
    shutil.copytree(index_dir, tmp_path / "index")
    return tmp_path / "index"


@pytest.fixture
def rng():
    return random.Random(0)


def flipped(whole, rng):
    """The same with another bit somewhere."""
    position = rng.randrange(len(whole))
    return whole[:position] + bytes([whole[position] ^ 1 << rng.randrange(8)]) + whole[position + 1 :]


def test_every_file_that_is_cut_flipped_or_missing_is_refused_by_name(copy, rng) -> None:
    directory, manifest = open_version(copy)
    files = [directory / name for name in (*manifest.files, "manifest.json")]
    assert set(files) == set(directory.iterdir())
    for path in files:
        whole = path.read_bytes()
        broken = [whole[: rng.randrange(len(whole))] for _ in range(PLACES)]
        broken += [flipped(whole, rng) for _ in range(PLACES)]
        for content in (b"", *broken, whole + b"\0"):
            path.write_bytes(content)
            with pytest.raises(IndexBroken, match=rf"{re.escape(path.name)}|has format"):
                open_version(copy)
        path.unlink()
        with pytest.raises(IndexBroken, match=rf"{re.escape(path.name)} is missing"):
            open_version(copy)
        path.write_bytes(whole)
    open_version(copy)


def test_aliases_that_are_cut_or_flipped_name_what_is_whole_or_are_refused(copy, rng) -> None:
    path, version = copy / "aliases.json", open_version(copy)
    whole = path.read_bytes()
    refused = 0
    for content in [whole[:n] for n in range(len(whole) - 1)] + [flipped(whole, rng) for _ in range(200)]:
        path.write_bytes(content)
        try:
            assert open_version(copy) == version, content
        except IndexBroken:
            refused += 1
    assert refused > len(whole)
    path.write_bytes(whole)
    assert read_aliases(copy).aliases == {"default": version[0].name}


@contextmanager
def full_disk(file_bytes):
    """No file of this process can grow beyond this."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (file_bytes, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize("lacking", [1, 100, 5000, 1 << 62])
def test_vectors_are_written_to_the_last_byte_or_it_is_said(tmp_path, lacking) -> None:
    store = FaissStore.from_vectors(np.ones((300, 16), dtype=np.float32))
    store.save(tmp_path / "whole")
    size = (tmp_path / "whole").stat().st_size
    with full_disk(max(0, size - lacking)), pytest.raises(OSError, match="File too large"):
        store.save(tmp_path / "cut")
