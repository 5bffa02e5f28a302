"""Nominatim's endpoints: /search (from words), /reverse (from a position), /lookup (of objects) and /status."""

import asyncio
from collections.abc import Callable, Coroutine
from importlib.metadata import version
from itertools import chain
from typing import Annotated, Any, Final, Literal
from urllib.parse import parse_qsl, urlencode

import numpy as np
from fastapi import APIRouter, Query, Request
from fastapi.exceptions import RequestValidationError
from fastapi.routing import APIRoute
from pydantic import ValidationError
from pydantic_core import PydanticCustomError
from starlette.responses import JSONResponse, PlainTextResponse, Response

from app import limits
from app.http.dependencies import AllIndexes, IndexName
from app.http.errors import Code, Problem
from app.http.formats.negotiation import language_headers, negotiate_language
from app.http.formats.nominatim import (
    XML,
    Place,
    respond_with_place,
    respond_with_places,
    reverse_result,
    search_results,
)
from app.http.middleware import reply_languages_of
from app.http.openapi import geojson_content, problems
from app.http.protocol import LocalizerLike
from app.http.queue import QUERY_ERRORS, UNAVAILABLE, InferenceQueue
from app.http.routes.localize import SEARCH_ERRORS, check_positions, localize_for
from app.http.schemas.fields import check_text
from app.http.schemas.geocoder import (
    STRUCTURED,
    LookupParameters,
    ReverseParameters,
    SearchParameters,
    parse_position,
)
from app.http.schemas.requests import LocalizeRequest
from index.build.artifact import DEFAULT_ALIAS
from models.citymap.frame import Frame
from models.language.languages.translation import choose_language

TWO_CORNERS: Final = "must be lon,lat,lon,lat: two corners, longitudes -180..180, latitudes -90..90"
MAX_LOOKED_UP: Final = 50  # as in Nominatim
OSM_TYPES: Final = {"N": "node", "W": "way", "R": "relation"}
DESCRIBED: dict[str, Any] = {"description": "Nominatim's format; display_name is the place in words"}
DESCRIBED["content"] = {**geojson_content()["content"], XML: {"schema": {"type": "string"}}}


