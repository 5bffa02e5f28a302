"""Reader: OpenStreetMap (.osm.pbf, .osm) -> CityMap.

A real map with extruded geometry, not LiDAR (docs/formats.md, OpenStreetMap): footprints, lines and nodes are read as
mapped, and points are put on them as `classes.toml` says. Colours come from colour, material and surface tags.
"""

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
import osmium
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from models.city.colours import BASIC_PALETTE, material_colour, parse_colour
from models.city.frame import Frame
from models.city.osm.sampling import GROUND_SPACING_M, Feature, sample_features
from models.city.points import thin
from models.city.types import CityMap, CutRules, Floats, Instance, MapShape
from models.errors import MapError

Shape = Literal["outline", "wall", "ground", "column", "crown", "box"]
STUFF_SHAPES = ("outline", "wall", "ground")
SUFFIXES = (".osm.pbf", ".pbf", ".osm", ".osm.bz2", ".osm.gz")
ATTRIBUTION = "© OpenStreetMap contributors, ODbL 1.0"
STOREY_M = 3.2
MIN_PART_POINTS = 24  # 6 m2 of ground at the sampling's half metre
UPRIGHT_MERGE_M = 1.0  # a lamp and the sign it carries are mapped this close
LINEAR_KEYS = ("highway", "railway", "barrier", "tunnel", "bridge")  # closed ways of these are loops, not areas
COLOUR_KEYS = ("building:colour", "colour")
MATERIAL_KEYS = ("building:material", "material", "surface")


@dataclass(frozen=True, slots=True)
class OsmClass:
    """A row of `classes.toml`: which tags make an instance of which label, and its shape."""

    label: str
    shape: Shape
    tags: tuple[str, ...]
    height_m: float = 0.0
    width_m: float = 2.0
    walkable: bool = False
    required: tuple[tuple[str, frozenset[str] | None], ...] = field(init=False)
    forbidden: tuple[tuple[str, frozenset[str] | None], ...] = field(init=False)

    def __post_init__(self) -> None:
        """Split the tag lines once, because they are asked for every element of the map."""
        split = [(line.startswith("!"), line.lstrip("!").partition("=")) for line in self.tags]
        conditions = [(no, key, None if value == "*" else frozenset(value.split("|"))) for no, (key, _, value) in split]
        object.__setattr__(self, "required", tuple((key, values) for no, key, values in conditions if not no))
        object.__setattr__(self, "forbidden", tuple((key, values) for no, key, values in conditions if no))

    def matches(self, tags: dict[str, str]) -> bool:
        """Whether an element with these tags belongs to this class."""
        return all(
            key in tags and (values is None or tags[key] in values) for key, values in self.required
        ) and not any(key in tags and (values is None or tags[key] in values) for key, values in self.forbidden)


@cache
def load_classes() -> tuple[OsmClass, ...]:
    """The table tag -> class that ships with the package."""
    table = tomllib.loads((Path(__file__).parent / "classes.toml").read_text())
    return tuple(OsmClass(**{**row, "tags": tuple(row["tags"])}) for row in table["class"])


def load_osm(path: Path, name: str | None = None) -> CityMap:
    """Read an OpenStreetMap file into a city map, in a local frame at the middle of the extract.

    Args:
        path: .osm.pbf, .pbf, .osm, .osm.gz or .osm.bz2.
        name: name of the map; the file's name up to the first dot by default.

    Raises:
        MapError: the file is missing, empty, cut short, no OpenStreetMap, or nothing in it is usable.
    """
    elements, bounds = _read_elements(path)
    if not elements:
        raise MapError(
            f"{path}: no building, street, tree or other known object in it; "
            "take an extract of an inhabited place, or extend models/city/osm/classes.toml"
        )
    lon_lat = shapely.from_wkb([element.wkb for element in elements])
    west, south, east, north = bounds or shapely.total_bounds(lon_lat)
    frame = Frame(origin_lat=round((south + north) / 2, 7), origin_lon=round((west + east) / 2, 7))
    geometries = shapely.transform(lon_lat, lambda xy: frame.from_wgs84(xy[:, 1], xy[:, 0]))
    if bounds:
        corners = frame.from_wgs84(np.array([south, north]), np.array([west, east]))
        geometries = shapely.clip_by_rect(geometries, *corners[0], *corners[1])
    features = _merge([_feature(e, g) for e, g in zip(elements, geometries, strict=True) if not shapely.is_empty(g)])
    points, starts = sample_features(features, path)
    city_map = _city_map(name or path.name.split(".")[0], features, points, starts, frame)
    return replace(city_map, shapes=tuple(_shape(feature) for feature in features))


