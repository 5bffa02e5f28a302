"""Bodies that are plain JSON, not too large, alone and together, and there in time."""

import asyncio
import json
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from typing import Any, Final

from starlette.datastructures import Headers as RequestHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.http.errors import Code, Problem

MAX_DEPTH = 32
LARGE_BYTES = 65_536  # from here on a body is checked beside the event loop, which would stand still
LARGE_AT_ONCE = 4  # of the largest bodies
MAX_VALUES = 400_000  # of one body, commas in its texts among them
BODY_S = 30.0  # for all of a body to come
DISCARDED_BYTES, DISCARDING_S = 33_554_432, 5.0  # of a body that is refused
REFUSALS: Final = (  # of a body, whatever the route
    Code.INVALID_JSON,
    Code.BODY_TOO_SLOW,
    Code.BODY_TOO_LARGE,
    Code.UNSUPPORTED_MEDIA_TYPE,
    Code.BODIES_FULL,
)
_CONTENT_TYPE = re.compile(
    r"application/json(?P<parameters>(\s*;\s*[\w.+-]+=(\"[\w .+-]*\"|[\w.+-]+))*)\s*;?\s*", re.A | re.I
)
_CHARSET = re.compile(r";\s*charset=([^\s;]*)", re.I)


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
        self._large = LargeBodies(LARGE_AT_ONCE * max(max_bytes, *self.larger.values(), LARGE_BYTES))

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request with its body checked."""
        if scope["type"] != "http" or scope["method"] not in {"POST", "PUT", "PATCH"}:
            await self.app(scope, receive, send)
            return
        max_bytes = self.larger.get(scope["path"], self.max_bytes)
        with self._large.share() as share:
            await self.app(scope, self._checked(scope, receive, max_bytes, share), send)

    @staticmethod
    def _checked(scope: Scope, receive: Receive, max_bytes: int, share: "Share") -> Receive:
        is_read = False

        async def receive_checked() -> Message:
            nonlocal is_read
            if is_read:
                return await receive()
            is_read = True
            try:
                check_headers(RequestHeaders(scope=scope), max_bytes)
            except Problem as problem:
                await discard(receive)
                raise _closing(problem) from None
            try:
                async with asyncio.timeout(BODY_S):
                    body = await read_body(receive, max_bytes, share)
            except TimeoutError:
                raise _closing(Problem(Code.BODY_TOO_SLOW)) from None
            except Problem as problem:
                raise _closing(problem) from None
            if body is None:
                return {"type": "http.disconnect"}
            if len(body) < LARGE_BYTES:
                check_json(body)
            else:
                await asyncio.to_thread(check_json, body)
            return {"type": "http.request", "body": body, "more_body": False}

        return receive_checked


class LargeBodies:
    """Bounds what all bodies take together that are large.

    Args:
        max_bytes: of all of them.
    """

    def __init__(self, max_bytes: int) -> None:
        self.max_bytes, self.bytes = max_bytes, 0

    @contextmanager
    def share(self) -> Iterator["Share"]:
        """A request's part of it, given back when it is answered."""
        share = Share(self)
        try:
            yield share
        finally:
            self.bytes -= share.taken


class Share:
    """What one request has of `LargeBodies`."""

    def __init__(self, large: LargeBodies) -> None:
        self._large, self.taken = large, 0

    def grow(self, size: int) -> None:
        """Take what a body of this many bytes needs; nothing if it is small.

        Raises:
            Problem: 429, others have it.
        """
        more = size - self.taken if size >= LARGE_BYTES else 0
        if self._large.bytes + more > self._large.max_bytes:
            raise Problem(Code.BODIES_FULL)
        self._large.bytes += more
        self.taken += more


def check_headers(headers: RequestHeaders, max_bytes: int) -> None:
    """Refuse a body by what its headers say.

    Raises:
        Problem: 415, or 413.
    """
    content_type = _CONTENT_TYPE.fullmatch(headers.get("content-type", ""))
    charsets = _CHARSET.findall(content_type["parameters"]) if content_type else []
    if content_type is None or any(charset.strip('"').lower() != "utf-8" for charset in charsets):
        raise Problem(Code.UNSUPPORTED_MEDIA_TYPE)
    if headers.get("content-encoding", "identity").lower() != "identity":
        raise Problem(Code.UNSUPPORTED_MEDIA_TYPE, "Send the body without Content-Encoding.")
    length = headers.get("content-length", "")
    if length.isdecimal() and int(length[:20]) > max_bytes:
        raise _too_large(max_bytes)


async def read_body(receive: Receive, max_bytes: int, share: Share) -> bytes | None:
    """The body, read no further than the limit; None if the client left.

    Raises:
        Problem: 413, or 429.
    """
    body = bytearray()
    while True:
        message = await receive()
        if message["type"] == "http.disconnect":
            return None
        body += message.get("body", b"")
        try:
            if len(body) > max_bytes:
                raise _too_large(max_bytes)
            share.grow(len(body))
        except Problem:
            if message.get("more_body", False):
                await discard(receive)
            raise
        if not message.get("more_body", False):
            return bytes(body)


async def discard(receive: Receive) -> None:
    """Take what a client still sends: one that sends all before it reads would else find its connection reset."""
    left = DISCARDED_BYTES
    with suppress(TimeoutError):
        async with asyncio.timeout(DISCARDING_S):
            while left > 0:
                message = await receive()
                left -= len(message.get("body", b""))
                if not message.get("more_body", False):
                    return


def check_json(body: bytes) -> None:
    """Refuse what JSON parsers disagree about or Python's is too kind to.

    Raises:
        Problem: 400: not UTF-8, not JSON, NaN or Infinity, a key twice, nested too deeply; 413: too many values.
    """
    if len(body) > MAX_VALUES and sum(map(body.count, (b"[", b"{", b","))) > MAX_VALUES:
        raise Problem(Code.BODY_TOO_LARGE, f"The body has more than {MAX_VALUES} values; send less.")
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
        raise Problem(Code.INVALID_JSON, "A key occurs twice in one object; send it once.")
    return value


def _refuse_constant(_name: str) -> None:
    raise Problem(Code.INVALID_JSON, "NaN and Infinity are not JSON; send a number, or leave the field out.")


def _closing(problem: Problem) -> Problem:
    """A problem after which the connection is closed, else the server goes on reading what it throws away."""
    problem.headers = {**(problem.headers or {}), "Connection": "close"}
    return problem


def _too_large(max_bytes: int) -> Problem:
    return Problem(Code.BODY_TOO_LARGE, f"The body has more than {max_bytes} bytes; send less.")


def _too_deep() -> Problem:
    return Problem(Code.INVALID_JSON, f"The body is nested more than {MAX_DEPTH} levels deep; send it flatter.")
