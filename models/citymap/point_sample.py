"""Sample a fixed number of points from each part of some cells, as point encoders expect."""

from dataclasses import dataclass
from typing import Any, Literal, Protocol

import numpy as np
import numpy.typing as npt

from models.citymap.types import Floats

POINTS_PER_PART = 256  # that the encoders of the paper take
PointFrame = Literal["part", "cell"]


@dataclass(frozen=True, slots=True, eq=False)
class PointSampling:
    """The frame of sampled points, and how they are chosen."""

    # "part" is relative to the middle of the part, with the farthest of all its points at 1; "cell" is relative to the
    # centre of the cell, with the edge of the cell as the unit
    frame: PointFrame = "part"
    # draws points with repetition, as the papers' training does; None takes points spread evenly over their list
    rng: np.random.Generator | None = None


FIXED_SAMPLING = PointSampling()


class Sampler(Protocol):
    """Maps rows [C] of cells to the samples [R, 256, 6] of all their parts, cell after cell."""

    def __call__(self, cells: npt.NDArray[np.integer[Any]], sampling: PointSampling = FIXED_SAMPLING) -> Floats:
        """Return the samples of some cells."""
        ...


def sample_points(
    xyz: Floats,
    rgb: Floats,
    sampling: PointSampling = FIXED_SAMPLING,
    cell_center: Floats | float = 0.0,
    cell_size: float = 1.0,
) -> Floats:
    """Return a sample [256, 6] (float32) of a part, positions and colours, from points and colours, both [P, 3].

    A short list repeats points. Unknown colours (NaN) become -1. The cell has the units of `xyz`.
    """
    if sampling.rng is None:
        rows = np.linspace(0, len(xyz) - 1, POINTS_PER_PART).astype(np.intp)
    else:
        rows = sampling.rng.integers(len(xyz), size=POINTS_PER_PART)
    if sampling.frame == "cell":
        shape = (xyz[rows] - cell_center) / cell_size
    else:
        middle = (xyz.min(axis=0) + xyz.max(axis=0)) / 2
        reach = float(np.linalg.norm(xyz - middle, axis=1).max())
        shape = (xyz[rows] - middle) / max(reach, 1e-6)
    return np.concatenate([shape, np.nan_to_num(rgb[rows], nan=-1.0)], axis=1).astype(np.float32)


def stack_samples(parts: list[Floats]) -> Floats:
    """Return R samples as [R, 256, 6], also if R is 0."""
    return np.stack(parts) if parts else np.zeros((0, POINTS_PER_PART, 6), dtype=np.float32)
