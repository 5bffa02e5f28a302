"""The mentions of a text on a map, and their explanations at a position."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from torch import Tensor

from models.citymap.types import Floats
from models.language.mentions.mentions import Mention


@dataclass(frozen=True, slots=True, eq=False)
class PlacedMentions:
    """The mentions of a text, prepared for evaluation at positions."""

    mentions: tuple[Mention, ...]  # those with objects near the map
    kernel_means: Tensor  # mean of each mention's kernel over the map, by which likelihoods are divided
    denied: tuple[Mention, ...] = ()  # those that the text says are not near
    listener_m: Floats | None = None  # [2] position of the listener
    listener_wind: float | None = None  # stated bearing from the listener to the speaker, degrees
    is_meeting: bool = False  # whether the text describes a meeting point, not the speaker's position


@dataclass(frozen=True, slots=True, eq=False)
class MentionExplanation:
    """The explanation of a mention at a position."""

    probability: float  # that an object explains the mention
    item: int  # index of the object, then of the line; -1 for none
    offset_m: Floats  # [2] from the position to it
    heading_deg: float = 0.0  # of the speaker, clockwise from north, that explains the whole text best


UNEXPLAINED: Final = MentionExplanation(0.0, -1, np.zeros(2))
