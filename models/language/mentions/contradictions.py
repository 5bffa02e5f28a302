"""Find contradictions in a text: the same thing on the left and on the right, or north and south of it."""

from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import Final

from models.language.languages.translation import translatable, translate
from models.language.measures import compass_name
from models.language.mentions.mentions import Mention

MIN_OPPOSITE_DEG: Final = 135.0  # two directions this far apart contradict each other
MAX_SAME_NAME_OBJECTS: Final = 4  # of one place; a chain may have one on either side
_EGO: Final = (
    translatable("ahead"), translatable("on the right"), translatable("behind"), translatable("on the left")
)  # fmt: skip
ShownDirection = tuple[str, float]  # its words, and its degrees


def contradictions(mentions: Sequence[Mention]) -> Iterator[str]:
    """Yield a sentence for each two mentions of the same thing that contradict each other."""
    for one, other in combinations(mentions, 2):
        if not 1 <= len(one.objects) <= MAX_SAME_NAME_OBJECTS or one.objects.tolist() != other.objects.tolist():
            continue
        for (shown, first), (also, second) in _pairs(one, other):
            if abs((first - second + 180.0) % 360.0 - 180.0) >= MIN_OPPOSITE_DEG:
                yield translate(
                    "'{text}': {one} and {other} are both said, but cannot both be true",
                    text=other.text,
                    one=shown,
                    other=also,
                )


def _pairs(one: Mention, other: Mention) -> Iterator[tuple[ShownDirection, ShownDirection]]:
    """Yield the directions that two mentions both state: side of a street, compass or egocentric direction."""
    if one.side is not None and other.side is not None:
        yield _side(one.side), _side(other.side)
    if one.cue.wind is not None and other.cue.wind is not None:
        yield _wind(one.cue.wind), _wind(other.cue.wind)
    # only of things: at a bend, one street is both ahead and behind
    if one.form == "thing" and one.cue.angle is not None and other.cue.angle is not None:
        yield _ego(one.cue.angle), _ego(other.cue.angle)


def _side(degrees: float) -> ShownDirection:
    return translate("its {direction} side", direction=translate(compass_name(degrees))), degrees


def _wind(degrees: float) -> ShownDirection:
    return translate("in the {direction}", direction=translate(compass_name(degrees))), degrees


def _ego(degrees: float) -> ShownDirection:
    return translate(_EGO[round(degrees / 90.0) % 4]), degrees
