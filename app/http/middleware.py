"""Middleware around all routes: the access log, the answer to internal errors, security headers and HEAD."""

import re
import time

import structlog
from asgi_correlation_id import correlation_id
from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.http.errors import Code, Problem
from app.http.metrics import OTHER, Metrics, known_method

_SANE_ID = re.compile(r"[A-Za-z0-9._-]{1,64}")

log = structlog.get_logger()


def is_sane_request_id(value: str) -> bool:
    """Return whether a client's X-Request-ID is safe in logs and headers."""
    return _SANE_ID.fullmatch(value) is not None


def descriptions_of(scope: Scope) -> list[str]:
    """Return the descriptions of one request, to which its route adds; they are logged only if the settings say so."""
    return scope.setdefault("hereabouts.descriptions", [])


def reply_languages_of(scope: Scope) -> list[str]:
    """Return the languages of the answers to one request, to which its route adds."""
    return scope.setdefault("hereabouts.reply_languages", [])


class AccessLog:
    """Middleware that logs and counts each request, and answers uncaught exceptions with 500."""

    def __init__(self, app: ASGIApp, metrics: Metrics, log_descriptions: bool) -> None:
        self.app = app
        self._metrics = metrics
        self._log_descriptions = log_descriptions

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        method, status, descriptions = scope["method"], 0, descriptions_of(scope)
        started_s = time.monotonic()

        async def note_status(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
            await send(message)

        try:
            await self.app(scope, receive, note_status)
        except Exception:
            log.exception("internal error", request_id=correlation_id.get())
            if status:
                raise
            await Problem(Code.INTERNAL_ERROR).response()(scope, receive, note_status)
        finally:
            route, seconds = getattr(scope.get("route"), "path", OTHER), time.monotonic() - started_s
            self._metrics.record(method, route, status, seconds)
            log.info(
                "request",
                method=known_method(method),
                route=route,
                status=status,
                ms=round(seconds * 1000, 1),
                request_id=correlation_id.get(),
                **({"descriptions": descriptions} if self._log_descriptions and descriptions else {}),
            )


class SafeHeaders:
    """Middleware that makes browsers trust the Content-Type and run nothing in JSON and XML answers."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request."""

        async def send_marked(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                headers["X-Content-Type-Options"] = "nosniff"
                headers.setdefault("Referrer-Policy", "no-referrer")
                if re.search("json|text/xml", headers.get("content-type", "")):
                    headers.setdefault("Content-Security-Policy", "default-src 'none'; frame-ancestors 'none'")
            await send(message)

        await self.app(scope, receive, send_marked)


class HeadAsGet:
    """Middleware that answers HEAD with the headers of GET."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request."""
        if scope["type"] != "http" or scope["method"] != "HEAD":
            await self.app(scope, receive, send)
            return
        is_sent = False

        async def send_head(message: Message) -> None:
            nonlocal is_sent
            if message["type"] == "http.response.start":
                await send(message)
            elif not is_sent:  # an event stream would send more
                is_sent = True
                await send({"type": "http.response.body"})

        scope["method"] = "GET"
        await self.app(scope, receive, send_head)
