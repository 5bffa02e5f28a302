"""What a text says of one thing that cannot all be true: on the left and on the right, north and south of it."""

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Final

from models.language.measures import compass_name
from models.language.mentions.mentions import Mention

OPPOSITE: Final = 135.0  # degrees between what is said twice, from which on both cannot be true
FEW: Final = 4  # objects of one name that are one place; of a chain there may be one on the left and one on the right
_EGO: Final = ("ahead", "on the right", "behind", "on the left")
Said = tuple[str, float]  # how it is shown, and the direction in degrees


def contradictions(mentions: Sequence[Mention]) -> Iterator[str]:
    """Sentences for the caller, one for each two mentions of the same one thing that contradict each other."""
    for one, other in combinations(mentions, 2):
        if not 1 <= len(one.objects) <= FEW or one.objects.tolist() != other.objects.tolist():
            continue
        for (shown, first), (also, second) in _pairs(one, other):
            if abs((first - second + 180.0) % 360.0 - 180.0) >= OPPOSITE:
                yield f"'{other.text}': {shown} and {also} are both said, but cannot both be true"


def _pairs(one: Mention, other: Mention) -> Iterator[tuple[Said, Said]]:
    """What both say of the same: the side of a street, a wind, or a direction from the speaker."""
    if one.side is not None and other.side is not None:
        yield _side(one.side), _side(other.side)
    if one.cue.wind is not None and other.cue.wind is not None:
        yield _wind(one.cue.wind), _wind(other.cue.wind)
    # who stands at a bend has one street ahead and behind
    if one.form == "thing" and one.cue.angle is not None and other.cue.angle is not None:
        yield _ego(one.cue.angle), _ego(other.cue.angle)


def _side(degrees: float) -> Said:
    return f"its {_name(degrees)} side", degrees


def _wind(degrees: float) -> Said:
    return f"in the {_name(degrees)}", degrees


def _ego(degrees: float) -> Said:
    return _EGO[round(degrees / 90.0) % 4], degrees


def _name(degrees: float) -> str:
    return compass_name(degrees)
