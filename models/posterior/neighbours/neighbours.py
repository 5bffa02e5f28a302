"""The neighbours of positions in a map."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.hints import HINT_REACH_M
from models.citymap.points import Ints
from models.citymap.types import Floats

STEP_M: Final = HINT_REACH_M / 127  # of offsets


@dataclass(frozen=True, slots=True, eq=False)
class Neighbours:
    """The R neighbours of M nodes, ordered by node, then whole objects first, then by distance."""

    node: Ints  # [R] int64
    part: Ints  # [R] int64, index of the object
    offset: npt.NDArray[np.int8]  # [R, 2] node minus the object's closest point (east, north), in steps of STEP_M
    whole: npt.NDArray[np.bool_]  # [R] False if the cube around the node has too little of an object for a cell

    @property
    def offset_m(self) -> Floats:
        """The offset [R, 2] in metres."""
        return self.offset.astype(np.float64) * STEP_M
