"""The features of a map as solids, and sampled points on them for models that take points."""

from dataclasses import dataclass
from math import ceil
from typing import Final, Literal

import numpy as np
import shapely

from models.citymap.types import Floats

Shape = Literal["outline", "wall", "ground", "column", "crown", "box"]
Form = Literal["area", "line", "thing"]
FORMS: Final[tuple[Form, ...]] = ("area", "line", "thing")
AREA: Final = FORMS.index("area")
THING: Final = FORMS.index("thing")
GROUND_SPACING_M: Final = 0.5  # so that diagonal neighbours are within the 0.75 m that connect (rule 4)
RAISED_SPACING_M: Final = {"outline": 0.7, "wall": 0.5, "box": 0.5}
COLUMN_SPACING_M: Final = 0.25  # between points of poles, trunks and small boxes
VISIBLE_HEIGHT_M: Final = 15.0  # top of a 30 m cell on the ground
CROWN_POINTS: Final = 64  # of a tree's ball of leaves
BOX_HALF_WIDTH_M: Final = 0.3  # of a small box


@dataclass(frozen=True, slots=True, eq=False)
class Solid:
    """A feature of a map."""

    instance: int
    # "ground" is filled, and covered by earlier solids; "outline" and "wall" are raised along their lines; "column",
    # "crown" and "box" are things, kept whole
    shape: Shape
    geometry: shapely.Geometry  # areas of ground, else lines or a point; metres, map frame
    base_m: float = 0.0  # height of its base above the ground
    height_m: float = 0.0

    @property
    def form(self) -> Form:
        """Return how the solid is cut."""
        if self.shape == "ground":
            return "area"
        return "line" if self.shape in ("outline", "wall") else "thing"

    @property
    def is_raised(self) -> bool:
        """Whether the solid is raised along lines."""
        return self.form == "line" or (self.shape == "box" and shapely.length(self.geometry) > 0)

    @property
    def levels_m(self) -> Floats:
        """Return the heights of the sampled points above each position."""
        if self.shape == "ground":
            return np.zeros(1)
        if not self.is_raised:
            return self.base_m + np.arange(0, self.height_m + 1e-9, COLUMN_SPACING_M)
        top_m = min(max(self.height_m, self.base_m + 1.0), max(VISIBLE_HEIGHT_M, self.base_m + 1.0))
        spacing_m = RAISED_SPACING_M[self.shape]
        return self.base_m + np.arange(max(1, int((top_m - self.base_m) / spacing_m)) + 1) * spacing_m

    @property
    def top_m(self) -> float:
        """Return the height of the top."""
        return float(self.levels_m[-1])

    @property
    def radius_m(self) -> float:
        """Return how far the solid extends beyond its geometry."""
        if self.is_raised:
            return 0.0
        return BOX_HALF_WIDTH_M if self.shape == "box" else self.crown_m

    @property
    def crown_m(self) -> float:
        """Return the radius of a tree's crown, whose middle is three times as high; 0 for others."""
        return self.height_m / 4 if self.shape == "crown" else 0.0

    @property
    def point_density(self) -> float:
        """Return the points per square metre of ground, per metre of a line, or in all for a thing."""
        if self.shape == "ground":
            return 1 / GROUND_SPACING_M**2
        if self.form == "line":
            return len(self.levels_m) / RAISED_SPACING_M[self.shape]
        if self.is_raised:
            return float(len(self.levels_m) * (1 + ceil(shapely.length(self.geometry) / RAISED_SPACING_M[self.shape])))
        return float(len(template_points(self.shape, self.height_m)))


def crown_reach_m(metres: Floats, crown_m: Floats) -> Floats:
    """Return by how much the closest point of a crown is nearer than the trunk, in the plane.

    The closest point in space is on the trunk up to four radii away; beyond, it is on the ball of leaves.
    """
    reach: Floats = crown_m * metres / np.sqrt(metres**2 + (3 * crown_m) ** 2 + 1e-12)
    return np.where(metres > 4 * crown_m, reach, 0.0)


def sample_solid(solid: Solid) -> Floats:
    """Return points [P, 3] (float64) on a solid, metres."""
    if solid.shape == "ground":
        xy = np.concatenate([_lattice_inside(part) for part in shapely.get_parts(solid.geometry)])
    elif solid.is_raised:
        xy = _along(solid.geometry, RAISED_SPACING_M[solid.shape])
    else:
        foot = np.array([*shapely.get_coordinates(solid.geometry)[0], solid.base_m])
        return template_points(solid.shape, solid.height_m) + foot
    levels = solid.levels_m
    return np.column_stack([np.repeat(xy, len(levels), axis=0), np.tile(levels, len(xy))])


def _lattice_inside(polygon: shapely.Geometry) -> Floats:
    """Return the points [n, 2] of a lattice inside one polygon."""
    shapely.prepare(polygon)
    west, south, east, north = np.floor(np.array(polygon.bounds) / GROUND_SPACING_M).astype(np.int64)
    x, y = np.meshgrid(np.arange(west + 1, east + 1), np.arange(south + 1, north + 1))
    x, y = x * GROUND_SPACING_M, y * GROUND_SPACING_M
    inside = shapely.contains_xy(polygon, x, y)
    return np.column_stack([x[inside], y[inside]])


def _along(geometry: shapely.Geometry, spacing_m: float) -> Floats:
    """Return points [n, 2] along lines, including both ends."""
    lines = shapely.get_parts(geometry)
    steps = np.maximum(1, np.ceil(shapely.length(lines) / spacing_m).astype(int)) + 1
    share = np.concatenate([np.linspace(0, 1, n) for n in steps])
    points = shapely.line_interpolate_point(np.repeat(lines, steps), share, normalized=True)
    return shapely.get_coordinates(points)


def template_points(shape: str, height_m: float) -> Floats:
    """Return the points [P, 3] of a column, a crown or a small box that stands at the origin."""
    z = np.arange(0, height_m + 1e-9, COLUMN_SPACING_M)
    if shape == "box":
        sides = np.array([-BOX_HALF_WIDTH_M, 0.0, BOX_HALF_WIDTH_M])
        return np.stack(np.meshgrid(sides, sides, z), axis=-1).reshape(-1, 3)
    if shape == "column":
        return np.column_stack([np.zeros((len(z), 2)), z])
    # a trunk below a ball of leaves, the ball's points on a golden spiral
    radius_m = height_m / 4
    i = np.arange(CROWN_POINTS) + 0.5
    polar, azimuth = np.arccos(1 - 2 * i / CROWN_POINTS), np.pi * (1 + 5**0.5) * i
    ball = np.column_stack([np.cos(azimuth) * np.sin(polar), np.sin(azimuth) * np.sin(polar), np.cos(polar)])
    trunk = template_points("column", height_m - 2 * radius_m)
    return np.concatenate([trunk, ball * radius_m + [0, 0, height_m - radius_m]])
