"""Errors as RFC 9457 problem+json, with one table of stable codes. Problems never echo the input."""

import re
from collections.abc import Mapping, Sequence
from enum import Enum
from itertools import islice
from typing import Any

import structlog
from asgi_correlation_id import correlation_id
from fastapi import FastAPI, HTTPException, Request
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, ConfigDict, Field, ValidationError
from starlette.exceptions import HTTPException as StarletteHTTPException
from starlette.responses import JSONResponse, Response
from starlette.routing import Match, Route

from models.errors import ReplyError, StoreUnavailable, WeightsError

PROBLEM_JSON = "application/problem+json"
MAX_LISTED_ERRORS = 20  # invalid fields in one problem
MAX_PROBLEM_BYTES = 1024  # a longer problem lists fewer fields
FIELD_MESSAGES = {  # by pydantic's type of error, with fields of its context
    "missing": "is missing; give it",
    "extra_forbidden": "is unknown; leave it out",
    "int_type": "must be a whole number",
    "int_parsing": "must be a whole number",
    "int_from_float": "must be a whole number",
    "int_parsing_size": "has too many digits; send fewer",
    "float_type": "must be a number",
    "float_parsing": "must be a number",
    "finite_number": "must be a finite number",
    "greater_than_equal": "must be at least {ge}",
    "less_than_equal": "must be at most {le}",
    "bool_type": "must be true or false",
    "bool_parsing": "must be true or false",
    "string_type": "must be a string",
    "string_unicode": "must be valid Unicode",
    "string_too_short": "must have {min_length} or more characters",
    "string_too_long": "must have {max_length} or fewer characters",
    "string_pattern_mismatch": "must match {pattern}",
    "literal_error": "must be {expected}",
    "list_type": "must be a list",
    "tuple_type": "must be a list",
    "too_short": "must have {min_length} or more items",
    "too_long": "must have {max_length} or fewer items",
    "dict_type": "must be a JSON object",
    "model_type": "must be a JSON object",
    "model_attributes_type": "must be a JSON object",
}
log = structlog.get_logger()
_PLAIN_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,63}")


