"""Evidence in words: "pharmacy: Apteekki Bulevardia, 16 m to your right"."""

from dataclasses import replace
from typing import Final

import numpy as np

from index.answering.answers import Evidence
from index.answering.place_text import compass_direction
from models.citymap.types import Floats
from models.language.languages.translation import translatable, translate

EXPLAINED_PROBABILITY: Final = 0.5  # from here on evidence counts as explained
NOT_FOUND: Final = translatable("not found here")
UNKNOWN_NAME: Final = translatable("unknown name")
NOT_ON_MAP: Final = translatable("not on this map")
HERE_M: Final = 1.0  # from a nearer point a direction tells nothing
_SIDES: Final = (  # up to which angle, on the left, on the right
    (22.5, translatable("ahead of you"), translatable("ahead of you")),
    (67.5, translatable("ahead on your left"), translatable("ahead on your right")),
    (112.5, translatable("to your left"), translatable("to your right")),
    (157.5, translatable("behind you on your left"), translatable("behind you on your right")),
    (181.0, translatable("behind you"), translatable("behind you")),
)


def with_fit(
    evidence: Evidence, position: Floats, heading_deg: float | None = None, missing: str = NOT_FOUND
) -> Evidence:
    """Return evidence at a position [2] with its `fit` in words.

    Directions start from the speaker's heading, clockwise from north, or without a heading from the north. `missing`
    are the words for evidence that no object explains.
    """
    fit = _fit(evidence, position, heading_deg, missing)
    return replace(evidence, fit=translate("{evidence}: {fit}", evidence=evidence.text, fit=fit))


def speaks_for(evidence: Evidence) -> bool:
    """Return whether evidence speaks for the position that it was evaluated at."""
    return evidence.explained >= EXPLAINED_PROBABILITY


def _fit(evidence: Evidence, position: Floats, heading_deg: float | None, missing: str) -> str:
    if evidence.absent:
        return translate("none here, as described") if speaks_for(evidence) else translate("there is one here")
    if evidence.at is None:
        return translate(missing)
    offset_m = np.subtract(evidence.at, position)
    distance_m = np.hypot(*offset_m)
    is_other_name = evidence.name is not None and evidence.name.lower() != evidence.text.lower()
    what = f"{evidence.name}, " if is_other_name else ""
    if distance_m < HERE_M:
        return what + translate("right here")
    if heading_deg is None:
        direction = translate("to the {direction}", direction=compass_direction(offset_m))
    else:
        direction = _side(offset_m, heading_deg)
    if speaks_for(evidence):
        return what + translate("{metres:.0f} m {direction}", metres=distance_m, direction=direction)
    return what + translate("{metres:.0f} m away {direction}", metres=distance_m, direction=direction)


def _side(offset_m: Floats, heading_deg: float) -> str:
    """Return the direction of an offset [2] (east, north) from a heading."""
    angle = (float(np.degrees(np.arctan2(*offset_m))) - heading_deg + 180.0) % 360.0 - 180.0
    return translate(next(left if angle < 0 else right for most, left, right in _SIDES if abs(angle) <= most))
