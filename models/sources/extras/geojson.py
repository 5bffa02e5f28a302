"""Read a GeoJSON file."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import shapely
from shapely.errors import ShapelyError

from models.errors import DataError
from models.sources.extras.records import ExtraRecord


def read_features(path: Path, content: Any) -> Iterator[ExtraRecord]:
    """Yield the features of a parsed file, numbered from 1; raise DataError that names a wrong one."""
    if content.get("type") == "FeatureCollection":
        features = content.get("features")
    else:
        features = [content if content.get("type") == "Feature" else {"geometry": content}]
    if not isinstance(features, list):
        raise DataError(f"{path}: its FeatureCollection has no list 'features'; export it again as GeoJSON (RFC 7946)")
    for number, feature in enumerate(features, 1):
        if not isinstance(feature, dict):
            raise DataError(f"{path}, feature {number}: not an object; export it again as GeoJSON (RFC 7946)")
        properties = feature.get("properties")
        geometry = _geometry(path, number, feature.get("geometry"))
        yield ExtraRecord(
            str(number), f"feature {number}", geometry, properties if isinstance(properties, dict) else {}
        )


def _geometry(path: Path, number: int, geometry: Any) -> shapely.Geometry | None:
    if geometry is None:
        return None
    try:
        shape = shapely.from_geojson(json.dumps(geometry))
    except (ShapelyError, ValueError) as error:
        raise DataError(
            f"{path}, feature {number}: its geometry cannot be read ({error}); correct or remove it"
        ) from error
    return None if shape.is_empty else shape
