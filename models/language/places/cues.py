"""The words that say where a thing is from the speaker: left, across, at the corner, two blocks north; and how far."""

import re
from dataclasses import dataclass
from math import atan2, degrees
from typing import Final, Literal

from models.language.places.names import NUMBERS
from models.language.places.words import english

Relation = Literal[
    "at", "outside", "beside", "near", "across", "inside", "past", "off", "on", "far", "block", "wind", "seen"
]
WIND_DEGREES: Final = {
    "north": 0, "northeast": 45, "east": 90, "southeast": 135, "south": 180, "southwest": 225, "west": 270,
    "northwest": 315,
}  # fmt: skip
FARTHEST_M: Final = 5000.0
A_FEW, A_COUPLE, FEW_METRES = 2.5, 2.0, 3.0
A_BIT: Final = 0.4  # how much to the side "ahead, a bit to the left" is
WIND_WORD: Final = r"(?:north|south)[\s-]?(?:east|west)|north|south|east|west"


@dataclass(frozen=True, slots=True)
class Cue:
    """What some words say of a thing.

    Attributes:
        relation: how near, and in which way.
        angle: degrees clockwise from where the speaker looks; None if not said.
        wind: degrees clockwise from north, from the speaker to the thing; None if not said.
        distance_m: said; None if it is not.
        is_loose: whether the distance is in blocks, doors or minutes.
        is_absent: whether the text says that it is not there.
    """

    relation: Relation = "seen"
    angle: float | None = None
    wind: float | None = None
    distance_m: float | None = None
    is_loose: bool = False
    is_absent: bool = False


SEEN: Final = Cue()
_W = english()
_MANY = ("few", "couple")
_NUMBER = rf"(?:\d+(?:[.,]\d+)?|{'|'.join(word for word in NUMBERS if word not in _MANY)})"
_UNIT = "|".join(_W.metres)
_DISTANCE = re.compile(
    rf"\b({_NUMBER})(?:\s+(?:of|or|to)\s+(?:{_NUMBER})|(?<=half)\s+an?)?(\s+and\s+a\s+half)?[\s-]*"
    rf"(?:more\s+|full\s+|city\s+|short\s+|long\s+)?({_UNIT})e?s?\b(?! of\b)(\s+and\s+a\s+half)?"
)
_COMPOUND = re.compile(
    r"\b(twenty|thirty|forty|fifty|sixty|seventy|eighty|ninety)[\s-](one|two|three|four|five|six|seven|eight|nine)\b"
)
_THOUSANDS = re.compile(r"(?<=\d),(?=\d{3}\b)")
_FEW = re.compile(rf"\b(?:a )?(?:few|(couple)(?: of)?|some)\s+(?:more\s+)?({_UNIT})e?s?\b")
_WIND = re.compile(rf"\b({WIND_WORD})(?:ern|erly|wards?|bound)?\b")
_TO_HERE = r"(?:me|us|it|here|this|you|there|where)\b"
_WIND_OF = re.compile(rf"\b({WIND_WORD})(?:ern)?(?: side| end| corner)?\s+(?:of|from|to)\s+(?:[a-z]+\s+){{0,2}}$")
_WIND_IS = re.compile(
    rf"\b({WIND_WORD})\s+(?:of|from)\s+{_TO_HERE}|\b(?:to|on)\s+(?:the|my|our|its|it s|it's|his)\s+({WIND_WORD})\b"
    rf"|\b(?:directly|just|due|is|are|further|and)\s+({WIND_WORD})\s*(?:$|[.,;])"
    rf"|\b({WIND_WORD})\s+(?:is|are|there|lies|sits)\b"
)
_SIDE = re.compile(r"\b(left|right)\b")
_LOOSE = _W.list("loose_units")
_ADJECTIVES = "the |a |an |that |this |my |our |one of |some |those |these |old |big |tall |little |small "
_FORMS: dict[str, str] = {
    "looking": r"\b(?:{})\s+(?:[a-z]+\s+){{0,3}}$",
    "almost": r"\b(?:{})\s+(?:[a-z]+\s+){{0,1}}$",
    "at": r"\b(?:{})\s+(?:" + _ADJECTIVES + r")*$",
    "outside": r"\b(?:{})\s+(?:" + _ADJECTIVES + r")*$",
}
_BEFORE = {
    name: _W.pattern("before", name, _FORMS.get(name, r"\b(?:{})\s+(?:[a-z]+\s+){{0,2}}$"))
    for name in (
        "looking",
        "back_to",
        "across_from",
        "almost",
        "at",
        "outside",
        "beside",
        "past",
        "near",
        "inside",
        "absent",
    )
}
_BESIDE = {
    name: _W.pattern("beside", name, r"\b(?:{})\b") for name in ("across", "far", "block", "here", "front", "back")
}
_ADVERB, _A_BIT = _W.pattern("beside", "adverb"), _W.pattern("beside", "a_bit")
_OF_ME = re.compile(r"\b(?:in front of|behind) (?:me|us)\s*$")


