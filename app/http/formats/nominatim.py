"""Answers in the form that clients of Nominatim read (its documented output of /search and /reverse)."""

from collections.abc import Sequence
from typing import Any, Final, Literal

import numpy as np

from app.http.protocol import LocalizerLike
from app.http.schemas.responses import LocalizeResponse
from index.answering.answers import Described, LatLon
from models.citymap.frame import Frame

Format = Literal["json", "jsonv2", "geojson"]
NOTHING: Final = {"error": "Unable to geocode"}  # Nominatim's words for a position that is nowhere, with status 200
APART_M: Final = 30.0  # of two results; candidates overlap
RANK: Final = 30  # Nominatim's for a point of interest or a house
KIND: Final = {"category": "place", "type": "position"}

Place = dict[str, Any]
Box = tuple[float, float, float, float]


def places(found: LocalizeResponse, localizer: LocalizerLike, limit: int) -> list[Place]:
    """The estimate, then what else it could be; none closer than APART_M to one before.

    Args:
        found: in a georeferenced frame.
        localizer: says each place in words.
        limit: how many.
    """
    if found.estimate is None:
        return []
    spots = [(found.estimate.position, found.estimate.radius_m.p90, found.estimate.probability)]
    spots += [(one.position, (one.bbox[2] - one.bbox[0]) / 2, one.probability) for one in found.candidates]
    results: list[Place] = []
    for n in apart([position for position, _, _ in spots])[:limit]:
        (x, y), radius_m, probability = spots[n]
        box = (x - radius_m, y - radius_m, x + radius_m, y + radius_m)
        results.append(_place(len(results) + 1, (x, y), box, probability, localizer.describe((x, y)), localizer))
    return results


def apart(positions: Sequence[tuple[float, float]]) -> list[int]:
    """Which positions are more than APART_M from all of these before them: candidates overlap."""
    kept: list[int] = []
    for n, position in enumerate(positions):
        if all(np.hypot(*np.subtract(position, positions[k])) > APART_M for k in kept):
            kept.append(n)
    return kept


def place_of(described: Described, localizer: LocalizerLike) -> Place:
    """A position, described."""
    x, y = described.position
    box = (x - APART_M / 2, y - APART_M / 2, x + APART_M / 2, y + APART_M / 2)
    return _place(1, described.position, box, 1.0, described, localizer)


def _place(
    number: int,
    position: tuple[float, float],
    box: Box,
    importance: float,
    described: Described | None,
    localizer: LocalizerLike,
) -> Place:
    at = LatLon.from_position(np.array(position), localizer.frame)
    assert at is not None
    name = described.place if described and described.place else f"{at.lat:.6f}, {at.lon:.6f}"
    return {
        "place_id": number,
        "licence": localizer.facts.attribution,
        "lat": f"{at.lat:.7f}",
        "lon": f"{at.lon:.7f}",
        **KIND,
        "place_rank": RANK,
        "importance": round(importance, 6),
        "addresstype": KIND["type"],
        "name": name,
        "display_name": name,
        "boundingbox": _degrees(box, localizer.frame),
        "extratags": {"description": described.description} if described else {},
    }


def formatted(found: Sequence[Place], form: Format) -> Any:
    """Places as /search gives them."""
    if form == "geojson":
        return {
            "type": "FeatureCollection",
            "licence": found[0]["licence"] if found else "",
            "features": [*map(_feature, found)],
        }
    return [_json(place) if form == "json" else place for place in found]


def formatted_one(place: Place, form: Format) -> Any:
    """A place as /reverse gives it."""
    if form == "geojson":
        return formatted([place], form)
    return _json(place) if form == "json" else place


def _json(place: Place) -> Place:
    """The first format calls the category class."""
    return {("class" if name == "category" else name): value for name, value in place.items()}


def _feature(place: Place) -> dict[str, Any]:
    south, north, west, east = map(float, place["boundingbox"])
    left_out = {"licence", "lat", "lon", "boundingbox"}
    return {
        "type": "Feature",
        "properties": {name: value for name, value in place.items() if name not in left_out},
        "bbox": [west, south, east, north],
        "geometry": {"type": "Point", "coordinates": [float(place["lon"]), float(place["lat"])]},
    }


def _degrees(box: Box, frame: Frame) -> list[str]:
    """South, north, west, east, as Nominatim orders and writes them."""
    west, south, east, north = box
    lat, lon = frame.to_wgs84(np.array([(west, south), (east, north)]))
    return [f"{value:.7f}" for value in (lat[0], lat[1], lon[0], lon[1])]
