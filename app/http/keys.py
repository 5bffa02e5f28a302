"""The read key of the service. A new route needs the key unless it is declared open."""

import hmac
import re
from collections.abc import Collection, Iterable
from typing import Any, Final

from fastapi import APIRouter
from fastapi.routing import APIRoute
from pydantic import SecretStr
from starlette.types import ASGIApp, Receive, Scope, Send

from app.http.errors import Code, Problem
from app.http.proxies import route_path
from app.settings import is_local

OPEN: Final[dict[str, Any]] = {"security": []}  # `openapi_extra=` of a route that needs no key, as OpenAPI defines it
DOCS: Final = frozenset({("GET", "/docs"), ("GET", "/docs/oauth2-redirect"), ("GET", "/openapi.json")})
DOCS_ASSETS: Final = "/static-offline-docs/"
SCHEMES: Final[dict[str, Any]] = {
    "bearer": {"type": "http", "scheme": "bearer"},
    "api_key": {"type": "apiKey", "in": "header", "name": "X-API-Key"},
}
SAFE_METHODS: Final = frozenset({"GET", "HEAD", "OPTIONS"})  # RFC 9110, 9.2.1
READING_POSTS: Final = frozenset({"/localize", "/localize/batch", "/describe"})  # have a body but change no state
FORWARDED_PREFIX: Final = b"x-forwarded"
FORWARDED_HEADERS: Final = frozenset({  # a reverse proxy, a tunnel or a content delivery network sends one of them
    b"forwarded", b"via", b"x-real-ip", b"x-client-ip", b"x-cluster-client-ip", b"x-original-host",
    b"x-original-forwarded-for", b"x-envoy-external-address", b"true-client-ip", b"cf-connecting-ip",
    b"fastly-client-ip",
})  # fmt: skip
_HOST: Final = re.compile(r"(\[(?P<address>[^\[\]]+)\]|(?P<name>[^\[\]:]+))(:\d*)?")
CHALLENGE: Final = 'Bearer realm="hereabouts"'  # RFC 6750, 3: without an error where no key was sent

Headers = Iterable[tuple[bytes, bytes]]


class KeyCheck:
    """Middleware that refuses requests without the key before routing, reading the body or queueing.

    Without a key, anyone may read, and only direct requests from this machine change state. `open_routes` never need
    the key; GET includes HEAD. Paths below the root path are compared literally, so one with a parameter is never open.
    """

    def __init__(self, app: ASGIApp, read_key: SecretStr | None, open_routes: Collection[tuple[str, str]]) -> None:
        self.app = app
        self._key = None if read_key is None else read_key.get_secret_value().encode()
        self._open_routes = frozenset(open_routes) | DOCS

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request."""
        if scope["type"] != "lifespan" and not self._is_open(scope):
            try:
                self._check(scope)
            except Problem as problem:
                await problem.response()(scope, receive, send)
                return
        await self.app(scope, receive, send)

    def _check(self, scope: Scope) -> None:
        if self._key is not None:
            check_key(scope["headers"], self._key)
        elif changes_state(scope) and not is_direct(scope):
            raise _refusal(Code.KEY_NOT_SET)

    def _is_open(self, scope: Scope) -> bool:
        if scope["type"] != "http":
            return False
        method = "GET" if scope["method"] == "HEAD" else scope["method"]
        path = route_path(scope)
        return (method == "GET" and path.startswith(DOCS_ASSETS)) or (method, path) in self._open_routes


def changes_state(scope: Scope) -> bool:
    """Return whether a request may change stored state or start work that outlives the request."""
    return scope.get("method") not in SAFE_METHODS and route_path(scope) not in READING_POSTS


def is_direct(scope: Scope) -> bool:
    """Return whether a request comes from this machine, addressed to this machine, and not through a proxy.

    The listening address is not enough: a proxy on this machine connects over loopback too. A web page that reaches the
    service under its own host name (DNS rebinding) is recognized by the Host header, one of another origin by Origin.
    """
    client = scope.get("client")
    hosts = [value for name, value in scope["headers"] if name == b"host"]
    origins = [value.rpartition(b"/")[2] for name, value in scope["headers"] if name == b"origin"]
    return (
        client is not None
        and is_local(client[0])
        and len(hosts) == 1
        and all(is_local(_host_name(host)) for host in (*hosts, *origins))
        and not any(name in FORWARDED_HEADERS or name.startswith(FORWARDED_PREFIX) for name, _ in scope["headers"])
    )


def _host_name(value: bytes) -> str:
    """Return the host of a Host header without port and brackets."""
    match = _HOST.fullmatch(value.decode("latin-1").strip())
    return (match["address"] or match["name"]).removesuffix(".").lower() if match else ""


def open_routes(routers: Iterable[APIRouter]) -> set[tuple[str, str]]:
    """Return the method and path of the routes that are declared open by `openapi_extra=OPEN`."""
    return {
        (method, route.path)
        for router in routers
        for route in router.routes
        if isinstance(route, APIRoute) and (route.openapi_extra or {}).get("security") == OPEN["security"]
        for method in route.methods or ()
    }


def check_key(headers: Headers, key: bytes) -> None:
    """Raise 401 with RFC 6750's challenge unless a request sends the key and no other key."""
    sent = sent_keys(headers)
    if not sent:
        raise _refusal(Code.KEY_REQUIRED, CHALLENGE)
    if not all([hmac.compare_digest(each, key) for each in sent]):  # noqa: C419  # compare all, whatever the first is
        raise _refusal(Code.KEY_WRONG, f'{CHALLENGE}, error="invalid_token"')


def sent_keys(headers: Headers) -> list[bytes]:
    """Return the keys in the headers of a request, ignoring other Authorization schemes such as Basic."""
    keys = []
    for name, value in headers:
        if name == b"x-api-key":
            keys.append(value.strip())
        elif name == b"authorization":
            scheme, _, token = value.strip().partition(b" ")
            if scheme.lower() == b"bearer":
                keys.append(token.strip())
    return [key for key in keys if key]


def _refusal(code: Code, challenge: str | None = None) -> Problem:
    problem = Problem(code)
    problem.headers = {} if challenge is None else {"WWW-Authenticate": challenge}
    return problem
