"""Read OpenStreetMap (.osm.pbf, .osm) into a CityMap with extruded geometry (docs/formats.md, OpenStreetMap).

Footprints, lines and nodes are read as mapped and raised as `classes.toml` says. Colours come from colour, material and
surface tags.
"""

import logging
from collections.abc import Iterator, Sequence
from itertools import chain
from pathlib import Path
from typing import Final

import numpy as np
import shapely

from models.citymap.colours import BASIC_PALETTE
from models.citymap.frame import Frame
from models.citymap.geometry.tiling import Geometries
from models.citymap.types import CityMap, CutRules
from models.errors import MapError
from models.sources.extras.layer import ExtraLayer
from models.sources.osm.classes import OsmClass, load_classes
from models.sources.osm.elements import ClassifiedElement, read_elements
from models.sources.osm.extent import Box, Extent, read_extent
from models.sources.osm.feature_strips import FeatureStrips
from models.sources.osm.features import Feature, build_feature
from models.sources.osm.imported_map import ImportedMap
from models.sources.osm.ordering import ordered_file
from models.sources.osm.reading import batched
from models.spool import spool_directory

STUFF_SHAPES = ("outline", "wall", "ground")
ATTRIBUTION = "© OpenStreetMap contributors, ODbL 1.0"
MIN_PART_POINTS = 24  # of a part of stuff: 6 m2 of ground
LOCATION_SPACING_M = 2.0  # between locations where a person can stand, about
EDGE_M: Final = 0.02  # two units of OpenStreetMap's coordinates

_log = logging.getLogger(__name__)


def load_osm(path: Path, name: str | None = None, extras: Sequence[ExtraLayer] = ()) -> CityMap:
    """Read an OpenStreetMap file into a city map, in a local frame at the middle of the extract.

    Its default name is the file's up to the first dot. `extras` join it. Raise MapError if the file is missing, not
    usable or too large.
    """
    used = dict.fromkeys(item.osm_class for layer in extras for item in layer.objects if item.osm_class is not None)
    classes = (*load_classes(), *(row for row in used if row not in load_classes()))
    with ordered_file(path) as ordered, spool_directory() as directory:
        extent = read_extent(ordered)
        for warning in extent.warnings():
            _log.warning("%s: %s", path.name.split(".")[0], warning)
        features = chain(read_features(ordered, extent), _extra_features(extras, classes, extent.frame))
        strips = FeatureStrips(directory, features, classes)
        if not strips.numbers:
            raise MapError(f"{path}: it has nothing inside its own bounds; download it again, or correct its bounds")
        return _city_map(name or path.name.split(".")[0], strips, extent.frame)


def read_features(path: Path, extent: Extent) -> Iterator[list[Feature]]:
    """Yield the features of a file, in metres and clipped to its box, in batches; errors as `load_osm`."""
    for elements, lon_lat in read_elements(path):
        yield list(_build_features(elements, lon_lat, extent.frame, extent.box))


def _extra_features(extras: Sequence[ExtraLayer], classes: Sequence[OsmClass], frame: Frame) -> Iterator[list[Feature]]:
    """Yield the features of a city's own data, with their rows in `classes`, in batches."""
    number = {row: n for n, row in enumerate(classes)}
    objects = ((item, item.osm_class) for layer in extras for item in layer.objects if item.osm_class is not None)
    for batch in batched(objects):
        elements = [ClassifiedElement("", row, number[row], dict(item.tags), item.source_id) for item, row in batch]
        yield list(_build_features(elements, np.array([item.geometry for item, _ in batch]), frame, None))


def _build_features(
    elements: Sequence[ClassifiedElement], lon_lat: Geometries, frame: Frame, box: Box | None
) -> Iterator[Feature]:
    geometries = shapely.transform(lon_lat, lambda xy: frame.from_wgs84(xy[:, 1], xy[:, 0]))
    if box:
        west, south, east, north = box
        corners = frame.from_wgs84(np.array([south, north]), np.array([west, east]))
        clipped = shapely.clip_by_rect(geometries, *corners[0], *corners[1])
        # what is on an edge itself, as in a file whose box is that of its nodes
        rows = np.flatnonzero(shapely.is_empty(clipped))
        clipped[rows] = shapely.clip_by_rect(geometries[rows], *(corners[0] - EDGE_M), *(corners[1] + EDGE_M))
        geometries = clipped
    for element, geometry in zip(elements, geometries, strict=True):
        if not shapely.is_empty(geometry):
            yield build_feature(element.osm_class, element.order, element.tags, element.source_id, geometry)


def _city_map(name: str, strips: FeatureStrips, frame: Frame) -> CityMap:
    rules = CutRules(min_part_points=MIN_PART_POINTS)
    imported = ImportedMap.from_strips(strips, rules)
    locations = imported.pieces.ground_lattice(
        np.flatnonzero(imported.is_walkable[imported.pieces.instance]), LOCATION_SPACING_M
    )
    if not len(locations):
        raise MapError(f"{name}: it has no street, path or square, so nobody can stand there; take a larger extract")
    return CityMap(
        name=name,
        instances=imported.instances,
        stuff=frozenset(row.label for row in load_classes() if row.shape in STUFF_SHAPES),
        locations_m=locations,
        frame=frame,
        palette=BASIC_PALETTE,
        rules=rules,
        attribution=ATTRIBUTION,
        outlines=imported.outlines,
        pieces=imported.pieces,
    )
