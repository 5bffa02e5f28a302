import pytest

from index.asked import LISTED, OTHER, UNKNOWN, Asked
from models.language.lexicon.asked import load_asked
from models.language.lexicon.lexicon import load_lexicon

ALL = [
    Asked("near", ("tree",)),
    Asked("way", ("street lamp",)),
    Asked("colour", ("building", "red", "gray")),
    Asked("street", ("Unioninkatu", "Liisankatu", "A: B")),
    Asked("name", ("Stockmann | Argos: 2",)),
]


@pytest.mark.parametrize("asked", ALL)
def test_an_id_says_all(asked):
    assert Asked.parse(asked.id) == asked


@pytest.mark.parametrize(
    "wrong",
    ["", "near", "near:", "far:tree", "street:", "street:A|A", "street:A|", "colour:building", "street:A|B|C|D|E"],
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
        "Is the street you are on Unioninkatu, Liisankatu or A: B?",
        "Do you see Stockmann | Argos: 2?",
    ]


@pytest.mark.parametrize("asked", ALL)
def test_choices_are_the_values_and_unknown(asked):
    question = asked.question()
    assert question.id == asked.id
    assert [choice.value for choice in question.choices] == [*asked.values, UNKNOWN]
    assert len({choice.text for choice in question.choices}) == len(question.choices)
    assert (OTHER in asked.values) == (asked.kind in {"street", "colour"})


def test_only_classes_of_maps_are_asked_about():
    assert set(load_asked().things) <= set(load_lexicon().labels) - load_lexicon().elsewhere
