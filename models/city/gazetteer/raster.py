"""How far every cell of a map is from some objects, about: a distance transform on the cells' grid."""

from collections import OrderedDict

import numpy as np
from scipy.ndimage import distance_transform_edt

from models.city.gazetteer.gazetteer import Gazetteer
from models.city.points import Ints, ranges
from models.city.types import Floats

SAMPLED_M = 6.0  # between samples of lines
MARGIN_M = 300.0  # round the cells, in which objects count too
LARGE_M = 20.0  # areas that reach farther have samples inside
LATTICE_M = 9.0  # between these
KEPT_BYTES = 16 * 2**20  # of distances that were asked for lately


class Raster:
    """The cells' grid, with every object of a gazetteer on it.

    Args:
        gazetteer: of the map.
        centers_m: [N, 2] of the cells.
        spacing_m: of their grid.
    """

    def __init__(self, gazetteer: Gazetteer, centers_m: Floats, spacing_m: float) -> None:
        self.spacing_m = spacing_m
        self._low = centers_m.min(axis=0) - MARGIN_M
        self.shape = tuple(np.ceil((centers_m.max(axis=0) + MARGIN_M - self._low) / spacing_m).astype(int) + 1)
        self._cell = self.pixels(centers_m)
        self._samples, self._starts = _samples(gazetteer)
        self._pixel = self.pixels(self._samples)
        self._lately: OrderedDict[bytes, Floats] = OrderedDict()

    def pixels(self, points_m: Floats) -> Ints:
        """[n] pixel of points [n, 2], -1 outside."""
        column = np.round((points_m - self._low) / self.spacing_m).astype(np.int64)
        inside = ((column >= 0) & (column < self.shape)).all(axis=1)
        return np.where(inside, column[:, 0] * self.shape[1] + column[:, 1], -1)

    def metres_to(self, objects: Ints) -> Floats:
        """[N] metres from each cell's centre to the nearest of some objects, to the grid; inf if none is near."""
        key = objects.tobytes()
        found = self._lately.get(key)
        if found is None:
            pixels = self._pixel[ranges(self._starts[objects], self._starts[objects + 1])]
            found = self._lately[key] = self._metres(pixels)
            while len(self._lately) * found.nbytes > max(KEPT_BYTES, found.nbytes):
                self._lately.popitem(last=False)
        return found

    def metres_to_lines(self, lines_m: Floats) -> Floats:
        """[N] the same for segments [n, 4]."""
        steps = np.maximum(1, np.ceil(np.hypot(*(lines_m[:, 2:] - lines_m[:, :2]).T) / SAMPLED_M)).astype(int) + 1
        return self._metres(self.pixels(along(lines_m, steps)))

    def _metres(self, pixels: Ints) -> Floats:
        pixels = pixels[pixels >= 0]
        if not len(pixels):
            return np.full(len(self._cell), np.inf)
        free = np.ones(self.shape[0] * self.shape[1], dtype=bool)
        free[pixels] = False
        away = distance_transform_edt(free.reshape(self.shape)).astype(np.float32).ravel()
        metres: Floats = away[self._cell] * np.float32(self.spacing_m)
        return metres


def along(lines_m: Floats, steps: Ints) -> Floats:
    """Points along segments [n, 4], so many of each."""
    line = np.repeat(np.arange(len(lines_m)), steps)
    share = (np.arange(steps.sum()) - np.repeat(np.cumsum(steps) - steps, steps)) / np.repeat(
        np.maximum(steps - 1, 1), steps
    )
    ends = lines_m[line].astype(np.float64)
    points: Floats = ends[:, :2] + share[:, None] * (ends[:, 2:] - ends[:, :2])
    return points


def _samples(gazetteer: Gazetteer) -> tuple[Floats, Ints]:
    """Points [S, 2] on every object's lines and inside large areas; starts [O + 1]."""
    if not len(gazetteer):
        return np.zeros((0, 2)), np.zeros(1, np.int64)
    lines = gazetteer.segments_m
    steps = np.ceil(np.hypot(*(lines[:, 2:] - lines[:, :2]).T) / SAMPLED_M).astype(int) + 1
    owner = np.repeat(np.repeat(np.arange(len(gazetteer)), np.diff(gazetteer.starts)), steps)
    points, owners = [along(lines, steps)], [owner]
    for number in np.flatnonzero(gazetteer.is_area & (gazetteer.reach_m > LARGE_M)):
        ends = lines[gazetteer.starts[number] : gazetteer.starts[number + 1]].astype(np.float64)
        inside = lattice(ends, LATTICE_M)
        points.append(inside)
        owners.append(np.full(len(inside), number))
    joined, of = np.concatenate(points), np.concatenate(owners)
    order = np.argsort(of, kind="stable")
    return joined[order], np.searchsorted(of[order], np.arange(len(gazetteer) + 1))


def lattice(ends: Floats, apart_m: float) -> Floats:
    """Points inside rings of segments [n, 4], in rows and columns."""
    low, high = ends.reshape(-1, 2).min(axis=0), ends.reshape(-1, 2).max(axis=0)
    axes = [np.arange(a + apart_m / 2, b, apart_m) for a, b in zip(low, high, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    x, y = grid.T[:, :, None]
    x1, y1, x2, y2 = ends.T
    with np.errstate(divide="ignore", invalid="ignore"):
        crosses = ((y1 > y) != (y2 > y)) & (x < x1 + (y - y1) * (x2 - x1) / (y2 - y1))
    found: Floats = grid[crosses.sum(axis=1) % 2 == 1]
    return found
