"""The result of every localizer: ranked cells, a position in each, and a distribution over the map."""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import compiled
from models.posterior.certainty import DISTANCES_M, Certainty, TextFacts, probability_within, radius_of
from models.posterior.modes import Mode, find_modes

# A point stands for a square; radii divide it into up to 5 x 5 squares of at least this width.
SUBSQUARE_M, MAX_SUBSQUARES_PER_SIDE = 0.75, 5
MIN_POINT_WEIGHT: Final = 1e-9  # lighter points are left out of radii: together they weigh nothing
RADIUS_MASSES: Final = (0.5, 0.9)  # the probabilities that the radii of an answer contain


@dataclass(frozen=True, eq=False)
class PositionDistribution:
    """A distribution over positions, by K candidate cells and by M points."""

    rows: Ints  # [K] cells, that of the estimate first, then by probability
    score: Floats  # [K] their ranking scores
    probability: Floats  # [K] of the part of the map that each cell owns
    other: float  # probability of all other cells
    positions: Floats  # [K, 2] best position in each, metres, map frame
    points_m: Floats  # [M, 2]
    points: Ints  # [M] node of each point, or cell if the positions of cells are the points
    weight: Floats  # [M] probability of each point; adds up to 1 - other
    spacing_m: float  # edge of the square that each point stands for
    extent_m: float  # radius that contains the whole map
    is_retrieved: bool = True  # whether the vector index proposed the cells; False for the inverted list
    calibrated_masses: tuple[float, float] = RADIUS_MASSES  # mass that contains RADIUS_MASSES of the truths
    facts: TextFacts | None = None  # how the text was understood, if it names places
    certainty: Certainty | None = None  # calibrates with the facts, instead of the masses

    @cached_property
    def modes(self) -> tuple[Mode, ...]:
        """The distinct places of the distribution, first that of the estimate."""
        return find_modes(self.positions, self.probability, self.points_m, self.weight, self.spacing_m)

    def radii_m(self, *shares: float) -> tuple[float, ...]:
        """Return the radii of circles round the first position that contain calibrated shares, such as .5 and .9."""
        if self._curve is not None:
            return tuple(min(radius_of(self._curve, share), self.extent_m) for share in shares)
        metres, mass = self._mass_by_distance
        wanted = np.interp(shares, (0.0, *RADIUS_MASSES, 1.0), (0.0, *self.calibrated_masses, 1.0))
        # The whole map, if the points have less mass than that.
        radii = np.append(metres, self.extent_m)[np.searchsorted(mass, wanted)]
        return tuple(np.minimum(radii, self.extent_m).tolist())

    def probability_within(self, metres: float) -> float:
        """Return the calibrated probability that the true position is within a distance of the first position."""
        if metres >= self.extent_m:
            return 1.0
        if self._curve is not None:
            return probability_within(self._curve, metres)
        known = (0.0, *self.calibrated_masses, 1.0), (0.0, *RADIUS_MASSES, 1.0)
        return float(np.interp(self.share_within(metres), *known))

    def share_within(self, metres: float) -> float:
        """Return the mass within a distance of the first position; mass without points counts as farther away."""
        known, mass = self._mass_by_distance
        return float(np.append(0.0, mass)[np.searchsorted(known, metres, side="right")])

    @property
    def shares(self) -> Floats:
        """The mass [G] within each of DISTANCES_M of the first position."""
        known, mass = self._mass_by_distance
        return np.append(0.0, mass)[np.searchsorted(known, DISTANCES_M, side="right")]

    @cached_property
    def _curve(self) -> Floats | None:
        """The calibrated probabilities [G] of being within DISTANCES_M; None without facts."""
        return None if self.certainty is None or self.facts is None else self.certainty.curve(self.shares, self.facts)

    @cached_property
    def _mass_by_distance(self) -> tuple[Floats, Floats]:
        """Return distances from the first position, ascending, and the mass up to each."""
        side = min(MAX_SUBSQUARES_PER_SIDE, max(1, round(self.spacing_m / SUBSQUARE_M)))
        steps = ((np.arange(side) + 0.5) / side - 0.5) * self.spacing_m
        square, mass = _squares(self.points_m, self.weight, self.positions[0], steps)
        order = np.argsort(square)
        return np.sqrt(square[order]), np.cumsum(mass[order])

    def covariance_m2(self) -> Floats:
        """Return the covariance [2, 2] of the true position around the first one, square metres."""
        offset = self.points_m - self.positions[0]
        covariance: Floats = (offset * self.weight[:, None]).T @ offset
        return covariance + np.eye(2) * (self.spacing_m**2 + self.other * self.extent_m**2) / 12


def heaviest(cell: Ints, weight: Floats) -> Ints:
    """Return the first row of the greatest weight [M] of each cell; the rows of a cell [M] stand together."""
    starts = np.flatnonzero(np.diff(cell, prepend=-1))
    highest = np.repeat(np.maximum.reduceat(weight, starts), np.diff(np.append(starts, len(weight))))
    best = np.flatnonzero(weight == highest)
    return best[np.diff(cell[best], prepend=-1) != 0]


@compiled
def _squares(points_m: Floats, weight: Floats, center_m: Floats, steps: Floats) -> tuple[Floats, Floats]:
    """Return the squared distances [C] of the small squares of points [M, 2] from a centre, and their masses [C]."""
    count, side = 0, len(steps)
    for m in range(len(weight)):
        count += weight[m] > MIN_POINT_WEIGHT
    square, mass, n = np.empty(count * side * side), np.empty(count * side * side), 0
    for m in range(len(weight)):
        if weight[m] > MIN_POINT_WEIGHT:
            for i in range(side):
                east = points_m[m, 0] - center_m[0] + steps[i]
                for j in range(side):
                    north = points_m[m, 1] - center_m[1] + steps[j]
                    square[n], mass[n] = east * east + north * north, weight[m] / (side * side)
                    n += 1
    return square, mass
