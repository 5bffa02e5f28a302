"""Evidence in words: "pharmacy: Apteekki Bulevardia, 16 m to your right"."""

from dataclasses import replace
from typing import Final

import numpy as np

from index.answering.answers import Evidence
from index.answering.place_text import compass_direction
from models.citymap.types import Floats

EXPLAINED_PROBABILITY: Final = 0.5  # from here on evidence counts as explained
NOT_FOUND: Final = "not found here"
UNKNOWN_NAME: Final = "unknown name"
NOT_ON_MAP: Final = "not on this map"
HERE_M: Final = 1.0  # from a nearer point a direction tells nothing
_SIDES: Final = (
    (22.5, "ahead of you"),
    (67.5, "ahead on your {}"),
    (112.5, "to your {}"),
    (157.5, "behind you on your {}"),
    (181.0, "behind you"),
)


def with_fit(
    evidence: Evidence, position: Floats, heading_deg: float | None = None, missing: str = NOT_FOUND
) -> Evidence:
    """Return evidence at a position [2] with its `fit` in words.

    Directions start from the speaker's heading, clockwise from north, or without a heading from the north. `missing`
    are the words for evidence that no object explains.
    """
    return replace(evidence, fit=f"{evidence.text}: {_fit(evidence, position, heading_deg, missing)}")


def speaks_for(evidence: Evidence) -> bool:
    """Return whether evidence speaks for the position that it was evaluated at."""
    return evidence.explained >= EXPLAINED_PROBABILITY


def _fit(evidence: Evidence, position: Floats, heading_deg: float | None, missing: str) -> str:
    if evidence.absent:
        return "none here, as described" if speaks_for(evidence) else "there is one here"
    if evidence.at is None:
        return missing
    offset_m = np.subtract(evidence.at, position)
    distance_m = np.hypot(*offset_m)
    is_other_name = evidence.name is not None and evidence.name.lower() != evidence.text.lower()
    what = f"{evidence.name}, " if is_other_name else ""
    if distance_m < HERE_M:
        return f"{what}right here"
    away = "" if speaks_for(evidence) else " away"
    direction = f"to the {compass_direction(offset_m)}" if heading_deg is None else _side(offset_m, heading_deg)
    return f"{what}{distance_m:.0f} m{away} {direction}"


def _side(offset_m: Floats, heading_deg: float) -> str:
    """Return the direction of an offset [2] (east, north) from a heading."""
    angle = (float(np.degrees(np.arctan2(*offset_m))) - heading_deg + 180.0) % 360.0 - 180.0
    side = "left" if angle < 0 else "right"
    return next(words.format(side) for most, words in _SIDES if abs(angle) <= most)