@dataclass(frozen=True, slots=True)
class _Element:
    wkb: str
    osm_class: OsmClass
    order: int
    tags: dict[str, str]
    source_id: str


def _read_elements(path: Path) -> tuple[list[_Element], tuple[float, float, float, float] | None]:
    """The elements of the file that belong to a class, and the extract's box (west, south, east, north)."""
    if not path.is_file():
        raise MapError(f"{path}: no such file; give the path of an .osm.pbf or .osm file")
    if not path.name.lower().endswith(SUFFIXES):
        raise MapError(f"{path}: not an OpenStreetMap file by its name; expected one of {', '.join(SUFFIXES)}")
    if path.stat().st_size == 0:
        raise MapError(f"{path}: the file is empty; download it again")
    keys = sorted({key for row in load_classes() for key, _ in row.required})
    try:
        box = osmium.io.Reader(str(path)).header().box()
        processor = osmium.FileProcessor(str(path)).with_areas().with_filter(osmium.filter.KeyFilter(*keys))
        elements = list(_classify(processor))
    except (RuntimeError, ValueError, OSError, osmium.InvalidLocationError) as error:
        raise MapError(
            f"{path}: cannot be read as OpenStreetMap ({error}); download it again, it may be cut short"
        ) from error
    if not box.valid():
        return elements, None
    return elements, (box.bottom_left.lon, box.bottom_left.lat, box.top_right.lon, box.top_right.lat)


def geometries() -> dict[str, Any]:
    """By osmium's letter of an element what makes its geometry: a point, a line or areas."""
    factory = osmium.geom.WKBFactory()
    return {"n": factory.create_point, "w": factory.create_linestring, "a": factory.create_multipolygon}


def source_id(element: Any, kind: str) -> str:
    """Where an element comes from, "way/1234"; `kind` is osmium's letter."""
    if kind == "a":
        return f"{'way' if element.from_way() else 'relation'}/{element.orig_id()}"
    return f"{'node' if kind == 'n' else 'way'}/{element.id}"


def _classify(processor: Any) -> Iterator[_Element]:
    create = geometries()
    for element in processor:
        kind = element.type_str()
        if kind not in create:
            continue
        if kind == "n" and not element.location.valid():
            raise ValueError(f"node {element.id} has coordinates out of range")
        tags = {tag.k: tag.v for tag in element.tags}
        if not _is_visible(tags):
            continue
        for order, row in enumerate(load_classes()):
            if row.matches(tags):
                if _is_wanted(element, kind, row, tags):
                    try:
                        wkb = create[kind](element)
                    except (osmium.InvalidLocationError, RuntimeError):
                        break  # nodes left out by the extract, or a broken ring: this element has no geometry here
                    yield _Element(wkb, row, order, tags, source_id(element, kind))
                break


def _is_visible(tags: dict[str, str]) -> bool:
    """Whether a passer-by at ground level can see an element; cellars, subways and rooms cannot be seen."""
    layer, level = tags.get("layer", "0"), tags.get("level", "0")
    underground = layer.startswith("-") or tags.get("location") in ("underground", "indoor")
    return not underground and tags.get("indoor", "no") == "no" and "0" in level.replace(";", ",").split(",")


def _is_wanted(element: Any, kind: str, row: OsmClass, tags: dict[str, str]) -> bool:
    """Whether to take this spelling of an element: a closed way comes as a way and as an area."""
    if kind == "n":
        return row.shape in ("column", "crown", "box") or row.label == "crossing"
    if row.shape in ("column", "crown"):
        return False
    linear = row.shape == "wall" or (row.required[0][0] in LINEAR_KEYS and tags.get("area") != "yes")
    if kind == "w":
        return linear if element.is_closed() else row.shape != "outline"
    return not linear or (row.shape != "wall" and not element.from_way())


