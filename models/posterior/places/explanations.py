"""A text's mentions on a map, and what explains each at a position."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from torch import Tensor

from models.citymap.types import Floats
from models.language.mentions.mentions import Mention


@dataclass(frozen=True, slots=True, eq=False)
class Places:
    """A text's mentions, ready to be asked of positions.

    Attributes:
        mentions: those that the map knows.
        common: [K] mean of each mention's kernel over the map: what is near everywhere tells nothing.
        listener_m: [2] where the listener is, if winds are seen from there.
        listener_wind: degrees from the listener to the speaker; None if not said.
        is_meeting: whether the place told of is not where the speaker stands.
    """

    mentions: tuple[Mention, ...]
    common: Tensor
    listener_m: Floats | None = None
    listener_wind: float | None = None
    is_meeting: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Explained:
    """What explains a mention at a position.

    Attributes:
        probability: that something does.
        item: which of the mention's objects, beyond them which of its lines; -1 for none.
        way_m: [2] from the position to it.
    """

    probability: float
    item: int
    way_m: Floats


NOT_EXPLAINED: Final = Explained(0.0, -1, np.zeros(2))
