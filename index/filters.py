"""What a query says of the place besides its description: where it must be, and where it is likely."""

import numpy as np
import numpy.typing as npt

from index.query import Box, Circle, Crs, Query
from models.city.frame import Frame
from models.city.types import Floats
from models.posterior.surroundings.surroundings import Surroundings

NODES_AT_ONCE = 1 << 17


def inside(query: Query, points_m: Floats, frame: Frame) -> npt.NDArray[np.bool_]:
    """[M] True where points [M, 2] of the map are inside `within`; everywhere without one."""
    within = query.within
    if isinstance(within, Circle):
        offset = points_m - position_m(within.center, query.crs, frame)
        return np.asarray(np.hypot(offset[:, 0], offset[:, 1]) <= within.radius_m)
    if isinstance(within, Box):
        x, y = points_m.T
        if query.crs == "wgs84":
            y, x = frame.to_wgs84(points_m)
        return np.asarray((x >= within.west) & (x <= within.east) & (y >= within.south) & (y <= within.north))
    return np.ones(len(points_m), dtype=bool)


def nodes_inside(query: Query, surroundings: Surroundings, frame: Frame) -> npt.NDArray[np.bool_]:
    """[M] which of all nodes are inside `within`."""
    count = int(surroundings.cell_starts[-1])
    found = np.zeros(count, np.bool_)
    for first in range(0, count, NODES_AT_ONCE):
        some = np.arange(first, min(first + NODES_AT_ONCE, count))
        found[some] = inside(query, surroundings.positions_m(some), frame)
    return found


def log_prior(query: Query, points_m: Floats, frame: Frame) -> Floats:
    """[M] logarithm of the prior's density at points [M, 2], up to a constant; 0 without one."""
    if query.prior is None:
        return np.zeros(len(points_m))
    offset = points_m - position_m(query.prior.position, query.crs, frame)
    density: Floats = -(offset**2).sum(axis=1) / (2 * query.prior.sigma_m**2)
    return density


def position_m(position: tuple[float, float], crs: Crs, frame: Frame) -> Floats:
    """[2] metres of a position: (x, y), or (lon, lat) with crs wgs84."""
    return np.asarray(position, dtype=np.float64) if crs == "map" else frame.from_wgs84(position[1], position[0])
