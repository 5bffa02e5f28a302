"""Features of an OpenStreetMap file: what an element becomes, and which of them are one instance."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from models.city.colours import material_colour, parse_colour
from models.city.osm.classes import OsmClass
from models.city.tiled.solids import Shape, Solid

STOREY_M = 3.2
UPRIGHT_MERGE_M = 1.0  # a lamp and the sign it carries are mapped this close
COLOUR_KEYS = ("building:colour", "colour")
MATERIAL_KEYS = ("building:material", "material", "surface")


@dataclass(frozen=True, slots=True)
class Feature:
    """A map element on its way to an instance; `geometry` is in metres, `group` numbers the instance.

    Of a line that stands for a strip of ground `geometry` is the strip, `axis` the line, `width_m` how wide it is.
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
    group: int = -1
    axis: shapely.Geometry | None = None
    width_m: float = 0.0

    @property
    def solid(self) -> Solid:
        """How it stands there."""
        is_area = shapely.get_dimensions(self.geometry) == 2
        outline = self.geometry if self.shape == "ground" or not is_area else shapely.boundary(self.geometry)
        return Solid(self.group, self.shape, outline, self.base_m, self.height_m)


def as_feature(
    row: OsmClass, order: int, tags: Mapping[str, str], source_id: str, geometry: shapely.Geometry
) -> Feature:
    """What an element of a class becomes; `order` is the row of the class in the table, `geometry` in metres."""
    colours = (parse_colour(tags[key]) for key in COLOUR_KEYS if key in tags)
    materials = (material_colour(tags[key]) for key in MATERIAL_KEYS if key in tags)
    axis, width = None, 0.0
    if row.shape == "ground" and shapely.get_dimensions(geometry) < 2:
        axis, width = geometry, _metres(tags.get("width", "")) or row.width_m
        geometry = shapely.buffer(
            geometry, width / 2, quad_segs=4, cap_style="flat" if row.label != "crossing" else "round"
        )
    return Feature(
        label=row.label,
        shape=row.shape,
        order=order,
        walkable=row.walkable,
        geometry=geometry,
        height_m=_height(tags, row.height_m),
        base_m=_metres(tags.get("min_height", "")) or STOREY_M * (_metres(tags.get("building:min_level", "")) or 0.0),
        rgb=next((rgb for rgb in (*colours, *materials) if rgb), None),
        name=tags.get("name:en") or tags.get("name"),
        source_id=source_id,
        axis=axis,
        width_m=width,
    )


def _height(tags: Mapping[str, str], default_m: float) -> float:
    levels = _metres(tags.get("building:levels", ""))
    return _metres(tags.get("height", "")) or (STOREY_M * levels if levels else default_m)


def _metres(text: str) -> float | None:
    """A length as mappers write it ("12", "12 m", "12.5m"); None if it is something else."""
    try:
        value = float(text.lower().removesuffix("m").strip())
    except ValueError:
        return None
    return value if 0 < value < 1000 else None


def merge(features: Sequence[Feature]) -> list[Feature]:
    """Join what OpenStreetMap splits: set `group`, one number an instance, in order of their first features.

    Lines and surfaces of one label, name and colour that touch are one (a road in five ways); upright
    things within a metre are one, named by the first in the table (a lamp and its sign); a crossing
    mapped as a node is left out where it is also mapped as a way.
    """
    crossings = [f.geometry for f in features if f.label == "crossing" and not f.source_id.startswith("node/")]
    tree = shapely.STRtree(crossings)
    features = [
        f
        for f in features
        if not (f.label == "crossing" and f.source_id.startswith("node/") and tree.query(f.geometry, "intersects").size)
    ]
    features = sorted(features, key=lambda f: f.order)
    geometries = np.array([f.geometry for f in features], dtype=object)
    is_upright = np.array([f.shape == "column" for f in features])
    known: dict[object, int] = {}
    keys = np.array([known.setdefault((f.label, f.name, f.rgb, f.shape), len(known)) for f in features])
    is_joinable = np.array([f.shape in ("wall", "ground") for f in features])
    left, right = shapely.STRtree(geometries).query(geometries, "dwithin", distance=UPRIGHT_MERGE_M)
    touches = is_joinable[left] & (keys[left] == keys[right])
    touches[touches] = shapely.intersects(geometries[left[touches]], geometries[right[touches]])
    joined = touches | (is_upright[left] & is_upright[right])
    graph = coo_array((np.ones(joined.sum()), (left[joined], right[joined])), shape=(len(features),) * 2)
    groups = connected_components(graph, directed=False)[1]
    first = np.unique(groups, return_index=True)[1]
    kept = is_upright & (first[groups] != np.arange(len(features)))  # carried by another upright thing
    left = [(f, int(g)) for f, g, drop in zip(features, groups, kept, strict=True) if not drop]
    number = {group: n for n, group in enumerate(dict.fromkeys(group for _, group in left))}
    return [replace(f, group=number[group]) for f, group in left]
