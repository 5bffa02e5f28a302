"""Sample a fixed number of points from each part of some cells, as point encoders expect."""

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from models.citymap.types import Floats

POINTS_PER_PART = 256  # that the encoders of the paper take
# Maps rows [C] of cells to the samples [R, 256, 6] of all their parts, cell after cell.
Sampler = Callable[[npt.NDArray[np.integer[Any]]], Floats]


def sample_points(xyz: Floats, rgb: Floats) -> Floats:
    """Return a sample [256, 6] (float32) of a part: position and colour of points spread evenly over their list.

    Positions are relative to the middle of the part and scaled so that the farthest of all its points is at 1. A short
    list repeats points. Unknown colours (NaN) become -1.
    """
    middle = (xyz.min(axis=0) + xyz.max(axis=0)) / 2
    reach = float(np.linalg.norm(xyz - middle, axis=1).max())
    rows = np.linspace(0, len(xyz) - 1, POINTS_PER_PART).astype(np.intp)
    shape = (xyz[rows] - middle) / max(reach, 1e-6)
    return np.concatenate([shape, np.nan_to_num(rgb[rows], nan=-1.0)], axis=1).astype(np.float32)


def stack_samples(parts: list[Floats]) -> Floats:
    """Return R samples as [R, 256, 6], also if R is 0."""
    return np.stack(parts) if parts else np.zeros((0, POINTS_PER_PART, 6), dtype=np.float32)
