"""Scenery on disk: parts in files of their own, each compressed as it is sent."""

import gzip
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

LEVEL = 9


@dataclass(frozen=True, slots=True)
class SceneryPart:
    """A file to send as it is.

    Attributes:
        path: where it lies, compressed by gzip.
        sha256: of it.
    """

    path: Path
    sha256: str


def save_scenery(directory: Path, parts: Iterable[bytes]) -> None:
    """Write the parts, scenery.0.safetensors.gz and on."""
    for number, part in enumerate(parts):
        (directory / file_name(number)).write_bytes(gzip.compress(part, LEVEL, mtime=0))


def file_name(number: int) -> str:
    """Of a part."""
    return f"scenery.{number}.safetensors.gz"


def is_scenery(name: str) -> bool:
    """Whether a file of an index is a part."""
    return name.startswith("scenery.")
