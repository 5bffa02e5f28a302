"""How far positions are from where people walk: lines and squares, on a fine raster."""

from typing import Final

import numpy as np

from models.city.gazetteer.gazetteer import WALKED, Gazetteer
from models.city.gazetteer.nearest import columns_away, pixels_away, pixels_of
from models.city.gazetteer.raster import along, lattice
from models.city.points import Ints, ranges
from models.city.types import Floats

PIXEL_M: Final = 2.0
FARTHEST_M: Final = 50.0
SQUARES: Final = ("highway/pedestrian_area", "place/square")  # walked on all over
REACH: Final = round(FARTHEST_M / PIXEL_M)


class Walkways:
    """Distances to where people walk.

    Args:
        gazetteer: of the map, with an object of kind WALKED.
        low_m, high_m: [2] corners of what is asked about.
    """

    def __init__(self, gazetteer: Gazetteer, low_m: Floats, high_m: Floats) -> None:
        self._low = low_m - FARTHEST_M
        columns, rows = (np.ceil((high_m + FARTHEST_M - self._low) / PIXEL_M).astype(int) + 1).tolist()
        self._shape = columns, rows
        drawn = [self._pixels(points)[0] for points in (_lines(gazetteer), _squares(gazetteer))]
        self._away = columns_away(np.concatenate(drawn), self._shape, REACH)

    def metres(self, points_m: Floats) -> Floats:
        """[n] float32 metres from points [n, 2] to where people walk, at most FARTHEST_M."""
        pixel, inside = self._pixels(points_m)
        away = np.full(len(points_m), FARTHEST_M, np.float32)
        away[inside] = np.minimum(pixels_away(self._away, pixel, REACH) * np.float32(PIXEL_M), FARTHEST_M)
        return away

    def _pixels(self, points_m: Floats) -> tuple[Ints, Ints]:
        """The pixels of those points that are inside, and which these are."""
        pixel = pixels_of(points_m, self._low, PIXEL_M, self._shape)
        inside = np.flatnonzero(pixel >= 0)
        return pixel[inside], inside


def _lines(gazetteer: Gazetteer) -> Floats:
    objects = gazetteer.by_kind.get(WALKED, np.zeros(0, np.int64))
    lines = gazetteer.segments_m[ranges(gazetteer.starts[objects], gazetteer.starts[objects + 1])]
    steps = np.ceil(np.hypot(*(lines[:, 2:] - lines[:, :2]).T) / (PIXEL_M / 2)).astype(int) + 1
    points: Floats = along(lines, steps)
    return points


def _squares(gazetteer: Gazetteer) -> Floats:
    squares = [n for kind in SQUARES for n in gazetteer.by_kind.get(kind, ()) if gazetteer.is_area[n]]
    inside: Floats = lattice(gazetteer.segments_m, gazetteer.starts, np.array(squares, np.int64), PIXEL_M / 2)[0]
    return inside
