"""Mentions of things, streets, corners, spans and addresses, and their cues."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Final, Literal

import numpy as np

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.language.languages.tabulated import Language
from models.language.languages.translation import translate
from models.language.measures import (
    COMPASS_WORD,
    Bearing,
    CharacterSpan,
    Measure,
    first_bearing,
    match_facts_to_spans,
    overlaps,
)
from models.language.mentions.cue_reader import ReadCue
from models.language.mentions.cues import NO_CUE, Cue, Form
from models.language.mentions.lookup import NO_LINES
from models.language.mentions.names import Word
from models.language.mentions.spans import Span

MAX_ANCHOR_OBJECTS: Final = 4  # of a name that tells one place
MentionForm = Form | Literal["point"]  # of a code, such as coordinates
NO_OBJECTS: Final = np.zeros(0, np.int64)
NO_WEIGHTS: Final = np.zeros(0)


@dataclass(frozen=True, slots=True, eq=False)
class Mention:
    """A thing, street, corner, span or address that a text names."""

    text: str
    start: int
    end: int
    form: MentionForm  # of the mention; "unknown" for a name that the map lacks
    objects: Ints = field(default_factory=lambda: NO_OBJECTS)  # [n] candidates of the gazetteer
    # [n + e] relative weights of the objects, then of the lines
    weights: Floats = field(default_factory=lambda: NO_WEIGHTS)
    # [e, 4] candidates that are not objects: corners, spans, interpolated house numbers
    lines_m: Floats = field(default_factory=lambda: NO_LINES)
    trust: float = 1.0  # probability that the words mean any of the candidates
    is_exact: bool = False  # whether the words are a whole name of the map
    kinds: tuple[str, ...] = ()  # kinds that the words state
    lacks_name: bool = False  # whether the words also have a name that no object of the kinds has: "Pasila station"
    is_denied: bool = False  # whether the text says that it is not there: "not near Kiasma"
    cue: Cue = NO_CUE  # where it is from the speaker
    side: float | None = None  # degrees of the stated side ("the north side of"); None without one
    note: str = ""  # what was assumed to find it, or why it was not found, in the language of the reply

    @property
    def warning(self) -> str:
        """Return what the caller should know; often nothing."""
        if self.note or not self.is_unknown:
            return self.note
        return translate("'{text}' was not found on the map", text=self.text)

    @property
    def is_unknown(self) -> bool:
        """Whether the words have a name that the map lacks."""
        return self.form == "unknown" or self.lacks_name

    @property
    def is_anchor(self) -> bool:
        """Whether the words are the whole name of few objects, a corner, a span or an address."""
        is_name = self.form == "thing" and self.is_exact and len(self.objects) <= MAX_ANCHOR_OBJECTS
        return is_name or (self.form in ("corner", "span", "address", "point") and len(self.weights) > 0)

    @classmethod
    def from_span(cls, span: Span, words: Sequence[Word], text: str) -> "Mention":
        """Return the mention of a span of a text, without its cue."""
        start, end = words[span.first].start, words[span.last].end
        common, kinds = (text[start:end], start, end, span.form), tuple(span.kinds)
        if span.match is None:
            return cls(*common, kinds=kinds)
        match = span.match
        mention = cls(*common, match.objects, match.weights, NO_LINES, match.trust, match.is_exact, kinds)
        return replace(mention, lacks_name=True) if span.lacks_name else mention


_SIDE = re.compile(
    rf"\b({COMPASS_WORD})(?:ern|most)?\s+(?:side|end|corner|edge|part|half|bank)(?:\s+(?:of|on))?\b", re.IGNORECASE
)
_THE_STREET = re.compile(r"\s+(?:the|that|this)\s+(?:same\s+)?(?:street|road|avenue|ave|st)\b", re.IGNORECASE)
_THE = re.compile(r"\b(?:the|this|that|our|my)\s+$", re.IGNORECASE)
_ON_TOP = re.compile(r"\bon[\s-]top of\s+(?:[a-z-]+\s+){0,3}$", re.IGNORECASE)


def add_cues(text: str, mentions: Sequence[Mention], language: Language) -> list[Mention]:
    """Return mentions with their cues, without those that are absent or not meant."""
    mentions = [mention for n, mention in enumerate(mentions) if not _is_repeated(text, mention, mentions[:n])]
    read = language.read_cues(text, [(m.start, m.end, "address" if m.form == "point" else m.form) for m in mentions])
    meant = [
        (mention, cue)
        for mention, cue in zip(mentions, read, strict=True)
        if (mention.is_denied or (cue.is_meant and not language.is_absent(text, mention.start)))
        and not _is_greeted(text, mention, language)
    ]
    sides = [Bearing(m.start(), m.end(), first_bearing(m[1]) or 0.0) for m in _SIDE.finditer(text)]
    winds = _without_overlaps(language.find_bearings(text), [*mentions, *sides])  # without the east of East 53rd Street
    measures = match_facts_to_spans(text, language.find_measures(text), [mention for mention, _ in meant])
    winds_by_mention = match_facts_to_spans(text, winds, [mention if cue.has_wind else None for mention, cue in meant])
    sides_by_mention = _sides(text, _without_overlaps(sides, mentions), meant)
    result = []
    for n, (mention, read_cue) in enumerate(meant):
        cue = _cue(text, mention, read_cue, measures.get(n), winds_by_mention.get(n))
        result.append(replace(mention, cue=cue, side=sides_by_mention[n].degrees if n in sides_by_mention else None))
    return result


def _is_greeted(text: str, mention: Mention, language: Language) -> bool:
    """Return whether an unknown name is a person's."""
    is_word = mention.form == "unknown" and " " not in mention.text
    return is_word and language.is_greeted(text, mention.start, mention.end)


