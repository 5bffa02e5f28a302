"""An index directory: immutable versions with a manifest each, and aliases that name the versions to serve.

<root>/aliases.json            {"aliases": {"default": "<version>"}, "versions": {"<version>": "<manifest's sha256>"}}
<root>/<version>/manifest.json written last; names every other file with its sha256
<root>/<version>/vectors.faiss                 one vector per cell; absent if they are in Milvus
<root>/<version>/hints.safetensors             the retriever's vectors of every template hint about the map
<root>/<version>/levels.safetensors            the retriever's other levels, unless built with --no-levels
<root>/<version>/cells.safetensors, cells.json the cells and their content
<root>/<version>/pieces.safetensors or surroundings.safetensors   the instances near each position
<root>/<version>/statements.safetensors        the inverted list: the cells in which a statement holds
<root>/<version>/gazetteer.safetensors         named objects, streets and corners
<root>/<version>/names.safetensors, landmarks.safetensors   the name table, and the names visible from each cell
<root>/<version>/meanings.faiss, meanings.json one vector per name or noun, for paraphrases
<root>/<version>/scenery.<n>.safetensors.gz    the drawing of the map for the page
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

ALIASES_FILE: Final = "aliases.json"
DEFAULT_ALIAS: Final = "default"  # used when a request names no index
LOCK_FILE: Final = ".lock"  # locked while the alias file is edited

_log = logging.getLogger(__name__)


class Aliases(BaseModel):
    """The content of the alias file."""

    model_config = ConfigDict(extra="forbid")

    aliases: dict[Name, Name] = {}  # version by alias
    versions: dict[Name, Sha256] = {}  # sha256 of the manifest, by registered version


OLD_ALIASES: Final = TypeAdapter(dict[Name, Name])


def set_alias(root: Path, alias: str, version: str) -> None:
    """Point an alias to a version, and register the version if needed; IndexBroken if the alias file is broken.

    Running services follow the alias file. If the vectors are in Milvus, the alias "default" is also moved there, for
    people who look into Milvus; nothing here reads that alias.
    """
    with _edit_aliases(root) as known:
        known.aliases[alias] = version
        known.versions[version] = sha256(root / version / MANIFEST)
    with suppress(IndexBroken):  # reported when the version is opened
        manifest = read_manifest(root / version)
        if alias == DEFAULT_ALIAS and manifest.collection is not None:
            _move_in_milvus(alias, manifest)


def _move_in_milvus(alias: str, manifest: Manifest) -> None:
    try:
        with closing(_milvus_store(manifest)) as store:
            store.move_alias(alias)
    except StoreUnavailable as error:
        _log.warning("alias %s now names %s, but could not be moved in Milvus: %s", alias, manifest.version, error)


def remove_alias(root: Path, alias: str) -> None:
    """Remove an alias and keep the version it names; IndexBroken if there is no such alias."""
    known = read_aliases(root)
    if alias not in known.aliases:
        raise IndexBroken(f"no alias {alias} in {root}; its aliases are {_join_names(known.aliases)}")
    with _edit_aliases(root) as known:
        known.aliases.pop(alias, None)


def register(root: Path, version: str) -> Manifest:
    """Check and register a version that was copied into the index directory, without an alias; return its manifest."""
    if version in read_aliases(root).versions:
        return verify(root / version)
    manifest = read_manifest(root / version)
    check_files(root / version, manifest)
    check_sums(root / version, manifest)
    check_store(manifest)
    with _edit_aliases(root) as known:
        known.versions[version] = sha256(root / version / MANIFEST)
    return manifest


@contextmanager
def _edit_aliases(root: Path) -> Iterator[Aliases]:
    root.mkdir(parents=True, exist_ok=True)
    with FileLock(root / LOCK_FILE):
        known = read_aliases(root)
        yield known
        replace_file(root / ALIASES_FILE, (known.model_dump_json(indent=2) + "\n").encode())


def read_aliases(root: Path) -> Aliases:
    """Return the aliases and registered versions of an index directory; IndexBroken if they cannot be read."""
    try:
        content = (root / ALIASES_FILE).read_bytes()
        with suppress(ValidationError):  # up to format 6 the file held aliases alone
            return Aliases(aliases=OLD_ALIASES.validate_json(content))
        return Aliases.model_validate_json(content)
    except FileNotFoundError:
        return Aliases()
    except (OSError, ValidationError) as error:
        advice = f"delete {root} and {ADVICE}"
        raise IndexBroken(f"{root / ALIASES_FILE} is broken or of another version of hereabouts; {advice}") from error


def list_versions(root: Path) -> list[str]:
    """Return the names of the versions in an index directory, sorted."""
    return sorted(path.parent.name for path in root.glob(f"[!.]*/{MANIFEST}"))


def find_version(path: Path, alias: str = DEFAULT_ALIAS) -> tuple[Path, Manifest]:
    """Return the directory and manifest of an index version, given as its path or by an index directory and an alias.

    Only the manifest and the sizes of the files are checked. Raise IndexBroken if the version is missing, incomplete or
    its manifest was changed.
    """
    directory = path if (path / MANIFEST).is_file() else _version_directory(path, alias)
    known = read_aliases(directory.parent).versions
    manifest = read_manifest(directory, known.get(directory.name))
    check_files(directory, manifest)
    return directory, manifest


def open_version(path: Path, alias: str = DEFAULT_ALIAS) -> tuple[Path, Manifest]:
    """Do as `find_version`, and check the sums of all files too."""
    directory, manifest = find_version(path, alias)
    check_sums(directory, manifest)
    return directory, manifest


def _version_directory(root: Path, alias: str) -> Path:
    aliases = read_aliases(root).aliases
    if alias not in aliases:
        there = f"; its aliases are {_join_names(aliases)}" if aliases else ""
        raise IndexBroken(f"no index {'' if alias == DEFAULT_ALIAS else alias + ' '}in {root}{there}; {ADVICE}")
    return root / aliases[alias]


def _join_names(names: Iterable[str]) -> str:
    return ", ".join(sorted(names)) or "none"


def check_store(manifest: Manifest) -> None:
    """Raise IndexBroken or StoreUnavailable if a version's vectors are in Milvus, but not all of them."""
    if manifest.collection is not None:
        with closing(_milvus_store(manifest)) as store:
            store.check()


def _milvus_store(manifest: Manifest) -> MilvusStore:
    assert manifest.collection is not None
    return MilvusStore(manifest.collection, manifest.dim, manifest.cells)


def verify(directory: Path) -> Manifest:
    """Check every file of a version, and its rows in Milvus, and return its manifest."""
    manifest = open_version(directory)[1]
    check_store(manifest)
    return manifest
