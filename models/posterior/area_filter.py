"""The area that a request allows. Without torch, because the service reads requests without it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from models.citymap.types import Floats


@dataclass(frozen=True, slots=True, eq=False)
class AreaFilter:
    """The area outside which a position has no probability."""

    has_node: npt.NDArray[np.bool_]  # [N] whether a node of each cell is inside
    contains: Callable[[Floats], npt.NDArray[np.bool_]]  # whether positions [M, 2] are inside
