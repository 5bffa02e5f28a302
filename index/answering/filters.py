"""What a query says of the place besides its description: where it must be, and where it is likely."""

from collections.abc import Callable
from typing import Final

import numpy as np
import numpy.typing as npt

from index.answering.query import Box, Circle, Query
from models.citymap.frame import Frame
from models.citymap.hints import BEST_CELL_REACH_M
from models.citymap.points import ranges
from models.citymap.types import Floats
from models.posterior.area_filter import Inside
from models.posterior.neighbours.neighbour_index import NeighbourIndex

BEND_M: Final = 0.5  # by which an edge of a box in degrees may bend between points
REACH_M: Final = BEST_CELL_REACH_M + BEND_M  # of a cell's nodes from its centre
EDGE_POINTS: Final = 65  # of a box in degrees, between which its edges are straight
MARGIN_DEG: Final = 1e-3
Mask = npt.NDArray[np.bool_]
Roughly = Callable[[Floats, float], tuple[Mask, Mask]]


def inside(query: Query, points_m: Floats, frame: Frame) -> Mask:
    """[M] True where points [M, 2] of the map are inside `within`; everywhere without one."""
    within = query.within
    if isinstance(within, Circle):
        offset = points_m - frame.position_m(within.center, query.crs)
        return np.asarray(np.hypot(offset[:, 0], offset[:, 1]) <= within.radius_m)
    if isinstance(within, Box):
        x, y = points_m.T
        if query.crs == "wgs84":
            y, x = frame.to_wgs84(points_m)
        return np.asarray((x >= within.west) & (x <= within.east) & (y >= within.south) & (y <= within.north))
    return np.ones(len(points_m), dtype=bool)


def where_inside(query: Query, surroundings: NeighbourIndex, centers_m: Floats, frame: Frame) -> Inside | None:
    """The nodes that are inside `within`, of cells with centres [N, 2]; None without one.

    Exact: of cells that its border may cross each node is looked at.
    """
    if query.within is None:
        return None
    roughly = _of_circle(query, frame) if isinstance(query.within, Circle) else _of_box(query, centers_m, frame)

    def holds(points_m: Floats) -> Mask:
        near, sure = roughly(points_m, BEND_M)
        unsure = np.flatnonzero(near & ~sure)
        sure[unsure] = inside(query, points_m[unsure], frame)
        return sure

    near, sure = roughly(centers_m, REACH_M)
    starts = surroundings.cell_starts
    border = np.flatnonzero(near & ~sure)
    nodes = ranges(starts[border], starts[border + 1])
    cells = sure & (np.diff(starts) > 0)
    cells[surroundings.owner(nodes[holds(surroundings.positions_m(nodes))])] = True
    return Inside(cells, holds)


def _of_circle(query: Query, frame: Frame) -> Roughly:
    """Which points [N, 2] may be less than some metres away from what is inside, and of which all so near is inside."""
    circle = query.within
    assert isinstance(circle, Circle)
    center_m = frame.position_m(circle.center, query.crs)

    def roughly(points_m: Floats, reach_m: float) -> tuple[Mask, Mask]:
        most_m = circle.radius_m + reach_m
        near, sure = _between(points_m, center_m - most_m, center_m + most_m), np.zeros(len(points_m), np.bool_)
        some = np.flatnonzero(near)
        away_m = np.hypot(*(points_m[some] - center_m).T)
        near[some], sure[some] = away_m <= most_m, away_m <= circle.radius_m - reach_m
        return near, sure

    return roughly


def _of_box(query: Query, centers_m: Floats, frame: Frame) -> Roughly:
    """As `_of_circle`, of points of the map that has these centres [N, 2] of cells."""
    box = query.within
    assert isinstance(box, Box)
    outer = inner = np.array([[box.west, box.south], [box.east, box.north]])
    if query.crs == "wgs84":
        low = np.array([axis.min() for axis in centers_m.T]) - REACH_M
        high = np.array([axis.max() for axis in centers_m.T]) + REACH_M
        lat, lon = frame.to_wgs84(_edges(low, high).reshape(-1, 2))
        # Of a box round half the world no more than is about the map: the rest may have no metres.
        west, south = max(box.west, lon.min() - MARGIN_DEG), max(box.south, lat.min() - MARGIN_DEG)
        east, north = min(box.east, lon.max() + MARGIN_DEG), min(box.north, lat.max() + MARGIN_DEG)
        if west > east or south > north:
            return lambda points_m, _: (np.zeros(len(points_m), np.bool_), np.zeros(len(points_m), np.bool_))
        at = _edges(np.array([west, south]), np.array([east, north]))
        edges = frame.from_wgs84(at[..., 1], at[..., 0])  # [4, E, 2] of west, east, south and north
        outer = np.array([edges.reshape(-1, 2).min(axis=0), edges.reshape(-1, 2).max(axis=0)])
        inner = np.array([[edges[0, :, 0].max(), edges[2, :, 1].max()], [edges[1, :, 0].min(), edges[3, :, 1].min()]])

    def roughly(points_m: Floats, reach_m: float) -> tuple[Mask, Mask]:
        near, sure = _between(points_m, outer[0] - reach_m, outer[1] + reach_m), np.zeros(len(points_m), np.bool_)
        some = np.flatnonzero(near)
        sure[some] = _between(points_m[some], inner[0] + reach_m, inner[1] - reach_m)
        return near, sure

    return roughly


def _between(points_m: Floats, low: Floats, high: Floats) -> Mask:
    """[n] whether points [n, 2] lie in a box; axis by axis, which takes a tenth of the time."""
    x, y = points_m.T
    return np.asarray((x >= low[0]) & (x <= high[0]) & (y >= low[1]) & (y <= high[1]))


def _edges(low: Floats, high: Floats) -> Floats:
    """[4, E, 2] points on the west, east, south and north edge of a box."""
    along = np.linspace(0.0, 1.0, EDGE_POINTS)
    x, y = (low[axis] + along * (high[axis] - low[axis]) for axis in (0, 1))
    sides = [(np.full_like(y, low[0]), y), (np.full_like(y, high[0]), y)]
    sides += [(x, np.full_like(x, low[1])), (x, np.full_like(x, high[1]))]
    return np.array([np.stack(side, axis=-1) for side in sides])


def log_prior(query: Query, points_m: Floats, frame: Frame) -> Floats:
    """[M] logarithm of the prior's density at points [M, 2], up to a constant; 0 without one."""
    if query.prior is None:
        return np.zeros(len(points_m))
    offset = points_m - frame.position_m(query.prior.position, query.crs)
    density: Floats = -(offset**2).sum(axis=1) / (2 * query.prior.sigma_m**2)
    return density
