"""The index versions of the service's directory, and which of them each name serves; for operators."""

import asyncio
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import structlog
from fastapi import APIRouter
from fastapi import Path as InPath
from pydantic import BaseModel, Field

from app.http.bodies import REFUSALS
from app.http.dependencies import AllIndexes, SettingsNow
from app.http.errors import Code, Problem
from app.http.openapi import problems
from app.http.schemas.requests import Body
from app.settings import Settings
from index.build.artifact import read_aliases, register, set_alias
from index.build.artifact import verify as verify_version
from index.build.manifest import MANIFEST, NAME, Name
from index.build.snapshot import SNAPSHOTS, snapshot
from models.errors import IndexBroken

ERRORS = (
    *REFUSALS,
    Code.INVALID_REQUEST,
    Code.ADMIN_OFF,
    Code.ADMIN_KEY_REQUIRED,
    Code.VERSION_NOT_FOUND,
    Code.INDEX_BROKEN,
    Code.STORE_UNAVAILABLE,
)
log = structlog.get_logger()
router = APIRouter(tags=["indexes"])
Version = Annotated[str, InPath(pattern=NAME)]


class VersionInfo(BaseModel):
    """A version of an index."""

    version: str
    registered: bool = Field(description="whether it may be served; else POST /indexes takes it")
    aliases: list[str] = Field(description="names that serve it now")


class IndexesResponse(BaseModel):
    """All versions of the service's directory."""

    aliases: dict[str, str] = Field(description="the version that answers for each name")
    versions: list[VersionInfo]


class Registration(Body):
    """A version that was built elsewhere and copied into the service's index directory."""

    version: Name


class Nothing(Body):
    """{}: a body, so that no page of another site can send it unasked."""


class AliasChange(Body):
    """A name, and the version that it is to serve."""

    alias: Name
    version: Name


class Verified(BaseModel):
    """A version whose files are what its manifest says, all of them."""

    version: str
    files: int
    bytes: int


class Snapshot(BaseModel):
    """A version in one file."""

    version: str
    file: str = Field(description="in the service's index directory")
    bytes: int
    sha256: str


@router.get("/indexes", responses=problems(Code.INDEX_BROKEN))
def list_indexes(indexes: AllIndexes, settings: SettingsNow) -> IndexesResponse:
    """The versions there are, and the names that serve them."""
    known = _registered(settings.index_dir)
    served = indexes.versions()
    directories = {path.parent.name for path in settings.index_dir.glob(f"[!.]*/{MANIFEST}")}
    return IndexesResponse(
        aliases=served,
        versions=[
            VersionInfo(
                version=version,
                registered=version in known,
                aliases=sorted(alias for alias, named in served.items() if named == version),
            )
            for version in sorted(directories | set(known))
        ],
    )


@router.post("/indexes", status_code=201, responses=problems(*ERRORS, Code.NOT_WRITABLE))
def register_index(asked: Registration, settings: SettingsNow) -> Verified:
    """Take a version that lies in the service's directory, once it is whole; no name serves it yet."""
    return _verified(settings, asked.version, takes_it=True)


@router.post(
    "/indexes/aliases",
    responses=problems(*ERRORS, Code.NOT_WRITABLE, Code.INDEX_MISMATCH, Code.DRAINING, Code.LOAD_FAILED),
)
async def change_alias(asked: AliasChange, indexes: AllIndexes, settings: SettingsNow) -> IndexesResponse:
    """Let a name serve another version: it is opened first, no request is dropped, each is answered by one version."""
    await asyncio.to_thread(_verified, settings, asked.version)
    with _writing(settings):
        keep = asyncio.to_thread(set_alias, settings.index_dir, asked.alias, asked.version)
        await indexes.switch(asked.alias, asked.version, keep)
    return await asyncio.to_thread(list_indexes, indexes, settings)


@router.post("/indexes/{version}/verify", responses=problems(*ERRORS))
def verify(version: Version, _body: Nothing, settings: SettingsNow) -> Verified:
    """Read every file of a version again, and compare it with its manifest; rows in Milvus are counted."""
    return _verified(settings, version)


@router.post("/indexes/{version}/snapshot", status_code=201, responses=problems(*ERRORS, Code.NOT_WRITABLE))
def take_snapshot(version: Version, _body: Nothing, settings: SettingsNow) -> Snapshot:
    """Write a version into one file, whole or not at all."""
    _verified(settings, version)
    with _writing(settings):
        path, digest = snapshot(settings.index_dir, version)
    return Snapshot(version=version, file=f"{SNAPSHOTS}/{path.name}", bytes=path.stat().st_size, sha256=digest)


def _verified(settings: Settings, version: str, takes_it: bool = False) -> Verified:
    """A version of the service's directory, checked, and registered if that is asked for.

    Raises:
        Problem: there is none, it is broken, or it is not registered.
        StoreUnavailable: its vectors are in Milvus, which does not answer.
    """
    root = settings.index_dir
    if not (root / version / MANIFEST).is_file():
        raise Problem(Code.VERSION_NOT_FOUND)
    try:
        if takes_it:
            with _writing(settings):
                manifest = register(root, version)
        else:
            manifest = verify_version(root / version)
    except (IndexBroken, OSError):  # a file that cannot be read is as good as none
        raise Problem(Code.INDEX_BROKEN) from None
    if version not in _registered(root):
        raise Problem(Code.VERSION_NOT_FOUND, "It is not registered; POST /indexes takes it.")
    files = manifest.files.values()
    return Verified(version=version, files=len(files), bytes=sum(record.bytes for record in files))


def _registered(root: Path) -> Mapping[str, str]:
    """The versions that a directory knows.

    Raises:
        Problem: its aliases cannot be read.
    """
    try:
        return read_aliases(root).versions
    except IndexBroken:
        raise Problem(Code.INDEX_BROKEN) from None


@contextmanager
def _writing(settings: Settings) -> Iterator[None]:
    """Say so where the directory cannot be written.

    Raises:
        Problem: it is read-only, or the disk is full.
    """
    try:
        yield
    except OSError as error:
        log.error("index directory not written", reason=error.strerror)
        raise Problem(Code.NOT_WRITABLE) from None
