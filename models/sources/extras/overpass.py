"""Read the JSON that Overpass returns."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import shapely

from models.errors import DataError
from models.sources.extras.records import ExtraRecord

ADVICE = "end the query with 'out geom;'"
Positions = Sequence[tuple[float, float]]  # longitude and latitude of each vertex


def read_elements(path: Path, content: Any) -> Iterator[ExtraRecord]:
    """Yield the elements of a parsed file; nodes that only make up ways are left out.

    Raise DataError that names an element without a geometry.
    """
    elements = content["elements"]
    if not isinstance(elements, list) or not all(isinstance(element, dict) for element in elements):
        raise DataError(f"{path}: 'elements' is not a list of objects; run the Overpass query with [out:json] again")
    nodes = {element.get("id"): element for element in elements if element.get("type") == "node"}
    vertices = {node for element in elements for node in element.get("nodes", ())}
    for element in elements:
        tags = element.get("tags") or {}
        if element.get("type") == "node" and element.get("id") in vertices and not tags:
            continue
        row = f"{element.get('type')}/{element.get('id')}"
        try:
            geometry = _geometry(element, nodes)
        except (KeyError, TypeError, ValueError, shapely.errors.ShapelyError) as error:
            raise DataError(f"{path}, {row}: it has no usable geometry ({error!r}); {ADVICE}") from error
        yield ExtraRecord(row, row, geometry, tags)


def _geometry(element: Mapping[str, Any], nodes: Mapping[Any, Mapping[str, Any]]) -> shapely.Geometry:
    if element["type"] == "node":
        return shapely.Point(*_position(element))
    if element["type"] == "relation" and "members" in element:
        lines = [_line(member) for member in element["members"] if member.get("geometry")]
        if lines:
            areas = shapely.get_parts(shapely.polygonize(lines))
            return shapely.union_all(areas) if len(areas) else shapely.union_all(lines)
    elif "geometry" in element:
        return _closed(_line(element))
    elif "nodes" in element and all(node in nodes for node in element["nodes"]):
        return _closed(shapely.LineString([_position(nodes[node]) for node in element["nodes"]]))
    return shapely.Point(*_position(element["center"]))


def _line(element: Mapping[str, Any]) -> shapely.LineString:
    """Return the line of a way; vertices outside the query's box are null."""
    return shapely.LineString([_position(vertex) for vertex in element["geometry"] if vertex is not None])


def _closed(line: shapely.LineString) -> shapely.Geometry:
    """Return the area inside a ring, or the line if it is open."""
    return shapely.Polygon(line) if line.is_ring else line


def _position(vertex: Mapping[str, Any]) -> tuple[float, float]:
    return float(vertex["lon"]), float(vertex["lat"])
