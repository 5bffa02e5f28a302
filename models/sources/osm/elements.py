"""The elements of an OpenStreetMap file that have a class of classes.toml, with their geometry."""

import logging
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import osmium
import shapely

from models.citymap.geometry.tiling import Geometries
from models.errors import MapError
from models.sources.osm.classes import OsmClass, find_class, load_classes
from models.sources.osm.incomplete import IncompleteAreas, known_line
from models.sources.osm.reading import batched, explained_errors, geometry_factories, located_elements, source_id
from models.sources.osm.tags import read_tags

LINEAR_KEYS = ("highway", "railway", "barrier", "tunnel", "bridge")  # closed ways of these are loops, not areas


@dataclass(frozen=True, slots=True)
class ClassifiedElement:
    """An element with its class."""

    wkb: str
    osm_class: OsmClass
    order: int
    tags: dict[str, str]
    source_id: str


_log = logging.getLogger(__name__)
Batch = tuple[list[ClassifiedElement], Geometries]  # with the geometry of each, in degrees


def read_elements(path: Path) -> Iterator[Batch]:
    """Yield the elements of a file with a class, in batches; raise MapError if there are none, or it cannot be read."""
    keys = sorted({key for row in load_classes() for key, _ in row.required})
    is_empty = True
    with explained_errors(path), located_elements(path) as processor:
        processor.with_areas().with_filter(osmium.filter.KeyFilter(*keys))
        for batch in batched(_classify(processor, path)):
            is_empty = False
            yield batch, shapely.from_wkb([element.wkb for element in batch])
    if is_empty:
        raise MapError(
            f"{path}: it has no building, street, tree or other known object; "
            "take an extract of an inhabited place, or extend models/sources/osm/classes.toml"
        )


def _classify(processor: Any, path: Path) -> Iterator[ClassifiedElement]:
    create, incomplete, misplaced = geometry_factories(), IncompleteAreas(), list[str]()
    for element in processor:
        kind = element.type_str()
        tags = read_tags(element.tags)
        match = find_class(tags) if _is_visible(tags) else None
        if match is None:
            continue
        number, row = match
        if kind == "a":
            incomplete.note_area(element)
        if _is_area(element, kind, row, tags):
            incomplete.expect(element, tags)
        elif _is_wanted(element, kind, row, tags):
            if wkb := _geometry(create[kind], element, kind):
                yield ClassifiedElement(wkb, row, number, tags, source_id(element, kind))
            elif kind == "n":
                misplaced.append(source_id(element, kind))
    if misplaced:
        text = "%s: left out %d elements with coordinates out of range, such as %s"
        _log.warning(text, path.name.split(".")[0], len(misplaced), misplaced[0])
    for area in incomplete.read(path):
        match = find_class(area.tags)
        if match is not None and shapely.get_dimensions(area.shape) > 0:
            yield ClassifiedElement(shapely.to_wkb(area.shape, hex=True), match[1], match[0], area.tags, area.source_id)


def _geometry(create: Any, element: Any, kind: str) -> str | None:
    """Return the geometry of an element, of a way its known part; None if nothing can be drawn."""
    try:
        return str(create(element))
    except (osmium.InvalidLocationError, RuntimeError):  # nodes that the extract left out, or a broken ring
        line = known_line(element) if kind == "w" else None
        return shapely.to_wkb(line, hex=True) if line is not None and shapely.length(line) else None


def _is_visible(tags: dict[str, str]) -> bool:
    """Whether a passer-by at ground level can see an element; cellars, subways and rooms are hidden."""
    layer, level = tags.get("layer", "0"), tags.get("level", "0")
    underground = layer.startswith("-") or tags.get("location") in ("underground", "indoor")
    return not underground and tags.get("indoor", "no") == "no" and "0" in level.replace(";", ",").split(",")


def _is_wanted(element: Any, kind: str, row: OsmClass, tags: dict[str, str]) -> bool:
    """Whether to use this form of an element: osmium yields a closed way as a way and as an area."""
    if kind == "n":
        return row.shape in ("column", "crown", "box") or row.label == "crossing"
    if row.shape in ("column", "crown") or kind == "r":
        return False
    if kind == "w":
        return _is_linear(row, tags) if element.is_closed() else row.shape != "outline"
    return not _is_linear(row, tags) or (row.shape != "wall" and not element.from_way())


def _is_area(element: Any, kind: str, row: OsmClass, tags: dict[str, str]) -> bool:
    """Whether an element should come again as an area that is wanted."""
    if row.shape in ("column", "crown"):
        return False
    if kind == "w":
        return element.is_closed() and not _is_linear(row, tags)
    return kind == "r" and (row.shape != "wall" or not _is_linear(row, tags))


def _is_linear(row: OsmClass, tags: dict[str, str]) -> bool:
    return row.shape == "wall" or (row.required[0][0] in LINEAR_KEYS and tags.get("area") != "yes")
