"""How far positions are from where people walk: lines and squares, on a fine raster."""

from typing import Final

import numpy as np
from scipy.ndimage import distance_transform_edt

from models.city.gazetteer.gazetteer import WALKED, Gazetteer
from models.city.gazetteer.raster import along, lattice
from models.city.points import Ints, ranges
from models.city.types import Floats

PIXEL_M: Final = 2.0
FARTHEST_M: Final = 50.0
SQUARES: Final = ("highway/pedestrian_area", "place/square")  # walked on all over
_STEP_M: Final = 0.25  # of what is kept


class Walkways:
    """Distances to where people walk.

    Args:
        gazetteer: of the map, with an object of kind WALKED.
        low_m, high_m: [2] corners of what is asked about.
    """

    def __init__(self, gazetteer: Gazetteer, low_m: Floats, high_m: Floats) -> None:
        self._low = low_m - FARTHEST_M
        self._shape = tuple(np.ceil((high_m + FARTHEST_M - self._low) / PIXEL_M).astype(int) + 1)
        free = np.ones(self._shape, dtype=bool)
        for points in (_lines(gazetteer), _squares(gazetteer)):
            row, inside = self._pixels(points)
            free[tuple(row[inside].T)] = False
        metres = distance_transform_edt(free).astype(np.float32) * PIXEL_M
        self._away = np.minimum(metres / _STEP_M, FARTHEST_M / _STEP_M).astype(np.uint8)

    def metres(self, points_m: Floats) -> Floats:
        """[n] float32 metres from points [n, 2] to where people walk, at most FARTHEST_M."""
        row, inside = self._pixels(points_m)
        away = np.full(len(points_m), FARTHEST_M, np.float32)
        away[inside] = self._away[tuple(row[inside].T)] * np.float32(_STEP_M)
        return away

    def _pixels(self, points_m: Floats) -> tuple[Ints, Ints]:
        row = np.round((points_m - self._low) / PIXEL_M).astype(np.int64)
        return row, np.flatnonzero(((row >= 0) & (row < self._shape)).all(axis=1))


def _lines(gazetteer: Gazetteer) -> Floats:
    objects = gazetteer.by_kind.get(WALKED, np.zeros(0, np.int64))
    lines = gazetteer.segments_m[ranges(gazetteer.starts[objects], gazetteer.starts[objects + 1])]
    steps = np.ceil(np.hypot(*(lines[:, 2:] - lines[:, :2]).T) / (PIXEL_M / 2)).astype(int) + 1
    return along(lines, steps)


def _squares(gazetteer: Gazetteer) -> Floats:
    squares = [n for kind in SQUARES for n in gazetteer.by_kind.get(kind, ()) if gazetteer.is_area[n]]
    inside = [
        lattice(gazetteer.segments_m[gazetteer.starts[n] : gazetteer.starts[n + 1]].astype(np.float64), PIXEL_M / 2)
        for n in squares
    ]
    return np.concatenate(inside) if inside else np.zeros((0, 2))
