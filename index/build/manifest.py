"""The manifest of an index version, written last, and the checks against it."""

import hashlib
from collections.abc import Sequence
from datetime import UTC, datetime
from importlib.metadata import version as package_version
from pathlib import Path
from typing import Annotated, Final, Literal, Self

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    PositiveFloat,
    PositiveInt,
    StringConstraints,
    ValidationError,
    model_validator,
)

from models.citymap.summary import MapSummary
from models.errors import DataError, IndexBroken, IndexMismatch
from models.files import FileRecord, sha256
from models.sources.kitti360pose.files import list_scenes, select_scenes
from models.sources.store.layout import MANIFEST as STORE_MANIFEST

MANIFEST: Final = "manifest.json"
FORMAT: Final = 13
ADVICE: Final = "build it with 'hereabouts index --map MAP --out DIR'"
REQUIRED_FILES: Final = frozenset(
    {"vectors.faiss", "hints.safetensors", "cells.safetensors", "cells.json", "gazetteer.safetensors"}
)

NAME_PATTERN: Final = r"^[A-Za-z0-9][A-Za-z0-9._-]{0,127}$"  # of aliases, versions and files
Name = Annotated[str, StringConstraints(pattern=NAME_PATTERN)]
StoreName = Literal["faiss", "milvus"]
Sha256 = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]


class FrameRecord(BaseModel):
    """The map's frame, as models.citymap.frame.Frame."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    frame_id: str = Field(min_length=1)
    origin_lat: float | None = Field(ge=-90, le=90)
    origin_lon: float | None = Field(ge=-180, le=180)
    epsg: PositiveInt | None


class Manifest(BaseModel):
    """The content and origin of an index version."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    format: int = FORMAT
    version: Name
    created: Annotated[str, StringConstraints(pattern=r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\+00:00$")]  # UTC, ISO 8601
    software: str  # the version of hereabouts
    map_name: str
    map_sha256: Sha256
    attribution: str
    frame: FrameRecord
    palette: Literal["basic", "kitti360"]
    cell_size_m: PositiveFloat
    grid_m: PositiveFloat
    model: str  # the retriever's name, with its text encoder and width
    model_fingerprint: Sha256  # sha256 of all weights of the retriever
    dim: PositiveInt
    metric: Literal["inner_product"] = "inner_product"
    cells: PositiveInt
    instances: PositiveInt
    store: StoreName = "faiss"
    collection: Annotated[str, StringConstraints(pattern=r"^[A-Za-z_][A-Za-z0-9_]{0,254}$")] | None = None
    summary: MapSummary | None = None  # None for a data set
    files: dict[Name, FileRecord]

    @model_validator(mode="after")
    def _store_is_named(self) -> Self:
        if (self.store == "milvus") != (self.collection is not None):
            raise ValueError("collection must be given with store milvus, and with no other store")
        return self


class FormatOnly(BaseModel):
    """The format number, read before the rest of a manifest."""

    format: int


def fingerprint(data: Path, split: str | None = None, region: str | None = None, extras: Sequence[str] = ()) -> str:
    """Return the sha256 of a map's files, its split, its region and its extra data; DataError without such a path."""
    if not data.exists():
        raise DataError(f"{data}: no such file or directory; give the path of a map")
    if data.is_file():
        files = [data]
    elif (data / STORE_MANIFEST).is_file():
        files = [data / STORE_MANIFEST]  # contains the sums of all other files
    else:
        files = [data / "cells" / f"{s}.pkl" for s in select_scenes(list_scenes(data), split, data / "cells")]
    parts = [f"{split}", *([region] if region else []), *extras, *(f"{path.name} {sha256(path)}" for path in files)]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def new_version(map_sha256: str, model_fingerprint: str) -> dict[str, str]:
    """Return the manifest's fields that name a new version and its origin."""
    now = datetime.now(UTC)
    digest = hashlib.sha256((map_sha256 + model_fingerprint).encode()).hexdigest()
    return {
        "version": f"{now:%Y%m%dT%H%M%S%f}-{digest[:8]}",
        "created": now.isoformat(timespec="seconds"),
        "software": package_version("hereabouts"),
        "map_sha256": map_sha256,
        "model_fingerprint": model_fingerprint,
    }


def write_manifest(directory: Path, manifest: Manifest) -> None:
    """Write a version's manifest, its last file."""
    (directory / MANIFEST).write_text(manifest.model_dump_json(indent=2) + "\n")


def read_manifest(directory: Path, expected: str | None = None) -> Manifest:
    """Read the manifest of a version; IndexBroken if it is missing, invalid, or has another sha256 than `expected`."""
    path = directory / MANIFEST
    try:
        content = path.read_bytes()
        format_number = FormatOnly.model_validate_json(content).format
    except OSError as error:
        raise IndexBroken(f"{path} is missing; {ADVICE}") from error
    except ValidationError as error:
        raise IndexBroken(f"{path} is broken; {ADVICE}") from error
    if format_number != FORMAT:
        raise IndexBroken(f"{directory} has format {format_number}, this hereabouts reads {FORMAT}; {ADVICE}")
    if expected is not None and hashlib.sha256(content).hexdigest() != expected:
        raise IndexBroken(f"{path} was changed after it was written; {ADVICE}")
    try:
        manifest = Manifest.model_validate_json(content)
    except ValidationError as error:
        wrong = error.errors()[0]
        field = ".".join(map(str, wrong["loc"])) or "manifest"
        raise IndexBroken(f"{path} is broken: {field}: {wrong['msg']}; {ADVICE}") from error
    if manifest.version != directory.name:
        raise IndexBroken(f"{path} belongs to version {manifest.version}; rename its directory to that, or {ADVICE}")
    needed = REQUIRED_FILES - {"vectors.faiss"} if manifest.store == "milvus" else REQUIRED_FILES
    if missing := needed - set(manifest.files):
        raise IndexBroken(f"{path} names no {', '.join(sorted(missing))}; {ADVICE}")
    return manifest


def check_files(directory: Path, manifest: Manifest) -> None:
    """Check that a version's files have the recorded sizes, which takes no time; or raise IndexBroken."""
    for name, record in manifest.files.items():
        file = directory / name
        if not file.is_file() or file.stat().st_size != record.bytes:
            raise IndexBroken(f"{file} is missing or cut short; {ADVICE}")


def check_sums(directory: Path, manifest: Manifest) -> None:
    """Compare the sha256 of a version's files with its manifest, a gigabyte per second; or raise IndexBroken."""
    for name, record in manifest.files.items():
        file = directory / name
        try:
            is_intact = sha256(file) == record.sha256
        except OSError as error:
            raise IndexBroken(f"{file} cannot be read ({error.strerror}); check its disk, or {ADVICE}") from error
        if not is_intact:
            raise IndexBroken(f"{file} was changed after it was written; {ADVICE}")


def check_model(manifest: Manifest, fingerprint: str) -> None:
    """Raise IndexMismatch if another model built the index."""
    if manifest.model_fingerprint != fingerprint:
        raise IndexMismatch(
            f"index {manifest.version} was built by model {manifest.model_fingerprint[:12]}, "
            f"the loaded model is {fingerprint[:12]}; rebuild the index with this model"
        )
