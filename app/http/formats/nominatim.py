"""Answers in Nominatim's formats."""

import re
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from starlette.responses import JSONResponse, Response

from app.http.formats.negotiation import GEOJSON, JSON
from app.http.formats.nominatim_xml import place_xml, places_xml
from app.http.protocol import LocalizerLike
from app.http.schemas.geocoder import Output
from app.http.schemas.responses import LocalizeResponse
from index.answering.answers import Described, LatLon
from models.citymap.frame import Frame

XML: Final = "text/xml"
NO_RESULT: Final = {"error": "Unable to geocode"}  # Nominatim's answer, with status 200
REVERSED_BOX_M: Final = 30.0  # edge of the box of a described position
PLACE_RANK: Final = 30  # Nominatim's rank of a point of interest or a house
PLACE_KIND: Final = {"category": "place", "type": "position"}
GEOCODEJSON_NAMES: Final = {"house_number": "housenumber", "road": "street", "suburb": "district"}
_OSM_ID: Final = re.compile(r"(node|way|relation)/(\d+)")

Place = dict[str, Any]
Box = tuple[float, float, float, float]


def search_results(
    response: LocalizeResponse, localizer: LocalizerLike, limit: int, language: str | None
) -> list[Place]:
    """Return the places of an answer."""
    results = []
    for place in response.places[:limit]:
        box, described = _box(place.position, place.radius_m), localizer.describe(place.position, language)
        name = place.place or (described.place if described else None)
        results.append(_place(place.position, box, place.probability, name, described, localizer, place.source_id))
    return results


def reverse_result(described: Described, localizer: LocalizerLike, source_id: str | None = None) -> Place:
    """Return a described position as a place, by default about the first object with a name."""
    box = _box(described.position, REVERSED_BOX_M / 2)
    return _place(described.position, box, 1.0, described.place, described, localizer, source_id)


def _box(center: tuple[float, float], radius_m: float) -> Box:
    x, y = center
    return x - radius_m, y - radius_m, x + radius_m, y + radius_m


def _place(
    position: tuple[float, float],
    box: Box,
    importance: float,
    words: str | None,
    described: Described | None,
    localizer: LocalizerLike,
    source_id: str | None,
) -> Place:
    wgs84 = LatLon.from_position(np.array(position), localizer.frame)
    assert wgs84 is not None
    name = words or f"{wgs84.lat:.6f}, {wgs84.lon:.6f}"
    facts = described.hints if described else ()
    source_id = source_id or next((fact.source_id for fact in facts if fact.name and fact.source_id), "")
    osm = _OSM_ID.fullmatch(source_id)
    return {
        "place_id": _place_id(wgs84),
        "licence": localizer.facts.attribution,
        **({"osm_type": osm[1], "osm_id": int(osm[2])} if osm else {}),
        "lat": f"{wgs84.lat:.7f}",
        "lon": f"{wgs84.lon:.7f}",
        **PLACE_KIND,
        "place_rank": PLACE_RANK,
        "importance": round(importance, 6),
        "addresstype": PLACE_KIND["type"],
        "name": name,
        "display_name": name,
        "address": described.address if described else {},
        "boundingbox": _degrees(box, localizer.frame),
        "extratags": {"description": described.description} if described else {},
        "namedetails": {"name": name},
    }


def _place_id(wgs84: LatLon) -> int:
    """Return a number of a position, to a metre, that stays the same and is exact in JavaScript."""
    return round((wgs84.lat + 90) * 1e5) * 36_000_001 + round((wgs84.lon + 180) * 1e5)


def respond_with_places(results: Sequence[Place], output: Output, licence: str, headers: dict[str, str]) -> Response:
    """Return the answer of /search and /lookup."""
    places = [_selected(place, output) for place in results]
    if output.format == "xml":
        return Response(places_xml(places, licence), media_type=XML, headers=headers)
    content: Any = places
    if output.format == "geojson":
        content = {"type": "FeatureCollection", "licence": licence, "features": [*map(_feature, places)]}
    elif output.format == "geocodejson":
        geocoding = {"version": "0.1.0", "licence": licence, "attribution": licence}
        features = [*map(_geocodejson_feature, places)]
        content = {"type": "FeatureCollection", "geocoding": geocoding, "features": features}
    media_type = GEOJSON if output.format.startswith("geo") else JSON
    return JSONResponse(content, media_type=media_type, headers=headers)


def respond_with_place(result: Place | None, output: Output, licence: str, headers: dict[str, str]) -> Response:
    """Return the answer of /reverse."""
    if output.format == "xml":
        place = NO_RESULT if result is None else _selected(result, output)
        return Response(place_xml(place, licence), media_type=XML, headers=headers)
    if result is None:
        return JSONResponse(NO_RESULT, headers=headers)
    if output.format in ("json", "jsonv2"):
        return JSONResponse(_selected(result, output), headers=headers)
    return respond_with_places([result], output, licence, headers)


def _selected(place: Place, output: Output) -> Place:
    """Return the fields of a place that an answer has."""
    wanted = {"address": output.addressdetails, "namedetails": output.namedetails}
    # Nominatim's first format has `class` in place of `category`.
    renamed = {"category": "class"} if output.format == "json" else {}
    return {renamed.get(name, name): value for name, value in place.items() if wanted.get(name, True)}


def _feature(place: Place) -> dict[str, Any]:
    omitted = {"licence", "lat", "lon", "boundingbox"}
    return _located(place, {name: value for name, value in place.items() if name not in omitted})


def _geocodejson_feature(place: Place) -> dict[str, Any]:
    fields = {name: place[name] for name in ("place_id", "osm_type", "osm_id") if name in place}
    address = {GEOCODEJSON_NAMES.get(name, name): part for name, part in place.get("address", {}).items()}
    kind = {"osm_key": place["category"], "osm_value": place["type"], "type": "house"}
    label = {"label": place["display_name"], "name": place["name"]}
    extra = {"extra": place["extratags"]}
    return _located(place, {"geocoding": {**fields, **kind, **label, **address, **extra}})


def _located(place: Place, properties: dict[str, Any]) -> dict[str, Any]:
    south, north, west, east = map(float, place["boundingbox"])
    return {
        "type": "Feature",
        "properties": properties,
        "bbox": [west, south, east, north],
        "geometry": {"type": "Point", "coordinates": [float(place["lon"]), float(place["lat"])]},
    }


def _degrees(box: Box, frame: Frame) -> list[str]:
    """Return south, north, west, east as strings, in Nominatim's order."""
    west, south, east, north = box
    lat, lon = frame.to_wgs84(np.array([(west, south), (east, north)]))
    return [f"{value:.7f}" for value in (lat[0], lat[1], lon[0], lon[1])]
