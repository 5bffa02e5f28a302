"""Example answers in the OpenAPI document."""

from pydantic import JsonValue

_CRS: JsonValue = {
    "frame_id": "map",
    "epsg": None,
    "origin": {"lat": 60.17, "lon": 24.94},
    "units": "m",
    "axes": "ENU",
}
_PROVENANCE: JsonValue = {
    "index": "default",
    "index_version": "20260101T120000Z-1a2b3c4d",
    "model": "posterior/minilm/192",
    "model_sha256": "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08",
    "map": "helsinki",
    "attribution": "© OpenStreetMap contributors",
}
_VARIANCES = (1444.0, 1444.0, 1e4, 3.29, 3.29, 0.099)
_COVARIANCE: list[JsonValue] = [v if row == column else 0.0 for row in range(6) for column, v in enumerate(_VARIANCES)]
ANSWERED: JsonValue = {
    "request_id": "5f0c1f3f8d4e4a0f9d5c3f7a1b2c3d4e",
    "status": "ambiguous",
    "language": "en",
    "estimate": {
        "position": [105.0, -35.0],
        "method": "posterior",
        "covariance": [[1444.0, 0.0], [0.0, 1444.0]],
        "radius_m": {"p50": 44.1, "p90": 81.8},
        "within_m": {"10": 0.11, "30": 0.35, "100": 0.93, "250": 0.97},
        "probability": 0.22,
        "wgs84": {"lat": 60.1699, "lon": 24.9384},
        "place": "on Kaivokatu, between Keskuskatu and Mikonkatu, 14 m south of Ateneum",
        "heading": {"mean_deg": 271.0, "spread_deg": 18.0},
    },
    "places": [
        {
            "probability": 0.91,
            "position": [105.0, -35.0],
            "wgs84": {"lat": 60.1699, "lon": 24.9384},
            "radius_m": 60.3,
            "place": "on Kaivokatu, between Keskuskatu and Mikonkatu, 14 m south of Ateneum",
            "supports": ["Ateneum: 14 m to your right"],
            "contradicts": [],
            "source_id": "relation/1655211",
        }
    ],
    "candidates": [
        {
            "rank": 1,
            "cell_id": "helsinki_00042",
            "score": 0.81,
            "probability": 0.22,
            "center": [105.0, -35.0],
            "bbox": [90.0, -50.0, 120.0, -20.0],
            "position": [105.0, -35.0],
            "wgs84": {"lat": 60.1699, "lon": 24.9384},
        }
    ],
    "other_probability": 0.78,
    "evidence": [
        {
            "text": "Ateneum",
            "span": [12, 19],
            "label": "tourism/museum",
            "colour": None,
            "relation": "right",
            "distance_m": None,
            "absent": False,
            "explained": 0.98,
            "instance": "tourism/museum",
            "name": "Ateneum",
            "source_id": "way/5678",
            "away_m": 14.0,
            "at": [105.5, -21.0],
            "bearing_deg": 2.0,
            "exact": True,
            "fit": "Ateneum: 14 m to your right",
        },
    ],
    "heat_map": {"spacing_m": 1.5, "points": [[105.0, -35.0, 0.08]]},
    "ros": {
        "header": {"stamp": {"sec": 1767268800, "nanosec": 0}, "frame_id": "map"},
        "pose": {
            "pose": {
                "position": {"x": 105.0, "y": -35.0, "z": 0.0},
                "orientation": {"x": 0.0, "y": 0.0, "z": 1.0, "w": 0.0},
            },
            "covariance": _COVARIANCE,
        },
    },
    "question": {
        "id": "street",
        "text": "Which street are you on?",
        "choices": [
            {"value": "Kaivokatu", "text": "Kaivokatu"},
            {"value": "Mikonkatu", "text": "Mikonkatu"},
            {"value": "unknown", "text": "I don't know"},
        ],
        "is_open": True,
    },
    "crs": _CRS,
    "provenance": _PROVENANCE,
    "timings_ms": {"queue": 0.2, "encode": 9.1, "search": 0.4, "estimate": 0.1, "total": 10.3},
    "warnings": [],
}
DESCRIBED: JsonValue = {
    "request_id": "5f0c1f3f8d4e4a0f9d5c3f7a1b2c3d4e",
    "description": "I am on Kaivokatu, between Keskuskatu and Mikonkatu.",
    "hints": [
        {
            "text": "I am on Kaivokatu, between Keskuskatu and Mikonkatu.",
            "instance": "street",
            "name": "Kaivokatu",
            "source_id": "way/1234",
            "at": [105.0, -41.2],
            "away_m": 6.2,
            "bearing_deg": 180.0,
        },
    ],
    "place": "on Kaivokatu, between Keskuskatu and Mikonkatu, 14 m south of Ateneum",
    "position": [105.0, -35.0],
    "wgs84": {"lat": 60.1699, "lon": 24.9384},
    "cell_id": "helsinki_00042",
    "crs": _CRS,
    "provenance": _PROVENANCE,
    "timings_ms": {"total": 8.4},
}
MAP: JsonValue = {
    "name": "helsinki",
    "num_cells": 13041,
    "num_instances": 9120,
    "summary": {
        "bbox": [24.9351762, 60.164155, 24.9534145, 60.179113],
        "width_km": 1.01,
        "height_km": 1.67,
        "walkable_km": 94.6,
        "objects": 8598,
        "streets": 93,
        "named_objects": 1868,
        "house_numbers": 1445,
        "kinds": {"traffic sign": 1506, "street lamp": 586, "bench": 162},
        "scripts": {"latin": 2656, "cyrillic": 3},
        "languages": {"sv": 1126, "fi": 1068},
        "extras": {"bins.geojson as amenity=waste_basket": 380},
        "cut": {},
        "dropped": {},
        "repaired": {},
    },
    "crs": _CRS,
    "provenance": _PROVENANCE,
}
