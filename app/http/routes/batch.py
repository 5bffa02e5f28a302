"""Several descriptions in one request, as JSON or as a CSV table; an invalid one fails alone."""

import asyncio
from collections.abc import Awaitable, Callable, Iterable
from io import BytesIO
from typing import Annotated, Any, TypeVar

from fastapi import APIRouter, Query, Request, Response
from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    JsonValue,
    ValidationError,
    ValidatorFunctionWrapHandler,
    WrapValidator,
)

from app.http.bodies import CSV, REFUSALS
from app.http.dependencies import AllIndexes, IndexName
from app.http.errors import Code, Problem, ProblemBody, as_problem
from app.http.formats.csv_table import CsvTable
from app.http.formats.darwin_core import ERROR, georeference, to_request, without_position
from app.http.formats.negotiation import language_headers
from app.http.indexes import Indexes
from app.http.openapi import problems
from app.http.queue import QUERY_ERRORS
from app.http.routes.localize import check_positions, localize_for
from app.http.schemas.fields import Body
from app.http.schemas.requests import EXAMPLE, LocalizeRequest
from app.http.schemas.responses import LocalizeResponse
from app.limits import MAX_BATCH_ITEMS, MAX_BATCH_ROWS
from index.build.artifact import DEFAULT_ALIAS
from models.errors import DataError, DescriptionError, HereaboutsError

PATH = "/localize/batch"
ERRORS = (*REFUSALS, Code.NO_GEOREFERENCE, *QUERY_ERRORS)  # other problems belong to one item
CONCURRENT_ITEMS = 4  # of one request in the queue, so that other requests get workers too
BATCH_EXAMPLE: JsonValue = {"items": [EXAMPLE, {"hints": ["I stand on a gray road."]}]}
T = TypeVar("T")
U = TypeVar("U")


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


def _accept_bytes(value: Any, validate: ValidatorFunctionWrapHandler) -> Any:
    """Leave a body that is not JSON, which FastAPI passes as bytes, to the route."""
    return value if isinstance(value, bytes) else validate(value)


TABLE: dict[str, Any] = {CSV: {"schema": {"type": "string"}, "example": "id,text\r\n1,I am on Kaivokatu.\r\n"}}
router = APIRouter(tags=["localize"])


@router.post(
    PATH,
    response_model=BatchResponse,
    responses={200: {"content": TABLE}, **problems(*ERRORS)},
    openapi_extra={"requestBody": {"content": TABLE}},
)
async def batch(
    request: Request,
    response: Response,
    body: Annotated[BatchRequest, WrapValidator(_accept_bytes)],
    indexes: AllIndexes,
    text: Annotated[str | None, Query(description="of a CSV table: the column of the descriptions")] = None,
    lang: Annotated[
        str | None, Query(description="of a CSV table: the column with the language of the remarks, such as sv")
    ] = None,
    index: IndexName = DEFAULT_ALIAS,
) -> BatchResponse | Response:
    """Localize several descriptions; an item that cannot be answered gets an error instead.

    The answer to a CSV table in UTF-8 is the same table with the georeference terms of Darwin Core. A row without a
    sure position has empty cells and the reason in georeferenceRemarks.
    """
    if isinstance(body, bytes):
        return await _answer_table(request, body, indexes, text, lang, index)
    if indexes.is_draining or all(_index_of(item) == DEFAULT_ALIAS for item in body.items):
        indexes.check_accepting()
    items = await _answer_each(lambda item: _answer(request, item, indexes), body.items)
    response.headers.update(language_headers(request))
    return BatchResponse(items=items)


async def _answer_each(answer: Callable[[T], Awaitable[U]], items: Iterable[T]) -> list[U]:
    """Return the answers in order; a few are computed at a time."""
    slots = asyncio.Semaphore(CONCURRENT_ITEMS)

    async def answer_in_slot(item: T) -> U:
        async with slots:
            return await answer(item)

    async with asyncio.TaskGroup() as group:
        tasks = [group.create_task(answer_in_slot(item)) for item in items]
    return [task.result() for task in tasks]


async def _answer_table(
    request: Request, body: bytes, indexes: Indexes, text: str | None, lang: str | None, index: str
) -> Response:
    """Return the table with an answer in each row, all of one version of the index."""
    if text is None:
        raise Problem.for_field("text", "is missing; send the name of the column with the descriptions, as ?text=NAME")
    try:
        table = await asyncio.to_thread(CsvTable.check, lambda: BytesIO(body), text, lang)
    except DataError as error:
        raise Problem.for_field("(body)", str(error)) from None
    if table.num_rows > MAX_BATCH_ROWS:
        advice = "send fewer, or run 'hereabouts batch'"
        raise Problem(Code.BODY_TOO_LARGE, f"The table has more than {MAX_BATCH_ROWS} rows; {advice}.")
    async with indexes.lease(index) as queue:
        queue.check_accepting()
        frame = queue.localizer.frame
        if not frame.is_georeferenced:
            raise Problem(Code.NO_GEOREFERENCE, "The map has no latitude and longitude; send application/json.")

        async def answer(row: list[str]) -> bytes:
            try:
                item = to_request(row[table.text_column], index)
                result = await localize_for(request, item, queue, table.language_of(row))
            except DescriptionError as error:
                cells = without_position(ERROR, [str(error)])
            except (Problem, HereaboutsError) as error:
                cells = without_position(ERROR, [as_problem(error).detail])
            else:
                cells = georeference(result, frame)
            return table.encode([*row, *cells])

        rows = await _answer_each(answer, await asyncio.to_thread(list, table.rows()))
    return Response(table.encoded_header() + b"".join(rows), media_type=CSV, headers=language_headers(request))


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
