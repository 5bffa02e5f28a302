"""Files and directories that are there whole or not at all, whatever happens while they are written."""

import fcntl
import hashlib
import json
import mmap
import os
import secrets
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, BinaryIO, Final

import numpy as np
import numpy.typing as npt
from pydantic import BaseModel, ConfigDict
from safetensors import safe_open
from safetensors.numpy import save_file

BUILDING: Final = ".building-"  # begins the name of a file or directory that is being filled


class FileRecord(BaseModel):
    """A file, as a manifest knows it.

    Attributes:
        sha256: of its contents, in hex.
        bytes: its size.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    sha256: str
    bytes: int


@contextmanager
def replacing(path: Path) -> Iterator[BinaryIO]:
    """A file to write, which takes its place only when all is written; if that fails, nothing is left or changed."""
    path = path.resolve()  # of a link, what it leads to
    path.parent.mkdir(parents=True, exist_ok=True)
    remove_abandoned(path.parent)
    file, beside = _begin_file(path.parent)
    try:
        with file:
            yield file
            file.flush()
            os.fsync(file.fileno())
            if path.exists():
                shutil.copymode(path, beside)
            beside.replace(path)
            sync(path.parent)
    finally:
        beside.unlink(missing_ok=True)


def _begin_file(parent: Path) -> tuple[BinaryIO, Path]:
    """A new file in a directory, locked until it is closed or its process ends, however that may be."""
    while True:
        beside = parent / f"{BUILDING}{secrets.token_hex(8)}"
        file = beside.open("xb")  # and not by mkstemp, whose files only their owner can read
        fcntl.flock(file, fcntl.LOCK_EX)
        if beside.exists():  # else somebody took it for abandoned before it was locked
            return file, beside
        file.close()


def replace_file(path: Path, content: bytes) -> None:
    """Write a file so that a reader, or a restart after a crash, finds the old one or the new one, never a part."""
    with replacing(path) as file:
        file.write(content)


@contextmanager
def new_directory(path: Path) -> Iterator[Path]:
    """A directory to fill, which appears under its name only when the block is done; if that fails, nothing is left.

    Whoever may reach it can read what is in it: some libraries write files that only their owner can.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    remove_abandoned(path.parent)
    held, beside = _begin_directory(path.parent)
    try:
        yield beside
        for item in (*beside.rglob("*"), beside):
            item.chmod(0o755 if item.is_dir() else 0o644)
            sync(item)
        beside.rename(path)
        sync(path.parent)
    finally:
        os.close(held)
        shutil.rmtree(beside, ignore_errors=True)


@contextmanager
def new_scratch(parent: Path) -> Iterator[Path]:
    """A directory in another that is removed when the block ends, or later if its process was killed."""
    remove_abandoned(parent)
    held, directory = _begin_directory(parent)
    try:
        yield directory
    finally:
        os.close(held)
        shutil.rmtree(directory, ignore_errors=True)


def _begin_directory(parent: Path) -> tuple[int, Path]:
    """As `_begin_file`, for a directory; with the descriptor that holds it."""
    while True:
        beside = Path(tempfile.mkdtemp(prefix=BUILDING, dir=parent))
        with suppress(FileNotFoundError):
            held = os.open(beside, os.O_RDONLY)
            fcntl.flock(held, fcntl.LOCK_EX)
            if beside.exists():
                return held, beside
            os.close(held)


def remove_abandoned(parent: Path) -> None:
    """Remove from a directory what was being filled when its process was killed."""
    for left in parent.glob(f"{BUILDING}*"):
        with suppress(OSError):  # another user owns it, or another process removes it at the same time
            descriptor = os.open(left, os.O_RDONLY)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                if left.is_dir():
                    shutil.rmtree(left, ignore_errors=True)
                else:
                    left.unlink()
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
    """sha256 of a file, in hex."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def file_records(directory: Path) -> dict[str, FileRecord]:
    """Sizes and sums of the files of a directory, by name in order."""
    return {p.name: FileRecord(sha256=sha256(p), bytes=p.stat().st_size) for p in sorted(directory.iterdir())}


def save_in_order(columns: dict[str, npt.NDArray[Any]], facts: dict[str, str], path: Path) -> None:
    """Write a safetensors file with its metadata in order of their names: else it is another in each process."""
    save_file(columns, path, facts)
    with path.open("r+b") as file:
        size = int.from_bytes(file.read(8), "little")
        header = json.loads(file.read(size))
        header["__metadata__"] = dict(sorted(header["__metadata__"].items()))
        text = json.dumps(header, ensure_ascii=False, separators=(",", ":")).encode()
        assert size - 8 < len(text) <= size, "the same, in another order"
        file.seek(8)
        file.write(text.ljust(size))  # so that tensors stay aligned


def mapped(path: Path) -> tuple[dict[str, npt.NDArray[Any]], dict[str, str]]:
    """The arrays of a safetensors file and its metadata, without reading it: pages come when they are looked at.

    Processes share these pages; who writes into an array has its own copy of one, and the file stays.

    Raises:
        OSError, SafetensorError: the file is missing, or none of these.
    """
    with safe_open(path, framework="numpy") as file:  # which refuses arrays that are not wholly in the file
        facts = file.metadata() or {}
    content = np.memmap(path, np.uint8, mode="c").view(np.ndarray)
    begin = 8 + int.from_bytes(content[:8].tobytes(), "little")
    header = json.loads(content[8:begin].tobytes())
    header.pop("__metadata__", None)
    arrays = {}
    for name, array in header.items():
        first, last = (begin + offset for offset in array["data_offsets"])
        arrays[name] = content[first:last].view(_dtype(array["dtype"])).reshape(array["shape"])
    return arrays, facts


def let_go(array: npt.NDArray[Any]) -> None:
    """Have the system forget the pages of the file that an array of `mapped` lies in, until they are looked at.

    What was written into any array of that file is lost; of a copy there is nothing to forget.
    """
    base: Any = array
    while base is not None and not isinstance(base, mmap.mmap):
        base = getattr(base, "base", None)  # bytes that an array is a view of have none
    if base is not None:
        base.madvise(mmap.MADV_DONTNEED)


def _dtype(name: str) -> np.dtype[Any]:
    """The type of what safetensors calls F32, I8 or BOOL."""
    return np.dtype(np.bool_ if name == "BOOL" else f"{name[0].lower()}{int(name[1:]) // 8}")


def cache_directory() -> Path:
    """Where computed things are kept: HEREABOUTS_CACHE_DIR, else hereabouts in XDG_CACHE_HOME, else in ~/.cache."""
    if own := os.environ.get("HEREABOUTS_CACHE_DIR"):
        return Path(own)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "hereabouts"
