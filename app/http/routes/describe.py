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
from app.http.schemas.requests import DescribeRequest
from app.http.schemas.responses import DescribeResponse

ERRORS = (
    *REFUSALS,
    Code.INVALID_REQUEST,
    Code.INDEX_NOT_FOUND,
    Code.INTERNAL_ERROR,
    *UNAVAILABLE,
    Code.DEADLINE_EXCEEDED,
)
NOTHING_THERE = "is off the map, or nothing is near it; take a place where one can stand on the map that /info names"


router = APIRouter(tags=["localize"])


@router.post("/describe", responses=problems(*ERRORS))
async def describe(
    body: DescribeRequest,
    indexes: AllIndexes,
) -> DescribeResponse:
    """Describe a position in words by which POST /localize finds it again."""
    started_s = time.monotonic()
    async with indexes.lease(body.index) as queue:
        queue.check_accepting()
        localizer = queue.localizer
        check_reach(body, localizer.frame)
        x, y = localizer.frame.position_m(body.position, body.crs).tolist()
        # It reads what the localizer holds and runs no model: a thread of its own will do.
        work = asyncio.to_thread(localizer.describe, (x, y))
        try:
            described = await asyncio.wait_for(work, body.deadline_ms / 1000)
        except TimeoutError:
            raise Problem(Code.DEADLINE_EXCEEDED) from None
        if described is None:
            raise Problem.of_field("position", NOTHING_THERE)
        timings_ms = {"total": (time.monotonic() - started_s) * 1000}
        return DescribeResponse.of(described, localizer, correlation_id.get() or "", timings_ms, body.index)
