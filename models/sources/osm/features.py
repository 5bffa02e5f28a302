"""Features of an OpenStreetMap file: elements with a class, and which of them are one instance."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from models.citymap.colours import material_colour, parse_colour
from models.citymap.geometry.solids import Shape, Solid
from models.citymap.points import Ints
from models.sources.osm.classes import OsmClass

STOREY_M = 3.2  # height of a storey, where only levels are mapped
UPRIGHT_MERGE_M = 1.0  # a lamp and the sign on it are mapped this close
COLOUR_KEYS = ("building:colour", "colour")
MATERIAL_KEYS = ("building:material", "material", "surface")


@dataclass(frozen=True, slots=True)
class Feature:
    """A map element on its way to an instance; `geometry` is in metres.

    For a line that stands for a strip of ground, `geometry` is the strip, `axis` the line and `width_m` its width.
    """

    label: str
    shape: Shape
    order: int
    walkable: bool
    geometry: shapely.Geometry
    height_m: float
    base_m: float
    rgb: tuple[float, float, float] | None
    name: str | None
    source_id: str
    axis: shapely.Geometry | None = None
    width_m: float = 0.0

    def solid(self, instance: int, base_m: float, height_m: float) -> Solid:
        """Return the feature as a solid of an instance; all solids of an instance have the same heights."""
        is_area = shapely.get_dimensions(self.geometry) == 2
        outline = self.geometry if self.shape == "ground" or not is_area else shapely.boundary(self.geometry)
        return Solid(instance, self.shape, outline, base_m, height_m)


def build_feature(
    row: OsmClass, order: int, tags: Mapping[str, str], source_id: str, geometry: shapely.Geometry
) -> Feature:
    """Build the feature of an element; `order` is the row of its class in the table, `geometry` is in metres."""
    colours = (parse_colour(tags[key]) for key in COLOUR_KEYS if key in tags)
    materials = (material_colour(tags[key]) for key in MATERIAL_KEYS if key in tags)
    axis, width = None, 0.0
    if row.shape == "ground" and shapely.get_dimensions(geometry) < 2:
        axis, width = geometry, _parse_m(tags.get("width", "")) or row.width_m
        geometry = shapely.buffer(
            geometry, width / 2, quad_segs=4, cap_style="flat" if row.label != "crossing" else "round"
        )
    return Feature(
        label=row.label,
        shape=row.shape,
        order=order,
        walkable=row.walkable,
        geometry=geometry,
        height_m=_height_m(tags, row.height_m),
        base_m=_parse_m(tags.get("min_height", "")) or STOREY_M * (_parse_m(tags.get("building:min_level", "")) or 0.0),
        rgb=next((rgb for rgb in (*colours, *materials) if rgb), None),
        name=tags.get("name:en") or tags.get("name") or None,
        source_id=source_id,
        axis=axis,
        width_m=width,
    )


def _height_m(tags: Mapping[str, str], default_m: float) -> float:
    levels = _parse_m(tags.get("building:levels", ""))
    return _parse_m(tags.get("height", "")) or (STOREY_M * levels if levels else default_m)


def _parse_m(text: str) -> float | None:
    """Parse a length as mappers write it ("12", "12 m", "12.5m"); return None for anything else."""
    try:
        value = float(text.lower().removesuffix("m").strip())
    except ValueError:
        return None
    return value if 0 < value < 1000 else None


def find_joins(features: Sequence[Feature]) -> tuple[Ints, Ints]:
    """Find the features, in order of their classes, that OpenStreetMap splits or repeats.

    Lines and surfaces of one label, name and colour that touch are one (a road in five ways); upright features within a
    metre are one, named by the first in the table (a lamp and its sign); a crossing mapped as a node is left out where
    it is also mapped as a way. Return rows [D] of those that are left out, and pairs [E, 2] of others, the lower first.
    """
    is_crossing = np.array([f.label == "crossing" for f in features], np.bool_)
    is_node = np.array([f.source_id.startswith("node/") for f in features], np.bool_)
    geometries = np.array([f.geometry for f in features], dtype=object)
    nodes = np.flatnonzero(is_crossing & is_node)
    duplicates = shapely.STRtree(geometries[is_crossing & ~is_node]).query(geometries[nodes], "intersects")[0]
    left_out = nodes[np.unique(duplicates)]
    rows = np.delete(np.arange(len(features)), left_out)
    features, geometries = [features[row] for row in rows.tolist()], geometries[rows]
    is_upright = np.array([f.shape == "column" for f in features], np.bool_)
    known: dict[object, int] = {}
    keys = np.array([known.setdefault((f.label, f.name, f.rgb, f.shape), len(known)) for f in features])
    is_joinable = np.array([f.shape in ("wall", "ground") for f in features], np.bool_)
    left, right = shapely.STRtree(geometries).query(geometries, "dwithin", distance=UPRIGHT_MERGE_M)
    touches = is_joinable[left] & (keys[left] == keys[right])
    touches[touches] = shapely.intersects(geometries[left[touches]], geometries[right[touches]])
    joined = (left < right) & (touches | (is_upright[left] & is_upright[right]))
    return left_out, np.stack([rows[left[joined]], rows[right[joined]]], axis=1)
