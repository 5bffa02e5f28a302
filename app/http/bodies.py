"""Limits on request bodies: strict JSON or CSV, bounded size (each and in total), and bounded time."""

import asyncio
import json
import re
from codecs import BOM_UTF8
from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, Final

from starlette.datastructures import Headers as RequestHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.http.errors import Code, Problem
from app.http.proxies import route_path

CSV: Final = "text/csv"
MAX_JSON_DEPTH: Final = 32
MAX_JSON_VALUES: Final = 400_000  # of one body; commas inside strings count too
LARGE_BODY_BYTES: Final = 65_536  # larger bodies are parsed in a thread, so that the event loop is not blocked
MAX_LARGE_BODIES: Final = 4  # of the largest size, in memory at once
BODY_TIMEOUT_S: Final = 30.0  # for the whole body to arrive
REFUSALS: Final = (  # problems of a body, on any route
    Code.INVALID_JSON,
    Code.BODY_TOO_SLOW,
    Code.BODY_TOO_LARGE,
    Code.UNSUPPORTED_MEDIA_TYPE,
    Code.BODIES_FULL,
)
_CONTENT_TYPE = re.compile(
    r"(?P<type>application/json|text/csv)(?P<parameters>(\s*;\s*[\w.+-]+=(\"[\w .+-]*\"|[\w.+-]+))*)\s*;?\s*",
    re.A | re.I,
)
_CHARSET = re.compile(r";\s*charset=([^\s;]*)", re.I)

Reserve = Callable[[int], None]  # for a body of this size


class StrictBody:
    """Middleware that checks a body when the route first reads it, so that an unknown path is a 404 whatever the body.

    `larger` maps paths to limits other than `max_bytes`; `tables` are the paths that also take CSV, which they check.
    """

    def __init__(
        self, app: ASGIApp, max_bytes: int, larger: Mapping[str, int] | None = None, tables: Collection[str] = ()
    ) -> None:
        self.app = app
        self.tables = tables
        self.max_bytes = max_bytes
        self.larger = larger or {}
        self._large = LargeBodies(MAX_LARGE_BODIES * max(max_bytes, *self.larger.values(), LARGE_BODY_BYTES))

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request."""
        if scope["type"] != "http" or scope["method"] not in {"POST", "PUT", "PATCH"}:
            await self.app(scope, receive, send)
            return
        max_bytes = self.larger.get(route_path(scope), self.max_bytes)
        with self._large.reservation() as reserve:
            await self.app(scope, self._checked(scope, receive, max_bytes, reserve), send)

    def _checked(self, scope: Scope, receive: Receive, max_bytes: int, reserve: Reserve) -> Receive:
        is_read = False

        async def receive_checked() -> Message:
            nonlocal is_read
            if is_read:
                return await receive()
            is_read = True
            media_type = check_headers(RequestHeaders(scope=scope), max_bytes)
            if media_type == CSV and route_path(scope) not in self.tables:
                raise Problem(Code.UNSUPPORTED_MEDIA_TYPE)
            try:
                async with asyncio.timeout(BODY_TIMEOUT_S):
                    body = await read_body(receive, max_bytes, reserve)
            except TimeoutError:
                problem = Problem(Code.BODY_TOO_SLOW)
                problem.headers = {"Connection": "close"}  # RFC 9110, 15.5.9
                raise problem from None
            if body is None:
                return {"type": "http.disconnect"}
            if media_type != CSV:  # the route checks tables
                body = body.removeprefix(BOM_UTF8)
                if len(body) < LARGE_BODY_BYTES:
                    check_json(body)
                else:
                    await asyncio.to_thread(check_json, body)
            return {"type": "http.request", "body": body, "more_body": False}

        return receive_checked


class LargeBodies:
    """A bound in bytes on all large bodies together."""

    def __init__(self, max_bytes: int) -> None:
        self.max_bytes, self.bytes = max_bytes, 0

    @contextmanager
    def reservation(self) -> Iterator[Reserve]:
        """Yield a function that reserves memory for the body of one request; 429 if other requests use all of it."""
        reserved = 0

        def reserve(size: int) -> None:
            nonlocal reserved
            more = size - reserved if size >= LARGE_BODY_BYTES else 0
            if self.bytes + more > self.max_bytes:
                raise Problem(Code.BODIES_FULL)
            self.bytes += more
            reserved += more

        try:
            yield reserve
        finally:
            self.bytes -= reserved


def check_headers(headers: RequestHeaders, max_bytes: int) -> str:
    """Return the media type; raise 415 or 413 if the headers show the wrong type or too large a size."""
    content_type = _CONTENT_TYPE.fullmatch(headers.get("content-type", ""))
    charsets = _CHARSET.findall(content_type["parameters"]) if content_type else []
    if content_type is None or any(charset.strip('"').lower() != "utf-8" for charset in charsets):
        raise Problem(Code.UNSUPPORTED_MEDIA_TYPE)
    if headers.get("content-encoding", "identity").lower() != "identity":
        raise Problem(Code.UNSUPPORTED_MEDIA_TYPE, "Send the body without Content-Encoding.")
    length = headers.get("content-length", "")
    if length.isdecimal() and int(length[:20]) > max_bytes:
        raise _too_large(max_bytes)
    return content_type["type"].lower()


async def read_body(receive: Receive, max_bytes: int, reserve: Reserve) -> bytes | None:
    """Read the body; None if the client disconnected, 413 or 429 if it is too large."""
    body = bytearray()
    while True:
        message = await receive()
        if message["type"] == "http.disconnect":
            return None
        body += message.get("body", b"")
        if len(body) > max_bytes:
            raise _too_large(max_bytes)
        reserve(len(body))
        if not message.get("more_body", False):
            return bytes(body)


def check_json(body: bytes) -> None:
    """Raise 400 for JSON that parsers read differently (NaN, repeated keys, deep nesting), 413 for too many values."""
    if len(body) > MAX_JSON_VALUES and sum(map(body.count, (b"[", b"{", b","))) > MAX_JSON_VALUES:
        raise Problem(Code.BODY_TOO_LARGE, f"The body has more than {MAX_JSON_VALUES} values; send fewer.")
    try:
        value = json.loads(body.decode(), object_pairs_hook=_unique, parse_constant=_refuse_constant)
    except UnicodeDecodeError:
        raise Problem(Code.INVALID_JSON, "The body is not UTF-8; send UTF-8.") from None
    except RecursionError:
        raise _too_deep() from None
    except json.JSONDecodeError as error:
        where = f"line {error.lineno} column {error.colno}"
        raise Problem(Code.INVALID_JSON, f"The body is not JSON at {where}; send one JSON object.") from None
    except ValueError:
        raise Problem(Code.INVALID_JSON, "A number in the body has too many digits; send fewer.") from None
    level: list[Any] = [value]
    for _ in range(MAX_JSON_DEPTH):
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
        raise Problem(Code.INVALID_JSON, "A key occurs twice in one object; send it once.")
    return value


def _refuse_constant(_name: str) -> None:
    raise Problem(Code.INVALID_JSON, "NaN and Infinity are not JSON; send a number, or leave the field out.")


def _too_large(max_bytes: int) -> Problem:
    return Problem(Code.BODY_TOO_LARGE, f"The body has more than {max_bytes} bytes; send a smaller body.")


def _too_deep() -> Problem:
    return Problem(Code.INVALID_JSON, f"The body has more than {MAX_JSON_DEPTH} nested levels; send a flatter body.")