class Code(Enum):
    """All errors of the service; the member's name in lower case is the stable `code`."""

    INVALID_JSON = (400, "The body is not JSON", "Send one JSON object in UTF-8.")
    KEY_REQUIRED = (
        401,
        "A key is required",
        "Send the service's key as `Authorization: Bearer KEY` or `X-API-Key: KEY`; ask the operator for it.",
    )
    KEY_WRONG = (
        401,
        "The key is wrong",
        "Send the key that the service was started with (HEREABOUTS_READ_KEY); ask the operator for it.",
    )
    KEY_NOT_SET = (
        403,
        "No key is set, so only local requests may change anything",
        "Set HEREABOUTS_READ_KEY, restart the service, and send that key. Without a key, send the request from the "
        "service's machine, to localhost and not through a proxy.",
    )
    NOT_FOUND = (404, "No such path", "Use a path that /docs lists.")
    INDEX_NOT_FOUND = (404, "No such index", "GET /info lists the served indexes.")
    CELL_NOT_FOUND = (404, "No such cell", "Use a cell_id from an answer of the current index version.")
    MAP_NOT_FOUND = (
        404,
        "No such map, or no such part of it",
        "GET /info gives the map's name and its number of parts.",
    )
    JOB_NOT_FOUND = (404, "No such job", "Finished jobs are kept only for a while; start a new one.")
    CORRECTIONS_OFF = (
        404,
        "The service stores no corrections",
        "Its operator has to set HEREABOUTS_CORRECTIONS_FILE and serve a map with latitude and longitude.",
    )
    METHOD_NOT_ALLOWED = (405, "The path does not support this method", "Use a method of the Allow header.")
    NOT_ACCEPTABLE = (
        406,
        "The format is not available",
        "Accept application/json, or another format that /docs lists.",
    )
    NO_GEOREFERENCE = (406, "The map has no latitude and longitude", "Accept application/json.")
    BODY_TOO_SLOW = (408, "The body did not arrive in time", "Send it without pauses, or send a smaller body.")
    INDEX_BROKEN = (
        409,
        "The index directory is broken",
        "Its aliases.json cannot be read; the operator has to restore it or build the index again.",
    )
    NOT_WRITABLE = (
        409,
        "The service cannot write to its directory",
        "The directory is read-only or the disk is full; the operator has to fix that. Nothing was changed.",
    )
    BODY_TOO_LARGE = (413, "The body is too large", "Send a smaller body; GET /info gives the limits.")
    UNSUPPORTED_MEDIA_TYPE = (
        415,
        "The body has the wrong type",
        "Send Content-Type: application/json; POST /localize/batch also takes text/csv.",
    )
    INVALID_REQUEST = (422, "The request is invalid", "Correct the fields listed in `errors`.")
    QUEUE_FULL = (429, "Too many requests are waiting", "Try again after Retry-After seconds.", 1)
    BODIES_FULL = (429, "Too many large bodies at once", "Try again after Retry-After seconds.", 2)
    JOBS_FULL = (429, "Too many evaluations are waiting", "Try again after Retry-After seconds, or cancel one.", 30)
    CLIENT_CLOSED_REQUEST = (499, "The client closed the connection", "This appears only in the log.")
    INTERNAL_ERROR = (500, "Internal error", "Report it with the request_id.")
    NOT_READY = (503, "The model is still loading", "Try again after Retry-After seconds.", 2)
    DRAINING = (503, "The service is shutting down", "Try another replica, or try again after Retry-After seconds.", 5)
    STORE_UNAVAILABLE = (
        503,
        "The vector store does not answer",
        "Try again after Retry-After seconds; if it persists, the operator has to check Milvus.",
        2,
    )
    LOAD_FAILED = (
        503,
        "The index or the model could not be loaded",
        "The reason is in the service's log, for its operator.",
    )
    DEADLINE_EXCEEDED = (504, "No answer before the deadline", "Send a larger deadline_ms, or try again later.")

    def __init__(self, status: int, title: str, remedy: str, retry_after_s: int | None = None) -> None:
        self.status, self.title, self.remedy, self.retry_after_s = status, title, remedy, retry_after_s

    @property
    def code(self) -> str:
        """The stable code that clients compare with."""
        return self.name.lower()


_FIRST_OF_STATUS = {code.status: code for code in reversed(Code)}  # for errors of Starlette itself


class FieldError(BaseModel):
    """An invalid field and what is wrong with it."""

    field: str = Field(examples=["within.bbox[3]"])
    message: str


class ProblemBody(BaseModel):
    """An error of the service (RFC 9457). Programs compare `code`; people read `detail`."""

    model_config = ConfigDict(title="Problem")

    type: str
    title: str
    status: int
    detail: str
    code: str = Field(description="; ".join(f"{code.code} ({code.status})" for code in Code))
    request_id: str
    errors: list[FieldError] | None = Field(None, description="the invalid fields; only with code invalid_request")


class Problem(HTTPException):
    """An error that is sent to the client."""

    def __init__(
        self, code: Code, detail: str | None = None, errors: Sequence[FieldError] = (), retry_after_s: int | None = None
    ) -> None:
        retry_after_s = retry_after_s or code.retry_after_s
        headers = {} if retry_after_s is None else {"Retry-After": str(retry_after_s)}
        super().__init__(code.status, detail or code.remedy, headers)
        self.code = code
        self.errors = tuple(errors)

    @classmethod
    def for_body(cls, error: ValidationError) -> "Problem":
        """Return the 422 about a body that was validated outside FastAPI."""
        return _validation_problem(RequestValidationError([{**e, "loc": ("body", *e["loc"])} for e in error.errors()]))

    @classmethod
    def for_field(cls, field: str, message: str) -> "Problem":
        """Return a 422 about one field."""
        return cls(Code.INVALID_REQUEST, f"{field}: {message}", [FieldError(field=field, message=message)])

    def body(self) -> dict[str, Any]:
        """Return the problem+json object."""
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
        """Return the problem as a response."""
        return JSONResponse(self.body(), self.status_code, self.headers, media_type=PROBLEM_JSON)


