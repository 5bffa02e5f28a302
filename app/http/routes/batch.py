"""Several descriptions in one request; one that cannot be used fails alone."""

import asyncio
from typing import Annotated, Any

from fastapi import APIRouter, Request
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, ConfigDict, Field, JsonValue, ValidationError

from app.http.bodies import REFUSALS
from app.http.dependencies import AllIndexes
from app.http.errors import Code, Problem, ProblemBody, as_problem
from app.http.indexes import Indexes
from app.http.openapi import problems
from app.http.queue import UNAVAILABLE
from app.http.routes.localize import check_reach, found_for
from app.http.schemas.requests import EXAMPLE, Body, LocalizeRequest
from app.http.schemas.responses import LocalizeResponse
from app.limits import MAX_BATCH_ITEMS
from index.build.artifact import DEFAULT_ALIAS
from models.errors import HereaboutsError

PATH = "/localize/batch"
ERRORS = (*REFUSALS, Code.INVALID_REQUEST, Code.INTERNAL_ERROR, *UNAVAILABLE)  # others are of an item alone
CONCURRENT_ITEMS = 4  # of one request that wait for a worker, so that other requests get workers too
BATCH_EXAMPLE: JsonValue = {"items": [EXAMPLE, {"hints": ["I stand on a gray road."]}]}


class BatchRequest(Body):
    """Several descriptions. Items are checked one by one."""

    model_config = ConfigDict(json_schema_extra={"examples": [BATCH_EXAMPLE]})

    items: Annotated[
        list[dict[str, JsonValue]],
        Field(min_length=1, max_length=MAX_BATCH_ITEMS, description="each as the body of POST /localize"),
    ]


class BatchItem(BaseModel):
    """The answer to one item: one of the two."""

    result: LocalizeResponse | None = None
    error: ProblemBody | None = None


class BatchResponse(BaseModel):
    """An answer an item, in their order."""

    items: list[BatchItem]


router = APIRouter(tags=["localize"])


@router.post(PATH, responses=problems(*ERRORS))
async def batch(
    request: Request,
    body: BatchRequest,
    indexes: AllIndexes,
) -> BatchResponse:
    """Localize several descriptions; an item that cannot be answered has an error instead."""
    if indexes.is_draining or all(item.get("index", DEFAULT_ALIAS) == DEFAULT_ALIAS for item in body.items):
        indexes.check_accepting()
    turn = asyncio.Semaphore(CONCURRENT_ITEMS)

    async def answer(item: dict[str, Any]) -> BatchItem:
        async with turn:
            return await _answer(request, item, indexes)

    async with asyncio.TaskGroup() as group:
        tasks = [group.create_task(answer(item)) for item in body.items]
    return BatchResponse(items=[task.result() for task in tasks])


async def _answer(request: Request, item: dict[str, Any], indexes: Indexes) -> BatchItem:
    try:
        asked = LocalizeRequest.model_validate(item)
    except ValidationError as error:
        wrong = RequestValidationError([{**each, "loc": ("body", *each["loc"])} for each in error.errors()])
        return BatchItem(error=ProblemBody.model_validate(as_problem(wrong).body()))
    try:
        async with indexes.lease(asked.index) as queue:
            check_reach(asked, queue.localizer.frame)
            return BatchItem(result=await found_for(request, asked, queue))
    except (Problem, HereaboutsError) as error:
        return BatchItem(error=ProblemBody.model_validate(as_problem(error).body()))
