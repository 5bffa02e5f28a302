import pytest
import torch

from models.language.noticed import Noticed, resolve

TEXT = "Two garages by the bridge, one gray and north, the other south. A tree is east and another west."


def things(text, words):
    found, at = [], 0
    for word in words:
        at = text.index(word, at)
        found.append(Noticed(word, at, at + len(word), torch.ones(10), torch.ones(16), 0.0, None))
    return found


@pytest.mark.parametrize(
    ("text", "words", "kinds", "nouns"),
    [
        (
            TEXT, ["garages", "bridge", "one", "the other", "tree", "another"],
            ["plural", "noun", "stand-in", "stand-in", "noun", "stand-in"],
            ["bridge", "garages", "garages", "tree", "tree"],
        ),
        ("Three gray poles are north.", ["poles"], ["plural"], ["poles"] * 3),
        ("There are bushes north. And two cars", ["bushes"], ["plural"], ["bushes"]),
        ("One is north of me, a lamp south.", ["One", "lamp"], ["stand-in", "noun"], ["lamp"]),
    ],
)  # fmt: skip
def test_hints_of_plurals_and_of_what_stands_for_them(text, words, kinds, nouns):
    found = resolve(text, things(text, words), kinds)
    assert [thing.noun for thing in found] == nouns


def test_a_stand_in_keeps_its_own_place():
    found = resolve(TEXT, things(TEXT, ["garages", "one"]), ["plural", "stand-in"])
    assert [(thing.noun, TEXT[thing.start : thing.end]) for thing in found] == [("garages", "one")]
