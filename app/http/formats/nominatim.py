"""Answers in the format of Nominatim's /search and /reverse."""

from collections.abc import Sequence
from typing import Any, Final, Literal

import numpy as np

from app.http.protocol import LocalizerLike
from app.http.schemas.responses import LocalizeResponse
from index.answering.answers import Described, LatLon
from models.citymap.frame import Frame

Format = Literal["json", "jsonv2", "geojson"]
NO_RESULT: Final = {"error": "Unable to geocode"}  # Nominatim's answer, with status 200
REVERSED_BOX_M: Final = 30.0  # edge of the box of a described position
PLACE_RANK: Final = 30  # Nominatim's rank of a point of interest or a house
PLACE_KIND: Final = {"category": "place", "type": "position"}

Place = dict[str, Any]
Box = tuple[float, float, float, float]


def search_results(response: LocalizeResponse, localizer: LocalizerLike, limit: int) -> list[Place]:
    """Return the places of an answer."""
    results = []
    for number, place in enumerate(response.places[:limit], 1):
        box, described = _box(place.position, place.radius_m), localizer.describe(place.position)
        name = place.place or (described.place if described else None)
        results.append(_place(number, place.position, box, place.probability, name, described, localizer))
    return results


def reverse_result(described: Described, localizer: LocalizerLike) -> Place:
    """Return a described position as a place."""
    box = _box(described.position, REVERSED_BOX_M / 2)
    return _place(1, described.position, box, 1.0, described.place, described, localizer)


def _box(center: tuple[float, float], radius_m: float) -> Box:
    x, y = center
    return x - radius_m, y - radius_m, x + radius_m, y + radius_m


def _place(
    number: int,
    position: tuple[float, float],
    box: Box,
    importance: float,
    words: str | None,
    described: Described | None,
    localizer: LocalizerLike,
) -> Place:
    wgs84 = LatLon.from_position(np.array(position), localizer.frame)
    assert wgs84 is not None
    name = words or f"{wgs84.lat:.6f}, {wgs84.lon:.6f}"
    return {
        "place_id": number,
        "licence": localizer.facts.attribution,
        "lat": f"{wgs84.lat:.7f}",
        "lon": f"{wgs84.lon:.7f}",
        **PLACE_KIND,
        "place_rank": PLACE_RANK,
        "importance": round(importance, 6),
        "addresstype": PLACE_KIND["type"],
        "name": name,
        "display_name": name,
        "address": {},  # leaflet-control-geocoder needs it
        "boundingbox": _degrees(box, localizer.frame),
        "extratags": {"description": described.description} if described else {},
    }


def format_places(results: Sequence[Place], form: Format) -> Any:
    """Return places in a format of /search; /reverse has the same formats, and the place itself if it is no GeoJSON."""
    if form == "geojson":
        return {
            "type": "FeatureCollection",
            "licence": results[0]["licence"] if results else "",
            "features": [*map(_feature, results)],
        }
    # Nominatim's first format has `class` in place of `category`.
    renamed = {"category": "class"} if form == "json" else {}
    return [{renamed.get(name, name): value for name, value in place.items()} for place in results]


def _feature(place: Place) -> dict[str, Any]:
    south, north, west, east = map(float, place["boundingbox"])
    omitted = {"licence", "lat", "lon", "boundingbox"}
    return {
        "type": "Feature",
        "properties": {name: value for name, value in place.items() if name not in omitted},
        "bbox": [west, south, east, north],
        "geometry": {"type": "Point", "coordinates": [float(place["lon"]), float(place["lat"])]},
    }


def _degrees(box: Box, frame: Frame) -> list[str]:
    """Return south, north, west, east as strings, in Nominatim's order."""
    west, south, east, north = box
    lat, lon = frame.to_wgs84(np.array([(west, south), (east, north)]))
    return [f"{value:.7f}" for value in (lat[0], lat[1], lon[0], lon[1])]
