"""Content negotiation and validators (RFC 9110, 12.5 and 13)."""

import hashlib
import re
from collections.abc import Sequence

from fastapi import Request
from pydantic import BaseModel
from starlette.middleware.gzip import GZipMiddleware
from starlette.responses import Response
from starlette.types import Receive, Scope, Send

from app.http.errors import Code, Problem
from app.http.middleware import reply_languages_of
from models.citymap.frame import Frame
from models.language.languages.translation import REPLY_LANGUAGES

JSON = "application/json"
GEOJSON = "application/geo+json"
PIDF = "application/pidf+xml"
_QUALITY = re.compile(r"0(\.\d{0,3})?|1(\.0{0,3})?")


def choose_media_type(accept: str, offers: Sequence[str]) -> str | None:
    """Return the offer that an Accept header prefers, the first of equals; None if it accepts none."""
    if not accept.strip():
        return offers[0]
    ranges = [parsed for part in accept.split(",") if (parsed := _parse_range(part))]
    best = max(offers, key=lambda offer: _quality(offer, ranges))
    return best if _quality(best, ranges) > 0 else None


def negotiate(request: Request, frame: Frame, located: Sequence[str] = (GEOJSON,)) -> str:
    """Return JSON, or a requested format of `located`, which need a georeference; 406 if the client accepts none."""
    accept = ",".join(request.headers.getlist("accept"))
    media_type = choose_media_type(accept, (JSON, *located) if frame.is_georeferenced else (JSON,))
    if media_type is None:
        raise Problem(Code.NO_GEOREFERENCE if choose_media_type(accept, located) else Code.NOT_ACCEPTABLE)
    return media_type


def negotiate_language(request: Request) -> str | None:
    """Return the language of replies that an Accept-Language header prefers; None if it names none of them."""
    qualities = dict[str, float]()
    for part in ",".join(request.headers.getlist("accept-language")).lower().split(","):
        tag, *parameters = (each.strip() for each in part.split(";"))
        code, quality = tag.partition("-")[0], _parse_quality(parameters) or 0.0
        if code in REPLY_LANGUAGES and quality > qualities.get(code, 0.0):
            qualities[code] = quality
    return max(qualities, key=lambda code: qualities[code], default=None)


def language_headers(request: Request) -> dict[str, str]:
    """Return the headers of an answer with texts in the languages that its route noted."""
    languages = dict.fromkeys(reply_languages_of(request.scope))
    content = {"Content-Language": ", ".join(languages)} if languages else {}
    return {"Vary": "Accept, Accept-Language", **content}


def accepts_gzip(request: Request) -> bool:
    """Return whether a client accepts gzip."""
    accepted = {}
    for part in ",".join(request.headers.getlist("accept-encoding")).lower().split(","):
        coding, *parameters = (each.strip() for each in part.split(";"))
        quality = _parse_quality(parameters)
        accepted[coding] = quality is not None and quality > 0
    return accepted.get("gzip", accepted.get("*", False))


class Gzip(GZipMiddleware):
    """Starlette's middleware for clients that accept gzip; Starlette ignores qualities such as `gzip;q=0`."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request."""
        is_accepted = scope["type"] == "http" and accepts_gzip(Request(scope))
        await (super().__call__ if is_accepted else self.app)(scope, receive, send)


def respond(body: BaseModel, media_type: str, headers: dict[str, str] | None = None) -> Response:
    """Return a body in the negotiated media type."""
    return Response(body.model_dump_json(), media_type=media_type, headers={"Vary": "Accept", **(headers or {})})


def etag(*parts: str) -> str:
    """Return a strong ETag of the given parts; `Gzip` needs "W/" before it."""
    return f'"{hashlib.sha256(repr(parts).encode()).hexdigest()[:32]}"'


def is_unchanged(request: Request, tag: str) -> bool:
    """Return whether the client already has the content with this ETag (If-None-Match, which compares weakly)."""
    known = {each.strip().removeprefix("W/") for each in request.headers.get("if-none-match", "").split(",")}
    return tag.removeprefix("W/") in known or "*" in known


def _parse_range(text: str) -> tuple[str, float] | None:
    """Return (media range, quality) of one element of an Accept header; None if it is malformed."""
    media_range, *parameters = (part.strip().lower() for part in text.split(";"))
    main, slash, sub = media_range.partition("/")
    if not (main and slash and sub) or (main == "*" and sub != "*"):
        return None
    return None if (quality := _parse_quality(parameters)) is None else (media_range, quality)


def _parse_quality(parameters: Sequence[str]) -> float | None:
    """Return the quality among parameters, by default 1; None if it is malformed."""
    quality = next((value for name, _, value in (p.partition("=") for p in parameters) if name == "q"), "1")
    return float(quality) if _QUALITY.fullmatch(quality) else None


def _quality(offer: str, ranges: Sequence[tuple[str, float]]) -> float:
    """Return the quality of the most specific range that matches an offer; 0 if none matches."""
    for pattern in (offer, f"{offer.partition('/')[0]}/*", "*/*"):
        qualities = [quality for media_range, quality in ranges if media_range == pattern]
        if qualities:
            return max(qualities)
    return 0.0
