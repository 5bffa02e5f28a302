"""Requests through reverse proxies: the root path, and the headers of trusted proxies."""

from collections.abc import Sequence
from typing import Any

from starlette.datastructures import Headers
from starlette.responses import RedirectResponse
from starlette.types import ASGIApp, Scope
from uvicorn.middleware.proxy_headers import ProxyHeadersMiddleware

from app.settings import ROOT_PATH


def route_path(scope: Scope) -> str:
    """Return the path of a request below the root path, as routes have it."""
    path: str = scope["path"]
    return path.removeprefix(scope.get("root_path", ""))


class ProxiedRequests(ProxyHeadersMiddleware):
    """Middleware that finds the route's path of a request, whether or not a proxy removes the root path.

    A trailing slash is removed. The client, scheme, host and root path come from X-Forwarded headers if the connecting
    address is one of `proxies`. The headers stay, so that such a request is never direct (`app.http.keys`).
    """

    def __init__(self, app: ASGIApp, root_path: str, proxies: Sequence[str]) -> None:
        super().__init__(app, list(proxies))  # type: ignore[arg-type]  # uvicorn has its own types for ASGI
        self._root_path = root_path

    async def __call__(self, scope: Any, receive: Any, send: Any) -> None:
        """Serve one request."""
        if scope["type"] == "http":
            root_path = self._root_path
            client = scope.get("client")
            if client and client[0] in self.trusted_hosts:
                root_path = _use_forwarded(scope, root_path)
            if root_path and scope["path"] == root_path:  # relative links of the page need the slash
                query = scope["query_string"].decode("latin-1")
                await RedirectResponse(root_path + "/" + (f"?{query}" if query else ""))(scope, receive, send)
                return
            path = scope["path"]
            path = path.removeprefix(root_path) if path.startswith(root_path + "/") else path
            scope["root_path"] = root_path
            scope["path"] = root_path + (path.removesuffix("/") or "/")
        await super().__call__(scope, receive, send)


def _use_forwarded(scope: Scope, root_path: str) -> str:
    """Set the Host header to X-Forwarded-Host, and return the root path from X-Forwarded-Prefix."""
    values = (",".join(Headers(scope=scope).getlist(f"x-forwarded-{name}")) for name in ("host", "prefix"))
    host, prefix = (value.rpartition(",")[2].strip() for value in values)  # that of the nearest proxy
    if host:
        others = [(name, value) for name, value in scope["headers"] if name != b"host"]
        scope["headers"] = [(b"host", host.encode("latin-1")), *others]
    prefix = prefix.rstrip("/")
    return prefix if prefix and ROOT_PATH.fullmatch(prefix) else root_path
