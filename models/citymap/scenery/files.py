"""Scenery on disk: each part in a file, compressed as it is sent."""

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
    """The content of a part's safetensors file."""

    tensors: dict[str, npt.NDArray[Any]]
    metadata: dict[str, str]


@dataclass(frozen=True, slots=True)
class SceneryPart:
    """A file that is sent as it is."""

    path: Path  # compressed by gzip
    sha256: str


def save_scenery(directory: Path, parts: Iterable[SceneryBlob]) -> None:
    """Write the parts to scenery.0.safetensors.gz and so on, without a copy of a part in memory."""
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
    """Return the file name of a part."""
    return f"scenery.{number}.safetensors.gz"


def is_scenery(name: str) -> bool:
    """Whether a file of an index is a part of the scenery."""
    return name.startswith("scenery.")
