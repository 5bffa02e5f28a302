"""Synthetic towns, part 4: the plan of the streets, and its position in the world.

The plan is a grid of streets with some left out. A smooth map bends and turns it, with all its objects, and sets it on
hills.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from models.citymap.types import Floats
from models.sources.synthetic.shapes import Rng
from models.sources.synthetic.styles import Style

Node = tuple[int, int]


class Line(NamedTuple):
    """A street from one end of the plan to the other."""

    position_m: float  # where it crosses the other axis
    road_m: float  # width of its carriageway
    strip_m: float  # width, on each side, of parking bays or grass
    sidewalk_m: float  # width, on each side
    is_main: bool  # true for a through street

    @property
    def reach_m(self) -> float:
        """Return the distance from its middle to the lots."""
        return self.road_m / 2 + self.strip_m + self.sidewalk_m


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """A grid of streets."""

    east: tuple[Line, ...]  # streets that cross the first axis, and run along the second
    north: tuple[Line, ...]  # streets that cross the second axis, and run along the first
    along_u: npt.NDArray[np.bool_]  # [N, E - 1] bool, where the street north[n] is open between east[e] and the next
    along_v: npt.NDArray[np.bool_]  # [E, N - 1] bool, where the street east[e] is open between north[n] and the next

    def is_open(self, a: Node, b: Node) -> bool:
        """Whether a street leads from a crossing to its neighbour."""
        if a[1] == b[1]:
            return bool(self.along_u[a[1], min(a[0], b[0])])
        return bool(self.along_v[a[0], min(a[1], b[1])])

    def position_m(self, node: Node) -> Floats:
        """Return the position [2] of a crossing in metres, plan frame."""
        return np.array([self.east[node[0]].position_m, self.north[node[1]].position_m])

    def neighbours(self, node: Node) -> list[Node]:
        """Return the crossings to which a street leads from one."""
        e, n = node
        adjacent = [(e + 1, n), (e, n + 1), (e - 1, n), (e, n - 1)]
        inside = [b for b in adjacent if 0 <= b[0] < len(self.east) and 0 <= b[1] < len(self.north)]
        return [b for b in inside if self.is_open(node, b)]


def draw_plan(rng: Rng, style: Style, cells: float) -> Plan:
    """Draw a plan with room for a drive past some number of cells."""
    side = int(np.ceil(np.sqrt(cells * 100 * 1.5) / np.mean(style.block_m))) + 4
    lines = []
    for _ in range(2):
        places = np.cumsum(rng.uniform(*style.block_m, side))
        lines.append(tuple(_line(rng, style, float(place - places.mean())) for place in places))
    east, north = lines
    along = [rng.random((side, side - 1)) >= style.missing * (1 - 0.7 * np.array([[s.is_main] for s in a]))
             for a in (north, east)]  # fmt: skip
    return Plan(east, north, *along)


def _line(rng: Rng, style: Style, place_m: float) -> Line:
    is_main = bool(rng.random() < 0.25)
    road_m = float(rng.uniform(*style.road_m)) * (1.4 if is_main else 1)
    strip_m = float(rng.uniform(2, 3)) if rng.random() < style.parking + style.verge else 0.0
    return Line(place_m, road_m, strip_m, float(rng.uniform(*style.sidewalk_m)), is_main)


@dataclass(frozen=True, slots=True, eq=False)
class Land:
    """The map from the plan to the world."""

    sway: Floats  # [S, 2, 3] waves of the plan's axes: amplitude m, wave number 1/m, phase
    curvature: float  # 1/m, by which the first axis is bent into a circle; 0 for straight
    turn: Floats  # [2, 2] rotation
    origin_m: Floats  # [3] position of the plan's middle
    hills: Floats  # [W, 4] amplitude m, two wave numbers 1/m, phase
    slope: Floats  # [2] metres per metre

    def to_world(self, plan: Floats) -> Floats:
        """Return world metres [P, 3] of points of the plan, [P, 3] with heights above the ground."""
        u, v, height = plan.T
        for (a, k, p), (b, m, q) in self.sway:
            u, v = u + a * np.sin(k * v + p), v + b * np.sin(m * u + q)
        if self.curvature:
            radius = 1 / self.curvature + v
            angle = u * self.curvature
            u, v = radius * np.sin(angle), radius * np.cos(angle) - 1 / self.curvature
        xy = np.column_stack([u, v]) @ self.turn.T
        z = height + xy @ self.slope
        for amplitude, k, m, phase in self.hills:
            z = z + amplitude * np.sin(xy @ np.array([k, m]) + phase)
        return np.column_stack([xy, z]) + self.origin_m


def draw_land(rng: Rng, style: Style) -> Land:
    """Draw bends, direction and hills for a town of some style."""
    length = rng.uniform(150, 420, (2, 2))
    slope = style.bend * rng.uniform(0.4, 1, (2, 2)) * (0.65, 0.35)
    wave = 2 * np.pi / length
    sway = np.stack([slope / wave, wave, rng.uniform(0, 2 * np.pi, (2, 2))], axis=-1)
    angle = rng.uniform(0, 2 * np.pi)
    direction, phase = rng.uniform(0, 2 * np.pi, (2, 3))
    steep = 2 * np.pi / rng.uniform(250, 700, 3)
    hills = [style.relief_m * rng.uniform(0.1, 0.4, 3), steep * np.cos(direction), steep * np.sin(direction), phase]
    return Land(
        sway=sway,
        curvature=float(rng.choice([-1, 1]) / rng.uniform(900, 1500)) if style.fan else 0.0,
        turn=np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]),
        origin_m=rng.uniform((600, 2500, 100), (3000, 6000, 130)),
        hills=np.column_stack(hills),
        slope=rng.uniform(-0.012, 0.012, 2),
    )
