"""Hints parsed from a text, including things that only a plural or words such as "the other" name."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from torch import Tensor

from models.language.measures import COMPASS, Measure, find_measures, find_numbers

# The direction from the thing to the speaker: the eight compass directions, at it, or unknown.
RELATIONS: Final = (*COMPASS, "on-top", "near")
COUNT_CONTEXT_CHARACTERS = 40  # characters before a plural that may hold its number
MAX_PLURAL_HINTS = 4  # of one plural
COUNTED: Final = range(2, 7)  # numbers that may count a plural; others rarely do
_COLLECTIVES: Final = {"pair": 2, "couple": 2, "both": 2, "twin": 2, "either": 2, "trio": 3, "triple": 3}
_COLLECTIVE = re.compile(rf"\b({'|'.join(_COLLECTIVES)})\b", re.I)
_CLAUSE_END = re.compile(r"[.;:!?\n]")
_MEASURE = re.compile(
    r"\b(?:area|bit|bunch|clump|cluster|expanse|length|line|patch|piece|plot|row|section|stretch|strip)(?:e?s)?$", re.I
)
# Up to three words, such as a colour, may come between.
_OF_PHRASE = re.compile(r"\s+of(?:\s+(?!(?:a|an|and|at|but|by|in|is|of|on|or|the|to|with)\b)[\w-]+){0,3}\s+$", re.I)
_DEFINITE = re.compile(r"\b(?:the|this|that)\s+$", re.I)
_WHERE = re.compile(
    r"\b(?:north|south|east|west|touch)"
    r"|\b(?:adjacent|against|at|beside|by|close|feet|here|near(?:by)?|next to|on|stand|under)\b"
    r"|\b(?-i:[NS]?[EW]|[NS])\b",
    re.I,
)
SENTENCE_END: Final = re.compile(r"[.!?;\n](?:\s|$)")


@dataclass(frozen=True, slots=True, eq=False)
class ParsedHint:
    """A thing that a description names."""

    noun: str  # the words for it
    start: int
    end: int
    relation: Tensor  # [10] probability of each of RELATIONS
    colour: Tensor  # [C + 1] probability of each of COLOURS; the last, that no colour is stated
    absent: float  # probability that the text states its absence
    measure: Measure | None = None  # the stated distance; None without one

    def shifted(self, characters: int) -> "ParsedHint":
        """Return the hint with its characters moved by an offset."""
        measure = self.measure and replace(
            self.measure, start=self.measure.start + characters, end=self.measure.end + characters
        )
        return replace(self, start=self.start + characters, end=self.end + characters, measure=measure)

    @property
    def distance_m(self) -> float | None:
        """The stated distance; None without one."""
        return None if self.measure is None else self.measure.metres


def resolve(text: str, things: Sequence[ParsedHint], kinds: Sequence[str]) -> list[ParsedHint]:
    """Resolve things in text order: a stand-in gets its noun, a plural becomes as many hints as it counts.

    Plurals that stand-ins refer to and stand-ins without a noun before them are left out.
    """
    counts = [_count(text, thing) if kind == "plural" else 1 for thing, kind in zip(things, kinds, strict=True)]
    things, again = _merge_repeated(text, things, kinds)
    stand_in_counts = [0] * len(things)  # stand-ins of each plural
    nouns = [thing.noun for thing in things]
    for n, kind in enumerate(kinds):
        if kind == "stand-in":
            open_plurals = [m for m in range(n) if kinds[m] == "plural" and stand_in_counts[m] < max(2, counts[m])]
            before = open_plurals or [m for m in range(n) if kinds[m] == "noun"]
            nouns[n] = nouns[before[-1]] if before else ""
            if open_plurals:
                stand_in_counts[before[-1]] += 1
    hints: list[ParsedHint] = []
    for n, thing in enumerate(things):
        copies = 0 if stand_in_counts[n] or not nouns[n] or n in again else counts[n]
        hints += [replace(thing, noun=nouns[n])] * copies
    return hints


def _merge_repeated(text: str, things: Sequence[ParsedHint], kinds: Sequence[str]) -> tuple[list[ParsedHint], set[int]]:
    """Merge repeated mentions into the first one; return the things and the indices of the repeated ones.

    "I see a gray house. The house is north of me", "a house is north of me. The house is gray", and "a patch of grass",
    where the patch is not a thing.
    """
    merged, again = list(things), set[int]()
    placed = [_says_where(text, thing) for thing in things]
    for n, thing in enumerate(things):
        follows = text[thing.end : things[n + 1].start] if n + 1 < len(things) else ""
        if _MEASURE.search(thing.noun) and _OF_PHRASE.match(follows):
            again.add(n)
            if things[n + 1].measure is None:
                merged[n + 1] = replace(things[n + 1], measure=thing.measure)
        elif kinds[n] == "noun" and _DEFINITE.search(text, max(0, thing.start - 6), thing.start):
            same = [m for m in range(n) if m not in again and kinds[m] == "noun" and _is_like(things[m], thing)]
            if same and (both := _merged(merged[same[-1]], merged[n], placed[same[-1]], placed[n])):
                merged[same[-1]] = both
                placed[same[-1]] |= placed[n]
                again.add(n)
    return merged, again


def _is_like(one: ParsedHint, other: ParsedHint) -> bool:
    longer, shorter = sorted((one.noun.casefold(), other.noun.casefold()), key=len, reverse=True)
    return f" {longer}".endswith(f" {shorter}")


def _merged(first: ParsedHint, later: ParsedHint, first_placed: bool, later_placed: bool) -> ParsedHint | None:
    """Merge two mentions; None if both state a place or both a colour, so that they may be two things."""
    coloured = [x.colour[-1] < 0.5 for x in (first, later)]
    if (first_placed and later_placed) or all(coloured) or max(first.absent, later.absent) > 0.5:
        return None
    return replace(
        first,
        relation=(later if later_placed else first).relation,
        colour=(later if coloured[1] else first).colour,
        measure=later.measure or first.measure,
    )


def _says_where(text: str, thing: ParsedHint) -> bool:
    """Return whether the sentence of a thing says where anything is."""
    begin = max((m.end() for m in SENTENCE_END.finditer(text, 0, thing.start)), default=0)
    end = SENTENCE_END.search(text, thing.end)
    return bool(_WHERE.search(text, begin, end.start() if end else len(text)))


def _count(text: str, thing: ParsedHint) -> int:
    """Return how many things a plural names: the last number before it in its clause, else 1."""
    clause = _CLAUSE_END.split(text[max(0, thing.start - COUNT_CONTEXT_CHARACTERS) : thing.start])[-1]
    measures = find_measures(clause)
    counts_by_start = [(number.start, number.value) for number in find_numbers(clause) if not number.is_vague]
    counts_by_start += [(match.start(), _COLLECTIVES[match[1].lower()]) for match in _COLLECTIVE.finditer(clause)]
    counts = [
        int(value)
        for start, value in sorted(counts_by_start)
        if value in COUNTED and not any(measure.start <= start < measure.end for measure in measures)
    ]
    return min(counts[-1], MAX_PLURAL_HINTS) if counts else 1