def _is_repeated(text: str, mention: Mention, before: Sequence[Mention]) -> bool:
    """Return whether a kind is repeated: "the bank is north of the cafe", where a cafe is the goal."""
    if mention.form != "thing" or mention.is_exact or _THE.search(text[: mention.start]) is None:
        return False
    words = mention.text.lower()
    return any(one.form == "thing" and one.text.lower().endswith(words) and not one.is_exact for one in before)


def _without_overlaps(bearings: Sequence[Bearing], others: Sequence[CharacterSpan]) -> list[Bearing]:
    """Return the bearings that overlap none of the others."""
    return [one for one in bearings if not overlaps(one, others)]


def _cue(text: str, mention: Mention, read: ReadCue, far: Measure | None, wind: Bearing | None) -> Cue:
    degrees = None
    if wind is not None:
        # "north of it" has the thing in the south
        is_from_it = wind.is_of and wind.start < mention.start
        degrees = (wind.degrees + 180.0) % 360.0 if is_from_it else wind.degrees
    # Corners and spans have a relation from their own words.
    relation = mention.cue.relation if mention.cue != NO_CUE else read.relation
    if _ON_TOP.search(text[: mention.start]):
        relation = "on"
    elif relation == "block" and degrees is not None and "block" not in text.lower():
        relation = "wind"
    if degrees is not None:
        return Cue(relation, None, degrees, far)
    return Cue(relation, read.angle, None, far, read.angles)


def _sides(text: str, sides: Sequence[Bearing], meant: Sequence[tuple[Mention, ReadCue]]) -> dict[int, Bearing]:
    """Return the side of each street; "the north side of the street" belongs to the street mentioned before."""
    side_of: dict[int, Bearing] = {}
    for side in sides:
        if _THE_STREET.match(text, side.end):
            before = [n for n, (one, _) in enumerate(meant) if one.form == "street" and one.end <= side.start]
            on = [n for n in before if meant[n][1].relation == "inside"]
            if before:
                side_of[(on or before)[-1]] = side
    rest = [side for side in sides if side not in side_of.values()]
    streets = [
        mention if mention.form in ("street", "span", "corner") and n not in side_of else None
        for n, (mention, _) in enumerate(meant)
    ]
    return side_of | match_facts_to_spans(text, rest, streets)
