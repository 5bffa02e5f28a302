"""How far a true position may be from an estimate."""

import numpy as np

from index.answers import Radius
from models.city.types import Floats


def covariance_of(positions: Floats, probability: Floats, edge_m: float, extent_m: float) -> Floats:
    """[2, 2] square metres, of the true position around the first of some candidates.

    Args:
        positions: [C, 2] of the candidates, metres.
        probability: [C] of each; what is missing to one may be anywhere on the map.
        edge_m: in its cell, the true position is anywhere in a square of this size around the candidate's.
        extent_m: of the map.
    """
    offset = positions - positions[0]
    unseen = max(0.0, 1.0 - float(probability.sum()))
    covariance: Floats = (offset * probability[:, None]).T @ offset
    return covariance + np.eye(2) * (edge_m**2 / 12 + unseen * extent_m**2 / 12)


def radius_of(positions: Floats, probability: Floats, edge_m: float, extent_m: float) -> Radius:
    """Circles around the first of some candidates that hold the true position; arguments as `covariance_of`."""
    around = np.array([[i, j] for i in (-1, 0, 1) for j in (-1, 0, 1)]) * edge_m / 3  # the square, as nine points
    distance = np.linalg.norm((positions - positions[0])[:, None] + around, axis=2).ravel()
    order = np.argsort(distance)
    mass = np.cumsum(np.repeat(probability / 9, 9)[order])
    found = np.searchsorted(mass, (0.5, 0.9))
    p50, p90 = np.append(distance[order], extent_m)[found].tolist()  # the whole map if what is listed does not
    return Radius(p50, p90)
