"""What words say of where a thing is from the speaker, and the distances and winds that a text tells."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, Literal

from models.language.mentions.names import NUMBERS
from models.language.mentions.word_lists import english

Relation = Literal[
    "seen", "at", "outside", "beside", "near", "across", "inside", "past", "off", "on", "far", "block", "wind"
]
WIND_DEGREES: Final = {
    "north": 0, "northeast": 45, "east": 90, "southeast": 135, "south": 180, "southwest": 225, "west": 270,
    "northwest": 315,
}  # fmt: skip
FARTHEST_M: Final = 5000.0
A_FEW, A_COUPLE, FEW_METRES = 2.5, 2.0, 3.0
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
        angles: what the angle may be, with its probability, where that is not sure.
    """

    relation: Relation = "seen"
    angle: float | None = None
    wind: float | None = None
    distance_m: float | None = None
    is_loose: bool = False
    angles: tuple[tuple[float | None, float], ...] = ()


SEEN: Final = Cue()


@dataclass(frozen=True, slots=True)
class Said:
    """A distance or a wind of a text.

    Attributes:
        start, end: its characters.
        value: metres, or degrees clockwise from north.
        is_loose: of a distance: whether its unit is a loose one.
        is_of: whether it is "north of" something, or "30 m short of" it.
    """

    start: int
    end: int
    value: float
    is_loose: bool = False
    is_of: bool = False


_W = english()
_MANY = ("few", "couple")
_NUMBER = rf"(?:\d{{1,3}}(?:,\d{{3}})+(?!\d)|\d+(?:[.,]\d+)?|{'|'.join(word for word in NUMBERS if word not in _MANY)})"
_UNIT = "|".join(_W.metres)
_DISTANCE = re.compile(
    rf"\b({_NUMBER})(?:\s+(?:of|or|to)\s+(?:{_NUMBER})|(?<=half)\s+an?)?(\s+and\s+a\s+half)?(?:(?<=\d)[\s-]*|[\s-]+)"
    rf"(?:more\s+|full\s+|city\s+|short\s+|long\s+)?({_UNIT})e?s?\b(?! of\b)(\s+and\s+a\s+half)?",
    re.IGNORECASE,
)
_COMPOUND = re.compile(
    r"\b(twenty|thirty|forty|fifty|sixty|seventy|eighty|ninety)[\s-](one|two|three|four|five|six|seven|eight|nine)\b",
    re.IGNORECASE,
)
_THOUSANDS = re.compile(r"(?<=\d),(?=\d{3}(?!\d))")
_FEW = re.compile(rf"\b(?:a )?(?:few|(couple)(?: of)?|some)\s+(?:more\s+)?({_UNIT})e?s?\b", re.IGNORECASE)
_WIND = re.compile(rf"\b({WIND_WORD})(?:ern|erly|wards?|bound)?\b", re.IGNORECASE)
_OF = re.compile(
    r"(?:\s+(?:side|end|corner))?\s+(?:of|from|to)\b(?!\s+(?:me|us|it|here|this|you|there|where|that)\b)", re.IGNORECASE
)
_FROM = re.compile(
    r"\s+(?:[a-z-]+\s+){0,2}(?:of|from|before|past|off|beyond|after)\b(?!\s+(?:me|us|it|here|this|you|there|where|that)\b)",
    re.IGNORECASE,
)
_LOOSE = _W.list("loose_units")
_THINGS = ("yard", "foot", "meter", "metre", "door", "shop", "store", "building")
_AWAY = re.compile(r"\s+(?:away|ahead|behind|past|off|from|or\s+so|back|further|over|up|down)\b", re.IGNORECASE)


def distances_of(text: str) -> list[Said]:
    """The distances that a text tells, in metres."""
    plain = _COMPOUND.sub(_compound, text)  # as long as the text
    found = list(_measured(plain))
    for few in _FEW.finditer(plain):
        unit = few[2].lower()
        one = _W.metres[unit]
        many = (A_COUPLE if few[1] else A_FEW) * one
        many *= FEW_METRES if unit not in _LOOSE and one != _W.metres["step"] else 1.0
        if not any(said.start < few.end() and few.start() < said.end for said in found):
            found.append(Said(few.start(), few.end(), many, is_loose=True))
    return found


def _measured(plain: str) -> Iterator[Said]:
    for found in _DISTANCE.finditer(plain):
        if not _is_distance(plain, found):
            continue
        word, unit = found[1].lower(), found[3].lower()
        number = NUMBERS[word] if word in NUMBERS else float(_THOUSANDS.sub("", word).replace(",", "."))
        metres = (number + (0.5 if found[2] or found[4] else 0.0)) * _W.metres[unit]
        if metres <= FARTHEST_M:
            is_of = _FROM.match(plain, found.end()) is not None
            yield Said(found.start(), found.end(), metres, unit in _LOOSE, is_of)


def _is_distance(plain: str, found: re.Match[str]) -> bool:
    """Whether a number and a unit are a distance: neither a Foot Locker, nor two Miles Galleries, nor a shop."""
    number, unit = found[1], found[3]
    if unit[:1].isupper() and number[:1].islower() and not plain.isupper():
        return False
    is_thing = number.lower() in ("a", "an") and unit.lower() in _THINGS
    return not is_thing or _AWAY.match(plain, found.end()) is not None


def _compound(found: re.Match[str]) -> str:
    number = str(int(NUMBERS[found[1].lower()] + NUMBERS[found[2].lower()]))
    return number.ljust(len(found[0]))


def winds_of(text: str) -> list[Said]:
    """The winds that a text tells, in degrees."""
    return [
        Said(found.start(), found.end(), _degrees(found[1]), is_of=_OF.match(text, found.end()) is not None)
        for found in _WIND.finditer(text)
    ]


def wind_of(words: str) -> float | None:
    """Degrees of the first wind that words name; None without."""
    found = winds_of(words)
    return found[0].value if found else None


def _degrees(wind: str) -> float:
    return float(WIND_DEGREES[re.sub(r"[\s-]", "", wind.lower())])
