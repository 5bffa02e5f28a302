"""Errors as clients see them: RFC 9457 problem+json, one table of stable codes, nothing of the input echoed."""

import re
from collections.abc import Mapping, Sequence
from enum import Enum
from itertools import islice
from typing import Any

import structlog
from asgi_correlation_id import correlation_id
from fastapi import FastAPI, HTTPException, Request
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, ConfigDict, Field
from starlette.exceptions import HTTPException as StarletteHTTPException
from starlette.responses import JSONResponse, Response
from starlette.routing import Match, Route

from models.errors import ReplyError, StoreUnavailable, WeightsError

PROBLEM_JSON = "application/problem+json"
MAX_LISTED_ERRORS, MAX_BYTES = 20, 1024  # of a problem
SAID = {  # in place of pydantic's words, which tell nobody what to do
    "missing": "is missing; give it",
    "extra_forbidden": "is unknown; leave it out",
    "int_parsing_size": "has too many digits; send fewer",
}
log = structlog.get_logger()
_PLAIN_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,63}")


class Code(Enum):
    """Every error of the service. The member's name in lower case is the stable `code`.

    A member holds: HTTP status, title, what to do about it, seconds for Retry-After.
    """

    INVALID_JSON = (400, "The body is not JSON", "Send one JSON object in UTF-8.", None)
    KEY_REQUIRED = (
        401,
        "A key is required",
        "Send the service's key as `Authorization: Bearer KEY` or `X-API-Key: KEY`; its operator has it.",
        None,
    )
    KEY_WRONG = (
        401,
        "The key is wrong",
        "Send the key that the service was started with (HEREABOUTS_READ_KEY); its operator has it.",
        None,
    )
    KEY_NOT_SET = (
        403,
        "No key is set, so only programs on the service's own machine may change anything",
        "Set HEREABOUTS_READ_KEY, restart the service, and send that key. Without a key, send the request from the "
        "service's machine, to localhost and not through a proxy.",
        None,
    )
    NOT_FOUND = (404, "No such path", "See /docs for the paths there are.", None)
    INDEX_NOT_FOUND = (404, "No such index", "GET /info names the indexes that are served.", None)
    CELL_NOT_FOUND = (404, "No such cell", "Take a cell_id from an answer of the index that is served now.", None)
    MAP_NOT_FOUND = (
        404,
        "No such map, or no such part of it",
        "/info names the map and its number of parts.",
        None,
    )
    JOB_NOT_FOUND = (404, "No such job", "Finished jobs are kept for a while only; start another.", None)
    METHOD_NOT_ALLOWED = (405, "The path does not take this method", "See the Allow header.", None)
    NOT_ACCEPTABLE = (406, "No such format", "Accept application/json or application/geo+json.", None)
    NO_GEOREFERENCE = (406, "The map has no latitude and longitude", "Accept application/json.", None)
    BODY_TOO_SLOW = (408, "The body did not come in time", "Send it without a pause, or send less.", None)
    INDEX_BROKEN = (
        409,
        "The index directory is broken",
        "Its aliases.json cannot be read; its operator has to restore it or build the index again.",
        None,
    )
    NOT_WRITABLE = (
        409,
        "The service cannot write",
        "Its directory is read-only, or the disk is full; its operator has to see to that. Nothing was changed.",
        None,
    )
    BODY_TOO_LARGE = (413, "The body is too large", "Send less; /info shows the limits.", None)
    UNSUPPORTED_MEDIA_TYPE = (415, "The body is of another type", "Send Content-Type: application/json.", None)
    INVALID_REQUEST = (422, "The request cannot be used", "Correct the fields listed in `errors`.", None)
    QUEUE_FULL = (429, "Too many requests wait", "Ask again after Retry-After seconds.", 1)
    BODIES_FULL = (429, "Too many large bodies at once", "Ask again after Retry-After seconds.", 2)
    JOBS_FULL = (429, "Too many evaluations wait", "Ask again after Retry-After seconds, or cancel one.", 30)
    CLIENT_CLOSED_REQUEST = (499, "The client left", "Nobody reads this; it is for the log.", None)
    INTERNAL_ERROR = (500, "A fault in the service", "Report it with the request_id.", None)
    NOT_READY = (503, "The model is still loading", "Ask again after Retry-After seconds.", 2)
    DRAINING = (503, "The service is shutting down", "Ask another replica, or again after Retry-After seconds.", 5)
    STORE_UNAVAILABLE = (
        503,
        "The store of vectors does not answer",
        "Ask again after Retry-After seconds; its operator sees to Milvus.",
        2,
    )
    LOAD_FAILED = (503, "The index or the model could not be loaded", "The operator must correct it.", None)
    DEADLINE_EXCEEDED = (504, "No answer before the deadline", "Allow more deadline_ms, or ask again later.", None)

    def __init__(self, status: int, title: str, remedy: str, retry_after_s: int | None) -> None:
        self.status = status
        self.title = title
        self.remedy = remedy
        self.retry_after_s = retry_after_s

    @property
    def code(self) -> str:
        """What a client compares with."""
        return self.name.lower()


_BY_STATUS = {
    code.status: code
    for code in (
        Code.INVALID_JSON,
        Code.NOT_FOUND,
        Code.METHOD_NOT_ALLOWED,
        Code.NOT_ACCEPTABLE,
        Code.BODY_TOO_LARGE,
        Code.UNSUPPORTED_MEDIA_TYPE,
        Code.INVALID_REQUEST,
    )
}


