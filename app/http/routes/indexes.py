"""The versions in the index directory and the aliases that serve them."""

from fastapi import APIRouter
from pydantic import BaseModel, Field

from app.http.dependencies import AllIndexes, SettingsNow
from app.http.errors import Code, Problem
from app.http.openapi import problems
from index.build.artifact import list_versions, read_aliases
from models.errors import IndexBroken

router = APIRouter(tags=["indexes"])


class VersionInfo(BaseModel):
    """A version of an index."""

    version: str
    registered: bool = Field(description="whether it may be served; `hereabouts alias set` registers a version")
    aliases: list[str] = Field(description="the aliases that serve it now")


class IndexesResponse(BaseModel):
    """All versions in the index directory."""

    aliases: dict[str, str] = Field(description="the version that each alias serves")
    versions: list[VersionInfo]


@router.get("/indexes", responses=problems(Code.INDEX_BROKEN))
def list_indexes(indexes: AllIndexes, settings: SettingsNow) -> IndexesResponse:
    """List the versions in the index directory and the aliases that serve them."""
    try:
        registered = read_aliases(settings.index_dir).versions
    except IndexBroken:
        raise Problem(Code.INDEX_BROKEN) from None
    served = indexes.versions()
    return IndexesResponse(
        aliases=served,
        versions=[
            VersionInfo(
                version=version,
                registered=version in registered,
                aliases=sorted(alias for alias, served_version in served.items() if served_version == version),
            )
            for version in sorted({*list_versions(settings.index_dir), *registered})
        ],
    )
