"""Answers as the georeference terms of Darwin Core (https://dwc.tdwg.org/terms/#location)."""

import math
from collections.abc import Iterable
from importlib.metadata import version
from typing import Final

import numpy as np
from pydantic import ValidationError

from app.http.errors import field_message
from app.http.schemas.requests import LocalizeRequest
from app.http.schemas.responses import LocalizeResponse
from index.answering.answers import LikelyPlace
from index.build.artifact import DEFAULT_ALIAS
from models.citymap.frame import Frame
from models.errors import DescriptionError

COLUMNS: Final = (
    "decimalLatitude",
    "decimalLongitude",
    "geodeticDatum",
    "coordinateUncertaintyInMeters",
    "footprintWKT",
    "georeferenceProtocol",
    "georeferenceSources",
    "georeferenceRemarks",
    "georeferenceVerificationStatus",
    "localizationStatus",  # Darwin Core has no term for it
)
ERROR: Final = "error"  # status of a text that cannot be answered, next to those of answers
VERIFICATION: Final = {  # by status; the terms that Darwin Core recommends
    "ok": "requires verification",
    "ambiguous": "requires georeference",
    "no_match": "unable to georeference",
    ERROR: "requires georeference",
}
PROTOCOL: Final = (
    f"Hereabouts {version('hereabouts')}: localized from a description; "
    "the uncertainty and the footprint contain the position with probability 0.9"
)
SEPARATOR: Final = " | "  # of lists, as Darwin Core recommends
FOOTPRINT_CORNERS: Final = 32  # of a circle


def to_request(text: str, index: str = DEFAULT_ALIAS) -> LocalizeRequest:
    """Return the request for a text; DescriptionError says what is wrong with it."""
    try:
        return LocalizeRequest.model_validate({"description": text, "top_k": 1, "index": index})
    except ValidationError as error:
        raise DescriptionError(f"the text {field_message(error.errors()[0])}") from None


def georeference(response: LocalizeResponse, frame: Frame) -> list[str]:
    """Return the cells of `COLUMNS` for an answer; only a sure one has a position."""
    estimate, source = response.estimate, response.provenance
    if response.status == "no_match":
        return without_position("no_match", response.warnings)
    assert estimate is not None
    assert estimate.wgs84 is not None
    if response.status == "ambiguous":
        return without_position("ambiguous", (*map(_in_words, response.places), *response.warnings))
    best = response.places[:1]
    evidence = (fit for place in best for fit in (*place.supports, *place.contradicts))
    sources = source.map, source.attribution, f"index {source.index_version}", f"model {source.model}"
    return [
        f"{estimate.wgs84.lat:.7f}",
        f"{estimate.wgs84.lon:.7f}",
        "EPSG:4326",
        str(max(1, math.ceil(estimate.radius_m.p90))),  # 0 is not valid
        _circle(estimate.position, estimate.radius_m.p90, frame),
        PROTOCOL,
        SEPARATOR.join(filter(None, sources)),
        SEPARATOR.join(filter(None, (estimate.place, *evidence, *response.warnings))),
        VERIFICATION["ok"],
        "ok",
    ]


def without_position(status: str, reasons: Iterable[str]) -> list[str]:
    """Return the cells of `COLUMNS` for a text without a sure position."""
    return [*[""] * (len(COLUMNS) - 3), SEPARATOR.join(reasons), VERIFICATION[status], status]


def _in_words(place: LikelyPlace) -> str:
    assert place.wgs84 is not None
    return f"{100 * place.probability:.0f} % {place.wgs84.lat:.5f}, {place.wgs84.lon:.5f} {place.place or ''}".rstrip()


def _circle(center_m: tuple[float, float], radius_m: float, frame: Frame) -> str:
    angles = np.linspace(0, 2 * np.pi, FOOTPRINT_CORNERS, endpoint=False)
    lat, lon = frame.to_wgs84(center_m + radius_m * np.column_stack([np.cos(angles), np.sin(angles)]))
    corners = [f"{x:.6f} {y:.6f}" for x, y in zip(lon, lat, strict=True)]
    return f"POLYGON (({', '.join([*corners, corners[0]])}))"
