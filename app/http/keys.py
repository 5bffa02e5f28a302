"""Who may ask and who may change: the read key, the admin key. What is new is closed, unless it says it is open."""

import hmac
import re
from collections.abc import Collection, Iterable, Sequence
from typing import Any, Final

from fastapi import APIRouter
from fastapi.routing import APIRoute
from pydantic import SecretStr
from starlette.types import ASGIApp, Receive, Scope, Send

from app.http.errors import Code, Problem
from app.settings import is_local

OPEN: Final[dict[str, Any]] = {"security": []}  # `openapi_extra=` of a route that needs no key; OpenAPI's own words
DOCS: Final = frozenset({("GET", "/docs"), ("GET", "/docs/oauth2-redirect"), ("GET", "/openapi.json")})
ADMIN: Final = "/indexes"
DOCS_ASSETS: Final = "/static-offline-docs/"
SCHEMES: Final[dict[str, Any]] = {
    "bearer": {"type": "http", "scheme": "bearer"},
    "api_key": {"type": "apiKey", "in": "header", "name": "X-API-Key"},
}
SAFE_METHODS: Final = frozenset({"GET", "HEAD", "OPTIONS"})  # RFC 9110, 9.2.1
READING_POSTS: Final = frozenset({"/localize", "/localize/batch", "/describe"})  # have a body, and change nothing
FORWARDED_PREFIX: Final = b"x-forwarded"
FORWARDED_HEADERS: Final = frozenset(  # a reverse proxy, a tunnel or a content delivery network sends one of them
    {
        b"forwarded",
        b"via",
        b"x-real-ip",
        b"x-client-ip",
        b"x-cluster-client-ip",
        b"x-original-host",
        b"x-original-forwarded-for",
        b"x-envoy-external-address",
        b"true-client-ip",
        b"cf-connecting-ip",
        b"fastly-client-ip",
    }
)
_HOST: Final = re.compile(r"(\[(?P<address>[^\[\]]+)\]|(?P<name>[^\[\]:]+))(:\d*)?")
CHALLENGE: Final = 'Bearer realm="hereabouts"'  # RFC 6750, 3: without an error where no key was sent

Headers = Iterable[tuple[bytes, bytes]]


class KeyCheck:
    """Refuses requests without a key, before a route is looked for, a body is read or a place in the queue is taken.

    Args:
        app: what is served.
        read_key: of what asks; None: nothing.
        admin_key: of what changes the indexes, and of everything else too; None: nothing if the service is local, else
            nobody may.
        is_local: whether only this machine reaches the service.
        open_routes: method and path of what needs no key; HEAD goes with GET. Paths are compared as they are, so one
            with a parameter is never open.
    """

    def __init__(
        self,
        app: ASGIApp,
        read_key: SecretStr | None,
        admin_key: SecretStr | None,
        is_local: bool,
        open_routes: Collection[tuple[str, str]],
    ) -> None:
        self.app = app
        self._read_key, self._admin_key = _bytes(read_key), _bytes(admin_key)
        self._is_local = is_local
        self._open_routes = frozenset(open_routes) | DOCS

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request if it may be."""
        if scope["type"] != "lifespan" and not self._is_open(scope):
            try:
                self._check(scope)
            except Problem as problem:
                await problem.response()(scope, receive, send)
                return
        await self.app(scope, receive, send)

    def _check(self, scope: Scope) -> None:
        headers, changes = scope["headers"], is_admin(scope)
        if self._read_key is not None or (changes and self._admin_key is not None):
            check_key(headers, [key for key in (self._read_key, self._admin_key) if key is not None])
        if not changes:
            if self._read_key is None and changes_state(scope) and not is_direct(scope):
                raise _refusal(headers, Code.KEY_NOT_SET, CHALLENGE)
            return
        if self._admin_key is None:
            if self._read_key is not None or not self._is_local or not is_direct(scope):
                raise _refusal(headers, Code.ADMIN_OFF, CHALLENGE)
        elif not all(hmac.compare_digest(each, self._admin_key) for each in sent_keys(headers)):
            raise _refusal(headers, Code.ADMIN_KEY_REQUIRED, CHALLENGE)

    def _is_open(self, scope: Scope) -> bool:
        if scope["type"] != "http":
            return False
        method = "GET" if scope["method"] == "HEAD" else scope["method"]
        is_asset = method == "GET" and scope["path"].startswith(DOCS_ASSETS)
        return is_asset or (method, scope["path"]) in self._open_routes


def changes_state(scope: Scope) -> bool:
    """Return whether a request may change what the service keeps, or start work that outlives the request."""
    return scope.get("method") not in SAFE_METHODS and scope["path"] not in READING_POSTS


def is_direct(scope: Scope) -> bool:
    """Return whether a request comes from this machine, addressed to this machine, and not through a proxy.

    The address that the service listens on does not tell: a proxy on this machine connects over loopback too. A page
    that reaches the service by a name of its own (DNS rebinding) is recognized by its Host header.
    """
    client = scope.get("client")
    hosts = [value for name, value in scope["headers"] if name == b"host"]
    return (
        client is not None
        and is_local(client[0])
        and len(hosts) == 1
        and is_local(_host_name(hosts[0]))
        and not any(name in FORWARDED_HEADERS or name.startswith(FORWARDED_PREFIX) for name, _ in scope["headers"])
    )


def _host_name(value: bytes) -> str:
    """Return the host of a Host header without its port and without the brackets of an IPv6 address."""
    found = _HOST.fullmatch(value.decode("latin-1").strip())
    return (found["address"] or found["name"]).removesuffix(".").lower() if found else ""


def is_admin(scope: Scope) -> bool:
    """Whether a request would change what is served."""
    path = scope["path"]
    return scope.get("method") not in {"GET", "HEAD", "OPTIONS"} and (path == ADMIN or path.startswith(f"{ADMIN}/"))


def _bytes(key: SecretStr | None) -> bytes | None:
    return None if key is None else key.get_secret_value().encode()


def open_routes(routers: Iterable[APIRouter]) -> set[tuple[str, str]]:
    """Method and path of the routes that say they are open, by `openapi_extra=OPEN`."""
    return {
        (method, route.path)
        for router in routers
        for route in router.routes
        if isinstance(route, APIRoute) and (route.openapi_extra or {}).get("security") == OPEN["security"]
        for method in route.methods or ()
    }


def check_key(headers: Headers, keys: Sequence[bytes]) -> None:
    """Refuse a request by the keys that it brings: each has to be one of those that open.

    Raises:
        Problem: 401, with the challenge that RFC 6750 asks for.
    """
    sent = sent_keys(headers)
    if not sent:
        raise _refusal(headers, Code.KEY_REQUIRED, CHALLENGE)
    if not all([any([hmac.compare_digest(each, key) for key in keys]) for each in sent]):  # noqa: C419  # all are looked at
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