def add_error_handlers(app: FastAPI) -> None:
    """Turn every error of an application into a problem."""
    for kind in (RequestValidationError, WeightsError, ReplyError, StoreUnavailable):
        app.add_exception_handler(kind, _on_error)
    app.add_exception_handler(StarletteHTTPException, _on_http_exception)


def as_problem(error: Exception) -> "Problem":
    """Return the problem that describes an error; an internal error is raised again."""
    if isinstance(error, Problem):
        return error
    if isinstance(error, RequestValidationError):
        return _validation_problem(error)
    if isinstance(error, WeightsError):  # the retriever is loaded already, so `refine` needs the missing weights
        return Problem.for_field("refine", "this service has no usable model for it; leave it out")
    if isinstance(error, ReplyError):  # only the map knows the possible questions, so the localizer checks replies
        return Problem.for_field(f"answers[{error.number}].{error.field}", error.advice)
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
    problem = Problem(_FIRST_OF_STATUS.get(error.status_code, Code.INTERNAL_ERROR))
    problem.headers = {**(problem.headers or {}), **(error.headers or {})}
    if problem.code is Code.METHOD_NOT_ALLOWED:
        problem.headers["Allow"] = ", ".join(sorted(_methods(request)))
    return problem.response()


def _methods(request: Request) -> set[str]:
    methods: set[str] = set()
    for route in (*request.app.routes, *request.app.state.routes):
        if isinstance(route, Route) and route.matches(request.scope)[0] is not Match.NONE:
            methods |= route.methods or set()
    return methods | ({"HEAD"} if "GET" in methods else set())


def _validation_problem(error: RequestValidationError) -> Problem:
    messages_by_field = dict.fromkeys(  # a parameter that is declared twice is reported twice
        (field_name(item["loc"], item.get("ctx", {})), field_message(item)) for item in error.errors()
    )
    listed = [
        FieldError(field=field, message=message) for field, message in islice(messages_by_field, MAX_LISTED_ERRORS)
    ]
    detail = f"{listed[0].field}: {listed[0].message}"
    if len(messages_by_field) > 1:
        detail += f" (and {len(messages_by_field) - 1} more)"
    problem = Problem(Code.INVALID_REQUEST, detail, listed)
    while len(problem.response().body) > MAX_PROBLEM_BYTES and len(problem.errors) > 1:
        problem.errors = problem.errors[:-1]
    return problem


def field_message(error: Mapping[str, Any]) -> str:
    """Return pydantic's error as a sentence that says what to send."""
    if error["type"] not in FIELD_MESSAGES:
        return str(error["msg"])
    return FIELD_MESSAGES[error["type"]].format_map(error.get("ctx", {}))


def field_name(location: Sequence[str | int], context: Mapping[str, Any]) -> str:
    """Return the name of a field as a client writes it: "within.bbox[3]".

    `location` is pydantic's path and begins with the part of the request ("body"). Checks of several fields name the
    invalid one as "field" in pydantic's `context`.
    """
    name = ""
    within = (int(step) if step.isdecimal() else step for step in context.get("field", "").split("."))
    for step in (*location[1:], *within):
        if isinstance(step, int):
            name += f"[{step}]"
        elif step:
            # An unknown name is the client's text; only a short, plain identifier is shown.
            name += f".{step}" if _PLAIN_NAME.fullmatch(step) else ".(unknown)"
    return name.lstrip(".") or "(body)"
