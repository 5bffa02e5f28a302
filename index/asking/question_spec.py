"""Questions by their ids, and their texts."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Literal, cast, get_args

from index.answering.answers import Choice, Question
from models.language.languages.translation import nearest_noun, noun_with_article, translatable, translate
from models.language.lexicon.question_classes import load_question_classes
from models.posterior.nearby_objects import NEAR_M, QUARTERS

QuestionKind = Literal["near", "way", "colour", "street", "name", "corner", "address"]
OPEN_QUESTIONS: Final[Mapping[QuestionKind, str]] = {
    "street": translatable("Which street are you on?"),
    "name": translatable("What is the name of a shop or another place that you can see?"),
    "corner": translatable("What is the nearest cross street?"),
    "address": translatable("What is the number and street of the house nearest to you?"),
}
UNKNOWN: Final = "unknown"
OTHER: Final = "other"
MAX_CHOICES: Final = 4  # colours or names that a question offers
_CHOICE_TEXTS: Final = {
    "yes": translatable("Yes"),
    "no": translatable("No"),
    "none": translatable("There is none nearby"),
    OTHER: translatable("Another colour"),
    UNKNOWN: translatable("I don't know"),
}


@dataclass(frozen=True, slots=True)
class QuestionSpec:
    """A question: its kind and the names it is about."""

    # Near, way and colour ask whether an object is near, where the nearest lies, and its colour; the other kinds ask
    # for the name of a street, a visible place, a cross street or a house.
    kind: QuestionKind
    names: tuple[str, ...] = ()  # the class, followed by the offered colours; empty for open questions

    @classmethod
    def parse(cls, text: str) -> "QuestionSpec | None":
        """Parse an id; None if it is invalid. Names are not looked up on the map."""
        kind, colon, rest = text.partition(":")
        if kind not in get_args(QuestionKind) or bool(colon) == (kind in OPEN_QUESTIONS):
            return None
        names = tuple(rest.split("|")) if kind == "colour" else (rest,) if colon else ()
        is_valid = (
            all(names) and len(set(names)) == len(names) and (kind != "colour" or 1 < len(names) <= MAX_CHOICES + 1)
        )
        return cls(cast("QuestionKind", kind), names) if is_valid else None

    @property
    def is_open(self) -> bool:
        """Return whether any name of the map is a valid reply."""
        return self.kind in OPEN_QUESTIONS

    @property
    def id(self) -> str:
        """Return the id that clients send back."""
        return ":".join([self.kind, "|".join(self.names)] if self.names else [self.kind])

    @property
    def values(self) -> tuple[str, ...]:
        """Return the valid replies [K], without "unknown" and names."""
        if self.is_open:
            return ()
        if self.kind == "way":
            return (*QUARTERS, "none")
        return ("yes", "no") if self.kind == "near" else (*self.names[1:], OTHER)

    def question(self, listed: Sequence[str] = ()) -> Question:
        """Return the question with its text and choices; an open question offers the `listed` names."""
        closed = tuple(Choice(value, choice_text(value)) for value in (*self.values, UNKNOWN))
        return Question(self.id, self._text(), (*(Choice(name, name) for name in listed), *closed), self.is_open)

    def _text(self) -> str:
        if self.is_open:
            return translate(OPEN_QUESTIONS[self.kind])
        noun = load_question_classes().things[self.names[0]]
        if self.kind == "near":
            one = noun_with_article(noun)
            return translate("Is there {noun} within about {metres:.0f} metres of you?", noun=one, metres=NEAR_M)
        if self.kind == "way":
            return translate("In which direction is {noun}?", noun=nearest_noun(noun))
        return translate("What colour is {noun}?", noun=nearest_noun(noun))


def choice_text(value: str) -> str:
    """Return the text of a choice of a closed question in the language of the reply."""
    return translate(_CHOICE_TEXTS.get(value, value.capitalize()))
