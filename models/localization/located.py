"""What every localizer finds: cells in order, a position in each, and a distribution over the map."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from models.city.points import Ints
from models.city.types import Floats

SUBSQUARE_M, MOST_SUBSQUARES = 0.75, 5  # a point stands for a square; radii see it as up to 5 x 5 points this far apart

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
        counts = self.weight > 1e-9  # the rest together are nothing
        east, north = (self.points_m[counts] - self.positions[0]).T[..., None] + steps  # [2, C, side]
        square = (east[:, :, None] ** 2 + north[:, None, :] ** 2).ravel()
        order = np.argsort(square)
        return np.sqrt(square[order]), np.cumsum(np.repeat(self.weight[counts] / side**2, side**2)[order])

    def covariance_m2(self) -> Floats:
        """[2, 2] square metres, of the truth around the first position."""
        offset = self.points_m - self.positions[0]
        covariance: Floats = (offset * self.weight[:, None]).T @ offset
        return covariance + np.eye(2) * (self.spacing_m**2 + self.other * self.extent_m**2) / 12
