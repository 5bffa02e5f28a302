"""What a reader noticed in a text: things, also those that only a plural or words such as "the other" name."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

from torch import Tensor

BEFORE = 40  # characters before a plural in which its number stands
MOST = 4  # hints that a plural is taken for
_NUMBERS: Final = {
    **dict.fromkeys(("two", "2", "pair", "couple", "both", "twin", "either"), 2),
    **dict.fromkeys(("three", "3", "trio", "triple"), 3),
    **dict.fromkeys(("four", "4", "five", "5", "six", "6"), MOST),
}
_NUMBER = re.compile(rf"\b({'|'.join(_NUMBERS)})\b", re.I)


@dataclass(frozen=True, slots=True, eq=False)
class Noticed:
    """One thing that a description names.

    Attributes:
        noun: the words for it.
        start, end: where they stand in the text.
        relation: [10] probability of each of RELATIONS: where the speaker is, seen from it.
        colour: [C + 1] probability of each of COLOURS; the last, that none is said.
        absent: probability that the text says there is none.
        distance_m: said distance, None if none is.
    """

    noun: str
    start: int
    end: int
    relation: Tensor
    colour: Tensor
    absent: float
    distance_m: float | None


def resolve(text: str, things: Sequence[Noticed], kinds: Sequence[str]) -> list[Noticed]:
    """Hints from what was noticed: stand-ins get their noun, plurals become as many hints as they count.

    Args:
        text: the description.
        things: in its order.
        kinds: of each, "noun", "plural" or "stand-in".

    Returns:
        In the text's order. A plural of which stand-ins tell is no hint; a stand-in without a noun before it neither.
    """
    counts = [_count(text, thing) if kind == "plural" else 1 for thing, kind in zip(things, kinds, strict=True)]
    told = [0] * len(things)  # stand-ins of each plural
    nouns = [thing.noun for thing in things]
    for n, kind in enumerate(kinds):
        if kind == "stand-in":
            open_plurals = [m for m in range(n) if kinds[m] == "plural" and told[m] < max(2, counts[m])]
            before = open_plurals or [m for m in range(n) if kinds[m] == "noun"]
            nouns[n] = nouns[before[-1]] if before else ""
            if open_plurals:
                told[before[-1]] += 1
    found: list[Noticed] = []
    for n, thing in enumerate(things):
        copies = 0 if told[n] or not nouns[n] else counts[n]
        found += [replace(thing, noun=nouns[n])] * copies
    return found


def _count(text: str, thing: Noticed) -> int:
    """How many a plural names: the last number before it in its clause, else one hint's worth."""
    before = re.split(r"[.;:!?\n]", text[max(0, thing.start - BEFORE) : thing.start])[-1]
    said = _NUMBER.findall(before)
    return _NUMBERS[said[-1].lower()] if said else 1