class FieldError(BaseModel):
    """One field that is wrong."""

    field: str = Field(examples=["within.bbox[3]"])
    message: str


class ProblemBody(BaseModel):
    """Any error of the service (RFC 9457); compare `code`, show `detail`."""

    model_config = ConfigDict(title="Problem")

    type: str
    title: str
    status: int
    detail: str
    code: str = Field(description="; ".join(f"{code.code} ({code.status})" for code in Code))
    request_id: str
    errors: list[FieldError] | None = Field(None, description="with code invalid_request: what is wrong where")


class Problem(HTTPException):
    """An error on its way to the client."""

    def __init__(
        self,
        code: Code,
        detail: str | None = None,
        errors: Sequence[FieldError] = (),
        retry_after_s: int | None = None,
    ) -> None:
        retry_after_s = retry_after_s or code.retry_after_s
        headers = {} if retry_after_s is None else {"Retry-After": str(retry_after_s)}
        super().__init__(code.status, detail or code.remedy, headers)
        self.code = code
        self.errors = tuple(errors)

    @classmethod
    def of_field(cls, field: str, message: str) -> "Problem":
        """A 422 about one field."""
        return cls(Code.INVALID_REQUEST, f"{field}: {message}", [FieldError(field=field, message=message)])

    def body(self) -> dict[str, Any]:
        """The problem+json object."""
        return ProblemBody(
            type=f"urn:hereabouts:problem:{self.code.code}",
            title=self.code.title,
            status=self.code.status,
            detail=self.detail,
            code=self.code.code,
            request_id=correlation_id.get() or "",
            errors=list(self.errors) or None,
        ).model_dump(exclude_none=True)

    def response(self) -> Response:
        """The problem as a response."""
        return JSONResponse(self.body(), self.status_code, self.headers, media_type=PROBLEM_JSON)


def add_error_handlers(app: FastAPI) -> None:
    """Make every error of an application a problem."""
    for kind in (RequestValidationError, WeightsError, ReplyError, StoreUnavailable):
        app.add_exception_handler(kind, _on_error)
    app.add_exception_handler(StarletteHTTPException, _on_http_exception)


def as_problem(error: Exception) -> "Problem":
    """An error as clients see it.

    Raises:
        Exception: it is a fault of the service.
    """
    if isinstance(error, Problem):
        return error
    if isinstance(error, RequestValidationError):
        return _of_fields(error)
    if isinstance(error, WeightsError):  # the retriever was loaded before, so it is what `refine` asks for
        return Problem.of_field("refine", "this service has no usable model for it; leave it out")
    if isinstance(error, ReplyError):  # only the map knows what can be asked, so the model finds it
        return Problem.of_field(f"answers[{error.number}].{error.field}", error.advice)
    if isinstance(error, StoreUnavailable):
        log.warning("store unavailable", reason=str(error))
        return Problem(Code.STORE_UNAVAILABLE)
    raise error


async def _on_error(_request: Request, error: Exception) -> Response:
    return as_problem(error).response()


async def _on_http_exception(request: Request, error: Exception) -> Response:
    if isinstance(error, Problem):
        return error.response()
    if not isinstance(error, StarletteHTTPException):
        raise error
    problem = Problem(_BY_STATUS.get(error.status_code, Code.INTERNAL_ERROR))
    problem.headers = {**(problem.headers or {}), **(error.headers or {})}
    if problem.code is Code.METHOD_NOT_ALLOWED:
        problem.headers["Allow"] = ", ".join(sorted(_methods(request)))
    return problem.response()


def _methods(request: Request) -> set[str]:
    """The methods that a path takes, of all its routes."""
    methods: set[str] = set()
    for route in (*request.app.routes, *request.app.state.routes):
        if isinstance(route, Route) and route.matches(request.scope)[0] is not Match.NONE:
            methods |= route.methods or set()
    return methods


def _of_fields(error: RequestValidationError) -> Problem:
    found = dict.fromkeys(  # one parameter may be read in two places, and so be wrong twice
        (field_name(item["loc"], item.get("ctx", {})), SAID.get(item["type"], item["msg"])) for item in error.errors()
    )
    listed = [FieldError(field=field, message=message) for field, message in islice(found, MAX_LISTED_ERRORS)]
    detail = f"{listed[0].field}: {listed[0].message}"
    if len(found) > 1:
        detail += f" (and {len(found) - 1} more)"
    problem = Problem(Code.INVALID_REQUEST, detail, listed)
    while len(problem.response().body) > MAX_BYTES and len(problem.errors) > 1:
        problem.errors = problem.errors[:-1]
    return problem


def field_name(location: Sequence[str | int], context: Mapping[str, Any]) -> str:
    """Name of a field as a client would write it: "within.bbox[3]".

    Args:
        location: pydantic's path, which begins with where the field is ("body", "path").
        context: of the error; its "field", if any, is part of the path (checks of several fields give it).
    """
    name = ""
    within = (int(step) if step.isdecimal() else step for step in context.get("field", "").split("."))
    for step in (*location[1:], *within):
        if isinstance(step, int):
            name += f"[{step}]"
        elif step:
            # A name we do not know is the client's text: shown only if it is a plain, short word.
            name += f".{step}" if _PLAIN_NAME.fullmatch(step) else ".(unknown)"
    return name.lstrip(".") or "(body)"
