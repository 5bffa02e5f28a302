"""The named areas of an OpenStreetMap file: administrative boundaries and settlements."""

import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import cos, radians
from pathlib import Path
from typing import Any, Final

import osmium
import shapely
from rapidfuzz import fuzz, process

from models.errors import MapError
from models.sources.osm.extent import KM_PER_DEGREE
from models.sources.osm.reading import SUFFIXES, explained_errors

NAME_KEY: Final = re.compile(r"(?:alt_|int_|loc_|nat_|official_|old_|reg_|short_)?name(?::.+)?")
AREA_TYPES: Final = ("boundary", "multipolygon")  # of relations that enclose an area
INNER_ROLES: Final = ("inner", "enclave")
SMALL_PLACES: Final = frozenset(("city_block", "house", "islet", "locality", "plot", "square"))
MAX_LISTED: Final = 8  # places in an error message
MIN_LIKENESS: Final = 75.0  # rapidfuzz.fuzz.ratio, of 100, of a name that an error message suggests
LIST_ADVICE: Final = "'hereabouts index --map MAP --list-places' lists all"


@dataclass(frozen=True, slots=True)
class _Boundary:
    source_id: str
    tags: dict[str, str]
    ways: list[tuple[int, bool]]  # id of each, and whether it is of a hole


@dataclass(frozen=True, slots=True)
class NamedArea:
    """An administrative boundary or a settlement."""

    source_id: str  # "relation/123"
    names: tuple[str, ...]  # in all languages, the one to show first
    admin_level: str | None
    place: str | None  # "town", "suburb"
    shape: shapely.Geometry | None  # in degrees, longitude first; None if the file has not all of its boundary
    num_ways: int  # of its boundary
    num_missing: int  # of these ways

    @property
    def area_km2(self) -> float | None:
        """The area; None if the file has not all of its boundary."""
        if self.shape is None:
            return None
        return float(self.shape.area * KM_PER_DEGREE**2 * cos(radians(self.shape.centroid.y)))

    def __str__(self) -> str:
        """Return the name with what tells it from places of the same name."""
        level = self.admin_level and f"admin_level {self.admin_level}"
        return f"{self.names[0]} ({', '.join(filter(None, (level, self.place, self.size)))}): {self.source_id}"

    @property
    def size(self) -> str:
        """The area in words, or that it is unknown."""
        if self.area_km2 is None:
            return "incomplete"
        return f"{self.area_km2:,.{1 if self.area_km2 >= 1 else 3}f} km2"


def find_place(path: Path, text: str) -> shapely.Geometry:
    """Return the shape, in degrees, of the area with a name (in any language and case) or id ("relation/123").

    Raise MapError if there is no such area, more than one, or none with a complete boundary.
    """
    areas = list_places(path)
    wanted = plain_name(text)
    matches = [area for area in areas if area.source_id == wanted or wanted in map(plain_name, area.names)]
    complete = [area for area in matches if area.shape is not None]
    if len(complete) == 1:
        return complete[0].shape
    if complete:
        listed = "; ".join(map(str, complete[:MAX_LISTED]))
        example = f"--within place:{complete[0].source_id}"
        raise MapError(f"{path}: '{text}' names {len(complete)} places; choose one by its id, as {example}: {listed}")
    if matches:
        area = matches[0]
        raise MapError(
            f"{path}: the boundary of {area.names[0]}, {area.source_id}, is incomplete: {_lack(area)}; take a file "
            "that contains all of it, or give a box or a GeoJSON file"
        )
    raise MapError(f"{path}: it has no place '{text}'{_suggestions(wanted, areas)}; {LIST_ADVICE}")


def _lack(area: NamedArea) -> str:
    if area.num_missing:
        return f"{area.num_missing} of its {area.num_ways} ways are not in the file"
    return "its ways do not close to a ring"


def _suggestions(wanted: str, areas: Sequence[NamedArea]) -> str:
    names = {plain_name(name): name for area in areas if area.shape is not None for name in area.names}
    similar = process.extract(wanted, names.keys(), scorer=fuzz.ratio, score_cutoff=MIN_LIKENESS, limit=3)
    return f"; did you mean {' or '.join(names[plain] for plain, _, _ in similar)}?" if similar else ""


def plain_name(name: str) -> str:
    """Return a name in lower case and without accents."""
    letters = unicodedata.normalize("NFKD", name.casefold())
    return " ".join("".join(letter for letter in letters if not unicodedata.combining(letter)).split())


