"""Synthetic towns, part 1: points on simple bodies; x along the street, y away from it, z up, metres."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from models.citymap.types import Floats

SURFACE_NOISE_M = 0.015  # of points around their surface
Rng = np.random.Generator


class LocalFrame(NamedTuple):
    """A position in a town's plan, and a direction there."""

    u: float  # metres, plan frame
    v: float
    cos: float = 1.0  # of the angle from the plan's first axis to the frame's x axis
    sin: float = 0.0
    flip: float = 1.0  # -1 where the frame's y axis lies to the right of its x axis, else 1

    def to_plan(self, xyz: Floats) -> Floats:
        """Return points [P, 3] of this frame in the plan's frame."""
        x, y = xyz[:, 0], xyz[:, 1] * self.flip
        return np.column_stack([self.u + self.cos * x - self.sin * y, self.v + self.sin * x + self.cos * y, xyz[:, 2]])

    def offset(self, x: float, y: float, turn: float = 0.0) -> "LocalFrame":
        """Return the frame at a position of this one, turned by an angle in radians."""
        u, v = self.to_plan(np.array([[x, y, 0.0]]))[0, :2].tolist()
        cos, sin = float(np.cos(turn)), float(np.sin(turn)) * self.flip
        return LocalFrame(u, v, self.cos * cos - self.sin * sin, self.sin * cos + self.cos * sin, self.flip)


def patch(rng: Rng, corner: npt.ArrayLike, along: npt.ArrayLike, up: npt.ArrayLike, spacing_m: float) -> Floats:
    """Return points [P, 3] about `spacing_m` apart on the parallelogram from a corner, by its two edges."""
    edges = np.array([along, up], dtype=np.float64)
    counts = np.maximum(1, np.round(np.linalg.norm(edges, axis=1) / spacing_m)).astype(int)
    steps = np.indices(tuple(counts)).reshape(2, -1).T
    share = (steps + rng.uniform(0.1, 0.9, steps.shape)) / counts
    return np.asarray(corner, dtype=np.float64) + share @ edges + rng.normal(0, SURFACE_NOISE_M, (len(steps), 3))


def ground(rng: Rng, x: tuple[float, float], y: tuple[float, float], spacing_m: float, z: float = 0.0) -> Floats:
    """Return points [P, 3] of a level rectangle."""
    return patch(rng, (x[0], y[0], z), (x[1] - x[0], 0, 0), (0, y[1] - y[0], 0), spacing_m)


def box(rng: Rng, size: tuple[float, float, float], spacing_m: float, hidden: float = 1.0, z: float = 0.0) -> Floats:
    """Return points [P, 3] on a box (width, depth, height), its front at y = 0 and in the middle of x, its bottom at z.

    `hidden` is a factor of the spacing on the back and top; half as much on the sides.
    """
    w, d, h = size
    side = spacing_m * (1 + hidden) / 2
    return np.concatenate(
        [
            patch(rng, (-w / 2, 0, z), (w, 0, 0), (0, 0, h), spacing_m),
            patch(rng, (-w / 2, 0, z), (0, d, 0), (0, 0, h), side),
            patch(rng, (w / 2, 0, z), (0, d, 0), (0, 0, h), side),
            patch(rng, (-w / 2, d, z), (w, 0, 0), (0, 0, h), spacing_m * hidden),
            patch(rng, (-w / 2, 0, z + h), (w, 0, 0), (0, d, 0), spacing_m * hidden),
        ]
    )


def gable(rng: Rng, size: tuple[float, float, float], rise_m: float, spacing_m: float) -> Floats:
    """Return points [P, 3] of a pitched roof over a box of `size`, its ridge along x."""
    w, d, h = size
    return np.concatenate(
        [
            patch(rng, (-w / 2, 0, h), (w, 0, 0), (0, d / 2, rise_m), spacing_m),
            patch(rng, (-w / 2, d, h), (w, 0, 0), (0, -d / 2, rise_m), spacing_m * 1.5),
        ]
    )


def column(rng: Rng, count: int, radius_m: float, z: tuple[float, float], lean: float = 0.0) -> Floats:
    """Return points [P, 3] around an upright column, from one height to another."""
    angle, height = rng.uniform(0, 2 * np.pi, count), rng.uniform(*z, count)
    return np.column_stack([radius_m * np.cos(angle) + lean * height, radius_m * np.sin(angle), height])


def blob(rng: Rng, count: int, center: npt.ArrayLike, radii: npt.ArrayLike) -> Floats:
    """Return points [P, 3] in an ellipsoid, denser towards its surface."""
    direction = rng.normal(size=(count, 3))
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    reach = rng.uniform(0.15, 1, (count, 1)) ** 0.4
    return np.asarray(center) + direction * reach * np.asarray(radii)


def shift(xyz: Floats, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Floats:
    """Return the points [P, 3] shifted."""
    return xyz + np.array([x, y, z])


def subsample(rng: Rng, xyz: Floats, share: float) -> Floats:
    """Return a random share of some points, in their order."""
    return xyz[rng.random(len(xyz)) < share]


def pick(rng: Rng, weights: dict[str, float]) -> str:
    """Return a random key, as often as its weight says."""
    share: Any = np.array(list(weights.values()))
    return list(weights)[int(rng.choice(len(share), p=share / share.sum()))]
