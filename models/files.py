"""Files and directories that are there whole or not at all, whatever happens while they are written."""

import fcntl
import hashlib
import os
import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from threading import get_ident
from typing import BinaryIO, Final

from pydantic import BaseModel, ConfigDict

BUILDING: Final = ".building-"  # begins the name of a directory that is being filled
SETTLING_S: Final = 60.0


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
    beside = path.with_name(f".{path.name}.{os.getpid()}.{get_ident()}")
    try:
        with beside.open("wb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        if path.exists():
            shutil.copymode(path, beside)
        beside.replace(path)
        sync(path.parent)
    finally:
        beside.unlink(missing_ok=True)


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
    _remove_abandoned(path.parent)
    beside = Path(tempfile.mkdtemp(prefix=BUILDING, dir=path.parent))
    held = os.open(beside, os.O_RDONLY)
    fcntl.flock(held, fcntl.LOCK_EX)  # until this process ends, however that may be
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


def _remove_abandoned(parent: Path) -> None:
    """Remove directories that were being filled when their process was killed."""
    for left in parent.glob(f"{BUILDING}*"):
        with suppress(OSError):  # of somebody else, or somebody else removes it too
            if time.time() - left.stat().st_mtime < SETTLING_S:
                continue  # it may be about to be locked
            held = os.open(left, os.O_RDONLY)
            try:
                fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(left, ignore_errors=True)
            finally:
                os.close(held)


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


def cache_directory() -> Path:
    """Where computed things are kept: HEREABOUTS_CACHE_DIR, else hereabouts in XDG_CACHE_HOME, else in ~/.cache."""
    if own := os.environ.get("HEREABOUTS_CACHE_DIR"):
        return Path(own)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "hereabouts"
