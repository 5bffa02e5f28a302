"""What happens around a route: one log line a request, no fault unanswered, no body that is not plain JSON."""

import asyncio
import json
import re
import time
from collections.abc import Mapping
from email.message import Message as Headers
from typing import Any

import structlog
from asgi_correlation_id import correlation_id
from starlette.datastructures import Headers as RequestHeaders
from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.http.errors import Code, Problem

MAX_DEPTH = 32
LARGE_BYTES = 65_536  # from here on a body is checked beside the event loop, which would stand still
_SANE_ID = re.compile(r"[A-Za-z0-9._-]{1,64}")

log = structlog.get_logger()


def is_sane_request_id(value: str) -> bool:
    """Whether a client's X-Request-ID can go into logs and headers as it is."""
    return _SANE_ID.fullmatch(value) is not None


class AccessLog:
    """Writes a line a request (never its text), and answers 500 for what nobody else has caught."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve and log one request."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        status = 0
        started_s = time.monotonic()

        async def note_status(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
            await send(message)

        try:
            await self.app(scope, receive, note_status)
        except Exception:
            log.exception("fault", request_id=correlation_id.get())
            if status:
                raise
            await Problem(Code.INTERNAL_ERROR).response()(scope, receive, note_status)
        finally:
            log.info(
                "request",
                method=scope["method"],
                route=getattr(scope.get("route"), "path", "other"),
                status=status,
                ms=round((time.monotonic() - started_s) * 1000, 1),
                request_id=correlation_id.get(),
            )


class NoSniff:
    """Has browsers take every answer for what its Content-Type says."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request."""

        async def send_marked(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message)["X-Content-Type-Options"] = "nosniff"
            await send(message)

        await self.app(scope, receive, send_marked)


class StrictBody:
    """Checks a body when the route first asks for it, so that an unknown path is a 404 whatever the body.

    Args:
        app: what is served.
        max_bytes: of a body.
        larger: paths whose bodies have another limit.
    """

    def __init__(self, app: ASGIApp, max_bytes: int, larger: Mapping[str, int] | None = None) -> None:
        self.app = app
        self.max_bytes = max_bytes
        self.larger = larger or {}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request with its body checked."""
        if scope["type"] != "http" or scope["method"] not in {"POST", "PUT", "PATCH"}:
            await self.app(scope, receive, send)
            return
        max_bytes = self.larger.get(scope["path"], self.max_bytes)
        is_read = False

        async def receive_checked() -> Message:
            nonlocal is_read
            if is_read:
                return await receive()
            is_read = True
            try:
                check_headers(RequestHeaders(scope=scope), max_bytes)
                body = await read_body(receive, max_bytes)
            except Problem as problem:
                # Else the server goes on reading what it throws away.
                problem.headers = {**(problem.headers or {}), "Connection": "close"}
                raise
            if body is None:
                return {"type": "http.disconnect"}
            if len(body) < LARGE_BYTES:
                check_json(body)
            else:
                await asyncio.to_thread(check_json, body)
            return {"type": "http.request", "body": body, "more_body": False}

        await self.app(scope, receive_checked, send)


def check_headers(headers: RequestHeaders, max_bytes: int) -> None:
    """Refuse a body by what its headers say.

    Raises:
        Problem: 415, or 413.
    """
    content_type = Headers()
    content_type["content-type"] = headers.get("content-type", "")
    charset = content_type.get_content_charset("utf-8")
    # email's default for a missing or broken header is text/plain, which is refused as well.
    if content_type.get_content_type() != "application/json" or charset != "utf-8":
        raise Problem(Code.UNSUPPORTED_MEDIA_TYPE)
    if headers.get("content-encoding", "identity").lower() != "identity":
        raise Problem(Code.UNSUPPORTED_MEDIA_TYPE, "Send the body without Content-Encoding.")
    length = headers.get("content-length", "")
    if length.isdecimal() and int(length[:20]) > max_bytes:
        raise _too_large(max_bytes)


async def read_body(receive: Receive, max_bytes: int) -> bytes | None:
    """The body, read no further than the limit; None if the client left.

    Raises:
        Problem: 413.
    """
    body = bytearray()
    while True:
        message = await receive()
        if message["type"] == "http.disconnect":
            return None
        body += message.get("body", b"")
        if len(body) > max_bytes:
            raise _too_large(max_bytes)
        if not message.get("more_body", False):
            return bytes(body)


def check_json(body: bytes) -> None:
    """Refuse what JSON parsers disagree about or Python's is too kind to.

    Raises:
        Problem: 400: not UTF-8, not JSON, NaN or Infinity, a key twice, nested too deeply.
    """
    try:
        value = json.loads(body.decode(), object_pairs_hook=_unique, parse_constant=_refuse_constant)
    except UnicodeDecodeError:
        raise Problem(Code.INVALID_JSON, "The body is not UTF-8.") from None
    except RecursionError:
        raise _too_deep() from None
    except json.JSONDecodeError as error:
        where = f"line {error.lineno} column {error.colno}"
        raise Problem(Code.INVALID_JSON, f"The body is not JSON at {where}; send one JSON object.") from None
    except ValueError:
        raise Problem(Code.INVALID_JSON, "A number in the body has too many digits.") from None
    level: list[Any] = [value]
    for _ in range(MAX_DEPTH):
        level = [inner for outer in level for inner in _children(outer)]
        if not level:
            return
    raise _too_deep()


def _children(value: object) -> list[Any]:
    if isinstance(value, dict):
        return list(value.values())
    return value if isinstance(value, list) else []


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    value = dict(pairs)
    if len(value) != len(pairs):
        raise Problem(Code.INVALID_JSON, "A key occurs twice in one object.")
    return value


def _refuse_constant(_name: str) -> None:
    raise Problem(Code.INVALID_JSON, "NaN and Infinity are not JSON.")


def _too_large(max_bytes: int) -> Problem:
    return Problem(Code.BODY_TOO_LARGE, f"The body has more than {max_bytes} bytes; send less.")


def _too_deep() -> Problem:
    return Problem(Code.INVALID_JSON, f"The body is nested more than {MAX_DEPTH} levels deep.")
