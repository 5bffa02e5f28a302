"""Facts about a position, and texts labelled with them."""

from dataclasses import dataclass, replace
from typing import Literal

from models.language.measures import COMPASS


def opposite(wind: str) -> str:
    """Return the opposite compass direction."""
    return COMPASS[(COMPASS.index(wind) + 4) % 8]


@dataclass(frozen=True, slots=True)
class Fact:
    """A fact to express.

    Attributes:
        label: class of the thing, a key of the grammar's labels or any words.
        relation: one of RELATIONS.
        colour: a word; None to leave it out.
        distance_m: distance to state; None to leave it out.
        absent: whether there is no such thing.
        name: proper name of the thing, used instead of label and colour.
    """

    label: str
    relation: str = "near"
    colour: str | None = None
    distance_m: float | None = None
    absent: bool = False
    name: str | None = None

    @property
    def is_simple(self) -> bool:
        """Whether it is a thing with a relation and at most a colour."""
        return not self.absent and self.name is None and self.distance_m is None


@dataclass(frozen=True, slots=True)
class LabelledMention:
    """The place where a text names one or several things.

    Attributes:
        facts: indices of its facts; none for a plural that stand-ins refer to.
        start, end: the characters of the noun, without article and colour.
        noun: its words before typos.
        kind: a noun, a plural that names several things, or words that stand for one of those ("the other").
        coloured: whether the text states its colour.
    """

    facts: tuple[int, ...]
    start: int
    end: int
    noun: str
    kind: Literal["noun", "plural", "stand-in"] = "noun"
    coloured: bool = False


@dataclass(frozen=True, slots=True)
class LabelledText:
    """A text with its mentions.

    Attributes:
        text: English.
        mentions: in text order; every fact belongs to one.
    """

    text: str
    mentions: tuple[LabelledMention, ...]

    def followed_by(self, other: "LabelledText", between: str) -> "LabelledText":
        """Return this text followed by another."""
        shift = len(self.text) + len(between)
        moved = tuple(replace(m, start=m.start + shift, end=m.end + shift) for m in other.mentions)
        return LabelledText(self.text + between + other.text, self.mentions + moved)
