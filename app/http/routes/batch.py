"""Several descriptions in one request; one that cannot be used fails alone."""

import asyncio
from typing import Annotated, Any

from fastapi import APIRouter, Request
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, ConfigDict, Field, JsonValue, ValidationError, create_model

from app.http.bodies import REFUSALS
from app.http.dependencies import AllIndexes
from app.http.errors import Code, Problem, ProblemBody, as_problem
from app.http.indexes import Indexes
from app.http.openapi import problems
from app.http.queue import UNAVAILABLE
from app.http.routes.localize import check_reach, found_for
from app.http.schemas.requests import EXAMPLE, Body, LocalizeRequest, request_model
from app.http.schemas.responses import LocalizeResponse
from app.settings import Settings
from index.build.artifact import DEFAULT
from models.errors import HereaboutsError

PATH = "/localize/batch"
ERRORS = (*REFUSALS, Code.INVALID_REQUEST, Code.INTERNAL_ERROR, *UNAVAILABLE)  # others are of an item alone
BODIES = 4  # times as many bytes as one description may have, for all
AT_ONCE = 4  # items of one request that wait for the model: others ask too
BATCH_EXAMPLE: JsonValue = {"items": [EXAMPLE, {"hints": ["I stand on a gray road."]}]}


class BatchRequest(Body):
    """What to localize; `batch_model` adds the limits of a service. Items are checked one by one."""

    model_config = ConfigDict(json_schema_extra={"examples": [BATCH_EXAMPLE]})

    items: list[dict[str, JsonValue]]


class BatchItem(BaseModel):
    """The answer to one item: one of the two."""

    result: LocalizeResponse | None = None
    error: ProblemBody | None = None


class BatchResponse(BaseModel):
    """An answer an item, in their order."""

    items: list[BatchItem]


def build_router(settings: Settings) -> APIRouter:
    """The routes, with the settings' limits in their request bodies."""
    router = APIRouter(tags=["localize"])
    item_model = request_model(settings)
    description = "each as the body of POST /localize"
    body_model = create_model(
        "BatchRequest",
        __base__=BatchRequest,
        __doc__="Several descriptions.",
        items=(
            Annotated[
                list[dict[str, JsonValue]],
                Field(min_length=1, max_length=settings.max_items, description=description),
            ],
            ...,
        ),
    )

    @router.post(PATH, responses=problems(*ERRORS))
    async def batch(
        request: Request,
        body: body_model,
        indexes: AllIndexes,
    ) -> BatchResponse:
        """Where the speakers of several descriptions are; an item that cannot be answered has an error instead."""
        asked: BatchRequest = body
        if indexes.is_draining or all(item.get("index", DEFAULT) == DEFAULT for item in asked.items):
            indexes.check_accepting()
        turn = asyncio.Semaphore(AT_ONCE)

        async def answer(item: dict[str, Any]) -> BatchItem:
            async with turn:
                return await _answer(request, item_model, item, indexes)

        async with asyncio.TaskGroup() as group:
            tasks = [group.create_task(answer(item)) for item in asked.items]
        return BatchResponse(items=[task.result() for task in tasks])

    return router


async def _answer(
    request: Request, item_model: type[LocalizeRequest], item: dict[str, Any], indexes: Indexes
) -> BatchItem:
    try:
        asked = item_model.model_validate(item)
    except ValidationError as error:
        wrong = RequestValidationError([{**each, "loc": ("body", *each["loc"])} for each in error.errors()])
        return BatchItem(error=ProblemBody.model_validate(as_problem(wrong).body()))
    try:
        async with indexes.lease(asked.index) as queue:
            check_reach(asked, queue.localizer.frame)
            return BatchItem(result=await found_for(request, asked, queue))
    except (Problem, HereaboutsError) as error:
        return BatchItem(error=ProblemBody.model_validate(as_problem(error).body()))
