"""How far positions are from where people walk: lines and squares, on a fine raster."""

from typing import Final

import numpy as np

from models.citymap.gazetteer.distance_transform import columns_away, pixels_away
from models.citymap.gazetteer.gazetteer import WALKED, Gazetteer
from models.citymap.gazetteer.rasterize import Grid, draw_areas, draw_lines, pixels_of
from models.citymap.types import Floats

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
        west_south = low_m - FARTHEST_M
        shape = (np.ceil((high_m + FARTHEST_M - west_south) / PIXEL_M).astype(int) + 1).tolist()
        self._grid = Grid(west_south[0], west_south[1], PIXEL_M, shape[0], shape[1])
        shapes, ways = (gazetteer.segments_m, gazetteer.starts), gazetteer.by_kind.get(WALKED, np.zeros(0, np.int64))
        squares = [n for kind in SQUARES for n in gazetteer.by_kind.get(kind, ()) if gazetteer.is_area[n]]
        lines, _ = draw_lines(self._grid, *shapes, ways, PIXEL_M / 2)
        insides, _ = draw_areas(self._grid, *shapes, np.array(squares, np.int64), PIXEL_M / 2)
        self._away = columns_away(np.concatenate([lines, insides]), (shape[0], shape[1]), REACH)

    def metres(self, points_m: Floats) -> Floats:
        """[n] float32 metres from points [n, 2] to where people walk, at most FARTHEST_M."""
        pixel = pixels_of(self._grid, points_m)
        inside = pixel >= 0
        away = np.full(len(points_m), FARTHEST_M, np.float32)
        metres = pixels_away(self._away, pixel[inside], REACH) * np.float32(PIXEL_M)
        away[inside] = np.minimum(metres, FARTHEST_M)
        return away
