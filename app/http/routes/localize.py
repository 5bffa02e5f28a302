"""POST /localize: from a description to a position."""

import asyncio
import time
from collections.abc import Callable, Coroutine
from dataclasses import replace
from typing import Any

import numpy as np
from asgi_correlation_id import correlation_id
from fastapi import APIRouter, Request
from fastapi.routing import APIRoute
from starlette.responses import Response

from app.http.bodies import REFUSALS
from app.http.dependencies import AllIndexes
from app.http.errors import Code, Problem
from app.http.formats.geojson import localize_collection
from app.http.formats.negotiation import GEOJSON, PIDF, language_headers, negotiate, negotiate_language, respond
from app.http.formats.pidf import presence_document
from app.http.middleware import descriptions_of, reply_languages_of
from app.http.openapi import localize_content, problems
from app.http.protocol import LocalizerLike
from app.http.queue import QUERY_ERRORS, InferenceQueue, ServedAnswer
from app.http.schemas.requests import CorrectionRequest, DescribeRequest, LocalizeRequest
from app.http.schemas.responses import LocalizeResponse
from app.http.schemas.ros import to_ros_pose

SEARCH_ERRORS = (*QUERY_ERRORS, Code.NO_GEOREFERENCE, Code.QUEUE_FULL, Code.STORE_UNAVAILABLE, Code.DEADLINE_EXCEEDED)
ERRORS = (*REFUSALS, Code.NOT_ACCEPTABLE, *SEARCH_ERRORS)


class AdmissionRoute(APIRoute):
    """A route that refuses requests before their body is read if the queues are full.

    Under overload, reading the bodies of refused requests would take CPU time from accepted ones.
    """

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """Return the handler of the route behind the admission check."""
        handle = super().get_route_handler()

        async def handle_if_admitted(request: Request) -> Response:
            await request.app.state.indexes.check_room()
            return await handle(request)

        return handle_if_admitted


router = APIRouter(tags=["localize"], route_class=AdmissionRoute)


@router.post("/localize", response_model=LocalizeResponse, responses={200: localize_content(), **problems(*ERRORS)})
async def localize(request: Request, body: LocalizeRequest, indexes: AllIndexes) -> Response:
    """Localize the speaker of a description; the answer is JSON, or GeoJSON or PIDF-LO if Accept requests it."""
    async with indexes.lease(body.index) as queue:
        frame = queue.localizer.frame
        media_type = negotiate(request, frame, (GEOJSON, PIDF))
        check_positions(body, queue.localizer)
        response = await localize_for(request, body, queue)
    if media_type == PIDF:
        headers = language_headers(request)
        return Response(presence_document(response), media_type=PIDF, headers=headers)
    content = localize_collection(response, frame) if media_type == GEOJSON else response
    return respond(content, media_type, language_headers(request))


async def localize_for(
    request: Request, body: LocalizeRequest, queue: InferenceQueue, language: str | None = None
) -> LocalizeResponse:
    """Return the answer to a description, by default in a language of the Accept-Language header.

    The query is cancelled if the client disconnects.
    """
    started_s = time.monotonic()
    deadline_s = started_s + body.deadline_ms / 1000
    descriptions_of(request.scope).append(body.text())
    query = replace(body.to_query(), language=language or negotiate_language(request))
    served = await run_while_connected(request, queue.submit(query, deadline_s))
    reply_languages_of(request.scope).append(served.answer.language)
    timings_ms = {"queue": served.queue_ms, "total": (time.monotonic() - started_s) * 1000}
    response = LocalizeResponse.build(
        served.answer, queue.localizer, correlation_id.get() or "", timings_ms, body.index
    )
    if body.ros and response.estimate is not None:
        response.ros = to_ros_pose(response.estimate, response.crs.frame_id)
    return response


def check_positions(body: LocalizeRequest | DescribeRequest | CorrectionRequest, localizer: LocalizerLike) -> None:
    """Raise 422 for degrees that cannot be projected, that are swapped, or that are sent as metres."""
    frame = localizer.frame
    if body.crs == "wgs84" and not frame.is_georeferenced:
        raise Problem.for_field("crs", "this map has no georeference; send metres with crs map")
    for field, (x, y) in body.points() if frame.is_georeferenced else ():
        is_right, is_swapped = is_on_map(localizer, y, x), is_on_map(localizer, x, y)
        if body.crs == "map" and (is_right or is_swapped):
            raise Problem.for_field(field, "looks like degrees; send crs wgs84, or metres of the map")
        if body.crs == "wgs84" and is_swapped and not is_right:
            raise Problem.for_field(field, "looks like [latitude, longitude]; send [longitude, latitude]")
        # Boxes and polygons are compared in degrees; only single points are projected.
        is_corner = field in {"within.bbox", "within.coordinates"}
        if body.crs == "wgs84" and not is_corner and not np.isfinite(frame.from_wgs84(y, x)).all():
            raise Problem.for_field(field, "is too far from the map; send [longitude, latitude] near it")


def is_on_map(localizer: LocalizerLike, lat: float, lon: float) -> bool:
    """Return whether degrees lie in the box round the map's cells."""
    if not (abs(lat) <= 90 and abs(lon) <= 180):
        return False
    x, y = localizer.frame.from_wgs84(lat, lon)
    west, south, east, north = localizer.facts.box_m
    return bool(west <= x <= east and south <= y <= north)


async def run_while_connected(request: Request, work: Coroutine[Any, Any, ServedAnswer]) -> ServedAnswer:
    """Return the result of some work; cancel it when the client disconnects, which FastAPI does not do."""
    working = asyncio.create_task(work)
    leaving = asyncio.create_task(_disconnected(request))
    try:
        await asyncio.wait({working, leaving}, return_when=asyncio.FIRST_COMPLETED)
        if working.done():
            return working.result()
        raise Problem(Code.CLIENT_CLOSED_REQUEST)
    finally:
        working.cancel()
        leaving.cancel()
        await asyncio.gather(working, leaving, return_exceptions=True)


async def _disconnected(request: Request) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass
