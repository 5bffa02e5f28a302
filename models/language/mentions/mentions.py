"""What a text says of places: things, streets, corners, spans and addresses, and where each is from the speaker."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.language.measures import COMPASS_WORD, Bearing, Measure, bearing_of, bearings_in, measures_in, nearest_facts
from models.language.measures import Span as Placed
from models.language.mentions.cue_reader import CueReader, ReadCue
from models.language.mentions.cues import SEEN, Cue
from models.language.mentions.names import Word
from models.language.mentions.spans import Form, Span
from models.language.mentions.word_lists import english

NO_OBJECTS: Final = np.zeros(0, np.int64)
NO_WEIGHTS: Final = np.zeros(0)
NO_LINES: Final = np.zeros((0, 4))


@dataclass(frozen=True, slots=True, eq=False)
class Mention:
    """A thing, street, corner, span or address that a text names.

    Attributes:
        text: the words.
        start, end: where they stand.
        form: what it is; "unknown" for a name that the map has not.
        objects: [n] of the gazetteer that may be meant.
        weights: [n + e] relative, of these and of the lines.
        lines_m: [e, 4] places that are no object: corners, spans, house numbers between others.
        trust: that the words mean these at all.
        is_exact: whether a name of the map was said whole.
        kinds: what it is said to be.
        cue: where it is from the speaker.
        side: degrees of the side that is said ("the north side of"); None if none.
    """

    text: str
    start: int
    end: int
    form: Form
    objects: Ints = field(default_factory=lambda: NO_OBJECTS)
    weights: Floats = field(default_factory=lambda: NO_WEIGHTS)
    lines_m: Floats = field(default_factory=lambda: NO_LINES)
    trust: float = 1.0
    is_exact: bool = False
    kinds: tuple[str, ...] = ()
    cue: Cue = SEEN
    side: float | None = None

    @classmethod
    def of(cls, span: Span, words: Sequence[Word], text: str) -> "Mention":
        """A span of a text, without its cue."""
        start, end = words[span.first].start, words[span.last].end
        given, kinds = (text[start:end], start, end, span.form), tuple(span.kinds)
        if span.match is None:
            return cls(*given, kinds=kinds)
        match = span.match
        return cls(*given, match.objects, match.weights, NO_LINES, match.trust, match.is_exact, kinds)


_SIDE = re.compile(
    rf"\b({COMPASS_WORD})(?:ern|most)?\s+(?:side|end|corner|edge|part|half|bank)(?:\s+(?:of|on))?\b", re.IGNORECASE
)
_THE_STREET = re.compile(r"\s+(?:the|that|this)\s+(?:same\s+)?(?:street|road|avenue|ave|st)\b", re.IGNORECASE)
_ABSENT = english().pattern("cues", "absent", r"\b(?:{})\s+(?:[a-z]+\s+){{0,2}}$")
_GREETING = english().pattern("cues", "greeting", r"\W*(?:{})[ ,]+")
_HERE = re.compile(r"\s+here\b", re.IGNORECASE)
_THE = re.compile(r"\b(?:the|this|that|our|my)\s+$", re.IGNORECASE)
_ON_TOP = re.compile(r"\bon[\s-]top of\s+(?:[a-z-]+\s+){0,3}$", re.IGNORECASE)


def with_cues(text: str, mentions: Sequence[Mention], reader: CueReader) -> list[Mention]:
    """Mentions with what the text says of each; without those that it does not mean, or says are not there."""
    mentions = [mention for n, mention in enumerate(mentions) if not _is_again(text, mention, mentions[:n])]
    read = reader.read(text, [(mention.start, mention.end, mention.form) for mention in mentions])
    kept = [
        (mention, cue)
        for mention, cue in zip(mentions, read, strict=True)
        if cue.is_meant and not _ABSENT.search(text[: mention.start]) and not _is_greeted(text, mention)
    ]
    sides = [Bearing(m.start(), m.end(), bearing_of(m[1]) or 0.0) for m in _SIDE.finditer(text)]
    winds = _apart(bearings_in(text), [*mentions, *sides])  # the east of East 53rd Street is none
    far = nearest_facts(text, measures_in(text), [mention for mention, _ in kept])
    toward = nearest_facts(text, winds, [mention if cue.has_wind else None for mention, cue in kept])
    beside = _sides(text, _apart(sides, mentions), kept)
    said = [_cue(text, mention, cue, far.get(n), toward.get(n)) for n, (mention, cue) in enumerate(kept)]
    return [
        replace(mention, cue=said[n], side=beside[n].degrees if n in beside else None)
        for n, (mention, _) in enumerate(kept)
    ]


def _is_greeted(text: str, mention: Mention) -> bool:
    """Whether a name that the map has not is somebody's: "This is Ruth", "Hey Ruth", "Ruth here"."""
    if mention.form != "unknown" or " " in mention.text:
        return False
    before = text[: mention.start]
    is_here = not before.strip() and _HERE.match(text, mention.end) is not None
    return is_here or _GREETING.fullmatch(before) is not None


def _is_again(text: str, mention: Mention, before: Sequence[Mention]) -> bool:
    """Whether a kind is named again in the same words: "the bank is north of the cafe", where a cafe is the goal."""
    if mention.form != "thing" or mention.is_exact or _THE.search(text[: mention.start]) is None:
        return False
    words = mention.text.lower()
    return any(one.form == "thing" and one.text.lower().endswith(words) and not one.is_exact for one in before)


def _apart(said: Sequence[Bearing], others: Sequence[Placed]) -> list[Bearing]:
    """Those that stand in none of the others."""
    return [one for one in said if not any(one.start < other.end and other.start < one.end for other in others)]


def _cue(text: str, mention: Mention, read: ReadCue, far: Measure | None, wind: Bearing | None) -> Cue:
    degrees = None
    if wind is not None:
        # who is north of it has it in the south
        is_from_it = wind.is_of and wind.start < mention.start
        degrees = (wind.degrees + 180.0) % 360.0 if is_from_it else wind.degrees
    relation = (
        mention.cue.relation if mention.cue != SEEN else read.relation
    )  # of corners and spans: by their own words
    if _ON_TOP.search(text[: mention.start]):
        relation = "on"
    elif relation == "block" and degrees is not None and "block" not in text.lower():
        relation = "wind"
    if degrees is not None:
        return Cue(relation, None, degrees, far)
    return Cue(relation, read.angle, None, far, read.angles)


def _sides(text: str, sides: Sequence[Bearing], kept: Sequence[tuple[Mention, ReadCue]]) -> dict[int, Bearing]:
    """Of each street the side that is said: "the north side of the street" is that of the street it lies on."""
    found: dict[int, Bearing] = {}
    for side in sides:
        if _THE_STREET.match(text, side.end):
            before = [
                n for n, (mention, _) in enumerate(kept) if mention.form == "street" and mention.end <= side.start
            ]
            on = [n for n in before if kept[n][1].relation == "inside"]
            if before:
                found[(on or before)[-1]] = side
    rest = [side for side in sides if side not in found.values()]
    streets = [
        mention if mention.form in ("street", "span", "corner") and n not in found else None
        for n, (mention, _) in enumerate(kept)
    ]
    return found | nearest_facts(text, rest, streets)
