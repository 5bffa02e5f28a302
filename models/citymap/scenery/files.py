"""Scenery on disk: parts in files of their own, each compressed as it is sent."""

import gzip
import shutil
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy.typing as npt

from models.files import save_safetensors

GZIP_LEVEL = 9


class SceneryBlob(NamedTuple):
    """A part as a safetensors file holds it.

    Attributes:
        tensors: by name.
        metadata: its metadata.
    """

    tensors: dict[str, npt.NDArray[Any]]
    metadata: dict[str, str]


@dataclass(frozen=True, slots=True)
class SceneryPart:
    """A file to send as it is.

    Attributes:
        path: where it lies, compressed by gzip.
        sha256: of it.
    """

    path: Path
    sha256: str


def save_scenery(directory: Path, parts: Iterable[SceneryBlob]) -> None:
    """Write the parts, scenery.0.safetensors.gz and on; no copy of one is in memory."""
    plain = directory / "scenery"
    for number, part in enumerate(parts):
        save_safetensors(part.tensors, part.metadata, plain)
        with (
            plain.open("rb") as read,
            (directory / file_name(number)).open("wb") as written,
            gzip.GzipFile("", "wb", GZIP_LEVEL, written, mtime=0) as packed,
        ):
            shutil.copyfileobj(read, packed)
        plain.unlink()


def file_name(number: int) -> str:
    """Of a part."""
    return f"scenery.{number}.safetensors.gz"


def is_scenery(name: str) -> bool:
    """Whether a file of an index is a part."""
    return name.startswith("scenery.")
