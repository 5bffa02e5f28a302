"""Who may ask: the read key. Every route needs it but those that say they are open; what is new is closed."""

import hmac
from collections.abc import Collection, Iterable
from typing import Any, Final

from fastapi import APIRouter
from fastapi.routing import APIRoute
from pydantic import SecretStr
from starlette.types import ASGIApp, Receive, Scope, Send

from app.http.errors import Code, Problem

OPEN: Final[dict[str, Any]] = {"security": []}  # `openapi_extra=` of a route that needs no key; OpenAPI's own words
DOCS: Final = frozenset({("GET", "/docs"), ("GET", "/docs/oauth2-redirect"), ("GET", "/openapi.json")})
DOCS_ASSETS: Final = "/static-offline-docs/"
SCHEMES: Final[dict[str, Any]] = {
    "bearer": {"type": "http", "scheme": "bearer"},
    "api_key": {"type": "apiKey", "in": "header", "name": "X-API-Key"},
}
CHALLENGE: Final = 'Bearer realm="hereabouts"'  # RFC 6750, 3: without an error where no key was sent

Headers = Iterable[tuple[bytes, bytes]]


class KeyCheck:
    """Refuses requests without the key, before a route is looked for, a body is read or a place in the queue is taken.

    Args:
        app: what is served.
        key: the key.
        open_routes: method and path of what needs no key; HEAD goes with GET. Paths are compared as they are, so one
            with a parameter is never open.
    """

    def __init__(self, app: ASGIApp, key: SecretStr, open_routes: Collection[tuple[str, str]]) -> None:
        self.app = app
        self._key = key.get_secret_value().encode()
        self._open_routes = frozenset(open_routes) | DOCS

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request if it may be."""
        if scope["type"] != "lifespan" and not self._is_open(scope):
            try:
                check_key(scope["headers"], self._key)
            except Problem as problem:
                await problem.response()(scope, receive, send)
                return
        await self.app(scope, receive, send)

    def _is_open(self, scope: Scope) -> bool:
        if scope["type"] != "http":
            return False
        method = "GET" if scope["method"] == "HEAD" else scope["method"]
        is_asset = method == "GET" and scope["path"].startswith(DOCS_ASSETS)
        return is_asset or (method, scope["path"]) in self._open_routes


def open_routes(routers: Iterable[APIRouter]) -> set[tuple[str, str]]:
    """Method and path of the routes that say they are open, by `openapi_extra=OPEN`."""
    return {
        (method, route.path)
        for router in routers
        for route in router.routes
        if isinstance(route, APIRoute) and (route.openapi_extra or {}).get("security") == OPEN["security"]
        for method in route.methods or ()
    }


def check_key(headers: Headers, key: bytes) -> None:
    """Refuse a request by the keys that it brings: all of them have to be right.

    Raises:
        Problem: 401, with the challenge that RFC 6750 asks for.
    """
    sent = sent_keys(headers)
    if not sent:
        raise _refusal(headers, Code.KEY_REQUIRED, CHALLENGE)
    if not all(hmac.compare_digest(each, key) for each in sent):
        raise _refusal(headers, Code.KEY_WRONG, f'{CHALLENGE}, error="invalid_token"')


def sent_keys(headers: Headers) -> list[bytes]:
    """The keys in a request's headers; Authorization of another kind, a proxy's Basic for example, is none."""
    keys = []
    for name, value in headers:
        if name == b"x-api-key":
            keys.append(value.strip())
        elif name == b"authorization":
            scheme, _, token = value.strip().partition(b" ")
            if scheme.lower() == b"bearer":
                keys.append(token.strip())
    return [key for key in keys if key]


def _refusal(headers: Headers, code: Code, challenge: str) -> Problem:
    problem = Problem(code)
    problem.headers = {"WWW-Authenticate": challenge}
    if not {b"content-length", b"transfer-encoding"}.isdisjoint(name for name, _ in headers):
        problem.headers["Connection"] = "close"  # else the server goes on reading what it throws away
    return problem
