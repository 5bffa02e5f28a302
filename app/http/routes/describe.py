"""POST /describe: from a position to a description."""

import asyncio
import time

from asgi_correlation_id import correlation_id
from fastapi import APIRouter

from app.http.bodies import REFUSALS
from app.http.dependencies import AllIndexes
from app.http.errors import Code, Problem
from app.http.openapi import problems
from app.http.queue import QUERY_ERRORS
from app.http.routes.localize import check_positions
from app.http.schemas.requests import DescribeRequest
from app.http.schemas.responses import DescribeResponse

ERRORS = (*REFUSALS, *QUERY_ERRORS, Code.DEADLINE_EXCEEDED)
NOTHING_NEARBY = "is off the map, or nothing is near it; choose a position on the map where a person can stand"

router = APIRouter(tags=["localize"])


@router.post("/describe", responses=problems(*ERRORS))
async def describe(body: DescribeRequest, indexes: AllIndexes) -> DescribeResponse:
    """Describe a position in words from which POST /localize can find it again."""
    started_s = time.monotonic()
    async with indexes.lease(body.index) as queue:
        queue.check_accepting()
        localizer = queue.localizer
        check_positions(body, localizer)
        x, y = localizer.frame.position_m(body.position, body.crs).tolist()
        # This runs no model, so it needs no worker: a thread is enough.
        work = asyncio.to_thread(localizer.describe, (x, y))
        try:
            described = await asyncio.wait_for(work, body.deadline_ms / 1000)
        except TimeoutError:
            raise Problem(Code.DEADLINE_EXCEEDED) from None
        if described is None:
            raise Problem.for_field("position", NOTHING_NEARBY)
        timings_ms = {"total": (time.monotonic() - started_s) * 1000}
        return DescribeResponse.build(described, localizer, correlation_id.get() or "", timings_ms, body.index)
