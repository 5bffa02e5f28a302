"""How a language with a table says what is meant, joined, denied, corrected and past."""

import re
from collections.abc import Iterator, Sequence
from functools import cache
from typing import Final

from models.language.languages.cue_reader import TableCueReader
from models.language.languages.english import English
from models.language.languages.table import LanguageTable, fold, load_table, lower
from models.language.measures import Bearing, Measure
from models.language.mentions.cue_reader import MentionSpan, ReadCue

MAX_SMALL_WORD: Final = 3  # letters of the articles and prepositions between two streets that meet
MAX_APART: Final = 30  # characters from two streets to the word that says they meet, or that something is between
_MARKS: Final = re.compile(r"[\s,/&+@'’-]+")  # noqa: RUF001
_CLAUSE_END: Final = re.compile(r"[.;!?\n]\s*|,\s+")


class Tabulated:
    """A language, or several that a text mixes, that is read by its table."""

    def __init__(self, table: LanguageTable) -> None:
        self.table, self.stop = table, table.stop
        self._cues = TableCueReader(table)
        discourse = ("correction", "past", "now", "absent", "greeting")
        self._correction, self._past, self._now, self._absent, self._greeting = (
            table.pattern("discourse", name) for name in discourse
        )
        self._denied = table.phrases("discourse", "denied")

    def read_cues(self, text: str, mentions: Sequence[MentionSpan]) -> list[ReadCue]:
        """Return the cue of each mention (start, end, form)."""
        return self._cues.read(text, mentions)

    def cue_spans(self, text: str) -> list[tuple[int, int]]:
        """Return the start and end of the phrases that are no things: "on the left"."""
        return self._cues.phrase_spans(text)

    def find_measures(self, text: str) -> Sequence[Measure]:
        """Return the distances of a text."""
        return self._cues.find_measures(text)

    def find_bearings(self, text: str) -> list[Bearing]:
        """Return the compass directions of a text."""
        return self._cues.find_bearings(text)

    def meets(self, text: str, first: int, start: int, end: int, last: int) -> bool:
        """Return whether a text may say that the streets at first..start and end..last meet."""
        between = fold(text[start:end])
        if not between.strip():  # "angolo Via Roma Via Milano"
            return self._has_corner(text, first - MAX_APART // 2, first) or self._has_corner(
                text, last, last + MAX_APART // 2
            )
        rest = self.table.corners.sub(" ", fold(self.table.ands.sub(" ", lower(text[start:end]))))
        joined = rest != between or re.search(r"[/&+@]|-\s*$", between) is not None
        return joined and all(len(word) <= MAX_SMALL_WORD for word in _MARKS.split(rest)) and "." not in between

    def meets_at_end(self, text: str, start: int, end: int, last: int) -> bool:
        """Return whether a comma at start..end joins two streets, of which the second ends at `last`."""
        return text[start:end].strip() == "," and self._has_corner(text, last, last + MAX_APART // 2)

    def is_sure(self, text: str, start: int, end: int) -> bool:
        """Return whether the words at start..end, between two streets, can mean nothing but a corner."""
        near = self._has_corner(text, max(0, start - MAX_APART), end + MAX_APART)
        return near or re.search(r"[/&@]", text[start:end]) is not None

    def is_loose(self, text: str, start: int, end: int) -> bool:
        """Return whether the words between two streets say that their corner is near."""
        return False

    def is_between(self, text: str, first: int, start: int, end: int, last: int) -> bool:
        """Return whether a text is about what is between two things at first..start and end..last."""
        folded = fold(text)
        if self.table.ands.search(lower(text), start, end) is None and text[start:end].strip(" ") != "-":
            return False
        if self._has_corner(text, first - MAX_APART // 2, first):  # "all'angolo tra Via Roma e Via Milano"
            return False
        after = self.table.between.search(folded, last, last + MAX_APART // 2)
        return self.begins_between(text, first) or (
            after is not None and not _MARKS.sub("", folded[last : after.start()])
        )

    def begins_between(self, text: str, first: int) -> bool:
        """Return whether "between" stands before a thing."""
        folded = fold(text)
        matches = list(self.table.between.finditer(folded, max(0, first - MAX_APART), first))
        return bool(matches) and all(
            len(word) <= MAX_SMALL_WORD + 1 for word in folded[matches[-1].end() : first].split()
        )

    def corrections(self, text: str) -> Iterator[tuple[int, int]]:
        """Yield the start and end of words that take back what is before them."""
        return (match.span() for match in self._correction.finditer(fold(text)))

    def is_denied(self, text: str, start: int, end: int) -> bool:
        """Return whether a text says that the speaker is not at a thing."""
        folded = fold(text)
        return any(phrase.around(folded, start, end) is not None for phrase in self._denied)

    def clause_starts(self, text: str) -> list[int]:
        """Return the starts of the clauses that may be about different times."""
        return [0, *(match.end() for match in _CLAUSE_END.finditer(text))]

    def is_past(self, clause: str) -> bool:
        """Return whether a clause is about the past."""
        folded = fold(clause)
        return self._past.search(folded) is not None and self._now.search(folded) is None

    def is_absent(self, text: str, start: int) -> bool:
        """Return whether a text says that a thing is not there."""
        folded = fold(text)
        return any(
            len(folded[match.end() : start].split()) <= 1
            for match in self._absent.finditer(folded, max(0, start - MAX_APART), start)
        )

    def is_greeted(self, text: str, start: int, end: int) -> bool:
        """Return whether a name is a person's: "Hier ist Ruth"."""
        matches = list(self._greeting.finditer(fold(text[:start])))
        return bool(matches) and not _MARKS.sub("", text[matches[-1].end() : start])

    def _has_corner(self, text: str, start: int, end: int) -> bool:
        return self.table.corners.search(fold(text), max(0, start), end) is not None


Language = English | Tabulated


@cache
def tabulated(codes: tuple[str, ...]) -> Tabulated:
    """Return the language, or the mixture of languages, of table codes."""
    return Tabulated(load_table(codes))