def _feature(element: _Element, geometry: shapely.Geometry) -> Feature:
    row, tags = element.osm_class, element.tags
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
        order=element.order,
        walkable=row.walkable,
        geometry=geometry,
        height_m=_height(tags, row.height_m),
        base_m=_metres(tags.get("min_height", "")) or STOREY_M * (_metres(tags.get("building:min_level", "")) or 0.0),
        rgb=next((rgb for rgb in (*colours, *materials) if rgb), None),
        name=tags.get("name:en") or tags.get("name"),
        source_id=element.source_id,
        axis=axis,
        width_m=width,
    )


def _height(tags: dict[str, str], default_m: float) -> float:
    levels = _metres(tags.get("building:levels", ""))
    return _metres(tags.get("height", "")) or (STOREY_M * levels if levels else default_m)


def _metres(text: str) -> float | None:
    """A length as mappers write it ("12", "12 m", "12.5m"); None if it is something else."""
    try:
        value = float(text.lower().removesuffix("m").strip())
    except ValueError:
        return None
    return value if 0 < value < 1000 else None


def _merge(features: list[Feature]) -> list[Feature]:
    """Join what OpenStreetMap splits: set `group`, one number an instance.

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
    features.sort(key=lambda f: f.order)
    geometries = np.array([f.geometry for f in features], dtype=object)
    is_upright = np.array([f.shape == "column" for f in features])
    keys = np.unique([f"{f.label}|{f.name}|{f.rgb}|{f.shape}" for f in features], return_inverse=True)[1]
    is_joinable = np.array([f.shape in ("wall", "ground") for f in features])
    left, right = shapely.STRtree(geometries).query(geometries, "dwithin", distance=UPRIGHT_MERGE_M)
    touches = is_joinable[left] & (keys[left] == keys[right])
    touches[touches] = shapely.intersects(geometries[left[touches]], geometries[right[touches]])
    joined = touches | (is_upright[left] & is_upright[right])
    graph = coo_array((np.ones(joined.sum()), (left[joined], right[joined])), shape=(len(features),) * 2)
    groups = connected_components(graph, directed=False)[1]
    first = np.unique(groups, return_index=True)[1]
    kept = is_upright & (first[groups] != np.arange(len(features)))  # carried by another upright thing
    return [f.in_group(int(g)) for f, g, drop in zip(features, groups, kept, strict=True) if not drop]


def _shape(feature: Feature) -> MapShape:
    top_m = feature.base_m + feature.height_m if feature.shape != "outline" else feature.height_m
    drawn = feature.geometry if feature.axis is None else feature.axis
    heights = feature.base_m, 0.0 if feature.shape == "ground" else max(top_m, feature.base_m)
    return MapShape(feature.label, drawn, *heights, feature.width_m, feature.name, feature.source_id)


def _city_map(
    name: str, features: list[Feature], points: Floats, starts: npt.NDArray[np.intp], frame: Frame
) -> CityMap:
    by_group: dict[int, Feature] = {}
    for feature in features:
        by_group.setdefault(feature.group, feature)
    instances: list[Instance] = []
    walkable = []
    for feature, start, stop in zip(by_group.values(), starts[:-1], starts[1:], strict=True):
        if start == stop:
            continue  # covered by what lies above it
        rgb = None if feature.rgb is None else np.asarray(feature.rgb, dtype=np.float32)
        instances.append(
            Instance(len(instances), feature.label, points[start:stop], rgb, feature.name, feature.source_id)
        )
        if feature.walkable:
            walkable.append(points[start:stop])
    if not walkable:
        raise MapError(f"{name}: no street, path or square in it, so there is no place to stand; take a larger extract")
    return CityMap(
        name=name,
        instances=tuple(instances),
        stuff=frozenset(row.label for row in load_classes() if row.shape in STUFF_SHAPES),
        locations_m=thin(np.concatenate(walkable), 4 * GROUND_SPACING_M),
        frame=frame,
        palette=BASIC_PALETTE,
        rules=CutRules(min_part_points=MIN_PART_POINTS),
        attribution=ATTRIBUTION,
    )
