"""Where somebody may be, when the question says so: without torch, since the service reads requests without it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from models.citymap.types import Floats


@dataclass(frozen=True, slots=True, eq=False)
class Inside:
    """Where somebody may be alone.

    Attributes:
        cells: [N] whether a node of each cell is there.
        holds: whether positions [M, 2] are.
    """

    cells: npt.NDArray[np.bool_]
    holds: Callable[[Floats], npt.NDArray[np.bool_]]
