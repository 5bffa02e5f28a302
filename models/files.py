"""Files and directories that are there whole or not at all, whatever happens while they are written."""

import hashlib
import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import get_ident
from typing import BinaryIO

from pydantic import BaseModel, ConfigDict


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
    beside = Path(tempfile.mkdtemp(prefix=f".{path.name}-", dir=path.parent))
    try:
        yield beside
        for item in (*beside.rglob("*"), beside):
            item.chmod(0o755 if item.is_dir() else 0o644)
            sync(item)
        beside.rename(path)
        sync(path.parent)
    finally:
        shutil.rmtree(beside, ignore_errors=True)


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
