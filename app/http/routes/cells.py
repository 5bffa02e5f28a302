"""The cells of the map."""

from typing import Annotated

from fastapi import APIRouter, Query, Request
from starlette.responses import Response

from app.http.dependencies import IndexName, Localizer
from app.http.errors import Code, Problem
from app.http.formats.geojson import cell_collection, cells_collection
from app.http.formats.negotiation import GEOJSON, etag, is_unchanged, negotiate, respond
from app.http.openapi import geojson_content, problems
from app.http.schemas.responses import CellResponse, CellsResponse, CrsOut, Provenance
from index.build.artifact import DEFAULT_ALIAS

MAX_OFFSET, MAX_PAGE_CELLS = 1_000_000_000, 1000  # in cells
ERRORS = (
    *(Code.INDEX_NOT_FOUND, Code.INVALID_REQUEST, Code.NOT_ACCEPTABLE, Code.NO_GEOREFERENCE),
    *(Code.INTERNAL_ERROR, Code.NOT_READY, Code.LOAD_FAILED),
)
router = APIRouter(tags=["map"])


@router.get(
    "/cells",
    response_model=CellsResponse,
    responses={
        200: geojson_content(),
        304: {"description": "The content of If-None-Match has not changed"},
        **problems(*ERRORS),
    },
)
def cells(
    request: Request,
    localizer: Localizer,
    offset: Annotated[int, Query(ge=0, le=MAX_OFFSET, description="the number of cells to skip")] = 0,
    limit: Annotated[int, Query(ge=1, le=MAX_PAGE_CELLS)] = 100,
    index: IndexName = DEFAULT_ALIAS,
) -> Response:
    """Return a page of the map's cells, as JSON, or as GeoJSON if the Accept header requests it."""
    media_type, facts = negotiate(request, localizer.frame), localizer.facts
    headers = {"ETag": "W/" + etag(facts.version, f"{offset} {limit}", media_type), "Cache-Control": "no-cache"}
    if is_unchanged(request, headers["ETag"]):
        return Response(status_code=304, headers={"Vary": "Accept", **headers})
    root_path = request.scope["root_path"]
    is_last_page = offset + limit >= facts.num_cells
    body = CellsResponse(
        cells=tuple(localizer.cells(offset, limit)),
        total=facts.num_cells,
        next=None if is_last_page else f"{root_path}/cells?offset={offset + limit}&limit={limit}&index={index}",
        crs=CrsOut.from_frame(localizer.frame),
        provenance=Provenance.build(localizer, index=index),
    )
    return respond(cells_collection(body, localizer.frame) if media_type == GEOJSON else body, media_type, headers)


@router.get(
    "/cells/{cell_id}",
    response_model=CellResponse,
    responses={
        200: geojson_content(),
        304: {"description": "The content of If-None-Match has not changed"},
        **problems(Code.CELL_NOT_FOUND, *ERRORS),
    },
)
def cell(cell_id: str, request: Request, localizer: Localizer) -> Response:
    """Return a cell and its instances, as JSON, or as GeoJSON if the Accept header requests it."""
    media_type = negotiate(request, localizer.frame)
    detail = localizer.cell(cell_id)
    if detail is None:
        raise Problem(Code.CELL_NOT_FOUND)
    headers = {"ETag": "W/" + etag(localizer.facts.version, cell_id, media_type), "Cache-Control": "no-cache"}
    if is_unchanged(request, headers["ETag"]):
        return Response(status_code=304, headers={"Vary": "Accept", **headers})
    body = CellResponse.build(detail, localizer)
    return respond(cell_collection(body, localizer.frame) if media_type == GEOJSON else body, media_type, headers)
