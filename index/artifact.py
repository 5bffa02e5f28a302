"""An index on disk: immutable version directories, a manifest in each, and an alias that says which one serves.

<root>/aliases.json            {"aliases": {"default": "<version>"}, "versions": {"<version>": "<manifest's sha256>"}}
<root>/<version>/manifest.json written last; names every other file with its sha256
<root>/<version>/vectors.faiss                 a vector a cell; none if they are in Milvus
<root>/<version>/hints.safetensors             what the retriever makes of every template hint about the map
<root>/<version>/levels.starts.npy, levels.<level>.npy   the retriever's other levels, if they were asked for
<root>/<version>/cells.safetensors, cells.json where the cells are and what is in them
<root>/<version>/pieces.safetensors or surroundings.safetensors   what lies around every position
<root>/<version>/statements.safetensors        which cells a statement holds in
<root>/<version>/gazetteer.safetensors, gazetteer.json   what a passer-by could name
<root>/<version>/meanings.faiss, meanings.json a vector a name or noun of it, to find it by its meaning
<root>/<version>/scenery.<n>.safetensors.gz    what the map looks like
"""

import hashlib
import logging
from contextlib import closing, suppress
from datetime import UTC, datetime
from importlib.metadata import version as package_version
from pathlib import Path
from typing import Annotated, Final, Literal, Self

from filelock import FileLock
from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    PositiveFloat,
    PositiveInt,
    StringConstraints,
    TypeAdapter,
    ValidationError,
    model_validator,
)

from index.stores.milvus_store import MilvusStore
from models.city.kitti360pose.files import list_scenes, select_scenes
from models.city.store.files import MANIFEST as STORE_MANIFEST
from models.errors import IndexBroken, IndexMismatch, StoreUnavailable
from models.files import FileRecord, replace_file, sha256

MANIFEST: Final = "manifest.json"
ALIASES: Final = "aliases.json"
DEFAULT: Final = "default"  # the alias that is served to who names none
FORMAT: Final = 8
ADVICE: Final = "build it with 'hereabouts index --map MAP --out DIR'"
LOCK: Final = ".lock"  # held by whoever changes the aliases
NEEDED: Final = frozenset({"vectors.faiss", "hints.safetensors", "cells.safetensors", "cells.json", "gazetteer.json"})

_log = logging.getLogger(__name__)

NAME: Final = r"^[A-Za-z0-9][A-Za-z0-9._-]{0,127}$"  # of an alias, version or file
Name = Annotated[str, StringConstraints(pattern=NAME)]
StoreName = Literal["faiss", "milvus"]
Sha256 = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]


class Aliases(BaseModel):
    """What an index directory serves under which name.

    Attributes:
        aliases: the version that each names.
        versions: sha256 of the manifest of each version that was registered.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    aliases: dict[Name, Name] = {}
    versions: dict[Name, Sha256] = {}


EARLIER: Final = TypeAdapter(dict[Name, Name])


class FrameRecord(BaseModel):
    """The map's frame; see models.city.frame.Frame."""

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


def set_alias(root: Path, alias: str, version: str) -> None:
    """Let an alias name another version, at once for whoever opens it next; the version is registered, if it is not.

    If its vectors are in Milvus, the alias "default" is moved there too, after that: nothing here reads it.

    Raises:
        IndexBroken: the aliases there are cannot be read.
    """
    _change(root, aliases={alias: version}, versions={version: sha256(root / version / MANIFEST)})
    with suppress(IndexBroken):  # whoever opens it says so
        manifest = _read_manifest(root / version)
        if alias == DEFAULT and manifest.collection is not None:
            _move_in_milvus(alias, manifest)


def _move_in_milvus(alias: str, manifest: Manifest) -> None:
    try:
        with closing(_store(manifest)) as store:
            store.move_alias(alias)
    except StoreUnavailable as error:
        _log.warning("the alias %s moved to %s, but not in Milvus: %s", alias, manifest.version, error)


