"""The objects of a file of a city's own data."""

import hashlib
import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import shapely

from models.errors import DataError
from models.sources.extras.csv_rows import read_rows
from models.sources.extras.geojson import read_features
from models.sources.extras.kinds import ObjectKind
from models.sources.extras.overpass import read_elements
from models.sources.extras.records import ExtraRecord
from models.sources.osm.classes import OsmClass

MAX_BYTES: Final = 256 * 2**20  # a file is parsed in memory, in about ten times its size
TABLE_SUFFIXES: Final = (".csv", ".tsv", ".txt")
FORMATS: Final = "a .csv file with columns lat and lon, a GeoJSON file (.geojson, .json), or Overpass JSON"
# Properties that are used, next to the tags of the kind
USED_PROPERTY: Final = re.compile(
    r"(?:(?:alt|loc|official|old|short)_)?name(?::[a-z]{2,3}(?:[-_]\w+)?)?|addr:(?:housenumber|street|place)"
    r"|colour|material|height"
)
TITLES: Final = ("title", "label")  # of an object without a name


@dataclass(frozen=True, slots=True)
class ExtraObject:
    """An object that joins a map."""

    geometry: shapely.Geometry  # in degrees, longitude first
    tags: Mapping[str, str]  # with the names
    label: str | None  # its kind, if tags do not give it
    source_id: str  # "bins.geojson/17"
    osm_class: OsmClass | None  # None without a part in near hints


@dataclass(frozen=True, slots=True)
class ExtraLayer:
    """The objects of one kind in a file."""

    name: str  # of the file
    kind: ObjectKind
    sha256: str  # of the file
    objects: tuple[ExtraObject, ...]
    unplaced: int  # rows without a position
    outside: int = 0  # objects that `clip` left out

    @classmethod
    def read(cls, path: Path, kind: str) -> "ExtraLayer":
        """Read the objects of a kind; raise DataError that names the file, the row and what to do."""
        object_kind = ObjectKind.parse(kind)
        content = _content(path)
        records = list(_records(path, content))
        placed = [record for record in records if record.geometry is not None]
        if not placed:
            raise DataError(f"{path}: it has no object with a position; give {FORMATS}")
        objects = [item for record in placed for item in _objects(path, record, object_kind)]
        return cls(
            path.name, object_kind, hashlib.sha256(content).hexdigest(), tuple(objects), len(records) - len(placed)
        )

    def clip(self, box: tuple[float, float, float, float]) -> "ExtraLayer":
        """Return the layer with the parts of its objects in a box, in degrees as `models.sources.osm.map.Box`.

        Raise DataError if nothing is there.
        """
        west, south, east, north = box
        shapes = [item.geometry for item in self.objects]
        if east > 180:
            shapes = shapely.transform(shapes, lambda lon_lat: (lon_lat - [west, 0]) % [360, 720] + [west, 0])
        inside = shapely.clip_by_rect(shapes, *box)
        objects = [
            replace(item, geometry=geometry)
            for item, geometry in zip(self.objects, inside, strict=True)
            if not shapely.is_empty(geometry)
        ]
        if not objects:
            x, y = shapely.get_coordinates(shapes[0])[0]
            turned = shapely.transform(shapes, lambda lon_lat: lon_lat[:, ::-1])
            is_turned = not shapely.is_empty(shapely.clip_by_rect(turned, *box)).all()
            cure = "its latitude and longitude are exchanged: exchange them" if is_turned else "give data of this map"
            raise DataError(
                f"{self.name}: none of its {len(shapes)} objects is on the map (box {west:.4f},{south:.4f},{east:.4f},"
                f"{north:.4f}); the first is at latitude {y:.5f}, longitude {x:.5f}; {cure}"
            )
        return replace(self, objects=tuple(objects), outside=len(self.objects) - len(objects))

    def __str__(self) -> str:
        """Return the file and what its objects are."""
        return f"{self.name} as {self.kind}"


def _content(path: Path) -> bytes:
    try:
        if path.stat().st_size > MAX_BYTES:
            raise DataError(f"{path}: larger than {MAX_BYTES >> 20} MB; give the part of it that is on the map")
        return path.read_bytes()
    except OSError as error:
        raise DataError(f"{path}: cannot be read ({error.strerror}); give {FORMATS}") from error


def _records(path: Path, content: bytes) -> Iterator[ExtraRecord]:
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise DataError(f"{path}: not UTF-8 at byte {error.start}; save it as UTF-8") from error
    if path.suffix.lower() in TABLE_SUFFIXES:
        return read_rows(path, text)
    try:
        parsed = json.loads(text)
    except ValueError as error:
        raise DataError(f"{path}: not JSON ({error}); give {FORMATS}") from error
    if isinstance(parsed, dict) and "elements" in parsed:
        return read_elements(path, parsed)
    if isinstance(parsed, dict) and "type" in parsed:
        return read_features(path, parsed)
    raise DataError(f"{path}: neither GeoJSON nor Overpass JSON; give {FORMATS}")


def _objects(path: Path, record: ExtraRecord, kind: ObjectKind) -> Iterator[ExtraObject]:
    """Yield the objects of a record, of which most have one."""
    tags, source_id = {**_used_properties(record.properties), **kind.tags}, f"{path.name}/{record.row}"
    for part in _parts(record.geometry):
        geometry = shapely.make_valid(shapely.force_2d(part))
        west, south, east, north = geometry.bounds
        if not (-180 <= west <= east <= 360 and -90 <= south <= north <= 90):
            raise DataError(
                f"{path}, {record.title}: {west:.10g}, {south:.10g} is not a longitude and a latitude in degrees; "
                "convert the file to WGS 84 (ogr2ogr -t_srs EPSG:4326), or exchange latitude and longitude"
            )
        yield ExtraObject(geometry, tags, kind.label, source_id, kind.osm_class(geometry))


def _parts(geometry: shapely.Geometry) -> Iterator[shapely.Geometry]:
    if geometry.geom_type in ("GeometryCollection", "MultiPoint"):
        for part in shapely.get_parts(geometry):
            yield from _parts(part)
    elif not geometry.is_empty:
        yield geometry


def _used_properties(properties: Mapping[str, Any]) -> dict[str, str]:
    """Return the properties that are used, as tags of OpenStreetMap."""
    texts = {
        str(key).strip().lower(): " ".join(str(value).split())
        for key, value in properties.items()
        if isinstance(value, str | int | float) and str(value).strip()
    }
    used = {key: text for key, text in texts.items() if USED_PROPERTY.fullmatch(key)}
    title = next((texts[key] for key in TITLES if key in texts), None)
    return used if title is None or "name" in used else {"name": title, **used}
