"""Distances from positions to where people walk: lines and squares, on a fine raster."""

from typing import Final

import numpy as np

from models.citymap.gazetteer.distance_transform import column_distances, pixel_distances
from models.citymap.gazetteer.gazetteer import WALKED_KIND, Gazetteer
from models.citymap.gazetteer.rasterize import PixelGrid, draw_areas, draw_lines, pixels_at
from models.citymap.types import Floats

PIXEL_SIZE_M: Final = 2.0  # of the raster
MAX_DISTANCE_M: Final = 50.0  # greater distances are reported as this
SQUARE_KINDS: Final = ("highway/pedestrian_area", "place/square")  # areas that people walk on
REACH_PX: Final = round(MAX_DISTANCE_M / PIXEL_SIZE_M)


class Walkways:
    """Distances to the nearest walkway (an object of kind WALKED_KIND or a square) in a box between two corners [2]."""

    def __init__(self, gazetteer: Gazetteer, low_m: Floats, high_m: Floats) -> None:
        west_south = low_m - MAX_DISTANCE_M
        shape = (np.ceil((high_m + MAX_DISTANCE_M - west_south) / PIXEL_SIZE_M).astype(int) + 1).tolist()
        self._grid = PixelGrid(west_south[0], west_south[1], PIXEL_SIZE_M, shape[0], shape[1])
        shapes, ways = (
            (gazetteer.segments_m, gazetteer.starts),
            gazetteer.by_kind.get(WALKED_KIND, np.zeros(0, np.int64)),
        )
        squares = [n for kind in SQUARE_KINDS for n in gazetteer.by_kind.get(kind, ()) if gazetteer.is_area[n]]
        lines, _ = draw_lines(self._grid, *shapes, ways, PIXEL_SIZE_M / 2)
        insides, _ = draw_areas(self._grid, *shapes, np.array(squares, np.int64), PIXEL_SIZE_M / 2)
        self._columns = column_distances(np.concatenate([lines, insides]), (shape[0], shape[1]), REACH_PX)

    def distances_m(self, points_m: Floats) -> Floats:
        """Return the metres [n] (float32) from points [n, 2] to the nearest walkway, at most MAX_DISTANCE_M."""
        pixel = pixels_at(self._grid, points_m)
        inside = pixel >= 0
        distance_m = np.full(len(points_m), MAX_DISTANCE_M, np.float32)
        near_m = pixel_distances(self._columns, pixel[inside], REACH_PX) * np.float32(PIXEL_SIZE_M)
        distance_m[inside] = np.minimum(near_m, MAX_DISTANCE_M)
        return distance_m
