"""A map as coloured points, in an order in which any first part shows the whole map."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

from models.citymap.scenery.files import SceneryBlob
from models.citymap.types import Floats

POINTS_PER_PART = 200_000
UNITS_PER_M = 10  # coordinates are sent in decimetres
SEED = 0  # of the order of points


def encode_cloud(xyz_m: Floats, rgb: npt.NDArray[np.uint8]) -> Iterator[SceneryBlob]:
    """Yield parts of at most POINTS_PER_PART of the points [P, 3], drawn at random, with their colours [P, 3].

    Tensors: "steps" [P, 3], decimetres from the point before, the first from the origin; "rgb" [P, 3].
    """
    order = np.random.default_rng(SEED).permutation(len(xyz_m))
    for start in range(0, max(1, len(order)), POINTS_PER_PART):
        rows = order[start : start + POINTS_PER_PART]
        xyz = np.rint(xyz_m[rows] * UNITS_PER_M).astype(np.int32)
        by_place = np.lexsort(xyz.T)
        tensors: dict[str, npt.NDArray[Any]] = {
            "steps": np.diff(xyz[by_place], axis=0, prepend=np.zeros((1, 3), np.int32)).astype(np.int32),
            "rgb": np.ascontiguousarray(rgb[rows][by_place]),
        }
        yield SceneryBlob(tensors, {"kind": "points", "of": str(len(order))})
