"""Make a large city from a small one: copies of an extract side by side, as one OpenStreetMap file."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, radians, sqrt
from pathlib import Path
from typing import Any, Final

import osmium

from models.errors import MapError
from models.sources.osm.copy_names import CopyNames, ExtractNames
from models.sources.osm.reading import SUFFIXES, explained_errors

UNITS_PER_DEGREE: Final = 10_000_000  # OpenStreetMap stores coordinates in these units
BOX_MARGIN_UNITS: Final = 1000  # around the nodes of a file without a box, for features drawn wider than their line
OSM_TYPES: Final = {"n": osmium.osm.NODE, "w": osmium.osm.WAY, "r": osmium.osm.RELATION}  # in a file's order
Box = tuple[int, int, int, int]


@dataclass(frozen=True, slots=True)
class CopyGrid:
    """The layout of copies: row by row from the south-west, copy 0 where the extract is."""

    box: Box  # west, south, east, north of one copy, in units of 1e-7 degrees
    copies: int

    @property
    def columns(self) -> int:
        """Return the copies in a row, so that the grid is about as wide as it is high."""
        width, height = self._size
        metres = width * cos(radians((self.box[1] + self.box[3]) / 2 / UNITS_PER_DEGREE))
        return max(1, min(self.copies, round(sqrt(self.copies * height / metres))))

    @property
    def _size(self) -> tuple[int, int]:
        west, south, east, north = self.box
        return east - west + 1, north - south + 1

    def shift(self, copy: int) -> tuple[int, int]:
        """Return how far east and north of copy 0 a copy is, in units of 1e-7 degrees."""
        row, column = divmod(copy, self.columns)
        width, height = self._size
        return column * width, row * height

    def bounds(self) -> tuple[float, float, float, float]:
        """Return west, south, east, north of the grid in degrees; raise MapError if it does not fit on Earth."""
        west, south, east, north = self.box
        east, north = east + self.shift(self.columns - 1)[0], north + self.shift(self.copies - 1)[1]
        if east > 180 * UNITS_PER_DEGREE or north > 85 * UNITS_PER_DEGREE:
            raise MapError(
                f"{self.copies} copies side by side reach beyond 180 degrees east or 85 north; "
                "ask for fewer cells, or give a map further from there"
            )
        return west / UNITS_PER_DEGREE, south / UNITS_PER_DEGREE, east / UNITS_PER_DEGREE, north / UNITS_PER_DEGREE

    def to_first_copy(self, lat: float, lon: float) -> tuple[float, float]:
        """Return the position in copy 0 of a position in the grid, in degrees."""
        width, height = self._size
        rows = -(-self.copies // self.columns)
        column = min(max(int((lon * UNITS_PER_DEGREE - self.box[0]) // width), 0), self.columns - 1)
        row = min(max(int((lat * UNITS_PER_DEGREE - self.box[1]) // height), 0), rows - 1)
        return lat - row * height / UNITS_PER_DEGREE, lon - column * width / UNITS_PER_DEGREE


@dataclass(frozen=True, slots=True)
class CityExtract:
    """An extract to be copied."""

    path: Path
    box: Box  # of header and nodes, in units of 1e-7 degrees; a file without a box gets a margin
    numbers: dict[str, int]  # span of the ids by osmium's letter; each copy's ids are shifted by it
    names: ExtractNames

    @classmethod
    def read(cls, path: Path) -> "CityExtract":
        """Read an OpenStreetMap file once; raise MapError if it cannot be read, or has no positions."""
        if not path.is_file() or not path.name.lower().endswith(SUFFIXES):
            raise MapError(f"{path}: not an OpenStreetMap file; give one that ends in {' or '.join(SUFFIXES)} as --map")
        element: Any
        names, ids, bounds = ExtractNames(), {letter: {0} for letter in OSM_TYPES}, _BoundingBox()
        with explained_errors(path):
            header = osmium.io.Reader(str(path)).header().box()
            for element in osmium.FileProcessor(str(path)):
                letter = element.type_str()
                names.add((letter, element.id), {tag.k: tag.v for tag in element.tags})
                for kind, number in [(letter, element.id), *_references(element)]:
                    ids[kind].add(number)
                if letter == "n" and element.location.valid():
                    bounds.add(element.location)
        if header.valid():
            bounds.add(header.bottom_left)
            bounds.add(header.top_right)
        box = bounds.box(path, 0 if header.valid() else BOX_MARGIN_UNITS)
        return cls(path, box, {kind: max(numbers) - min(numbers) + 1 for kind, numbers in ids.items()}, names)

    def write_tiled(self, copies: int, out: Path) -> CopyGrid:
        """Write copies side by side into an .osm.pbf; the file is read again for each, with one element in memory.

        Copy 0 is the extract as it is. The others have shifted ids and coordinates and new names (`copy_names`). Raise
        MapError if they do not fit on Earth, or a file cannot be read or written.
        """
        block, header = CopyGrid(self.box, copies), osmium.io.Header()
        header.add_box(osmium.osm.Box(*block.bounds()))
        header.set("sorting", "Type_then_ID")
        try:
            with osmium.SimpleWriter(str(out), header=header) as writer:
                for entity in OSM_TYPES.values():
                    for copy in range(copies):
                        for element in self._copied(block, copy, entity):
                            writer.add(element)
        except (RuntimeError, ValueError, OSError) as error:
            raise MapError(f"{out}: cannot be written ({error}); make room, or give another map") from error
        return block

    def _copied(self, block: CopyGrid, copy: int, entity: Any) -> Iterator[Any]:
        elements = osmium.FileProcessor(str(self.path), entity)
        if not copy:
            yield from elements
            return
        names, shift = self.names.in_copy(copy), block.shift(copy)
        id_shift = {kind: copy * count for kind, count in self.numbers.items()}
        for element in elements:
            yield _move(element, names, id_shift, shift)


class _BoundingBox:
    def __init__(self) -> None:
        self._west = self._south = 1 << 40
        self._east = self._north = -(1 << 40)

    def add(self, place: Any) -> None:
        self._west, self._east = min(self._west, place.x), max(self._east, place.x)
        self._south, self._north = min(self._south, place.y), max(self._north, place.y)

    def box(self, path: Path, margin: int) -> Box:
        if self._west > self._east:
            raise MapError(f"{path}: it has no positions; take an extract of an inhabited place")
        return self._west - margin, self._south - margin, self._east + margin, self._north + margin


def _references(element: Any) -> list[tuple[str, int]]:
    if element.type_str() == "w":
        return [("n", node.ref) for node in element.nodes]
    if element.type_str() == "r":
        return [(member.type, member.ref) for member in element.members]
    return []


def _move(element: Any, names: CopyNames, id_shift: dict[str, int], shift: tuple[int, int]) -> Any:
    letter = element.type_str()
    tags = names.tags((letter, element.id), {tag.k: tag.v for tag in element.tags})
    changed: dict[str, Any] = {"id": element.id + id_shift[letter], "tags": tags}
    if letter == "n" and element.location.valid():
        east, north = shift
        changed["location"] = (
            (element.location.x + east) / UNITS_PER_DEGREE,
            (element.location.y + north) / UNITS_PER_DEGREE,
        )
    elif letter == "w":
        changed["nodes"] = [node.ref + id_shift["n"] for node in element.nodes]
    elif letter == "r":
        changed["members"] = [(m.type, m.ref + id_shift[m.type], m.role) for m in element.members]
    return element.replace(**changed)
