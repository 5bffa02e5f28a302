"""What the map looks like."""

import gzip
from typing import Annotated

from fastapi import APIRouter, Query, Request
from starlette.responses import FileResponse, Response

from app.http.dependencies import Localizer
from app.http.errors import Code, Problem
from app.http.formats.negotiation import etag, has_already, takes_gzip
from app.http.openapi import problems

router = APIRouter(tags=["map"])
BINARY = "application/octet-stream"


@router.get(
    "/maps/{name}/points",
    response_class=Response,
    responses={
        200: {
            "description": "a safetensors file, compressed by gzip: geometry (`kind` shapes) or coloured points "
            "(`kind` points), see docs/formats.md",
            "content": {BINARY: {"schema": {"type": "string", "format": "binary"}}},
        },
        304: {"description": "What the client has (If-None-Match) is still what is served"},
        **problems(Code.MAP_NOT_FOUND, Code.INDEX_NOT_FOUND, Code.INVALID_REQUEST),
        **problems(Code.INTERNAL_ERROR, Code.NOT_READY, Code.LOAD_FAILED),
    },
)
def points(
    name: str,
    request: Request,
    localizer: Localizer,
    part: Annotated[int, Query(ge=0, le=1_000_000, description="the first shows all of the map")] = 0,
) -> Response:
    """A part of what a map looks like; the first shows all of it, further ones have more points."""
    found = localizer.scenery(part) if name == localizer.facts.map_name else None
    if found is None:
        raise Problem(Code.MAP_NOT_FOUND)
    zipped = takes_gzip(request)
    headers = {
        "ETag": etag(found.sha256, str(zipped)),
        "Cache-Control": "no-cache",
        "Vary": "Accept-Encoding",
    }
    if has_already(request, headers["ETag"]):
        return Response(status_code=304, headers=headers)
    if zipped:
        return FileResponse(found.path, media_type=BINARY, headers={**headers, "Content-Encoding": "gzip"})
    return Response(gzip.decompress(found.path.read_bytes()), media_type=BINARY, headers=headers)
