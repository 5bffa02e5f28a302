"""A question as its id says it, and in words."""

from dataclasses import dataclass
from typing import Final, Literal, cast, get_args

from index.answers import Choice, Question
from models.language.lexicon.asked import load_asked
from models.posterior.sights import NEAR_M, QUARTERS

Kind = Literal["near", "way", "colour", "street", "name"]
UNKNOWN: Final = "unknown"
OTHER: Final = "other"
LISTED: Final = 4  # streets or colours to choose from
_WORDS: Final = {"yes": "Yes", "no": "No", "none": "None is near", UNKNOWN: "I don't know"}


@dataclass(frozen=True, slots=True)
class Asked:
    """A question.

    Attributes:
        kind: whether a thing is near, which way the nearest is, its colour, the street one is on, or a place's name.
        names: the class or place it is about, and for colours what there is to choose from; of streets these alone.
    """

    kind: Kind
    names: tuple[str, ...]

    @classmethod
    def parse(cls, text: str) -> "Asked | None":
        """The question of an id; None if it is of none. Whether the map has what it names is not looked at."""
        kind, _, rest = text.partition(":")
        if kind not in get_args(Kind):
            return None
        names = tuple(rest.split("|")) if kind in {"street", "colour"} else (rest,)
        listed = len(names) - (kind == "colour")
        is_whole = all(names) and len(set(names)) == len(names) and listed + (kind in {"near", "way", "name"}) >= 1
        return cls(cast("Kind", kind), names) if is_whole and listed <= LISTED else None

    @property
    def id(self) -> str:
        """As clients send it back."""
        return f"{self.kind}:{'|'.join(self.names)}"

    @property
    def values(self) -> tuple[str, ...]:
        """[K] what can be answered, but for "unknown"."""
        if self.kind == "way":
            return (*QUARTERS, "none")
        if self.kind in {"near", "name"}:
            return ("yes", "no")
        return (*(self.names if self.kind == "street" else self.names[1:]), OTHER)

    def question(self) -> Question:
        """In words."""
        choices = tuple(Choice(value, self._choice(value)) for value in (*self.values, UNKNOWN))
        return Question(self.id, self._text(), choices)

    def _choice(self, value: str) -> str:
        if value == OTHER:
            return f"Another {self.kind}"
        return value if self.kind == "street" and value in self.names else _WORDS.get(value, value.capitalize())

    def _text(self) -> str:
        if self.kind == "street":
            *others, last = self.names
            return f"Is the street you are on {', '.join(others)} or {last}?"
        if self.kind == "name":
            return f"Do you see {self.names[0]}?"
        noun = load_asked().things[self.names[0]]
        if self.kind == "near":
            article = "an" if noun[0] in "aeio" else "a"
            return f"Is there {article} {noun} within about {NEAR_M:.0f} metres of you?"
        if self.kind == "way":
            return f"Where is the nearest {noun}, seen from you?"
        return f"What colour is the nearest {noun}?"
