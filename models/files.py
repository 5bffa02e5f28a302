"""Atomic writing of files and directories, file checksums, and memory-mapped safetensors files."""

import errno
import fcntl
import hashlib
import json
import os
import secrets
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO, Final

import numpy as np
import numpy.typing as npt
from pydantic import BaseModel, ConfigDict
from safetensors import safe_open
from safetensors.numpy import save_file

from models.memory import map_file

TEMP_PREFIX: Final = ".building-"  # of the name of a file or directory that is still being written


class FileRecord(BaseModel):
    """The checksum and size of a file in a manifest."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    sha256: str  # in hex
    bytes: int


@contextmanager
def open_atomic(path: Path) -> Iterator[BinaryIO]:
    """Open a temporary file that replaces `path` when the block ends; on an error, nothing changes or is left over."""
    path = path.resolve()  # replace the target of a link, not the link
    path.parent.mkdir(parents=True, exist_ok=True)
    remove_abandoned(path.parent)
    file, temporary = _create_locked_file(path.parent)
    try:
        with file:
            yield file
            file.flush()
            os.fsync(file.fileno())
            if path.exists():
                shutil.copymode(path, temporary)
            temporary.replace(path)
            sync(path.parent)
    finally:
        temporary.unlink(missing_ok=True)


def _create_locked_file(parent: Path) -> tuple[BinaryIO, Path]:
    """Create a temporary file that stays locked until it is closed or its process ends."""
    while True:
        path = parent / f"{TEMP_PREFIX}{secrets.token_hex(8)}"
        file = path.open("xb")  # mkstemp would make it readable for its owner alone
        fcntl.flock(file, fcntl.LOCK_EX)
        if path.exists():  # otherwise another process removed it as abandoned before it was locked
            return file, path
        file.close()


def replace_file(path: Path, content: bytes) -> None:
    """Write a file atomically: a reader, or a restart after a crash, sees the old or the new content, never a part."""
    with open_atomic(path) as file:
        file.write(content)


def append_line(path: Path, line: bytes) -> None:
    """Append a line durably; other writers wait, and a part of a line that a crash left is closed by a line end.

    A new file can be read by its owner only.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "a+b", buffering=0, opener=partial(os.open, mode=0o600)) as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        size = file.seek(0, os.SEEK_END)
        file.seek(max(0, size - 1))
        content = (b"" if file.read(1) in (b"", b"\n") else b"\n") + line + b"\n"
        try:
            if file.write(content) != len(content):
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            os.fsync(file.fileno())
        except OSError:
            file.truncate(size)
            raise
        if not size:
            sync(path.parent)


@contextmanager
def new_directory(path: Path) -> Iterator[Path]:
    """Yield a temporary directory that becomes `path` when the block ends; on an error, it is removed.

    All its files become readable for everyone: some libraries write files that only their owner can read.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    remove_abandoned(path.parent)
    lock, temporary = _create_locked_directory(path.parent)
    try:
        yield temporary
        for item in (*temporary.rglob("*"), temporary):
            item.chmod(0o755 if item.is_dir() else 0o644)
            sync(item)
        temporary.rename(path)
        sync(path.parent)
    finally:
        os.close(lock)
        shutil.rmtree(temporary, ignore_errors=True)


@contextmanager
def scratch_directory(parent: Path) -> Iterator[Path]:
    """Yield a new directory that is removed when the block ends, or by a later call if the process is killed."""
    remove_abandoned(parent)
    lock, directory = _create_locked_directory(parent)
    try:
        yield directory
    finally:
        os.close(lock)
        shutil.rmtree(directory, ignore_errors=True)


def _create_locked_directory(parent: Path) -> tuple[int, Path]:
    """Create a temporary directory; return the descriptor that locks it, and its path."""
    while True:
        path = Path(tempfile.mkdtemp(prefix=TEMP_PREFIX, dir=parent))
        with suppress(FileNotFoundError):
            lock = os.open(path, os.O_RDONLY)
            fcntl.flock(lock, fcntl.LOCK_EX)
            if path.exists():
                return lock, path
            os.close(lock)


def remove_abandoned(parent: Path) -> None:
    """Remove temporary files and directories in `parent` whose processes were killed."""
    for path in parent.glob(f"{TEMP_PREFIX}*"):
        with suppress(OSError):  # another user owns it, or another process removes it at the same time
            descriptor = os.open(path, os.O_RDONLY)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                if path.is_dir():
                    shutil.rmtree(path, ignore_errors=True)
                else:
                    path.unlink()
            finally:
                os.close(descriptor)


def sync(path: Path) -> None:
    """Flush a file or directory to disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def sha256(path: Path) -> str:
    """Return the sha256 of a file, in hex."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def file_records(directory: Path) -> dict[str, FileRecord]:
    """Return the records of the files in a directory, sorted by name."""
    return {p.name: FileRecord(sha256=sha256(p), bytes=p.stat().st_size) for p in sorted(directory.iterdir())}


def save_safetensors(columns: dict[str, npt.NDArray[Any]], facts: dict[str, str], path: Path) -> None:
    """Write a safetensors file with sorted metadata, so that equal content gives equal bytes in every process."""
    save_file(columns, path, facts)
    with path.open("r+b") as file:
        size = int.from_bytes(file.read(8), "little")
        header = json.loads(file.read(size))
        header["__metadata__"] = dict(sorted(header["__metadata__"].items()))
        text = json.dumps(header, ensure_ascii=False, separators=(",", ":")).encode()
        assert size - 8 < len(text) <= size, "the reordered header has the same length"
        file.seek(8)
        file.write(text.ljust(size))  # padding keeps the tensors aligned


def map_arrays(path: Path) -> tuple[dict[str, npt.NDArray[Any]], dict[str, str]]:
    """Map the arrays of a safetensors file into memory (copy-on-write), and return them with the metadata.

    Processes share the pages of the file; a write changes a private copy, never the file.

    Raises:
        OSError, SafetensorError: the file is missing or not a valid safetensors file.
    """
    with safe_open(path, framework="numpy") as file:  # checks that all arrays lie within the file
        facts = file.metadata() or {}
    content = map_file(path)
    begin = 8 + int.from_bytes(content[:8].tobytes(), "little")
    header = json.loads(content[8:begin].tobytes())
    header.pop("__metadata__", None)
    arrays = {}
    for name, array in header.items():
        first, last = (begin + offset for offset in array["data_offsets"])
        arrays[name] = content[first:last].view(_dtype(array["dtype"])).reshape(array["shape"])
    return arrays, facts


def _dtype(name: str) -> np.dtype[Any]:
    """Return the NumPy type of a safetensors type name such as F32, I8 or BOOL."""
    return np.dtype(np.bool_ if name == "BOOL" else f"{name[0].lower()}{int(name[1:]) // 8}")


def cache_directory() -> Path:
    """Return the cache directory: HEREABOUTS_CACHE_DIR, else `hereabouts` in XDG_CACHE_HOME or ~/.cache."""
    if directory := os.environ.get("HEREABOUTS_CACHE_DIR"):
        return Path(directory)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "hereabouts"
