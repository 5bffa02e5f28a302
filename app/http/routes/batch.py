"""Several descriptions in one request; an invalid item fails alone."""

import asyncio
from typing import Annotated

from fastapi import APIRouter, Request, Response
from pydantic import BaseModel, ConfigDict, Field, JsonValue, ValidationError

from app.http.bodies import REFUSALS
from app.http.dependencies import AllIndexes
from app.http.errors import Code, Problem, ProblemBody, as_problem
from app.http.formats.negotiation import language_headers
from app.http.indexes import Indexes
from app.http.openapi import problems
from app.http.queue import UNAVAILABLE
from app.http.routes.localize import check_positions, localize_for
from app.http.schemas.fields import Body
from app.http.schemas.requests import EXAMPLE, LocalizeRequest
from app.http.schemas.responses import LocalizeResponse
from app.limits import MAX_BATCH_ITEMS
from index.build.artifact import DEFAULT_ALIAS
from models.errors import HereaboutsError

PATH = "/localize/batch"
ERRORS = (*REFUSALS, Code.INVALID_REQUEST, Code.INTERNAL_ERROR, *UNAVAILABLE)  # other problems belong to one item
CONCURRENT_ITEMS = 4  # of one request in the queue, so that other requests get workers too
BATCH_EXAMPLE: JsonValue = {"items": [EXAMPLE, {"hints": ["I stand on a gray road."]}]}


class BatchRequest(Body):
    """Several descriptions. Items are validated one by one."""

    model_config = ConfigDict(json_schema_extra={"examples": [BATCH_EXAMPLE]})

    items: Annotated[
        list[JsonValue],
        Field(min_length=1, max_length=MAX_BATCH_ITEMS, description="each like the body of POST /localize"),
    ]


class BatchItem(BaseModel):
    """The answer to one item: either a result or an error."""

    result: LocalizeResponse | None = None
    error: ProblemBody | None = None


class BatchResponse(BaseModel):
    """One answer per item, in order."""

    items: list[BatchItem]


router = APIRouter(tags=["localize"])


@router.post(PATH, responses=problems(*ERRORS))
async def batch(request: Request, response: Response, body: BatchRequest, indexes: AllIndexes) -> BatchResponse:
    """Localize several descriptions; an item that cannot be answered gets an error instead."""
    if indexes.is_draining or all(_index_of(item) == DEFAULT_ALIAS for item in body.items):
        indexes.check_accepting()
    slots = asyncio.Semaphore(CONCURRENT_ITEMS)

    async def answer(item: JsonValue) -> BatchItem:
        async with slots:
            return await _answer(request, item, indexes)

    async with asyncio.TaskGroup() as group:
        tasks = [group.create_task(answer(item)) for item in body.items]
    response.headers.update(language_headers(request))
    return BatchResponse(items=[task.result() for task in tasks])


def _index_of(item: JsonValue) -> JsonValue:
    return item.get("index", DEFAULT_ALIAS) if isinstance(item, dict) else DEFAULT_ALIAS


async def _answer(request: Request, item: JsonValue, indexes: Indexes) -> BatchItem:
    try:
        body = LocalizeRequest.model_validate(item)
    except ValidationError as error:
        return BatchItem(error=ProblemBody.model_validate(Problem.for_body(error).body()))
    try:
        async with indexes.lease(body.index) as queue:
            check_positions(body, queue.localizer)
            return BatchItem(result=await localize_for(request, body, queue))
    except (Problem, HereaboutsError) as error:
        return BatchItem(error=ProblemBody.model_validate(as_problem(error).body()))
