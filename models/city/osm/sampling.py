"""Points on map geometry: outlines and lines raised to their height, ground filled, poles and crowns."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import shapely

from models.city.types import Floats
from models.errors import MapError

GROUND_SPACING_M = 0.5  # diagonal neighbours lie within the 0.75 m that DBSCAN joins
RAISED_SPACING_M = {"outline": 0.7, "wall": 0.5, "box": 0.5}  # 0.7: four neighbours within 0.75 m, enough on a facade
COLUMN_SPACING_M = 0.25
VISIBLE_HEIGHT_M = 15.0  # a 30 m cell on the ground ends here
MAX_POINTS = 150_000_000  # 1.8 GB of coordinates


@dataclass(frozen=True, slots=True)
class Feature:
    """A map element on its way to an instance; `geometry` is in metres, `group` numbers the instance.

    Of a line that stands for a strip of ground `geometry` is the strip, `axis` the line, `width_m` how wide it is.
    """

    label: str
    shape: str
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

    def in_group(self, group: int) -> "Feature":
        """The same feature as part of an instance."""
        return replace(self, group=group)


def sample_features(features: list[Feature], path: Path) -> tuple[Floats, npt.NDArray[np.intp]]:
    """Points of all groups, in the order in which the groups first appear.

    Args:
        features: sorted so that ground which covers comes before ground that is covered.
        path: the map's file, for errors.

    Returns:
        points [P, 3] float32 metres; starts [G + 1]: group g has the points starts[g] to starts[g + 1].

    Raises:
        MapError: the map is too large to hold its points in memory.
    """
    ground = [f for f in features if f.shape == "ground"]
    raised = [f for f in features if f.shape in ("outline", "wall") or (f.shape == "box" and _extent(f.geometry) > 0)]
    upright = [f for f in features if f.shape in ("column", "crown") or (f.shape == "box" and _extent(f.geometry) == 0)]
    expected = sum(shapely.area(f.geometry) for f in ground) / GROUND_SPACING_M**2
    expected += sum(shapely.length(f.geometry) * VISIBLE_HEIGHT_M / RAISED_SPACING_M[f.shape] ** 2 for f in raised)
    if expected > MAX_POINTS:
        raise MapError(
            f"{path}: about {expected / 1e6:.0f} million points, more than the {MAX_POINTS // 10**6} million "
            "that fit in memory; cut it into districts with 'osmium extract' and index each"
        )
    parts = [_sample_ground(ground), _sample_raised(raised), _sample_upright(upright)]
    points = np.concatenate([part[0] for part in parts]).astype(np.float32)
    rank = {group: i for i, group in enumerate(dict.fromkeys(f.group for f in features))}
    groups = np.concatenate([part[1] for part in parts])
    ranks = np.array([rank[g] for g in range(len(rank))], dtype=np.intp)[groups] if rank else groups
    order = np.argsort(ranks, kind="stable")
    return points[order], np.searchsorted(ranks[order], np.arange(len(rank) + 1))


def _extent(geometry: shapely.Geometry) -> float:
    return float(shapely.length(geometry))


def _sample_ground(features: list[Feature]) -> tuple[Floats, npt.NDArray[np.intp]]:
    """Lattice points inside the polygons; where several lie over each other, the first feature's."""
    lattices, owners = [np.zeros((0, 2), dtype=np.int64)], [np.zeros(0, dtype=np.intp)]
    for i, feature in enumerate(features):
        for polygon in shapely.get_parts(feature.geometry):
            inside = _lattice_inside(polygon)
            lattices.append(inside)
            owners.append(np.full(len(inside), i, dtype=np.intp))
    lattice, owner = np.concatenate(lattices), np.concatenate(owners)
    key = lattice[:, 0] * (1 << 32) + lattice[:, 1]
    first = np.unique(key, return_index=True)[1]  # the first occurrence is the feature that covers
    groups = np.array([f.group for f in features], dtype=np.intp)
    xy = lattice[first] * GROUND_SPACING_M
    return np.column_stack([xy, np.zeros(len(xy))]), groups[owner[first]]


