"""Answers as GeoJSON (RFC 7946): longitude and latitude, rings counter-clockwise."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
from geojson_pydantic import Feature, FeatureCollection, Point, Polygon
from geojson_pydantic.types import Position2D

from app.http.schemas.responses import CellResponse, CellsResponse, LocalizeResponse, Provenance
from index.answering.answers import Status
from models.citymap.frame import Frame

AnyFeature = Feature[Point | Polygon, dict[str, Any]]
EXAMPLE = {
    "type": "FeatureCollection",
    "features": [
        {
            "type": "Feature",
            "id": "estimate",
            "geometry": {"type": "Point", "coordinates": [24.9384, 60.1699]},
            "properties": {"kind": "estimate", "probability": 0.62},
        }
    ],
}


class LocalizeCollection(FeatureCollection[AnyFeature]):
    """An answer: a Point for the estimate and for each place, a Polygon per candidate; the rest as foreign members."""

    request_id: str
    status: Status
    other_probability: float
    provenance: Provenance
    timings_ms: dict[str, float]
    warnings: list[str]


class CellCollection(FeatureCollection[AnyFeature]):
    """A cell: its Polygon, then one Point per instance."""

    provenance: Provenance


class CellsCollection(FeatureCollection[AnyFeature]):
    """Cells: one Polygon each."""

    total: int
    next: str | None
    provenance: Provenance


def localize_collection(response: LocalizeResponse, frame: Frame) -> LocalizeCollection:
    """Convert an answer in a georeferenced frame to features."""
    features = []
    if response.estimate is not None:
        properties = asdict(response.estimate)
        del properties["wgs84"]
        point = _point(response.estimate.position, frame)
        features.append(_feature("estimate", point, {"kind": "estimate", **properties}))
    for number, place in enumerate(response.places, 1):
        properties = asdict(place)
        del properties["wgs84"]
        features.append(_feature(f"place-{number}", _point(place.position, frame), {"kind": "place", **properties}))
    for candidate in response.candidates:
        properties = {"kind": "candidate", **asdict(candidate)}
        features.append(_feature(candidate.cell_id, _polygon(candidate.bbox, frame), properties))
    shared = response.model_dump(include={"request_id", "status", "other_probability", "timings_ms", "warnings"})
    return LocalizeCollection(type="FeatureCollection", features=features, provenance=response.provenance, **shared)


def cell_collection(cell: CellResponse, frame: Frame) -> CellCollection:
    """Convert a cell in a georeferenced frame to features."""
    properties = cell.model_dump(mode="json", include={"cell_id", "scene", "center", "bbox", "wgs84"})
    features = [_feature(cell.cell_id, _polygon(cell.bbox, frame), {"kind": "cell", **properties})]
    for instance in cell.instances:
        point = _point(instance.center[:2], frame)
        features.append(_feature(None, point, {"kind": "instance", **asdict(instance)}))
    return CellCollection(type="FeatureCollection", features=features, provenance=cell.provenance)


def cells_collection(response: CellsResponse, frame: Frame) -> CellsCollection:
    """Convert cells in a georeferenced frame to features."""
    features = [
        _feature(cell.cell_id, _polygon(cell.bbox, frame), {"kind": "cell", **asdict(cell)}) for cell in response.cells
    ]
    members = {"total": response.total, "next": response.next, "provenance": response.provenance}
    return CellsCollection(type="FeatureCollection", features=features, **members)


def _feature(name: str | None, geometry: Point | Polygon, properties: dict[str, Any]) -> AnyFeature:
    return AnyFeature(type="Feature", id=name, geometry=geometry, properties=properties)


def _point(position_m: tuple[float, float], frame: Frame) -> Point:
    return Point(type="Point", coordinates=_lon_lat([position_m], frame)[0])


def _polygon(bbox_m: tuple[float, float, float, float], frame: Frame) -> Polygon:
    west, south, east, north = bbox_m
    ring = [(west, south), (east, south), (east, north), (west, north), (west, south)]
    return Polygon(type="Polygon", coordinates=[_lon_lat(ring, frame)])


def _lon_lat(positions_m: Sequence[tuple[float, float]], frame: Frame) -> list[Position2D]:
    lat, lon = frame.to_wgs84(np.asarray(positions_m))
    if not (np.isfinite(lat).all() and np.isfinite(lon).all()):
        raise ValueError("a position of the map has no latitude and longitude")
    return [Position2D(*pair) for pair in zip(lon.tolist(), lat.tolist(), strict=True)]
