"""The served map: what it is good for, and its scenery for the page, which is geometry or points."""

import gzip
from typing import Annotated

from fastapi import APIRouter, Query, Request
from starlette.responses import FileResponse, Response

from app.http.dependencies import Localizer
from app.http.errors import Code, Problem
from app.http.formats.negotiation import accepts_gzip, etag, is_unchanged
from app.http.openapi import problems
from app.http.schemas.responses import MapResponse

router = APIRouter(tags=["map"])
BINARY = "application/octet-stream"


@router.get(
    "/maps/{name}",
    responses=problems(
        Code.MAP_NOT_FOUND, Code.INDEX_NOT_FOUND, Code.INVALID_REQUEST, Code.NOT_READY, Code.LOAD_FAILED
    ),
)
def describe_map(name: str, localizer: Localizer) -> MapResponse:
    """Return the size of a map, and what descriptions can name there."""
    if name != localizer.facts.map_name:
        raise Problem(Code.MAP_NOT_FOUND)
    return MapResponse.build(localizer)


@router.get(
    "/maps/{name}/points",
    response_class=Response,
    responses={
        200: {
            "description": "A safetensors file, compressed with gzip: geometry (`kind` shapes) or coloured points "
            "(`kind` points); docs/formats.md describes it",
            "content": {BINARY: {"schema": {"type": "string", "format": "binary"}}},
        },
        304: {"description": "The content of If-None-Match has not changed"},
        **problems(Code.MAP_NOT_FOUND, Code.INDEX_NOT_FOUND, Code.INVALID_REQUEST),
        **problems(Code.INTERNAL_ERROR, Code.NOT_READY, Code.LOAD_FAILED),
    },
)
def points(
    name: str,
    request: Request,
    localizer: Localizer,
    part: Annotated[int, Query(ge=0, le=1_000_000, description="number of the part; 0 shows the whole map")] = 0,
) -> Response:
    """Return a part of a map's scenery; part 0 shows the whole map, and further parts add points."""
    scenery = localizer.scenery(part) if name == localizer.facts.map_name else None
    if scenery is None:
        raise Problem(Code.MAP_NOT_FOUND)
    use_gzip = accepts_gzip(request)
    headers = {"ETag": etag(scenery.sha256, str(use_gzip)), "Cache-Control": "no-cache", "Vary": "Accept-Encoding"}
    if is_unchanged(request, headers["ETag"]):
        return Response(status_code=304, headers=headers)
    if use_gzip:
        return FileResponse(scenery.path, media_type=BINARY, headers={**headers, "Content-Encoding": "gzip"})
    return Response(gzip.decompress(scenery.path.read_bytes()), media_type=BINARY, headers=headers)
