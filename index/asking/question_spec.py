"""A question as its id says it, and in words."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Literal, cast, get_args

from index.answering.answers import Choice, Question
from models.language.lexicon.question_classes import load_question_classes
from models.posterior.nearby_objects import NEAR_M, QUARTERS

Kind = Literal["near", "way", "colour", "street", "name", "corner", "address"]
OPEN: Final[Mapping[Kind, str]] = {
    "street": "Which street are you on?",
    "name": "What is the name of a shop or another place that you see?",
    "corner": "Which street crosses the street you are on nearest to you?",
    "address": "What is the number of the house nearest to you, and its street?",
}
UNKNOWN: Final = "unknown"
OTHER: Final = "other"
LISTED: Final = 4  # colours to choose from, or names that are offered
_WORDS: Final = {
    "yes": "Yes", "no": "No", "none": "None is near", OTHER: "Another colour", UNKNOWN: "I don't know"
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Asked:
    """A question.

    Attributes:
        kind: whether a thing is near, which way the nearest is, its colour; or for which name is asked: of the street
            one is on, of a place that one sees, of the nearest street that crosses, of the nearest house.
        names: the class it is about, and for colours what there is to choose from; none where a name is asked for.
    """

    kind: Kind
    names: tuple[str, ...] = ()

    @classmethod
    def parse(cls, text: str) -> "Asked | None":
        """The question of an id; None if it is of none. Whether the map has what it names is not looked at."""
        kind, colon, rest = text.partition(":")
        if kind not in get_args(Kind) or bool(colon) == (kind in OPEN):
            return None
        names = tuple(rest.split("|")) if kind == "colour" else (rest,) if colon else ()
        is_whole = all(names) and len(set(names)) == len(names) and (kind != "colour" or 1 < len(names) <= LISTED + 1)
        return cls(cast("Kind", kind), names) if is_whole else None

    @property
    def is_open(self) -> bool:
        """Whether any name of the map can be answered."""
        return self.kind in OPEN

    @property
    def id(self) -> str:
        """As clients send it back."""
        return ":".join([self.kind, "|".join(self.names)] if self.names else [self.kind])

    @property
    def values(self) -> tuple[str, ...]:
        """[K] what can be answered, but for "unknown" and names."""
        if self.is_open:
            return ()
        if self.kind == "way":
            return (*QUARTERS, "none")
        return ("yes", "no") if self.kind == "near" else (*self.names[1:], OTHER)

    def question(self, listed: Sequence[str] = ()) -> Question:
        """In words.

        Args:
            listed: the names that an open question offers.
        """
        closed = tuple(Choice(value, _WORDS.get(value, value.capitalize())) for value in (*self.values, UNKNOWN))
        return Question(self.id, self._text(), (*(Choice(name, name) for name in listed), *closed), self.is_open)

    def _text(self) -> str:
        if self.is_open:
            return OPEN[self.kind]
        noun = load_question_classes().things[self.names[0]]
        if self.kind == "near":
            article = "an" if noun[0] in "aeio" else "a"
            return f"Is there {article} {noun} within about {NEAR_M:.0f} metres of you?"
        if self.kind == "way":
            return f"Where is the nearest {noun}, seen from you?"
        return f"What colour is the nearest {noun}?"
