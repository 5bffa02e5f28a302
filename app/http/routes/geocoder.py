"""Nominatim-compatible /search (from words) and /reverse (from a position)."""

import asyncio
from typing import Annotated, Any, Final

import numpy as np
from fastapi import APIRouter, Query, Request
from fastapi.exceptions import RequestValidationError
from pydantic import ValidationError
from starlette.responses import JSONResponse, Response

from app import limits
from app.http.dependencies import AllIndexes, IndexName
from app.http.errors import Code, Problem
from app.http.formats.negotiation import GEOJSON, JSON, language_headers
from app.http.formats.nominatim import NO_RESULT, Format, format_places, reverse_result, search_results
from app.http.openapi import geojson_content, problems
from app.http.queue import QUERY_ERRORS, InferenceQueue
from app.http.routes.localize import SEARCH_ERRORS, check_positions, localize_for
from app.http.schemas.requests import LocalizeRequest
from index.build.artifact import DEFAULT_ALIAS
from models.citymap.frame import Frame

TWO_CORNERS: Final = "must be lon,lat,lon,lat: two corners, longitudes -180..180, latitudes -90..90"
Form = Annotated[Format, Query(alias="format", description="as in Nominatim; xml is not supported")]
DESCRIBED: dict[str, Any] = {
    "description": "Nominatim's format; display_name is the place in words",
    **geojson_content(),
}

router = APIRouter(tags=["geocoder"])


@router.get("/search", responses={200: DESCRIBED, **problems(*SEARCH_ERRORS)})
async def search(
    request: Request,
    indexes: AllIndexes,
    q: Annotated[str, Query(description="what is around the speaker, in plain words")],
    form: Form = "jsonv2",
    limit: Annotated[int, Query(ge=1, le=limits.MAX_TOP_K)] = 10,
    viewbox: Annotated[str | None, Query(description="lon,lat,lon,lat: two corners of the preferred area")] = None,
    bounded: Annotated[bool, Query(description="search only inside viewbox")] = False,
    index: IndexName = DEFAULT_ALIAS,
) -> Response:
    """Localize the speaker of a description and answer like Nominatim; its other parameters are ignored."""
    async with indexes.lease(index) as queue:
        frame = _georeferenced_frame(queue)
        area = _search_area(viewbox, bounded, frame)
        try:
            body = LocalizeRequest.model_validate(
                {"description": q, "top_k": limit, "deadline_ms": limits.DEFAULT_DEADLINE_MS, "index": index, **area}
            )
        except ValidationError as error:
            raise RequestValidationError([_as_query_error(item) for item in error.errors()]) from None
        check_positions(body, queue.localizer)
        response = await localize_for(request, body, queue)
        results = await asyncio.to_thread(search_results, response, queue.localizer, limit)
    return _respond(format_places(results, form), form, language_headers(request))


@router.get("/reverse", responses={200: DESCRIBED, **problems(*QUERY_ERRORS, Code.NO_GEOREFERENCE)})
async def reverse(
    indexes: AllIndexes,
    lat: Annotated[float, Query(ge=-90, le=90, allow_inf_nan=False)],
    lon: Annotated[float, Query(ge=-180, le=180, allow_inf_nan=False)],
    form: Form = "jsonv2",
    index: IndexName = DEFAULT_ALIAS,
) -> Response:
    """Describe a position and answer like Nominatim; its other parameters are ignored."""
    async with indexes.lease(index) as queue:
        queue.check_accepting()
        position = _georeferenced_frame(queue).from_wgs84(lat, lon)
        x, y = position.tolist()
        described = await asyncio.to_thread(queue.localizer.describe, (x, y)) if abs(x) + abs(y) < 1e8 else None
        if described is None:
            return _respond(NO_RESULT, "json")
        content = format_places([reverse_result(described, queue.localizer)], form)
        return _respond(content if form == "geojson" else content[0], form)


def _as_query_error(error: Any) -> dict[str, Any]:
    """Convert an error of the request body to one of the query parameter that the field was made from."""
    context = error.get("ctx", {})
    steps = (*error["loc"], *context.get("field", "").split("."))
    name = "q" if {"within", "prior"}.isdisjoint(steps) else "viewbox"
    return {**error, "loc": ("query", name), "ctx": {**context, "field": ""}}


def _respond(content: Any, form: Format, headers: dict[str, str] | None = None) -> Response:
    return JSONResponse(content, media_type=GEOJSON if form == "geojson" else JSON, headers=headers)


def _georeferenced_frame(queue: InferenceQueue) -> Frame:
    frame = queue.localizer.frame
    if not frame.is_georeferenced:
        raise Problem(Code.NO_GEOREFERENCE, "This map has no latitude and longitude; use POST /localize.")
    return frame


def _search_area(viewbox: str | None, bounded: bool, frame: Frame) -> dict[str, Any]:
    """Return the fields of POST /localize for a viewbox: a filter if bounded, otherwise a prior at its middle."""
    if viewbox is None:
        return {}
    try:
        west, south, east, north = (float(part) for part in viewbox.split(","))
    except ValueError:
        raise Problem.for_field("viewbox", TWO_CORNERS) from None
    (west, east), (south, north) = sorted((west, east)), sorted((south, north))
    if not (-180 <= west <= east <= 180 and -90 <= south <= north <= 90):  # also refuses NaN
        raise Problem.for_field("viewbox", TWO_CORNERS)
    if bounded:
        return {"within": {"bbox": [west, south, east, north]}, "crs": "wgs84"}
    middle = [(west + east) / 2, (south + north) / 2]
    corner, centre = frame.from_wgs84(south, west), frame.from_wgs84(middle[1], middle[0])
    if not np.isfinite([corner, centre]).all():
        raise Problem.for_field("viewbox", "reaches too far from the map; give two corners near it")
    half_m = float(np.hypot(*(corner - centre)))
    return {"prior": {"position": middle, "sigma_m": max(half_m, 1.0)}, "crs": "wgs84"}