def spelt(text: str) -> str:
    """Words in lower case, what is often misspelt mended; the length may change."""
    text = f"{text.lower()} "
    for wrong, right in _W.misspelt.items():
        if wrong in text:
            text = text.replace(wrong, right)
    return text.strip()


def angle_of(words: str) -> float | None:
    """Degrees that words tell, clockwise from ahead; None without a direction. Words as `spelt`."""
    words = _ADVERB.sub(" ", words)
    front, back = (_BESIDE[name].search(words) for name in ("front", "back"))
    side, bit = _SIDE.search(words), _A_BIT.search(words)
    ahead = 0.0
    if front and not (back and side):
        ahead = 1.0
    elif back:
        ahead = -1.0
    if not side:
        return degrees(atan2(0.0, ahead)) if ahead else None
    size = A_BIT if ahead and bit else 1.0
    return degrees(atan2(size if side[1] == "right" else -size, ahead or (1.0 if bit else 0.0)))


def distance_of(words: str) -> tuple[float, bool] | None:
    """Metres that words tell, and whether their unit is a loose one; None without. Words as `spelt`."""
    words = _THOUSANDS.sub("", _COMPOUND.sub(_compound, words))
    found = _DISTANCE.search(words)
    if found:
        number = NUMBERS[found[1]] if found[1] in NUMBERS else float(found[1].replace(",", "."))
        metres = (number + (0.5 if found[2] or found[4] else 0.0)) * _W.metres[found[3]]
        return (metres, found[3] in _LOOSE) if metres <= FARTHEST_M else None
    few = _FEW.search(words)
    if not few:
        return None
    one = _W.metres[few[2]]
    return (A_COUPLE if few[1] else A_FEW) * one * (
        FEW_METRES if few[2] not in _LOOSE and one != _W.metres["step"] else 1.0
    ), True


def _compound(found: re.Match[str]) -> str:
    return str(int(NUMBERS[found[1]] + NUMBERS[found[2]]))


def wind_of(words: str) -> float | None:
    """Degrees of the wind that words name; None without. Words as `spelt`."""
    found = _WIND.search(words)
    return None if found is None else _degrees(found[1])


def cue_of(before: str, after: str) -> Cue:
    """What the words before and after a thing in its clause say of it.

    Args:
        before: as `spelt`, without what belongs to other things.
        after: likewise.
    """
    both, front = f"{before} | {after}", f"{before} "
    relation, angle = _relation(front, after, angle_of(both))
    if _BESIDE["across"].search(both) and relation not in ("at", "outside", "beside", "inside"):
        relation = "across"
    elif relation == "seen":
        relation = next((name for name, found in _LOOSELY if _BESIDE[found].search(both)), relation)
    wind = _wind(front, after, before)
    if wind is not None:
        angle = None
        said_so = relation in ("seen", "near", "far") or (relation == "inside" and _WIND_OF.search(front) is not None)
        relation = "wind" if said_so else relation
    metres, loose = distance_of(both) or (None, False)
    return Cue(relation, angle, wind, metres, loose, _BEFORE["absent"].search(front) is not None)


_LOOSELY: Final[tuple[tuple[Relation, str], ...]] = (("beside", "here"), ("block", "block"), ("far", "far"))
# What stands right before a thing, in the order in which it is asked for, and the relation that it tells.
_ORDER: Final[tuple[tuple[str, Relation], ...]] = (
    ("looking", "far"), ("back_to", "beside"), ("across_from", "across"), ("almost", "near"), ("at", "at"),
    ("outside", "outside"), ("beside", "beside"), ("past", "past"), ("near", "near"), ("inside", "inside"),
)  # fmt: skip
_NOT_OF_ME: Final = ("outside", "near")  # "in front of me", "behind me" say where a thing is, not where I am


def _relation(front: str, after: str, angle: float | None) -> tuple[Relation, float | None]:
    """What the words right before a thing tell, and the angle that they leave."""
    of_me = _OF_ME.search(front) is not None
    said = [
        (name, relation)
        for name, relation in _ORDER
        if _BEFORE[name].search(front) and not (of_me and name in _NOT_OF_ME)
    ]
    name, relation = said[0] if said else ("", "seen")
    if name == "looking":
        relation = "across" if ("across_from", "across") in said else "far"
        angle = angle or 0.0
    elif name == "back_to":
        angle = 180.0
    elif name == "across_from" and angle == 0.0 and "facing" in front:
        angle = None
    elif name == "outside" and "front of" in front:
        angle = angle_of(after)
    elif name == "inside" and angle is not None:
        relation = "seen"
    return relation, angle


def _wind(front: str, after: str, before: str) -> float | None:
    of = _WIND_OF.search(front)
    if of:
        return (_degrees(of[1]) + 180.0) % 360.0  # the speaker is north of it: it is south
    for words in (after, before):
        found = _WIND_IS.search(f"{words} ")
        if found:
            return _degrees(next(group for group in found.groups() if group))
    return None


def _degrees(wind: str) -> float:
    return float(WIND_DEGREES[re.sub(r"[\s-]", "", wind)])
