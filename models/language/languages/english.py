"""How English says what is meant, joined, denied, corrected and past."""

import re
from collections.abc import Iterator, Sequence
from typing import Final

from models.language.measures import Bearing, Measure, find_bearings, find_measures
from models.language.mentions.cue_reader import CueReader, MentionSpan, ReadCue
from models.language.mentions.word_lists import english

_W = english()
_MEETS, _AND = _W.pattern("streets", "meets"), _W.pattern("streets", "and")
_LOOSELY, _BETWEEN = _W.pattern("streets", "loosely"), _W.pattern("streets", "between")
_SURELY = re.compile(r"\b(?:and|at|meets|crosses|corner of)\b|[&/@]", re.IGNORECASE)
_AT_END = re.compile(r"\s*(?:$|[.,;!?\n]|corner\b|crossing\b|intersection\b)", re.IGNORECASE)
_CORRECTION = _W.pattern("discourse", "correction", r"[\s,.;:!?\u2013\u2014-]*\b(?:{})\b[\s,:-]*")
_DENIED = _W.pattern("discourse", "denied", r"\b(?:{})\s+(?:the\s+)?$")
_PAST, _NOW = (_W.pattern("discourse", name, r"\b(?:{})\b") for name in ("past", "now"))
_CLAUSE_END = _W.pattern("discourse", "clause_end")
_ABSENT = _W.pattern("cues", "absent", r"\b(?:{})\s+(?:[a-z]+\s+){{0,2}}$")
_GREETING = _W.pattern("cues", "greeting", r"\W*(?:{})[ ,]+")
_HERE = re.compile(r"\s+here\b", re.IGNORECASE)


class English:
    """English, whose cues a trained reader reads."""

    stop: Final = frozenset[str]()  # besides the words that are no names in any language
    table: Final = None

    def __init__(self, cues: CueReader) -> None:
        self._cues = cues

    def read_cues(self, text: str, mentions: Sequence[MentionSpan]) -> list[ReadCue]:
        """Return the cue of each mention (start, end, form)."""
        return self._cues.read(text, mentions)

    def cue_spans(self, text: str) -> list[tuple[int, int]]:
        """Return nothing: the trained reader knows which words are no things."""
        return []

    def find_measures(self, text: str) -> Sequence[Measure]:
        """Return the distances of a text."""
        return find_measures(text)

    def find_bearings(self, text: str) -> list[Bearing]:
        """Return the compass directions of a text."""
        return find_bearings(text)

    def meets(self, text: str, first: int, start: int, end: int, last: int) -> bool:
        """Return whether a text may say that the streets at first..start and end..last meet."""
        comma = text[start:end].strip() == ","
        # "in Rochstraße, Münzstraße is just behind me"
        return _MEETS.fullmatch(text, start, end) is not None and not comma

    def meets_at_end(self, text: str, start: int, end: int, last: int) -> bool:
        """Return whether a comma at start..end joins two streets, of which the second ends at `last`."""
        return text[start:end].strip() == "," and _AT_END.match(text, last) is not None

    def is_sure(self, text: str, start: int, end: int) -> bool:
        """Return whether the words at start..end, between two streets, can mean nothing but a corner."""
        return _SURELY.search(text, start, end) is not None

    def is_loose(self, text: str, start: int, end: int) -> bool:
        """Return whether the words between two streets say that their corner is near."""
        return _LOOSELY.search(text[start:end]) is not None

    def is_between(self, text: str, first: int, start: int, end: int, last: int) -> bool:
        """Return whether a text is about what is between two things at first..start and end..last."""
        return self.begins_between(text, first) and _AND.fullmatch(text, start, end) is not None

    def begins_between(self, text: str, first: int) -> bool:
        """Return whether "between" stands before a thing."""
        return _BETWEEN.search(text[:first]) is not None

    def corrections(self, text: str) -> Iterator[tuple[int, int]]:
        """Yield the start and end of words that take back what is before them."""
        return (match.span() for match in _CORRECTION.finditer(text))

    def is_denied(self, text: str, start: int, end: int) -> bool:
        """Return whether a text says that the speaker is not at a thing."""
        return _DENIED.search(text[:start]) is not None

    def clause_starts(self, text: str) -> list[int]:
        """Return the starts of the clauses that may be about different times."""
        return [0, *(match.end() for match in _CLAUSE_END.finditer(text))]

    def is_past(self, clause: str) -> bool:
        """Return whether a clause is about the past."""
        return _PAST.search(clause) is not None and _NOW.search(clause) is None

    def is_absent(self, text: str, start: int) -> bool:
        """Return whether a text says that a thing is not there."""
        return _ABSENT.search(text[:start]) is not None

    def is_greeted(self, text: str, start: int, end: int) -> bool:
        """Return whether a name is a person's: "This is Ruth", "Hey Ruth", "Ruth here"."""
        is_here = not text[:start].strip() and _HERE.match(text, end) is not None
        return is_here or _GREETING.fullmatch(text[:start]) is not None
