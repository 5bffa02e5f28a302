"""The parts of an index that shards have made: immutable directories with a manifest each, until they are merged.

<root>/.parts/<origin>/<i>-of-<n>/manifest.json   written last: what it was made of, which cells, the sum of every file
"""

import hashlib
import shutil
from collections.abc import Sequence
from contextlib import suppress
from importlib.metadata import version as package_version
from pathlib import Path
from tempfile import TemporaryFile
from typing import Final

from pydantic import BaseModel, ConfigDict, ValidationError

from index.build.manifest import MANIFEST, Name, Sha256
from index.build.shard import Shard
from index.build.shard_data import Part
from models.citymap.cells import CELLS_PER_BLOCK, CellTable
from models.errors import IndexBroken
from models.files import FileRecord, file_records, new_directory, sha256
from models.paper.levels import Level

PARTS: Final = ".parts"
FORMAT: Final = 2


class Origin(BaseModel):
    """What a part was made of; parts of one origin make an index.

    Attributes:
        format: of the part.
        software: version of hereabouts.
        map_sha256: as `index.build.manifest.fingerprint`.
        model_fingerprint, posterior_fingerprint: sha256 of all weights of the retriever and of the hint posterior.
        levels: whether it has the retriever's other levels.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    format: int = FORMAT
    software: str = package_version("hereabouts")
    map_sha256: Sha256
    model_fingerprint: Sha256
    posterior_fingerprint: Sha256
    levels: bool

    @property
    def digest(self) -> str:
        """A name for it."""
        return hashlib.sha256(self.model_dump_json().encode()).hexdigest()[:16]

    def fault(self, other: "Origin") -> str | None:
        """What is wrong with a part of another origin; None if it is this one."""
        if (other.format, other.software) != (self.format, self.software):
            return f"is of hereabouts {other.software}, this is {self.software}"
        if other.map_sha256 != self.map_sha256:
            return "is of another map, split or region"
        if other.model_copy(update={"levels": self.levels}) != self:
            return "is of another model"
        return None if other == self else f"was made {'with' if other.levels else 'without'} --levels"


class PartManifest(BaseModel):
    """What a part says of itself.

    Attributes:
        origin: what it was made of.
        rows: its cells, the first and the one after the last.
        cells: of the whole map.
        files: every other file.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    origin: Origin
    rows: tuple[int, int]
    cells: int
    files: dict[Name, FileRecord]


class Parts:
    """The parts of one origin in an index directory.

    Args:
        root: the index directory.
        origin: what all of them were made of.
    """

    def __init__(self, root: Path, origin: Origin) -> None:
        self._root, self._origin = root / PARTS, origin
        self._directory = self._root / origin.digest

    def path(self, shard: Shard) -> Path:
        """Where the part of a shard is, or will be."""
        return self._directory / shard.name

    def claim(self) -> None:
        """Find out before hours of work whether anything can be written here.

        Raises:
            OSError: it cannot.
        """
        self._directory.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=self._directory) as file:
            file.write(b"\0")

    def fault(self, shard: Shard) -> str | None:
        """What is wrong with the part of a shard, "is missing" for one; None if it is whole."""
        path = self.path(shard)
        if not path.exists():
            others = sorted(self._root.glob(f"*/{shard.name}"))
            known = [f" ({other.relative_to(self._root)} {said})" for other in others if (said := self._fault(other))]
            return f"is missing{''.join(known)}"
        return self._fault(path)

    def _fault(self, path: Path) -> str | None:
        """As `fault`, of what is at a path."""
        try:
            manifest = _read(path)
            if fault := self._origin.fault(manifest.origin):
                return fault
            changed = [name for name, record in manifest.files.items() if sha256(path / name) != record.sha256]
        except (OSError, ValidationError) as error:
            missing = Path(error.filename).name if isinstance(error, OSError) and error.filename else MANIFEST
            return f"is damaged: {missing} cannot be read"
        return f"is damaged: {', '.join(changed)} was changed after it was written" if changed else None

    def write(self, shard: Shard, part: Part, rows: range, cells: int) -> None:
        """Write the part of a shard, whole or not at all; if another process was faster, its part stays.

        Args:
            shard: which.
            part: what it made.
            rows: of which cells.
            cells: of the whole map.

        Raises:
            OSError, SafetensorError: it cannot be written.
        """
        path = self.path(shard)
        if path.exists():
            if self._fault(path) is None:
                return
            shutil.rmtree(path)
        try:
            with new_directory(path) as directory:
                part.save(directory)
                files = file_records(directory)
                manifest = PartManifest(origin=self._origin, rows=(rows.start, rows.stop), cells=cells, files=files)
                (directory / MANIFEST).write_text(manifest.model_dump_json(indent=2) + "\n")
        except OSError:
            if self.fault(shard) is not None:
                raise

    def check(self, count: int) -> None:
        """Pass if so many shards have all left their parts.

        Raises:
            IndexBroken: some are missing, damaged or of another origin; the message names each.
        """
        faults = [(shard.name, self.fault(shard)) for shard in Shard.all(count)]
        named = "; ".join(f"{name} {fault}" for name, fault in faults if fault)
        if named:
            raise IndexBroken(
                f"{self._directory} has not all of {count} parts: {named}; make each with the same options and "
                f"--shard I/{count} in the place of --merge {count}"
            )

    def read(self, count: int, levels: Sequence[Level], cells: CellTable) -> list[Part]:
        """All parts, which were checked, in order.

        Args:
            count: how many.
            levels: of the retriever that made them.
            cells: of the map.

        Raises:
            IndexBroken: one has other cells than its shard.
        """
        for shard in Shard.all(count):
            manifest, rows = _read(self.path(shard)), shard.rows(len(cells), CELLS_PER_BLOCK)
            if (*manifest.rows, manifest.cells) != (rows.start, rows.stop, len(cells)):
                raise IndexBroken(f"{self.path(shard)} has other cells than its shard; delete it and make it again")
        return [Part.load(self.path(shard), levels, cells) for shard in Shard.all(count)]

    def remove(self) -> None:
        """Remove what is no longer needed: the parts, of however many shards; what is being written stays."""
        for path in self._directory.glob("*-of-*"):
            shutil.rmtree(path, ignore_errors=True)
        with suppress(OSError):  # somebody else's parts, or none
            self._directory.rmdir()
            self._root.rmdir()


def _read(path: Path) -> PartManifest:
    return PartManifest.model_validate_json((path / MANIFEST).read_bytes())