def register(root: Path, version: str) -> Manifest:
    """Take a version that was built elsewhere and copied into an index directory; no alias names it yet.

    Returns:
        Its manifest.

    Raises:
        IndexBroken: it is missing, incomplete or changed; one that is registered stays as it is.
        StoreUnavailable: its vectors are in Milvus, which does not answer.
    """
    if version in read_aliases(root).versions:
        return verify(root / version)
    manifest = _read_manifest(root / version)
    check_files(root / version, manifest)
    check_store(manifest)
    _change(root, aliases={}, versions={version: sha256(root / version / MANIFEST)})
    return manifest


def _change(root: Path, aliases: dict[str, str], versions: dict[str, str]) -> None:
    root.mkdir(parents=True, exist_ok=True)
    with FileLock(root / LOCK):
        known = read_aliases(root)
        changed = Aliases(aliases=known.aliases | aliases, versions=known.versions | versions)
        replace_file(root / ALIASES, (changed.model_dump_json(indent=2) + "\n").encode())


def read_aliases(root: Path) -> Aliases:
    """The aliases and versions of an index directory; none if there is no such file.

    Raises:
        IndexBroken: the file is broken, or cannot be read.
    """
    try:
        content = (root / ALIASES).read_bytes()
        with suppress(ValidationError):  # up to format 6, an object of aliases alone; their versions are built anew
            return Aliases(aliases=EARLIER.validate_json(content))
        return Aliases.model_validate_json(content)
    except FileNotFoundError:
        return Aliases()
    except (OSError, ValidationError) as error:
        advice = f"delete {root} and {ADVICE}"
        raise IndexBroken(f"{root / ALIASES} is broken or of another version of hereabouts; {advice}") from error


def open_version(path: Path, alias: str = DEFAULT) -> tuple[Path, Manifest]:
    """Find and check an index version.

    Args:
        path: an index directory, or one version of it.
        alias: what to open of an index directory.

    Returns:
        The version's directory and its manifest; every file is there and unchanged.

    Raises:
        IndexBroken: it is missing, incomplete or changed.
    """
    directory = path if (path / MANIFEST).is_file() else _named(path, alias)
    known = read_aliases(directory.parent).versions
    manifest = _read_manifest(directory, known.get(directory.name))
    check_files(directory, manifest)
    return directory, manifest


def _named(root: Path, alias: str) -> Path:
    """The version's directory that an alias names."""
    aliases = read_aliases(root).aliases
    if alias not in aliases:
        there = f"; its aliases are {', '.join(sorted(aliases))}" if aliases else ""
        raise IndexBroken(f"no index {'' if alias == DEFAULT else alias + ' '}in {root}{there}; {ADVICE}")
    return root / aliases[alias]


def _read_manifest(directory: Path, expected: str | None = None) -> Manifest:
    """A version's manifest, if it is what was registered (its sha256)."""
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
    """Compare a version's files with its manifest.

    Raises:
        IndexBroken: one is missing, incomplete or changed.
    """
    for name, record in manifest.files.items():
        file = directory / name
        if not file.is_file() or file.stat().st_size != record.bytes:
            raise IndexBroken(f"{file} is missing or cut short; {ADVICE}")
        if sha256(file) != record.sha256:
            raise IndexBroken(f"{file} was changed after it was written; {ADVICE}")


def check_store(manifest: Manifest) -> None:
    """Ask Milvus, if a version's vectors are there, whether it has all of them.

    Raises:
        IndexBroken: the collection is missing, or has another number of rows.
        StoreUnavailable: Milvus does not answer.
    """
    if manifest.collection is not None:
        with closing(_store(manifest)) as store:
            store.check()


def _store(manifest: Manifest) -> MilvusStore:
    assert manifest.collection is not None
    return MilvusStore(manifest.collection, manifest.dim, manifest.cells)


def verify(directory: Path) -> Manifest:
    """The manifest of a registered version, of which every file and, in Milvus, every row is there.

    Raises:
        IndexBroken, StoreUnavailable: as `open_version` and `check_store`.
    """
    manifest = open_version(directory)[1]
    check_store(manifest)
    return manifest


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
