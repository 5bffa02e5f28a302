"""Facts about a position, and texts labelled with them."""

from dataclasses import dataclass, replace
from typing import Literal

from models.language.measures import COMPASS


def opposite(wind: str) -> str:
    """Return the opposite compass direction."""
    return COMPASS[(COMPASS.index(wind) + 4) % 8]


@dataclass(frozen=True, slots=True)
class ObjectFact:
    """A fact to express."""

    label: str  # class of the thing, a key of the grammar's labels or any words
    relation: str = "near"  # one of RELATIONS
    colour: str | None = None  # a word; None to leave it out
    distance_m: float | None = None  # distance to state; None to leave it out
    absent: bool = False  # whether there is no such thing
    name: str | None = None  # proper name of the thing, used instead of label and colour

    @property
    def is_simple(self) -> bool:
        """Whether it is a thing with a relation and at most a colour."""
        return not self.absent and self.name is None and self.distance_m is None


@dataclass(frozen=True, slots=True)
class LabelledMention:
    """The place where a text names one or several things."""

    facts: tuple[int, ...]  # indices of its facts; none for a plural that stand-ins refer to
    start: int  # the characters of the noun, without article and colour
    end: int
    noun: str  # its words before typos
    # a noun, a plural that names several things, or words that stand for one of those ("the other")
    kind: Literal["noun", "plural", "stand-in"] = "noun"
    coloured: bool = False  # whether the text states its colour


@dataclass(frozen=True, slots=True)
class LabelledText:
    """A text with its mentions."""

    text: str
    mentions: tuple[LabelledMention, ...]  # in text order; every fact belongs to one

    def followed_by(self, other: "LabelledText", between: str) -> "LabelledText":
        """Return this text followed by another."""
        shift = len(self.text) + len(between)
        moved = tuple(replace(m, start=m.start + shift, end=m.end + shift) for m in other.mentions)
        return LabelledText(self.text + between + other.text, self.mentions + moved)