class NominatimRoute(APIRoute):
    """A route without empty parameters, where the parameter accept-language replaces the header."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """Return the handler of the route behind the changes."""
        handle = super().get_route_handler()

        async def handle_changed(request: Request) -> Response:
            scope = request.scope
            parameters = parse_qsl(scope["query_string"].decode("latin-1"))
            scope["query_string"] = urlencode(parameters).encode()
            language = dict(parameters).get("accept-language", "").encode()
            if language:
                others = [header for header in scope["headers"] if header[0] != b"accept-language"]
                scope["headers"] = [*others, (b"accept-language", language)]
            return await handle(request)

        return handle_changed


router = APIRouter(tags=["geocoder"], route_class=NominatimRoute)


def _endpoint(path: str, responses: dict[int | str, dict[str, Any]]) -> Callable[[Any], Any]:
    """Return the decorator that adds a route under all paths that Nominatim has for it."""

    def add(function: Any) -> Any:
        router.add_api_route(path, function, responses=responses)
        router.add_api_route(f"{path}.php", function, include_in_schema=False)
        return function

    return add


@_endpoint("/search", {200: DESCRIBED, **problems(*SEARCH_ERRORS)})
async def search(request: Request, indexes: AllIndexes, sent: Annotated[SearchParameters, Query()]) -> Response:
    """Localize the speaker of a description and answer like Nominatim.

    The parameter accept-language replaces the header. Nominatim's other parameters are ignored.
    """
    limit = min(max(sent.limit, 1), limits.MAX_TOP_K)
    async with indexes.lease(sent.index) as queue:
        queue.check_accepting()
        frame, localizer = _georeferenced_frame(queue), queue.localizer
        text, area = _description(sent), _search_area(sent.viewbox, sent.bounded, frame)
        position = parse_position(text)
        if position is not None:
            result = await _describe(request, localizer, *frame.from_wgs84(*position).tolist())
            results = [] if result is None else [result]
        elif not _has_words(text):
            results = []
        else:
            try:
                body = LocalizeRequest.model_validate(
                    {
                        "description": text,
                        "top_k": limit,
                        "deadline_ms": limits.DEFAULT_DEADLINE_MS,
                        "index": sent.index,
                        **area,
                    }
                )
            except ValidationError as error:
                raise RequestValidationError([_as_query_error(item) for item in error.errors()]) from None
            check_positions(body, localizer)
            response = await localize_for(request, body, queue)
            language = reply_languages_of(request.scope)[-1]
            results = await asyncio.to_thread(search_results, response, localizer, limit, language)
    return respond_with_places(results, sent, localizer.facts.attribution, language_headers(request))


@_endpoint("/reverse", {200: DESCRIBED, **problems(*QUERY_ERRORS, Code.NO_GEOREFERENCE)})
async def reverse(request: Request, indexes: AllIndexes, sent: Annotated[ReverseParameters, Query()]) -> Response:
    """Describe a position and answer like Nominatim; its other parameters are ignored."""
    async with indexes.lease(sent.index) as queue:
        queue.check_accepting()
        position = _georeferenced_frame(queue).from_wgs84(sent.lat, sent.lon)
        result = await _describe(request, queue.localizer, *position.tolist())
    return respond_with_place(result, sent, queue.localizer.facts.attribution, language_headers(request))


@_endpoint("/lookup", {200: DESCRIBED, **problems(*QUERY_ERRORS, Code.NO_GEOREFERENCE)})
async def lookup(request: Request, indexes: AllIndexes, sent: Annotated[LookupParameters, Query()]) -> Response:
    """Describe where objects of OpenStreetMap are and answer like Nominatim; unknown ids are left out."""
    names = [*dict.fromkeys(name.strip().upper() for name in sent.osm_ids.split(","))]
    if len(names) > MAX_LOOKED_UP:
        raise Problem.for_field("osm_ids", f"has {len(names)} ids, but at most {MAX_LOOKED_UP} are allowed")
    results = []
    async with indexes.lease(sent.index) as queue:
        queue.check_accepting()
        _georeferenced_frame(queue)
        for source_id in (f"{OSM_TYPES[name[0]]}/{name[1:]}" for name in names if name[:1] in OSM_TYPES):
            position = await asyncio.to_thread(queue.localizer.position_of, source_id)
            result = position and await _describe(request, queue.localizer, *position, source_id)
            results += [result] if result else []
    return respond_with_places(results, sent, queue.localizer.facts.attribution, language_headers(request))


STATUS: Final[dict[str, Any]] = {"content": {"text/plain": {"schema": {"type": "string"}}}}


@_endpoint("/status", {200: STATUS, **problems(Code.INVALID_REQUEST, Code.INDEX_NOT_FOUND, *UNAVAILABLE)})
async def status(
    indexes: AllIndexes,
    form: Annotated[Literal["text", "json"], Query(alias="format")] = "text",
    index: IndexName = DEFAULT_ALIAS,
) -> Response:
    """Report that searches are answered, as Nominatim does."""
    async with indexes.lease(index) as queue:
        queue.check_accepting()
        facts = queue.localizer.facts
    if form == "text":
        return PlainTextResponse("OK")
    return JSONResponse(
        {"status": 0, "message": "OK", "data_updated": facts.created, "software_version": version("hereabouts")}
    )


async def _describe(
    request: Request, localizer: LocalizerLike, x: float, y: float, source_id: str | None = None
) -> Place | None:
    """Return a position of the map as a place; None off the map."""
    language = choose_language(negotiate_language(request), ())
    reply_languages_of(request.scope).append(language)
    near = abs(x) + abs(y) < 1e8
    described = await asyncio.to_thread(localizer.describe, (x, y), language) if near else None
    return None if described is None else reverse_result(described, localizer, source_id)


def _description(sent: SearchParameters) -> str:
    """Return the text to localize; the city of a street is left out, because the map has only one."""
    texts = (", ".join(part for name in names if (part := getattr(sent, name))) for names in STRUCTURED)
    structured = next(filter(None, texts), None)
    if sent.q and structured:
        parts = ", ".join(chain(*STRUCTURED))
        raise Problem.for_field("q", f"cannot be combined with {parts}; leave it or them out")
    text = sent.q or structured
    if text is None:
        raise Problem.for_field("q", "is missing; describe what is around you, or give parts of an address")
    return text


def _has_words(text: str) -> bool:
    try:
        return bool(check_text(text))
    except PydanticCustomError:
        return False


def _as_query_error(error: Any) -> dict[str, Any]:
    """Convert an error of the request body to one of the query parameter that the field was made from."""
    context = error.get("ctx", {})
    steps = (*error["loc"], *context.get("field", "").split("."))
    name = "q" if {"within", "prior"}.isdisjoint(steps) else "viewbox"
    return {**error, "loc": ("query", name), "ctx": {**context, "field": ""}}


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
        return {}  # the view of a client that shows the whole Earth
    half_m = float(np.hypot(*(corner - centre)))
    return {"prior": {"position": middle, "sigma_m": max(half_m, 1.0)}, "crs": "wgs84"}
