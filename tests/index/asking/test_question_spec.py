import pytest

from index.asking.question_spec import LISTED, OPEN, OTHER, UNKNOWN, Asked
from models.language.lexicon.lexicon import load_lexicon
from models.language.lexicon.question_classes import load_question_classes

ALL = [
    Asked("near", ("tree",)),
    Asked("way", ("street lamp",)),
    Asked("colour", ("building", "red", "gray")),
    Asked("street"),
    Asked("name"),
    Asked("corner"),
    Asked("address"),
]


@pytest.mark.parametrize("asked", ALL)
def test_an_id_says_all(asked):
    assert Asked.parse(asked.id) == asked


@pytest.mark.parametrize(
    "wrong",
    [
        *("", "near", "near:", "far:tree", "street:", "street:A", "name:Stockmann", "corner:A|B", "address:1 A"),
        *("colour:building", "colour:building|", "colour:building|red|red", "colour:building|a|b|c|d|e"),
    ],
)
def test_what_is_no_id(wrong):
    assert LISTED == 4
    assert Asked.parse(wrong) is None


def test_questions_in_words():
    texts = [asked.question().text for asked in ALL]
    assert texts == [
        "Is there a tree within about 10 metres of you?",
        "Where is the nearest street lamp, seen from you?",
        "What colour is the nearest building?",
        "Which street are you on?",
        "What is the name of a shop or another place that you see?",
        "Which street crosses the street you are on nearest to you?",
        "What is the number of the house nearest to you, and its street?",
    ]


@pytest.mark.parametrize("asked", ALL)
def test_choices_are_the_values_and_unknown(asked):
    question = asked.question()
    assert question.id == asked.id
    assert [choice.value for choice in question.choices] == [*asked.values, UNKNOWN]
    assert len({choice.text for choice in question.choices}) == len(question.choices)
    assert (OTHER in asked.values) == (asked.kind == "colour")
    assert question.is_open == (asked.kind in OPEN)


def test_an_open_question_offers_names():
    question = Asked("street").question(["Unioninkatu", "A: B | C"])
    assert [(choice.value, choice.text) for choice in question.choices] == [
        ("Unioninkatu", "Unioninkatu"),
        ("A: B | C", "A: B | C"),
        (UNKNOWN, "I don't know"),
    ]
    assert question.id == "street"


def test_only_classes_of_maps_are_asked_about():
    assert set(load_question_classes().things) <= set(load_lexicon().labels) - load_lexicon().elsewhere
