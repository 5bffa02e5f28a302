"""The known part of ways and areas whose nodes or member ways a file lacks, and of areas whose rings are broken.

An extract that is cut at a box names nodes that it does not contain. osmium makes no geometry of such ways, and no
areas of rings that are cut, open or cross themselves.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import cos, dist, radians
from pathlib import Path
from typing import Any

import osmium
import shapely

from models.sources.osm.reading import located_elements, read_osm, source_id
from models.sources.osm.tags import read_tags

AREA_TYPES = ("multipolygon", "boundary")  # of relations
INNER_ROLES = ("inner", "enclave")
# Of an outline that is closed by straight lines: a larger gap may enclose what is not inside.
MAX_GAP_SHARE = 1 / 3
LonLat = tuple[float, float]
Runs = list[list[LonLat]]  # consecutive known nodes


@dataclass(frozen=True, slots=True)
class IncompleteArea:
    """The known part of an area."""

    tags: dict[str, str]
    source_id: str
    shape: shapely.Geometry  # in degrees: polygons if the outline can be closed, otherwise lines or points
    is_cut: bool  # whether the file lacks a part of it; otherwise its outline is broken

    @property
    def is_area(self) -> bool:
        """Whether the shape has an inside."""
        return bool(shapely.get_dimensions(self.shape) == 2)


def known_line(way: Any) -> shapely.Geometry | None:
    """Return the known part of a way in degrees: lines, or points if no two nodes in a row are known, or None."""
    return _lines(_known_runs(way))


class IncompleteAreas:
    """The closed ways and relations that should be areas, but of which osmium makes none."""

    def __init__(self) -> None:
        self._pending: dict[str, set[int]] = {"w": set(), "r": set()}
        self._early = set[int]()  # relations whose areas came before them

    def expect(self, element: Any, tags: Mapping[str, str]) -> None:
        """Note a closed way or a relation that should come as an area, too."""
        kind, number = element.type_str(), element.id
        if tags.get("area") == "no" or (kind == "r" and tags.get("type") not in AREA_TYPES):
            return
        if kind == "r" and number in self._early:
            self._early.remove(number)
        else:
            self._pending[kind].add(number)

    def note_area(self, area: Any) -> None:
        """Note an area from osmium; that of a broken ring has no rings."""
        if not area.num_rings()[0]:
            return
        kind, number = "w" if area.from_way() else "r", area.orig_id()
        if number in self._pending[kind]:
            self._pending[kind].remove(number)
        elif kind == "r":
            self._early.add(number)

    def read(self, path: Path) -> Iterator[IncompleteArea]:
        """Yield the known parts of the areas that did not come, from another pass over the file, if there are any."""
        relations = list(_read_relations(path, self._pending["r"]))
        ways = self._pending["w"]
        needed = ways.union(number for _, _, members in relations for number, _ in members)
        if not needed:
            return
        runs, whole = dict[int, Runs](), set[int]()
        for way in _read_ways(path, needed):
            runs[way.id] = _known_runs(way)
            if sum(map(len, runs[way.id])) == len(way.nodes):
                whole.add(way.id)
            shape = _enclosed([_join_ends(runs[way.id])]) or _lines(runs[way.id])
            if way.id in ways and shape is not None:
                yield IncompleteArea(read_tags(way.tags), source_id(way, "w"), shape, way.id not in whole)
        for source, tags, members in relations:
            inner, outer = (
                _merge([run for number, is_inner in members if is_inner == wanted for run in runs.get(number, [])])
                for wanted in (True, False)
            )
            shape = _enclosed([[run] for run in outer], [[run] for run in inner]) or _lines(outer)
            if shape is not None:
                is_cut = not whole.issuperset(number for number, _ in members)
                yield IncompleteArea(tags, source, shape, is_cut)


def _read_relations(path: Path, numbers: set[int]) -> Iterator[tuple[str, dict[str, str], list[tuple[int, bool]]]]:
    """Yield the source, tags and member ways of relations, with whether each way bounds a hole."""
    wanted = read_osm(path, osmium.filter.IdFilter(numbers), entities=osmium.osm.RELATION) if numbers else ()
    for relation in wanted:
        members = [(member.ref, member.role in INNER_ROLES) for member in relation.members if member.type == "w"]
        yield source_id(relation, "r"), read_tags(relation.tags), members


def _read_ways(path: Path, numbers: set[int]) -> Iterator[Any]:
    """Yield ways with the locations of their nodes."""
    with located_elements(path, osmium.osm.NODE | osmium.osm.WAY) as processor:
        processor.with_filter(osmium.filter.EntityFilter(osmium.osm.WAY))
        yield from processor.with_filter(osmium.filter.IdFilter(numbers))


def _known_runs(way: Any) -> Runs:
    runs: Runs = [[]]
    for node in way.nodes:
        if node.location.valid():
            runs[-1].append((node.lon, node.lat))
        elif runs[-1]:
            runs.append([])
    return [run for run in runs if run]


def _lines(runs: Runs) -> shapely.Geometry | None:
    lines = [run for run in runs if len(set(run)) > 1]
    if lines:
        return shapely.multilinestrings([shapely.linestrings(run) for run in lines])
    return shapely.multipoints(list(dict.fromkeys(position for run in runs for position in run))) if runs else None


def _join_ends(runs: Runs) -> Runs:
    """Return the runs of a ring, which starts anywhere, with the last and the first as one if they meet."""
    if len(runs) > 1 and runs[0][0] == runs[-1][-1]:
        return [*runs[1:-1], runs[-1] + runs[0][1:]]
    return runs


def _merge(runs: Runs) -> Runs:
    """Return lines with those that meet end to end as one."""
    lines = [shapely.linestrings(run) for run in runs if len(set(run)) > 1]
    merged = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(lines))) if lines else ()
    return [[(x, y) for x, y in line.coords] for line in merged] or runs


def _enclosed(outer: Sequence[Runs], inner: Sequence[Runs] = ()) -> shapely.Geometry | None:
    """Return what rings enclose, each given by its runs in order; None if the outer ones cannot be closed."""
    areas, holes = ([_close(runs) for runs in rings] for rings in (outer, inner))
    if not areas or any(area is None for area in areas):
        return None
    enclosed = shapely.difference(shapely.union_all(areas), shapely.union_all([hole for hole in holes if hole]))
    return None if shapely.is_empty(enclosed) else enclosed


def _close(runs: Runs) -> shapely.Geometry | None:
    """Return the polygons of a ring whose gaps are closed by straight lines; None if they are too large."""
    ring = [position for run in runs for position in run]
    if len(set(ring)) < 3:
        return None
    if max(ring)[0] - min(ring)[0] > 180:  # it crosses 180 degrees
        return _close([[(x % 360, y) for x, y in run] for run in runs])
    scale = cos(radians(ring[0][1]))
    known = sum(dist((a * scale, b), (c * scale, d)) for run in runs for (a, b), (c, d) in pairwise(run))
    gaps = sum(
        dist((run[-1][0] * scale, run[-1][1]), (after[0][0] * scale, after[0][1]))
        for run, after in zip(runs, [*runs[1:], runs[0]], strict=True)
    )
    if gaps > MAX_GAP_SHARE * (known + gaps):
        return None
    parts = shapely.get_parts(shapely.get_parts(shapely.make_valid(shapely.Polygon(ring))))
    polygons = [part for part in parts if shapely.get_dimensions(part) == 2]
    return shapely.multipolygons(polygons) if polygons else None