def list_places(path: Path) -> list[NamedArea]:
    """Return the named areas of a file, complete and large ones first; raise MapError if it cannot be read.

    Memory holds the boundaries only.
    """
    if not path.is_file() or not path.name.lower().endswith(SUFFIXES):
        raise MapError(f"{path}: places are read from an OpenStreetMap file; give such a file")
    with explained_errors(path):
        boundaries, nodes_of_way = _read_boundaries(path)
        lines = _read_lines(path, nodes_of_way)
    return sorted(
        (_named_area(boundary, lines) for boundary in boundaries), key=lambda a: (-(a.area_km2 or 0), a.names[0])
    )


def _read_boundaries(path: Path) -> tuple[list[_Boundary], dict[int, list[int]]]:
    """Return the boundaries of a file, and the nodes of each of their ways in the file."""
    boundaries = [
        _Boundary(
            f"relation/{relation.id}", tags, [(m.ref, m.role in INNER_ROLES) for m in relation.members if m.type == "w"]
        )
        for relation in _elements(path, osmium.osm.RELATION)
        if (tags := dict(relation.tags)).get("type") in AREA_TYPES and _is_named_area(tags)
    ]
    needed, nodes_of_way = {way for boundary in boundaries for way, _ in boundary.ways}, dict[int, list[int]]()
    for way in _elements(path, osmium.osm.WAY):
        tags = dict(way.tags)
        is_boundary = way.is_closed() and _is_named_area(tags)
        if is_boundary:
            boundaries.append(_Boundary(f"way/{way.id}", tags, [(way.id, False)]))
        if is_boundary or way.id in needed:
            nodes_of_way[way.id] = [node.ref for node in way.nodes]
    return boundaries, nodes_of_way


def _elements(path: Path, kind: Any) -> Any:
    """Return an iterable of the elements of a kind; osmium's types do not tell nodes from ways."""
    return osmium.FileProcessor(str(path), kind)


def _is_named_area(tags: Mapping[str, str]) -> bool:
    is_place = tags.get("place", "square") not in SMALL_PLACES or tags.get("boundary") == "administrative"
    return is_place and any(map(NAME_KEY.fullmatch, tags))


def _read_lines(path: Path, nodes_of_way: Mapping[int, list[int]]) -> dict[int, shapely.LineString]:
    """Return the lines of ways, without those that lack a node."""
    needed = {node for nodes in nodes_of_way.values() for node in nodes}
    nodes = _elements(path, osmium.osm.NODE)
    if min(needed, default=0) >= 0:  # osmium cannot filter by negative ids
        nodes = nodes.with_filter(osmium.filter.IdFilter(needed))
    position = {node.id: (node.lon, node.lat) for node in nodes if node.id in needed}
    return {
        way: shapely.LineString([position[node] for node in nodes])
        for way, nodes in nodes_of_way.items()
        if len(nodes) > 1 and all(node in position for node in nodes)
    }


def _named_area(boundary: _Boundary, lines: Mapping[int, shapely.LineString]) -> NamedArea:
    tags, missing = boundary.tags, sum(way not in lines for way, _ in boundary.ways)
    outer, inner = (
        _enclosed([lines[way] for way, is_inner in boundary.ways if way in lines and is_inner == wanted])
        for wanted in (False, True)
    )
    is_complete = not missing and outer is not None and inner is not None and not shapely.is_empty(outer)
    return NamedArea(
        source_id=boundary.source_id,
        names=_names(tags),
        admin_level=tags.get("admin_level"),
        place=tags.get("place"),
        shape=shapely.difference(outer, inner) if is_complete else None,
        num_ways=len(boundary.ways),
        num_missing=missing,
    )


def _enclosed(lines: Sequence[shapely.LineString]) -> shapely.Geometry | None:
    """Return the area that lines enclose; None if an end is loose."""
    polygons, cuts, dangles, invalid = shapely.polygonize_full(lines)
    is_open = not all(map(shapely.is_empty, (cuts, dangles, invalid)))
    return None if is_open else shapely.union_all(shapely.get_parts(polygons))


def _names(tags: Mapping[str, str]) -> tuple[str, ...]:
    keys = sorted(filter(NAME_KEY.fullmatch, tags), key=lambda key: (key != "name", key))
    return tuple(dict.fromkeys(part.strip() for key in keys for part in tags[key].split(";") if part.strip()))
