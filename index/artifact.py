"""An index on disk: immutable version directories, a manifest in each, and an alias that says which one serves.

<root>/aliases.json            {"default": "<version>"}
<root>/<version>/manifest.json written last; names every other file with its sha256
<root>/<version>/vectors.faiss                 a vector a cell
<root>/<version>/hints.safetensors             what the retriever makes of every template hint about the map
<root>/<version>/levels.starts.npy, levels.<level>.npy   the retriever's other levels, if they were asked for
<root>/<version>/cells.safetensors, cells.json where the cells are and what is in them
<root>/<version>/surroundings.safetensors      what lies around every position
<root>/<version>/gazetteer.safetensors, gazetteer.json   what a passer-by could name
<root>/<version>/meanings.faiss, meanings.json a vector a name or noun of it, to find it by its meaning
<root>/<version>/scenery.<n>.safetensors.gz    what the map looks like
"""

import hashlib
import json
from datetime import UTC, datetime
from importlib.metadata import version as package_version
from pathlib import Path

from pydantic import BaseModel, ConfigDict, ValidationError

from models.city.kitti360pose.files import list_scenes, select_scenes
from models.city.store.files import MANIFEST as STORE_MANIFEST
from models.errors import IndexBroken, IndexMismatch
from models.files import FileRecord, replace_file, sha256

MANIFEST = "manifest.json"
ALIASES = "aliases.json"
FORMAT = 6
ADVICE = "build it with 'hereabouts index --map MAP --out DIR'"


class FrameRecord(BaseModel):
    """The map's frame; see models.city.frame.Frame."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    frame_id: str
    origin_lat: float | None
    origin_lon: float | None
    epsg: int | None


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
        files: every other file.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    format: int = FORMAT
    version: str
    created: str
    software: str
    map_name: str
    map_sha256: str
    attribution: str
    frame: FrameRecord
    palette: str
    cell_size_m: float
    grid_m: float
    model: str
    model_fingerprint: str
    dim: int
    metric: str = "inner_product"
    cells: int
    instances: int
    files: dict[str, FileRecord]


def fingerprint(data: Path, split: str | None = None) -> str:
    """sha256 of what a map is read from.

    Raises:
        DataError: there is nothing to read.
    """
    if data.is_file():
        files = [data]
    elif (data / STORE_MANIFEST).is_file():
        files = [data / STORE_MANIFEST]  # has the sums of all others
    else:
        files = [data / "cells" / f"{s}.pkl" for s in select_scenes(list_scenes(data), split, data / "cells")]
    parts = [f"{split}", *(f"{path.name} {sha256(path)}" for path in files)]
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
    """Let an alias name another version, at once for whoever opens it next."""
    aliases = read_aliases(root) | {alias: version}
    replace_file(root / ALIASES, (json.dumps(aliases, indent=2) + "\n").encode())


def read_aliases(root: Path) -> dict[str, str]:
    """The aliases of an index directory; none if there is no such file."""
    try:
        aliases = json.loads((root / ALIASES).read_text())
        return {str(alias): str(version) for alias, version in aliases.items()}
    except FileNotFoundError:
        return {}
    except (ValueError, AttributeError) as error:
        raise IndexBroken(f"{root / ALIASES} cannot be read; delete {root} and {ADVICE}") from error


def open_version(path: Path) -> tuple[Path, Manifest]:
    """Find and check an index version.

    Args:
        path: an index directory (its alias "default" is opened), or one version of it.

    Returns:
        The version's directory and its manifest; every file is there and unchanged.

    Raises:
        IndexBroken: it is missing, incomplete or changed.
    """
    directory = path if (path / MANIFEST).is_file() else path / read_aliases(path).get("default", "")
    if not (directory / MANIFEST).is_file():
        raise IndexBroken(f"no index in {path}; {ADVICE}")
    try:
        manifest = Manifest.model_validate_json((directory / MANIFEST).read_bytes())
    except ValidationError as error:
        raise IndexBroken(f"{directory / MANIFEST} is broken or of another version of hereabouts; {ADVICE}") from error
    if manifest.format != FORMAT:
        raise IndexBroken(f"{directory} has format {manifest.format}, this hereabouts reads {FORMAT}; {ADVICE}")
    for name, record in manifest.files.items():
        file = directory / Path(name).name
        if not file.is_file() or file.stat().st_size != record.bytes:
            raise IndexBroken(f"{file} is missing or cut short; {ADVICE}")
        if sha256(file) != record.sha256:
            raise IndexBroken(f"{file} was changed after it was written; {ADVICE}")
    return directory, manifest


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
