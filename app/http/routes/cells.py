"""The cells of the map."""

from fastapi import APIRouter, Request
from starlette.responses import Response

from app.http.dependencies import Localizer
from app.http.errors import Code, Problem
from app.http.geojson import cell_collection
from app.http.negotiation import GEOJSON, etag, has_already, negotiate, respond
from app.http.openapi import geojson_content, problems
from app.http.responses import CellResponse

router = APIRouter(tags=["map"])


@router.get(
    "/cells/{cell_id}",
    response_model=CellResponse,
    responses={
        200: geojson_content(),
        304: {"description": "The cell that the client has (If-None-Match) is still the one that is served"},
        **problems(
            Code.CELL_NOT_FOUND,
            Code.INDEX_NOT_FOUND,
            Code.INVALID_REQUEST,
            Code.NOT_ACCEPTABLE,
            Code.NO_GEOREFERENCE,
            Code.NOT_READY,
            Code.LOAD_FAILED,
        ),
    },
)
def cell(cell_id: str, request: Request, localizer: Localizer) -> Response:
    """A cell and what is in it, as JSON, or as GeoJSON if Accept says so."""
    media_type = negotiate(request, localizer.frame)
    detail = localizer.cell(cell_id)
    if detail is None:
        raise Problem(Code.CELL_NOT_FOUND)
    headers = {"ETag": etag(localizer.facts.version, cell_id, media_type), "Cache-Control": "no-cache"}
    if has_already(request, headers["ETag"]):
        return Response(status_code=304, headers={"Vary": "Accept", **headers})
    body = CellResponse.of(detail, localizer)
    return respond(cell_collection(body, localizer.frame) if media_type == GEOJSON else body, media_type, headers)
