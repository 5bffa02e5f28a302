"""Facts about a position, and texts that are known to tell them."""

from dataclasses import dataclass, replace
from typing import Literal

from models.language.measures import COMPASS


def opposite(wind: str) -> str:
    """The other end of the compass."""
    return COMPASS[(COMPASS.index(wind) + 4) % 8]


@dataclass(frozen=True, slots=True)
class Fact:
    """One thing to say.

    Attributes:
        label: class of the thing, a key of the grammar's labels or any words.
        relation: one of RELATIONS.
        colour: word, None if it is not said.
        distance_m: said distance, None if it is not.
        absent: that there is none of it.
        name: proper name of the thing, said instead of label and colour.
    """

    label: str
    relation: str = "near"
    colour: str | None = None
    distance_m: float | None = None
    absent: bool = False
    name: str | None = None

    @property
    def is_simple(self) -> bool:
        """Whether it is no more than a thing that is somewhere."""
        return not self.absent and self.name is None and self.distance_m is None


@dataclass(frozen=True, slots=True)
class Mention:
    """Where a text names a thing, or several at once.

    Attributes:
        facts: numbers of the facts that are told of it; none for a plural of which stand-ins then tell.
        start, end: the characters of the noun, without article and colour.
        noun: what stands there, before typos.
        kind: a noun, a plural that names several things, or words that stand for one of those ("the other").
        coloured: whether its colour is said.
    """

    facts: tuple[int, ...]
    start: int
    end: int
    noun: str
    kind: Literal["noun", "plural", "stand-in"] = "noun"
    coloured: bool = False


@dataclass(frozen=True, slots=True)
class LabelledText:
    """A text, and what of it means what.

    Attributes:
        text: English.
        mentions: in order of the text; every fact is one's.
    """

    text: str
    mentions: tuple[Mention, ...]

    def then(self, other: "LabelledText", between: str) -> "LabelledText":
        """Both, one after the other."""
        shift = len(self.text) + len(between)
        moved = tuple(replace(m, start=m.start + shift, end=m.end + shift) for m in other.mentions)
        return LabelledText(self.text + between + other.text, self.mentions + moved)
