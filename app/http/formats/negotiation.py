"""Which of the formats we have a client would rather read (RFC 9110, 12.5), and whether it has it already."""

import hashlib
import re
from collections.abc import Sequence

from fastapi import Request
from pydantic import BaseModel
from starlette.responses import Response

from app.http.errors import Code, Problem
from models.citymap.frame import Frame

JSON = "application/json"
GEOJSON = "application/geo+json"
_QUALITY = re.compile(r"0(\.\d{0,3})?|1(\.0{0,3})?")


def choose(accept: str, offers: Sequence[str]) -> str | None:
    """The offer that an Accept header likes best; of equals the first; None if it takes none.

    Args:
        accept: value of the header; empty takes anything. Ranges that are not well formed are passed over.
        offers: media types, the one we would rather send first.
    """
    if not accept.strip():
        return offers[0]
    ranges = [found for part in accept.split(",") if (found := _parse_range(part))]
    best = max(offers, key=lambda offer: _quality(offer, ranges))
    return best if _quality(best, ranges) > 0 else None


def negotiate(request: Request, frame: Frame) -> str:
    """The format to answer in: JSON, or GeoJSON if the client asks for it and the map is on Earth.

    Raises:
        Problem: 406.
    """
    accept = ",".join(request.headers.getlist("accept"))
    media_type = choose(accept, (JSON, GEOJSON) if frame.is_georeferenced else (JSON,))
    if media_type is None:
        raise Problem(Code.NO_GEOREFERENCE if choose(accept, (GEOJSON,)) else Code.NOT_ACCEPTABLE)
    return media_type


def takes_gzip(request: Request) -> bool:
    """Whether a client can read what gzip compressed."""
    takes = {}
    for part in ",".join(request.headers.getlist("accept-encoding")).lower().split(","):
        coding, *parameters = (each.strip() for each in part.split(";"))
        quality = _parse_quality(parameters)
        takes[coding] = quality is not None and quality > 0
    return takes.get("gzip", takes.get("*", False))


def respond(body: BaseModel, media_type: str, headers: dict[str, str] | None = None) -> Response:
    """A negotiated answer."""
    return Response(body.model_dump_json(), media_type=media_type, headers={"Vary": "Accept", **(headers or {})})


def etag(*parts: str) -> str:
    """A strong validator of what these parts name."""
    return f'"{hashlib.sha256(repr(parts).encode()).hexdigest()[:32]}"'


def has_already(request: Request, tag: str) -> bool:
    """Whether the client has what an ETag names (If-None-Match)."""
    known = {each.strip().removeprefix("W/") for each in request.headers.get("if-none-match", "").split(",")}
    return tag in known or "*" in known


def _parse_range(text: str) -> tuple[str, float] | None:
    """(media range, quality) of one element of an Accept header; None if it is not well formed."""
    media_range, *parameters = (part.strip().lower() for part in text.split(";"))
    main, slash, sub = media_range.partition("/")
    if not (main and slash and sub) or (main == "*" and sub != "*"):
        return None
    return None if (quality := _parse_quality(parameters)) is None else (media_range, quality)


def _parse_quality(parameters: Sequence[str]) -> float | None:
    """The quality that stands in parameters, 1 if none does; None if it is not well formed."""
    quality = next((value for name, _, value in (p.partition("=") for p in parameters) if name == "q"), "1")
    return float(quality) if _QUALITY.fullmatch(quality) else None


def _quality(offer: str, ranges: Sequence[tuple[str, float]]) -> float:
    """What the most specific range that fits says; 0 if none fits."""
    for fitting in (offer, f"{offer.partition('/')[0]}/*", "*/*"):
        qualities = [quality for media_range, quality in ranges if media_range == fitting]
        if qualities:
            return max(qualities)
    return 0.0
