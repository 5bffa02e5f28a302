"""What every localizer finds: cells in order, a position in each, and a distribution over the map."""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import compiled

SUBSQUARE_M, MOST_SUBSQUARES = 0.75, 5  # a point stands for a square; radii see it as up to 5 x 5 points this far apart

FAINT: Final = 1e-9  # the points of less together have nothing
TOLD = (0.5, 0.9)  # the shares that answers give radii of


@dataclass(frozen=True, eq=False)
class Located:
    """What is known of where a description was said.

    Attributes:
        rows: [K] cells, likeliest first.
        score: [K] what they are ranked by, before it is made a probability.
        probability: [K] that the speaker is in the part of the map that each cell owns.
        other: probability of all other cells.
        positions: [K, 2] the best position in each, metres, map frame.
        points_m, weight: [M, 2] and [M] the distribution; the weights add up to 1 - other.
        points: [M] row of each point: of the surroundings' nodes, or of the cells where their positions are the points.
        spacing_m: edge of the square that each point stands for.
        extent_m: radius that holds the whole map.
        held: what circles must hold of the distribution to hold .5 and .9 of the truths, from validation data.
        radius_scale: what radii are multiplied with, likewise.
    """

    rows: Ints
    score: Floats
    probability: Floats
    other: float
    positions: Floats
    points_m: Floats
    points: Ints
    weight: Floats
    spacing_m: float
    extent_m: float
    held: tuple[float, float] = TOLD
    radius_scale: float = 1.0

    def radii_m(self, *shares: float) -> tuple[float, ...]:
        """Radii round the first position of circles that hold some shares of the distribution, such as .5 and .9."""
        metres, mass = self._mass_by_distance
        wanted = np.interp(shares, (0.0, *TOLD, 1.0), (0.0, *self.held, 1.0))
        # The whole map, if what is known holds less.
        found = np.append(metres, self.extent_m)[np.searchsorted(mass, wanted)]
        return tuple(np.minimum(found * self.radius_scale, self.extent_m).tolist())

    def share_within(self, metres: float) -> float:
        """Share of the distribution that is this near to the first position; what is not known is farther."""
        known, mass = self._mass_by_distance
        return float(np.append(0.0, mass)[np.searchsorted(known, metres, side="right")])

    @cached_property
    def _mass_by_distance(self) -> tuple[Floats, Floats]:
        """Distances from the first position, ascending, and the mass up to each."""
        side = min(MOST_SUBSQUARES, max(1, round(self.spacing_m / SUBSQUARE_M)))
        steps = ((np.arange(side) + 0.5) / side - 0.5) * self.spacing_m
        square, mass = _squares(self.points_m, self.weight, self.positions[0], steps)
        order = np.argsort(square)
        return np.sqrt(square[order]), np.cumsum(mass[order])

    def covariance_m2(self) -> Floats:
        """[2, 2] square metres, of the truth around the first position."""
        offset = self.points_m - self.positions[0]
        covariance: Floats = (offset * self.weight[:, None]).T @ offset
        return covariance + np.eye(2) * (self.spacing_m**2 + self.other * self.extent_m**2) / 12


def heaviest(cell: Ints, weight: Floats) -> Ints:
    """[C] the row of the greatest weight [M] of each cell [M] whose rows stand together, of equal ones the first."""
    starts = np.flatnonzero(np.diff(cell, prepend=-1))
    highest = np.repeat(np.maximum.reduceat(weight, starts), np.diff(np.append(starts, len(weight))))
    best = np.flatnonzero(weight == highest)
    found: Ints = best[np.diff(cell[best], prepend=-1) != 0]
    return found


@compiled
def _squares(points_m: Floats, weight: Floats, center_m: Floats, steps: Floats) -> tuple[Floats, Floats]:
    """[C] squared distances from a centre of the small squares that points [M, 2] stand for, and the mass of each."""
    count, side = 0, len(steps)
    for m in range(len(weight)):
        count += weight[m] > FAINT
    square, mass, at = np.empty(count * side * side), np.empty(count * side * side), 0
    for m in range(len(weight)):
        if weight[m] > FAINT:
            for i in range(side):
                east = points_m[m, 0] - center_m[0] + steps[i]
                for j in range(side):
                    north = points_m[m, 1] - center_m[1] + steps[j]
                    square[at], mass[at] = east * east + north * north, weight[m] / (side * side)
                    at += 1
    return square, mass
