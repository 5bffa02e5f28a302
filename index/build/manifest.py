"""What an index version says of itself, and whether it is true: its manifest, written last."""

import hashlib
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

from models.errors import DataError, IndexBroken, IndexMismatch
from models.files import FileRecord, sha256
from models.sources.kitti360pose.files import list_scenes, select_scenes
from models.sources.store.layout import MANIFEST as STORE_MANIFEST

MANIFEST: Final = "manifest.json"
FORMAT: Final = 10
ADVICE: Final = "build it with 'hereabouts index --map MAP --out DIR'"
NEEDED: Final = frozenset(
    {"vectors.faiss", "hints.safetensors", "cells.safetensors", "cells.json", "gazetteer.safetensors"}
)

NAME: Final = r"^[A-Za-z0-9][A-Za-z0-9._-]{0,127}$"  # of an alias, version or file
Name = Annotated[str, StringConstraints(pattern=NAME)]
StoreName = Literal["faiss", "milvus"]
Sha256 = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]


class FrameRecord(BaseModel):
    """The map's frame; see models.citymap.frame.Frame."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    frame_id: str = Field(min_length=1)
    origin_lat: float | None = Field(ge=-90, le=90)
    origin_lon: float | None = Field(ge=-180, le=180)
    epsg: PositiveInt | None


class Manifest(BaseModel):
    """What an index version holds and what made it.

    Attributes:
        format: of the directory.
        version: name of the directory.
        created: UTC, ISO 8601.
        software: version of hereabouts.
        map_name, map_sha256, attribution: of the source; the sha256 is of the map's file.
        frame, palette, cell_size_m, grid_m: of the city map and its cells.
        model: what the retriever's text encoder is and how wide its vectors are.
        model_fingerprint: sha256 of all its weights.
        dim, metric, cells, instances: of the vectors.
        store, collection: where the vectors are: in a file, or in Milvus, in this collection.
        files: every other file.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    format: int = FORMAT
    version: Name
    created: Annotated[str, StringConstraints(pattern=r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\+00:00$")]
    software: str
    map_name: str
    map_sha256: Sha256
    attribution: str
    frame: FrameRecord
    palette: Literal["basic", "kitti360"]
    cell_size_m: PositiveFloat
    grid_m: PositiveFloat
    model: str
    model_fingerprint: Sha256
    dim: PositiveInt
    metric: Literal["inner_product"] = "inner_product"
    cells: PositiveInt
    instances: PositiveInt
    store: StoreName = "faiss"
    collection: Annotated[str, StringConstraints(pattern=r"^[A-Za-z_][A-Za-z0-9_]{0,254}$")] | None = None
    files: dict[Name, FileRecord]

    @model_validator(mode="after")
    def _store_is_named(self) -> Self:
        if (self.store == "milvus") != (self.collection is not None):
            raise ValueError("collection belongs to store milvus, and to no other")
        return self


class FormatOnly(BaseModel):
    """What is read of a manifest first, whatever else is in it."""

    format: int


def fingerprint(data: Path, split: str | None = None, region: str | None = None) -> str:
    """sha256 of what a map is read from; of a part of it, with what says which.

    Raises:
        DataError: there is nothing to read.
    """
    if not data.exists():
        raise DataError(f"{data}: no such file or directory; give the path of a map")
    if data.is_file():
        files = [data]
    elif (data / STORE_MANIFEST).is_file():
        files = [data / STORE_MANIFEST]  # has the sums of all others
    else:
        files = [data / "cells" / f"{s}.pkl" for s in select_scenes(list_scenes(data), split, data / "cells")]
    parts = [f"{split}", *([region] if region else []), *(f"{path.name} {sha256(path)}" for path in files)]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def new_version(map_sha256: str, model_fingerprint: str) -> dict[str, str]:
    """The manifest's fields that name a version and its origin."""
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
    """Read the manifest of a version.

    Args:
        directory: of the version.
        expected: the manifest's sha256, if the version is registered.

    Raises:
        IndexBroken: it is missing, not what was registered, or says what no manifest says.
    """
    path = directory / MANIFEST
    try:
        content = path.read_bytes()
        given = FormatOnly.model_validate_json(content).format
    except OSError as error:
        raise IndexBroken(f"{path} is missing; {ADVICE}") from error
    except ValidationError as error:
        raise IndexBroken(f"{path} is broken; {ADVICE}") from error
    if given != FORMAT:
        raise IndexBroken(f"{directory} has format {given}, this hereabouts reads {FORMAT}; {ADVICE}")
    if expected is not None and hashlib.sha256(content).hexdigest() != expected:
        raise IndexBroken(f"{path} was changed after it was written; {ADVICE}")
    try:
        manifest = Manifest.model_validate_json(content)
    except ValidationError as error:
        wrong = error.errors()[0]
        field = ".".join(map(str, wrong["loc"])) or "manifest"
        raise IndexBroken(f"{path} is broken: {field}: {wrong['msg']}; {ADVICE}") from error
    if manifest.version != directory.name:
        raise IndexBroken(f"{path} is of version {manifest.version}; give its directory that name, or {ADVICE}")
    needed = NEEDED - {"vectors.faiss"} if manifest.store == "milvus" else NEEDED
    if missing := needed - set(manifest.files):
        raise IndexBroken(f"{path} names no {', '.join(sorted(missing))}; {ADVICE}")
    return manifest


def check_files(directory: Path, manifest: Manifest) -> None:
    """Look whether a version's files are there, as long as its manifest says; takes no time.

    Raises:
        IndexBroken: one is missing or incomplete.
    """
    for name, record in manifest.files.items():
        file = directory / name
        if not file.is_file() or file.stat().st_size != record.bytes:
            raise IndexBroken(f"{file} is missing or cut short; {ADVICE}")


def check_sums(directory: Path, manifest: Manifest) -> None:
    """Read a version's files, which are there, and compare their sums with its manifest; takes a second a gigabyte.

    Raises:
        IndexBroken: one was changed, or the disk does not give it.
    """
    for name, record in manifest.files.items():
        file = directory / name
        try:
            is_whole = sha256(file) == record.sha256
        except OSError as error:
            raise IndexBroken(f"{file} cannot be read ({error.strerror}); see to its disk, or {ADVICE}") from error
        if not is_whole:
            raise IndexBroken(f"{file} was changed after it was written; {ADVICE}")


def check_model(manifest: Manifest, fingerprint: str) -> None:
    """Refuse an index that another model built.

    Raises:
        IndexMismatch: the weights differ, however alike the models are.
    """
    if manifest.model_fingerprint != fingerprint:
        raise IndexMismatch(
            f"index {manifest.version} was built by model {manifest.model_fingerprint[:12]}, "
            f"the loaded model is {fingerprint[:12]}; rebuild the index with this model"
        )
