"""The web page: the files of app/web/page, read once when the service starts."""

import gzip
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Final

from fastapi import APIRouter, Request
from starlette.responses import Response

from app.http.errors import Code, Problem
from app.http.formats.negotiation import accepts_gzip, etag, is_unchanged
from app.http.keys import OPEN

PAGE_DIR: Final = Path(__file__).parents[2] / "web" / "page"
INDEX: Final = "index.html"
NOT_BUILT: Final = "The page is not built: run `npm ci && npm run build` in app/web/source, then restart the service."
MEDIA_TYPES: Final = {  # not Python's `mimetypes`, which depend on files of the machine
    ".html": "text/html",
    ".js": "text/javascript",
    ".css": "text/css",
    ".txt": "text/plain",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".ico": "image/x-icon",
}
OTHER: Final = "application/octet-stream"
CONTENT_POLICY: Final = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
    "font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
HEADERS: Final = {
    "Cache-Control": "no-cache",
    "Vary": "Accept-Encoding",
    "Content-Security-Policy": CONTENT_POLICY,
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
}


@dataclass(frozen=True, slots=True)
class PageFile:
    """A file of the page, plain and, if that is smaller, compressed with gzip."""

    media_type: str
    plain: bytes
    zipped: bytes | None
    sha256: str

    @classmethod
    def load(cls, path: Path) -> "PageFile":
        """Read and compress a file."""
        plain = path.read_bytes()
        zipped = gzip.compress(plain, mtime=0)
        return cls(
            media_type=MEDIA_TYPES.get(path.suffix.lower(), OTHER),
            plain=plain,
            zipped=zipped if len(zipped) < len(plain) else None,
            sha256=sha256(plain).hexdigest(),
        )

    async def send(self, request: Request) -> Response:
        """Return the file in an encoding that the client accepts, or 304 if the client has it."""
        zipped = self.zipped if accepts_gzip(request) else None
        headers = {**HEADERS, "ETag": etag(self.sha256, str(zipped is not None))}
        if is_unchanged(request, headers["ETag"]):
            return Response(status_code=304, headers=headers)
        if zipped is None:
            return Response(self.plain, media_type=self.media_type, headers=headers)
        return Response(zipped, media_type=self.media_type, headers={**headers, "Content-Encoding": "gzip"})


def build_router(page_dir: Path) -> APIRouter:
    """Return one route per file, so that a client's path never reaches the disk; index.html is served at /."""
    router = APIRouter(include_in_schema=False)
    if not (page_dir / INDEX).is_file():
        router.add_api_route("/", _explain_how_to_build, openapi_extra=OPEN)
        return router
    for path in sorted(page_dir.iterdir()):
        if path.is_file() and path.suffix:  # a name without a suffix is hidden or could clash with a route
            route = "/" if path.name == INDEX else f"/{path.name}"
            router.add_api_route(route, PageFile.load(path).send, openapi_extra=OPEN)
    return router


async def _explain_how_to_build() -> Response:
    raise Problem(Code.NOT_FOUND, NOT_BUILT)
