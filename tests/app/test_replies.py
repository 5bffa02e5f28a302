"""A person's words become choices of a question."""

import pytest

from app.replies import choose
from index.answering.answers import Choice, Question


def question(*values, is_open=False, texts=()):
    texts = texts or [value.capitalize() for value in values]
    choices = tuple(Choice(value, text) for value, text in zip(values, texts, strict=True))
    return Question("q", "?", (*choices, Choice("unknown", "I don't know")), is_open)


BENCH = question("yes", "no")
WAY = question("north", "east", "south", "west", "none")
COLOUR = question("red", "dark-green", "other", texts=("Red", "Dark green", "Another colour"))
STREET = question("Bulevardi", "Yrjönkatu", "5th Avenue", is_open=True, texts=("Bulevardi", "Yrjönkatu", "5th Avenue"))


@pytest.mark.parametrize(
    ("asked_question", "reply", "choice"),
    [
        (BENCH, "Yes!", "yes"),
        (BENCH, "yeah, a green one", "yes"),
        (BENCH, "nope", "no"),
        (BENCH, "No, there isn't one", "no"),
        (BENCH, "I don\u2019t see any", "no"),
        (BENCH, "I don't know", "unknown"),
        (BENCH, "no idea", "unknown"),
        (BENCH, "I'm not sure", "unknown"),
        (BENCH, "???", "unknown"),
        (BENCH, "the second one", "no"),
        (BENCH, "Kyllä", "yes"),
        (BENCH, "Nein, keine Bank", "no"),
        (BENCH, "En näe", "no"),
        (BENCH, "no, wait, yes", None),
        (BENCH, "purple", None),
        (question("yes", "no", texts=("Sí", "No")), "si", "yes"),
        (WAY, "to the north of me", "north"),
        (WAY, "north-east", None),
        (WAY, "not north", None),
        (WAY, "There is none", "none"),
        (WAY, "option 3", "south"),
        (COLOUR, "it is dark green", "dark-green"),
        (COLOUR, "something else", "other"),
        (COLOUR, "neither", "other"),
        (STREET, "on Bulevardi", "Bulevardi"),
        (STREET, "I think I'm on yrjonkatu", "Yrjönkatu"),
        (STREET, "the second one", "Yrjönkatu"),
        (STREET, "last one", "5th Avenue"),
        (STREET, "option 1", "Bulevardi"),
        (STREET, "the ninth one", "9th one"),
        (STREET, "en tiedä", "unknown"),
        (STREET, "on 5th avenue", "5th Avenue"),
        (STREET, "It's called Fredrikinkatu", "fredrikinkatu"),
        (STREET, "La Torrefazione", "la torrefazione"),
        (STREET, "2", "2"),
        (STREET, "nope", "unknown"),
        (STREET, "none of them", "unknown"),
        (STREET, "yes", None),
        (STREET, "no, not Bulevardi", None),
    ],
)
def test_reply(asked_question, reply, choice):
    assert choose(asked_question, reply) == choice
