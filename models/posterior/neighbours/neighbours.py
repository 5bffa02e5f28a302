"""The neighbours of positions in a map."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.hints import HINT_REACH_M
from models.citymap.points import Ints
from models.citymap.types import Floats

STEP_M: Final = HINT_REACH_M / 127  # of the ways


@dataclass(frozen=True, slots=True, eq=False)
class Neighbours:
    """The neighbours of M nodes, ordered by node, then whole objects first, then by distance.

    Attributes:
        node: [R] int64 which of the nodes.
        part: [R] int64, which of the surroundings' things.
        way: [R, 2] int8, node minus the closest point (east, north), in steps of STEP_M.
        whole: [R] bool, False for a thing of which less than Clouds.thing_share is in the cube around the node.
    """

    node: Ints
    part: Ints
    way: npt.NDArray[np.int8]
    whole: npt.NDArray[np.bool_]

    @property
    def way_m(self) -> Floats:
        """[R, 2] the way in metres."""
        return self.way.astype(np.float64) * STEP_M
