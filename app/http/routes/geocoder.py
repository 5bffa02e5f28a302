"""The two paths of Nominatim that most geocoder clients ask: /search for words, /reverse for a position."""

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
from app.http.formats.negotiation import GEOJSON, JSON
from app.http.formats.nominatim import NOTHING, Format, formatted, formatted_one, place_of, places
from app.http.openapi import geojson_content, problems
from app.http.queue import UNAVAILABLE, InferenceQueue
from app.http.routes.localize import check_reach, found_for
from app.http.schemas.requests import LocalizeRequest
from index.build.artifact import DEFAULT_ALIAS
from models.citymap.frame import Frame

TWO_CORNERS: Final = "takes lon,lat,lon,lat: two corners, longitudes -180..180, latitudes -90..90"
REVERSE_ERRORS = (
    Code.INVALID_REQUEST,
    Code.INDEX_NOT_FOUND,
    Code.NO_GEOREFERENCE,
    Code.INTERNAL_ERROR,
    *UNAVAILABLE,
)
SEARCH_ERRORS = (*REVERSE_ERRORS, Code.QUEUE_FULL, Code.STORE_UNAVAILABLE, Code.DEADLINE_EXCEEDED)
Form = Annotated[Format, Query(alias="format", description="as of Nominatim; xml is not spoken")]
DESCRIBED: dict[str, Any] = {
    "description": "what Nominatim answers, with the place in words as display_name",
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
    viewbox: Annotated[str | None, Query(description="lon,lat,lon,lat: two corners of where to look first")] = None,
    bounded: Annotated[bool, Query(description="look nowhere else")] = False,
    index: IndexName = DEFAULT_ALIAS,
) -> Response:
    """Localize the speaker of a description and answer as Nominatim does; its other parameters are ignored."""
    async with indexes.lease(index) as queue:
        frame = _on_earth(queue)
        look = _look(viewbox, bounded, frame)
        try:
            asked = LocalizeRequest.model_validate(
                {"description": q, "top_k": limit, "deadline_ms": limits.DEFAULT_DEADLINE_MS, "index": index, **look}
            )
        except ValidationError as error:
            raise RequestValidationError([_of_query(item) for item in error.errors()]) from None
        check_reach(asked, frame)
        found = await found_for(request, asked, queue)
        listed = await asyncio.to_thread(places, found, queue.localizer, limit)
    return _respond(formatted(listed, form), form)


@router.get("/reverse", responses={200: DESCRIBED, **problems(*REVERSE_ERRORS)})
async def reverse(
    indexes: AllIndexes,
    lat: Annotated[float, Query(ge=-90, le=90, allow_inf_nan=False)],
    lon: Annotated[float, Query(ge=-180, le=180, allow_inf_nan=False)],
    form: Form = "jsonv2",
    index: IndexName = DEFAULT_ALIAS,
) -> Response:
    """Describe a position and answer as Nominatim does; its other parameters are ignored."""
    async with indexes.lease(index) as queue:
        queue.check_accepting()
        position = _on_earth(queue).from_wgs84(lat, lon)
        x, y = position.tolist()
        described = await asyncio.to_thread(queue.localizer.describe, (x, y)) if abs(x) + abs(y) < 1e8 else None
        if described is None:
            return _respond(NOTHING, "json")
        return _respond(formatted_one(place_of(described, queue.localizer), form), form)


def _of_query(wrong: Any) -> dict[str, Any]:
    """What is wrong with a request's body, as of the parameter that it was made of."""
    steps = (*wrong["loc"], *wrong.get("ctx", {}).get("field", "").split("."))
    return {**wrong, "loc": ("query", "q" if {"within", "prior"}.isdisjoint(steps) else "viewbox"), "ctx": {}}


def _respond(content: Any, form: Format) -> Response:
    return JSONResponse(content, media_type=GEOJSON if form == "geojson" else JSON)


def _on_earth(queue: InferenceQueue) -> Frame:
    """The frame of an index.

    Raises:
        Problem: nobody knows where on Earth it is.
    """
    frame = queue.localizer.frame
    if not frame.is_georeferenced:
        raise Problem(Code.NO_GEOREFERENCE, "This map has no latitude and longitude; ask POST /localize.")
    return frame


def _look(viewbox: str | None, bounded: bool, frame: Frame) -> dict[str, Any]:
    """Where to look, as POST /localize takes it: the box alone, or a bias to its middle.

    Raises:
        Problem: it is no box.
    """
    if viewbox is None:
        return {}
    try:
        west, south, east, north = (float(part) for part in viewbox.split(","))
    except ValueError:
        raise Problem.of_field("viewbox", TWO_CORNERS) from None
    (west, east), (south, north) = sorted((west, east)), sorted((south, north))
    if not (-180 <= west <= east <= 180 and -90 <= south <= north <= 90):  # nor NaN
        raise Problem.of_field("viewbox", TWO_CORNERS)
    if bounded:
        return {"within": {"bbox": [west, south, east, north]}, "crs": "wgs84"}
    middle = [(west + east) / 2, (south + north) / 2]
    corner, centre = frame.from_wgs84(south, west), frame.from_wgs84(middle[1], middle[0])
    if not np.isfinite([corner, centre]).all():
        raise Problem.of_field("viewbox", "reaches too far from the map; give two corners near it")
    half_m = float(np.hypot(*(corner - centre)))
    return {"prior": {"position": middle, "sigma_m": max(half_m, 1.0)}, "crs": "wgs84"}
