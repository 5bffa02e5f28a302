"""From a description to a position."""

import asyncio
import time
from collections.abc import Callable, Coroutine
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
from app.http.formats.negotiation import GEOJSON, negotiate, respond
from app.http.openapi import geojson_content, problems
from app.http.queue import UNAVAILABLE, InferenceQueue, Served
from app.http.request_notes import notes_of
from app.http.schemas.requests import DescribeRequest, LocalizeRequest
from app.http.schemas.responses import LocalizeResponse
from app.http.schemas.ros import pose_of
from models.citymap.frame import Frame

ERRORS = (
    *REFUSALS,
    Code.INVALID_REQUEST,
    Code.INDEX_NOT_FOUND,
    Code.NOT_ACCEPTABLE,
    Code.NO_GEOREFERENCE,
    Code.QUEUE_FULL,
    Code.INTERNAL_ERROR,
    *UNAVAILABLE,
    Code.STORE_UNAVAILABLE,
    Code.DEADLINE_EXCEEDED,
)


class Door(APIRoute):
    """Refuses what cannot wait before it is read: under load, what reading costs is taken from those answered."""

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """See FastAPI."""
        handle = super().get_route_handler()

        async def handle_if_there_is_room(request: Request) -> Response:
            await request.app.state.indexes.check_room()
            return await handle(request)

        return handle_if_there_is_room


router = APIRouter(tags=["localize"], route_class=Door)


@router.post("/localize", response_model=LocalizeResponse, responses={200: geojson_content(), **problems(*ERRORS)})
async def localize(
    request: Request,
    body: LocalizeRequest,
    indexes: AllIndexes,
) -> Response:
    """Localize the speaker of a description; the answer is JSON, or GeoJSON if Accept says so."""
    async with indexes.lease(body.index) as queue:
        frame = queue.localizer.frame
        media_type = negotiate(request, frame)
        check_reach(body, frame)
        response = await found_for(request, body, queue)
    return respond(localize_collection(response, frame) if media_type == GEOJSON else response, media_type)


async def found_for(request: Request, asked: LocalizeRequest, queue: InferenceQueue) -> LocalizeResponse:
    """The answer to a description, unless its client leaves.

    Raises:
        Problem: it is refused, too late, or nobody waits for it.
    """
    started_s = time.monotonic()
    deadline_s = started_s + asked.deadline_ms / 1000
    notes_of(request.scope).descriptions.append(asked.text())
    served = await unless_client_leaves(request, queue.submit(asked.query(), deadline_s))
    timings_ms = {"queue": served.queue_ms, "total": (time.monotonic() - started_s) * 1000}
    found = LocalizeResponse.of(served.answer, queue.localizer, correlation_id.get() or "", timings_ms, asked.index)
    if asked.ros and found.estimate is not None:
        found.ros = pose_of(found.estimate, found.crs.frame_id)
    return found


def check_reach(asked: LocalizeRequest | DescribeRequest, frame: Frame) -> None:
    """Refuse degrees that are no place in the map's frame.

    Raises:
        Problem: the map has no georeference, or a point is on another side of the Earth.
    """
    if asked.crs == "map":
        return
    if not frame.is_georeferenced:
        raise Problem.of_field("crs", "this map has no georeference; give metres, with crs map")
    for field, (lon, lat) in asked.points():
        # A box is compared in degrees; only single points are projected.
        if field != "within.bbox" and not np.isfinite(frame.from_wgs84(lat, lon)).all():
            raise Problem.of_field(field, "is too far from the map; give [longitude, latitude] near it")


async def unless_client_leaves(request: Request, work: Coroutine[Any, Any, Served]) -> Served:
    """The result of some work, which is cancelled when the client disconnects (FastAPI itself goes on).

    Raises:
        Problem: the client left.
    """
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
