"""The data of shards in an index directory: immutable directories with manifests, kept until they are merged.

<root>/.parts/<origin>/<i>-of-<n>/manifest.json   written last: origin, cells, the sum of every file
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
from index.build.shard_data import ShardData
from models.citymap.cells import CELLS_PER_BLOCK, CellTable
from models.errors import IndexBroken
from models.files import FileRecord, file_records, new_directory, sha256
from models.paper.levels import Level

SHARDS_DIR: Final = ".parts"
FORMAT: Final = 3


class Origin(BaseModel):
    """The origin of a shard's data; shards of the same origin can be merged."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    format: int = FORMAT
    software: str = package_version("hereabouts")
    map_sha256: Sha256  # as `index.build.manifest.fingerprint`
    model_fingerprint: Sha256
    posterior_fingerprint: Sha256  # of the hint posterior
    levels: bool  # whether the retriever's other levels are included

    @property
    def digest(self) -> str:
        """Return a short name for the origin."""
        return hashlib.sha256(self.model_dump_json().encode()).hexdigest()[:16]

    def fault(self, other: "Origin") -> str | None:
        """Return why data of another origin does not fit; None if it is the same."""
        if (other.format, other.software) != (self.format, self.software):
            return f"was made by hereabouts {other.software}, this is {self.software}"
        if other.map_sha256 != self.map_sha256:
            return "was made from another map, split or region"
        if other.model_copy(update={"levels": self.levels}) != self:
            return "was made by another model"
        return None if other == self else f"was made with {'--levels' if other.levels else '--no-levels'}"


class ShardManifest(BaseModel):
    """The manifest of a shard's data."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    origin: Origin
    rows: tuple[int, int]  # the first row of its cells, and the one after the last
    cells: int  # number of cells of the whole map
    files: dict[Name, FileRecord]  # every other file


class ShardStore:
    """The data of all shards of one origin in an index directory."""

    def __init__(self, root: Path, origin: Origin) -> None:
        self._root, self._origin = root / SHARDS_DIR, origin
        self._directory = self._root / origin.digest

    def path(self, shard: Shard) -> Path:
        """Return the directory of a shard's data, which need not exist."""
        return self._directory / shard.name

    def check_writable(self) -> None:
        """Check that the directory is writable, before hours of work, or raise OSError."""
        self._directory.mkdir(parents=True, exist_ok=True)
        with TemporaryFile(dir=self._directory) as file:
            file.write(b"\0")

    def fault(self, shard: Shard) -> str | None:
        """Return what is wrong with the data of a shard, such as "is missing"; None if it is complete."""
        path = self.path(shard)
        if not path.exists():
            others = sorted(self._root.glob(f"*/{shard.name}"))
            known = [f" ({other.relative_to(self._root)} {fault})" for other in others if (fault := self._fault(other))]
            return f"is missing{''.join(known)}"
        return self._fault(path)

    def _fault(self, path: Path) -> str | None:
        try:
            manifest = _read_manifest(path)
            if fault := self._origin.fault(manifest.origin):
                return fault
            changed = [name for name, record in manifest.files.items() if sha256(path / name) != record.sha256]
        except (OSError, ValidationError) as error:
            missing = Path(error.filename).name if isinstance(error, OSError) and error.filename else MANIFEST
            return f"is damaged: {missing} cannot be read"
        return f"is damaged: {', '.join(changed)} was changed after it was written" if changed else None

    def write(self, shard: Shard, part: ShardData, rows: range, cells: int) -> None:
        """Write the data of a shard, completely or not at all; data that another process wrote first stays."""
        path = self.path(shard)
        if path.exists():
            if self._fault(path) is None:
                return
            shutil.rmtree(path)
        try:
            with new_directory(path) as directory:
                part.save(directory)
                files = file_records(directory)
                manifest = ShardManifest(origin=self._origin, rows=(rows.start, rows.stop), cells=cells, files=files)
                (directory / MANIFEST).write_text(manifest.model_dump_json(indent=2) + "\n")
        except OSError:
            if self.fault(shard) is not None:
                raise

    def check(self, count: int) -> None:
        """Raise IndexBroken, with the names of the shards, if data is missing, damaged or of another origin."""
        faults = [(shard.name, self.fault(shard)) for shard in Shard.all(count)]
        named = "; ".join(f"{name} {fault}" for name, fault in faults if fault)
        if named:
            raise IndexBroken(
                f"{self._directory} lacks some of {count} parts: {named}; make each with the same options and "
                f"--shard I/{count} in the place of --merge {count}"
            )

    def read(self, count: int, levels: Sequence[Level], cells: CellTable) -> list[ShardData]:
        """Read the checked data of all shards, in order; IndexBroken if one has other cells than its shard."""
        for shard in Shard.all(count):
            manifest, rows = _read_manifest(self.path(shard)), shard.rows(len(cells), CELLS_PER_BLOCK)
            if (*manifest.rows, manifest.cells) != (rows.start, rows.stop, len(cells)):
                raise IndexBroken(f"{self.path(shard)} has other cells than its shard; delete it and make it again")
        return [ShardData.load(self.path(shard), levels, cells) for shard in Shard.all(count)]

    def remove(self) -> None:
        """Remove the data of all shards of this origin; data that is being written stays."""
        for path in self._directory.glob("*-of-*"):
            shutil.rmtree(path, ignore_errors=True)
        with suppress(OSError):  # not empty, or already removed
            self._directory.rmdir()
            self._root.rmdir()


def _read_manifest(path: Path) -> ShardManifest:
    return ShardManifest.model_validate_json((path / MANIFEST).read_bytes())
