"""An index on disk: immutable version directories, a manifest in each, and an alias that says which one serves.

<root>/aliases.json            {"aliases": {"default": "<version>"}, "versions": {"<version>": "<manifest's sha256>"}}
<root>/<version>/manifest.json written last; names every other file with its sha256
<root>/<version>/vectors.faiss                 a vector a cell; none if they are in Milvus
<root>/<version>/hints.safetensors             what the retriever makes of every template hint about the map
<root>/<version>/levels.starts.npy, levels.<level>.npy   the retriever's other levels, if they were asked for
<root>/<version>/cells.safetensors, cells.json where the cells are and what is in them
<root>/<version>/pieces.safetensors or surroundings.safetensors   what lies around every position
<root>/<version>/statements.safetensors        which cells a statement holds in
<root>/<version>/gazetteer.safetensors         what a passer-by could name
<root>/<version>/names.safetensors, landmarks.safetensors   what it is found by, and what is said of it in each cell
<root>/<version>/meanings.faiss, meanings.json a vector a name or noun of it, to find it by its meaning
<root>/<version>/scenery.<n>.safetensors.gz    what the map looks like
"""

import logging
from collections.abc import Iterable, Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from typing import Final

from filelock import FileLock
from pydantic import BaseModel, ConfigDict, TypeAdapter, ValidationError

from index.build.manifest import ADVICE, MANIFEST, Manifest, Name, Sha256, check_files, check_sums, read_manifest
from index.stores.milvus_store import MilvusStore
from models.errors import IndexBroken, StoreUnavailable
from models.files import replace_file, sha256

ALIASES: Final = "aliases.json"
DEFAULT: Final = "default"  # the alias that is served to who names none
LOCK: Final = ".lock"  # held by whoever changes the aliases

_log = logging.getLogger(__name__)


class Aliases(BaseModel):
    """What an index directory serves under which name.

    Attributes:
        aliases: the version that each names.
        versions: sha256 of the manifest of each version that was registered.
    """

    model_config = ConfigDict(extra="forbid")

    aliases: dict[Name, Name] = {}
    versions: dict[Name, Sha256] = {}


EARLIER: Final = TypeAdapter(dict[Name, Name])


def set_alias(root: Path, alias: str, version: str) -> None:
    """Let an alias name another version, at once for whoever opens it next; the version is registered, if it is not.

    If its vectors are in Milvus, the alias "default" is moved there too, after that: nothing here reads it.

    Raises:
        IndexBroken: the aliases there are cannot be read.
    """
    with _changing(root) as known:
        known.aliases[alias] = version
        known.versions[version] = sha256(root / version / MANIFEST)
    with suppress(IndexBroken):  # whoever opens it says so
        manifest = read_manifest(root / version)
        if alias == DEFAULT and manifest.collection is not None:
            _move_in_milvus(alias, manifest)


def _move_in_milvus(alias: str, manifest: Manifest) -> None:
    try:
        with closing(_store(manifest)) as store:
            store.move_alias(alias)
    except StoreUnavailable as error:
        _log.warning("the alias %s moved to %s, but not in Milvus: %s", alias, manifest.version, error)


def remove_alias(root: Path, alias: str) -> None:
    """Remove an alias; the version that it names stays.

    Raises:
        IndexBroken: there is no such alias, or the aliases cannot be read.
    """
    known = read_aliases(root)
    if alias not in known.aliases:
        raise IndexBroken(f"no alias {alias} in {root}; its aliases are {_listed(known.aliases)}")
    with _changing(root) as known:
        known.aliases.pop(alias, None)


def register(root: Path, version: str) -> Manifest:
    """Register a version that was built elsewhere and copied into an index directory; no alias names it yet.

    Returns:
        Its manifest.

    Raises:
        IndexBroken: it is missing, incomplete or changed; one that is registered stays as it is.
        StoreUnavailable: its vectors are in Milvus, which does not answer.
    """
    if version in read_aliases(root).versions:
        return verify(root / version)
    manifest = read_manifest(root / version)
    check_files(root / version, manifest)
    check_sums(root / version, manifest)
    check_store(manifest)
    with _changing(root) as known:
        known.versions[version] = sha256(root / version / MANIFEST)
    return manifest


@contextmanager
def _changing(root: Path) -> Iterator[Aliases]:
    """Lock the aliases of an index directory, and write them as the block leaves them unless it fails."""
    root.mkdir(parents=True, exist_ok=True)
    with FileLock(root / LOCK):
        known = read_aliases(root)
        yield known
        replace_file(root / ALIASES, (known.model_dump_json(indent=2) + "\n").encode())


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


def find_version(path: Path, alias: str = DEFAULT) -> tuple[Path, Manifest]:
    """Find an index version without reading its files, for the service, which reads them once it is ready.

    Args:
        path: an index directory, or one version of it.
        alias: what to find in an index directory.

    Returns:
        The version's directory and its manifest, which is what was registered; every file is there, and as long as it
        was.

    Raises:
        IndexBroken: it is missing or incomplete, or its manifest was changed.
    """
    directory = path if (path / MANIFEST).is_file() else _named(path, alias)
    known = read_aliases(directory.parent).versions
    manifest = read_manifest(directory, known.get(directory.name))
    check_files(directory, manifest)
    return directory, manifest


def open_version(path: Path, alias: str = DEFAULT) -> tuple[Path, Manifest]:
    """Find and read an index version: for whatever answers once and ends, and could not take a wrong answer back.

    Args:
        path: as `find_version`.
        alias: as there.

    Returns:
        The version's directory and its manifest; every file is there and unchanged.

    Raises:
        IndexBroken: it is missing, incomplete or changed.
    """
    directory, manifest = find_version(path, alias)
    check_sums(directory, manifest)
    return directory, manifest


def _named(root: Path, alias: str) -> Path:
    """The version's directory that an alias names."""
    aliases = read_aliases(root).aliases
    if alias not in aliases:
        there = f"; its aliases are {_listed(aliases)}" if aliases else ""
        raise IndexBroken(f"no index {'' if alias == DEFAULT else alias + ' '}in {root}{there}; {ADVICE}")
    return root / aliases[alias]


def _listed(names: Iterable[str]) -> str:
    return ", ".join(sorted(names)) or "none"


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
