"""Extract a region of a large OpenStreetMap file into a file of its own."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import osmium
import shapely
from shapely.errors import ShapelyError

from models.errors import MapError
from models.sources.osm.ordering import ordered_file
from models.sources.osm.places import find_place
from models.sources.osm.reading import SUFFIXES, explained_errors, open_writer, read_osm
from models.spool import spool_directory

PLACE_PREFIX = "place:"
REGION_FORMS = "give west,south,east,north in degrees, a GeoJSON file with a polygon, or place:NAME"


@dataclass(frozen=True, slots=True)
class Region:
    """A part of the Earth."""

    shape: shapely.Geometry  # in degrees, longitude first

    @classmethod
    def parse(cls, text: str, map_path: Path) -> "Region":
        """Parse "west,south,east,north", the path of a GeoJSON file, or "place:NAME" with a name in a map's file.

        Raise MapError if it encloses nothing.
        """
        if text.startswith(PLACE_PREFIX):
            return cls(find_place(map_path, text.removeprefix(PLACE_PREFIX)))
        path = Path(text)
        try:
            shape = _parse_geojson(path.read_text(encoding="utf-8")) if path.is_file() else _parse_box(text)
        except (ValueError, OSError, ShapelyError, KeyError, TypeError) as error:
            raise MapError(f"'{text[:80]}' is not a region: {REGION_FORMS}") from error
        if shape.is_empty or not shape.area or not shapely.box(-180, -90, 180, 90).covers(shape):
            raise MapError(f"'{text[:80]}' encloses nothing on Earth: {REGION_FORMS}")
        return cls(shape)


def _parse_box(text: str) -> shapely.Geometry:
    west, south, east, north = (float(number) for number in text.split(","))
    if west < east and south < north:
        return shapely.box(west, south, east, north)
    return shapely.Polygon()  # also if one is NaN


def _parse_geojson(text: str) -> shapely.Geometry:
    shapes = shapely.get_parts(shapely.from_geojson(json.dumps(json.loads(text))))
    areas = [shape for shape in shapely.get_parts(shapes) if shapely.get_dimensions(shape) == 2]
    return shapely.make_valid(shapely.union_all(areas))


@contextmanager
def extracted_file(path: Path, region: Region | None) -> Iterator[Path]:
    """Yield a file with the part of a file in a region (the file itself without a region), until the block ends."""
    with ordered_file(path) as ordered:
        if region is None:
            yield ordered
            return
        if not path.is_file() or not path.name.lower().endswith(SUFFIXES):
            raise MapError(f"{path}: --within needs an OpenStreetMap file; leave it out, or give such a file")
        with spool_directory() as directory:
            out = directory / f"{path.name.split('.')[0]}.osm.pbf"
            extract(ordered, region, out)
            yield out


def extract(path: Path, region: Region, out: Path) -> None:
    """Write the elements with a node in a region, with all their nodes, and the region's box, as an .osm.pbf.

    The file is read several times and never held in memory, which only needs a bit for each id. An element around the
    region without a node in it is left out. Raise MapError if the file cannot be read, or has nothing there.
    """
    header = osmium.io.Header()
    header.add_box(osmium.osm.Box(*region.shape.bounds))
    with explained_errors(path):
        taken = _nodes_inside(path, region.shape)
        taken.complete_forward_references(str(path))
        taken.complete_backward_references(str(path), relation_depth=1)
    with open_writer(out, header) as writer:
        for element in read_osm(path, taken.id_filter()):
            writer.add(element)


def _nodes_inside(path: Path, shape: shapely.Geometry) -> osmium.IdTracker:
    west, south, east, north = shape.bounds
    is_box, taken, count = shape.equals(shapely.box(*shape.bounds)), osmium.IdTracker(), 0
    shapely.prepare(shape)
    for node in osmium.FileProcessor(str(path), osmium.osm.NODE):
        assert isinstance(node, osmium.osm.Node)
        x, y = node.lon, node.lat
        if west <= x <= east and south <= y <= north and (is_box or shapely.contains_xy(shape, x, y)):
            taken.add_node(node.id)
            count += 1
    if not count:
        raise MapError(f"{path}: it has nothing in the region; check the file, and that longitude comes first")
    return taken
