"""The modes of a position distribution: positions that people would call different places."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import compiled

MIN_SEPARATION_M: Final = 60.0  # between peaks; people call nearer positions one place. Not measured
PEAK_RADIUS_M: Final = 30.0  # the mass within makes a peak; of 10 to 30 m the best on the development texts
MAX_MODES: Final = 5
MIN_MODE_PROBABILITY: Final = 0.03  # of all modes but the first
MODE_RADIUS_MASS: Final = 0.9  # share of the mass of a mode inside its radius


@dataclass(frozen=True, slots=True, eq=False)
class Mode:
    """A peak of a position distribution and the mass that is nearest to it."""

    cell: int  # index of its likeliest cell among the candidates
    position_m: Floats  # [2] best position of that cell
    probability: float
    radius_m: float  # contains MODE_RADIUS_MASS of its mass


def find_modes(
    positions_m: Floats, probability: Floats, points_m: Floats, weight: Floats, spacing_m: float
) -> tuple[Mode, ...]:
    """Return at most MAX_MODES modes: that of the first cell, then the others by probability.

    Args:
        positions_m: [K, 2] best position of each cell.
        probability: [K] of each cell.
        points_m: [M, 2] of the distribution.
        weight: [M] of the points.
        spacing_m: edge of the square that a point stands for.
    """
    peaks_m, mode_of_cell, mass = _divide(positions_m, probability)
    mode_of_point = _nearest(points_m, peaks_m)
    first = int(mode_of_cell[0])
    others = [n for n in np.argsort(-mass, kind="stable") if n != first and mass[n] >= MIN_MODE_PROBABILITY]
    modes = []
    for n in [first, *others[: MAX_MODES - 1]]:
        cell, own = int((mode_of_cell == n).argmax()), mode_of_point == n
        radius_m = max(_radius_m(points_m[own], weight[own], positions_m[cell]), spacing_m / 2)
        modes.append(Mode(cell, positions_m[cell], float(mass[n]), radius_m))
    return tuple(modes)


def likeliest_cell(positions_m: Floats, probability: Floats) -> int:
    """Return the first cell of the mode with the most mass; the arguments are those of `find_modes`."""
    _, mode_of_cell, mass = _divide(positions_m, probability)
    return int((mode_of_cell == mass.argmax()).argmax())


def _divide(positions_m: Floats, probability: Floats) -> tuple[Floats, Ints, Floats]:
    """Return the peaks [n, 2] of cells, the nearest peak [K] of each cell, and the mass [n] of each peak's cells."""
    peaks_m = positions_m[_peaks(positions_m, probability, PEAK_RADIUS_M, MIN_SEPARATION_M)]
    mode_of_cell = _nearest(positions_m, peaks_m)
    return peaks_m, mode_of_cell, np.bincount(mode_of_cell, probability, len(peaks_m)).astype(np.float64)


def _radius_m(points_m: Floats, weight: Floats, center_m: Floats) -> float:
    """Return the radius round a centre [2] that contains MODE_RADIUS_MASS of the weight [m] of points [m, 2]."""
    metres = np.hypot(*(points_m - center_m).T)
    order = np.argsort(metres)
    mass = np.cumsum(weight[order])
    return float(metres[order[np.searchsorted(mass, MODE_RADIUS_MASS * mass[-1])]]) if len(mass) else 0.0


@compiled
def _peaks(positions_m: Floats, probability: Floats, radius_m: float, separation_m: float) -> Ints:
    """Return the cells with the most mass within a radius of all cells that are nearer than a separation."""
    count = len(probability)
    near, is_peak = np.zeros(count), np.ones(count, np.bool_)
    square = np.empty((count, count))
    for a in range(count):
        for b in range(count):
            east, north = positions_m[a, 0] - positions_m[b, 0], positions_m[a, 1] - positions_m[b, 1]
            square[a, b] = east * east + north * north
            if square[a, b] <= radius_m * radius_m:
                near[a] += probability[b]
    for a in range(count):
        for b in range(count):
            if square[a, b] <= separation_m * separation_m and (near[b] > near[a] or (near[b] == near[a] and b < a)):
                is_peak[a] = False
                break
    return np.flatnonzero(is_peak)


@compiled
def _nearest(points_m: Floats, centers_m: Floats) -> Ints:
    """Return the nearest centre [M] of each point [M, 2]."""
    nearest = np.zeros(len(points_m), np.int64)
    for m in range(len(points_m)):
        least = np.inf
        for c in range(len(centers_m)):
            east, north = points_m[m, 0] - centers_m[c, 0], points_m[m, 1] - centers_m[c, 1]
            square = east * east + north * north
            if square < least:
                nearest[m], least = c, square
    return nearest
