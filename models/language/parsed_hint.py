"""What a reader noticed in a text: things, also those that only a plural or words such as "the other" name."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from torch import Tensor

from models.language.measures import COMPASS, Measure, measures_in, numbers_in

# Where the speaker is, seen from the thing: the eight winds, right at it, or not said.
RELATIONS: Final = (*COMPASS, "on-top", "near")
BEFORE = 40  # characters before a plural in which its number stands
MOST = 4  # hints that a plural is taken for
COUNTED: Final = range(2, 7)  # numbers that may count a plural; others are seldom told
_COLLECTIVES: Final = {"pair": 2, "couple": 2, "both": 2, "twin": 2, "either": 2, "trio": 3, "triple": 3}
_COLLECTIVE = re.compile(rf"\b({'|'.join(_COLLECTIVES)})\b", re.I)
_CLAUSE_END = re.compile(r"[.;:!?\n]")
_MEASURE = re.compile(
    r"\b(?:area|bit|bunch|clump|cluster|expanse|length|line|patch|piece|plot|row|section|stretch|strip)(?:e?s)?$", re.I
)
# What may stand between: a colour, say.
_OF = re.compile(r"\s+of(?:\s+(?!(?:a|an|and|at|but|by|in|is|of|on|or|the|to|with)\b)[\w-]+){0,3}\s+$", re.I)
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
    """One thing that a description names.

    Attributes:
        noun: the words for it.
        start, end: where they stand in the text.
        relation: [10] probability of each of RELATIONS: where the speaker is, seen from it.
        colour: [C + 1] probability of each of COLOURS; the last, that none is said.
        absent: probability that the text says there is none.
        measure: the distance that is said; None if none is.
    """

    noun: str
    start: int
    end: int
    relation: Tensor
    colour: Tensor
    absent: float
    measure: Measure | None = None

    def moved(self, characters: int) -> "ParsedHint":
        """Return the hint of a text that stands so far behind the begin of another."""
        measure = self.measure and replace(
            self.measure, start=self.measure.start + characters, end=self.measure.end + characters
        )
        return replace(self, start=self.start + characters, end=self.end + characters, measure=measure)

    @property
    def distance_m(self) -> float | None:
        """The distance that is said; None if none is."""
        return None if self.measure is None else self.measure.metres


def resolve(text: str, things: Sequence[ParsedHint], kinds: Sequence[str]) -> list[ParsedHint]:
    """Hints from what was noticed: stand-ins get their noun, plurals become as many hints as they count.

    Args:
        text: the description.
        things: in its order.
        kinds: of each, "noun", "plural" or "stand-in".

    Returns:
        In the text's order. A plural of which stand-ins tell is no hint; a stand-in without a noun before it neither.
    """
    counts = [_count(text, thing) if kind == "plural" else 1 for thing, kind in zip(things, kinds, strict=True)]
    things, again = _once_each(text, things, kinds)
    told = [0] * len(things)  # stand-ins of each plural
    nouns = [thing.noun for thing in things]
    for n, kind in enumerate(kinds):
        if kind == "stand-in":
            open_plurals = [m for m in range(n) if kinds[m] == "plural" and told[m] < max(2, counts[m])]
            before = open_plurals or [m for m in range(n) if kinds[m] == "noun"]
            nouns[n] = nouns[before[-1]] if before else ""
            if open_plurals:
                told[before[-1]] += 1
    found: list[ParsedHint] = []
    for n, thing in enumerate(things):
        copies = 0 if told[n] or not nouns[n] or n in again else counts[n]
        found += [replace(thing, noun=nouns[n])] * copies
    return found


def _once_each(text: str, things: Sequence[ParsedHint], kinds: Sequence[str]) -> tuple[list[ParsedHint], set[int]]:
    """What a thing is said to be where it is named again goes to where it was named first; and which name nothing new.

    "I see a gray house. The house is north of me", "a house is north of me. The house is gray", and "a patch of grass",
    of which the patch is no thing.
    """
    merged, again = list(things), set[int]()
    placed = [_says_where(text, thing) for thing in things]
    for n, thing in enumerate(things):
        follows = text[thing.end : things[n + 1].start] if n + 1 < len(things) else ""
        if _MEASURE.search(thing.noun) and _OF.match(follows):
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
    """Two mentions as one; None if both say a place or a colour, so that they may be two things."""
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
    """Whether the sentence that names a thing says where anything is."""
    begin = max((m.end() for m in SENTENCE_END.finditer(text, 0, thing.start)), default=0)
    end = SENTENCE_END.search(text, thing.end)
    return bool(_WHERE.search(text, begin, end.start() if end else len(text)))


def _count(text: str, thing: ParsedHint) -> int:
    """How many a plural names: the last number before it in its clause, else one hint's worth."""
    clause = _CLAUSE_END.split(text[max(0, thing.start - BEFORE) : thing.start])[-1]
    measures = measures_in(clause)
    said = [(number.start, number.value) for number in numbers_in(clause) if not number.is_vague]
    said += [(found.start(), _COLLECTIVES[found[1].lower()]) for found in _COLLECTIVE.finditer(clause)]
    counts = [
        int(value)
        for start, value in sorted(said)
        if value in COUNTED and not any(measure.start <= start < measure.end for measure in measures)
    ]
    return min(counts[-1], MOST) if counts else 1
