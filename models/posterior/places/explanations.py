"""The mentions of a text on a map, and their explanations at a position."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from torch import Tensor

from models.citymap.types import Floats
from models.language.mentions.mentions import Mention


@dataclass(frozen=True, slots=True, eq=False)
class Places:
    """The mentions of a text, prepared for evaluation at positions.

    Attributes:
        mentions: those with objects near the map.
        common: [K] mean of each mention's kernel over the map, by which likelihoods are divided.
        listener_m: [2] position of the listener; None if unknown.
        listener_wind: degrees from the listener to the speaker; None if not stated.
        is_meeting: whether the text describes a meeting point, not the speaker's position.
    """

    mentions: tuple[Mention, ...]
    common: Tensor
    listener_m: Floats | None = None
    listener_wind: float | None = None
    is_meeting: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class MentionExplanation:
    """The explanation of a mention at a position.

    Attributes:
        probability: that an object explains the mention.
        item: index of the object, then of the line; -1 for none.
        way_m: [2] from the position to it.
    """

    probability: float
    item: int
    way_m: Floats


UNEXPLAINED: Final = MentionExplanation(0.0, -1, np.zeros(2))