def _lattice_inside(polygon: shapely.Geometry) -> npt.NDArray[np.int64]:
    """Lattice coordinates [n, 2] inside one polygon."""
    shapely.prepare(polygon)
    west, south, east, north = np.floor(np.array(polygon.bounds) / GROUND_SPACING_M).astype(np.int64)
    x, y = np.meshgrid(np.arange(west + 1, east + 1), np.arange(south + 1, north + 1))
    inside = shapely.contains_xy(polygon, x * GROUND_SPACING_M, y * GROUND_SPACING_M)
    return np.column_stack([x[inside], y[inside]])


def _sample_raised(features: list[Feature]) -> tuple[Floats, npt.NDArray[np.intp]]:
    """Points along the outlines and lines, repeated upwards from the base to the height."""
    lines: list[shapely.Geometry] = []
    owner: list[int] = []
    for i, feature in enumerate(features):
        outline = (
            shapely.boundary(feature.geometry) if shapely.get_dimensions(feature.geometry) == 2 else feature.geometry
        )
        parts = shapely.get_parts(outline)
        lines.extend(parts)
        owner.extend([i] * len(parts))
    if not lines:
        return np.zeros((0, 3)), np.zeros(0, dtype=np.intp)
    spacing = np.array([RAISED_SPACING_M[f.shape] for f in features])
    steps = np.maximum(1, np.ceil(shapely.length(lines) / spacing[owner]).astype(int)) + 1
    line = np.repeat(np.arange(len(lines)), steps)
    fraction = (np.arange(steps.sum()) - np.repeat(np.cumsum(steps) - steps, steps)) / np.repeat(steps - 1, steps)
    xy = shapely.get_coordinates(
        shapely.line_interpolate_point(np.array(lines, dtype=object)[line], fraction, normalized=True)
    )
    owners = np.array(owner)[line]
    base = np.array([f.base_m for f in features])
    top = np.minimum([max(f.height_m, f.base_m + 1.0) for f in features], np.maximum(VISIBLE_HEIGHT_M, base + 1.0))
    levels = np.maximum(1, np.floor((top - base) / spacing).astype(int)) + 1
    column = np.repeat(np.arange(len(xy)), levels[owners])
    level = np.arange(len(column)) - np.repeat(np.cumsum(levels[owners]) - levels[owners], levels[owners])
    z = base[owners[column]] + level * spacing[owners[column]]
    groups = np.array([f.group for f in features], dtype=np.intp)
    return np.column_stack([xy[column], z]), groups[owners[column]]


def _sample_upright(features: list[Feature]) -> tuple[Floats, npt.NDArray[np.intp]]:
    """Columns, crowns and small boxes at points: one template a (shape, height), moved to each place."""
    points: list[npt.NDArray[Any]] = [np.zeros((0, 3))]
    for feature in features:
        template = {"column": _column, "crown": _crown, "box": _box}[feature.shape](feature.height_m)
        points.append(template + np.array([*shapely.get_coordinates(feature.geometry)[0], feature.base_m]))
    sizes = [len(p) for p in points[1:]]
    return np.concatenate(points), np.repeat(np.array([f.group for f in features], dtype=np.intp), sizes)


def _column(height_m: float) -> Floats:
    z = np.arange(0, height_m + 1e-9, COLUMN_SPACING_M)
    return np.column_stack([np.zeros((len(z), 2)), z])


def _crown(height_m: float) -> Floats:
    """A trunk below a ball of leaves, the ball's points on a golden spiral."""
    radius = height_m / 4
    i = np.arange(64) + 0.5
    polar, azimuth = np.arccos(1 - 2 * i / 64), np.pi * (1 + 5**0.5) * i
    ball = np.column_stack([np.cos(azimuth) * np.sin(polar), np.sin(azimuth) * np.sin(polar), np.cos(polar)])
    return np.concatenate([_column(height_m - 2 * radius), ball * radius + [0, 0, height_m - radius]])


def _box(height_m: float) -> Floats:
    x, y, z = np.meshgrid([-0.3, 0.0, 0.3], [-0.3, 0.0, 0.3], np.arange(0, height_m + 1e-9, COLUMN_SPACING_M))
    return np.column_stack([x.ravel(), y.ravel(), z.ravel()])
