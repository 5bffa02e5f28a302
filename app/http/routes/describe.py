"""From a position to a description."""

import asyncio
import time

from asgi_correlation_id import correlation_id
from fastapi import APIRouter

from app.http.bodies import REFUSALS
from app.http.dependencies import AllIndexes
from app.http.errors import Code, Problem
from app.http.openapi import problems
from app.http.queue import UNAVAILABLE
from app.http.routes.localize import check_reach
from app.http.schemas.requests import DescribeRequest, describe_model
from app.http.schemas.responses import DescribeResponse
from app.settings import Settings

ERRORS = (
    *REFUSALS,
    Code.INVALID_REQUEST,
    Code.INDEX_NOT_FOUND,
    Code.INTERNAL_ERROR,
    *UNAVAILABLE,
    Code.DEADLINE_EXCEEDED,
)
NOTHING_THERE = "is off the map, or nothing is near it; take a place where one can stand on the map that /info names"


def build_router(settings: Settings) -> APIRouter:
    """The routes, with the settings' limits in their request bodies."""
    router = APIRouter(tags=["localize"])
    body_model = describe_model(settings)

    @router.post("/describe", responses=problems(*ERRORS))
    async def describe(
        body: body_model,  # type: ignore[valid-type]  # FastAPI reads this class, made from the settings
        indexes: AllIndexes,
    ) -> DescribeResponse:
        """What the map says at a position, in words by which POST /localize finds it again."""
        started_s = time.monotonic()
        asked: DescribeRequest = body
        async with indexes.lease(asked.index) as queue:
            queue.check_accepting()
            localizer = queue.localizer
            check_reach(asked, localizer.frame)
            x, y = localizer.frame.position_m(asked.position, asked.crs).tolist()
            # It reads what the localizer holds and runs no model: a thread of its own will do.
            work = asyncio.to_thread(localizer.describe, (x, y))
            try:
                described = await asyncio.wait_for(work, asked.deadline_ms / 1000)
            except TimeoutError:
                raise Problem(Code.DEADLINE_EXCEEDED) from None
            if described is None:
                raise Problem.of_field("position", NOTHING_THERE)
            timings_ms = {"total": (time.monotonic() - started_s) * 1000}
            return DescribeResponse.of(described, localizer, correlation_id.get() or "", timings_ms, asked.index)

    return router
