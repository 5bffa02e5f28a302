from dataclasses import replace

import pytest
import torch

from models.language.measures import Measure
from models.language.parsed_hint import ParsedHint, resolve

TEXT = "Two garages by the bridge, one gray and north, the other south. A tree is east and another west."


def things(text, words):
    result, position = [], 0
    for word in words:
        position = text.index(word, position)
        result.append(ParsedHint(word, position, position + len(word), torch.ones(10), torch.ones(16), 0.0, None))
    return result


@pytest.mark.parametrize(
    ("text", "words", "kinds", "nouns"),
    [
        (
            TEXT, ["garages", "bridge", "one", "the other", "tree", "another"],
            ["plural", "noun", "stand-in", "stand-in", "noun", "stand-in"],
            ["bridge", "garages", "garages", "tree", "tree"],
        ),
        ("Three gray poles are north.", ["poles"], ["plural"], ["poles"] * 3),
        ("I am two metres from poles.", ["poles"], ["plural"], ["poles"]),
        ("A couple of metres ahead are poles.", ["poles"], ["plural"], ["poles"]),
        ("Two metres north are three poles.", ["poles"], ["plural"], ["poles"] * 3),
        ("Half a dozen poles are north.", ["poles"], ["plural"], ["poles"] * 4),
        ("There are bushes north. And two cars", ["bushes"], ["plural"], ["bushes"]),
        ("One is north of me, a lamp south.", ["One", "lamp"], ["stand-in", "noun"], ["lamp"]),
    ],
)  # fmt: skip
def test_hints_of_plurals_and_of_what_stands_for_them(text, words, kinds, nouns):
    result = resolve(text, things(text, words), kinds)
    assert [thing.noun for thing in result] == nouns


def test_a_stand_in_keeps_its_own_place():
    result = resolve(TEXT, things(TEXT, ["garages", "one"]), ["plural", "stand-in"])
    assert [(thing.noun, TEXT[thing.start : thing.end]) for thing in result] == [("garages", "one")]


NONE, GRAY, GREEN = torch.eye(16)[[15, 1, 5]]
NORTH, EAST, NEAR = torch.eye(10)[[0, 2, 9]]


@pytest.mark.parametrize(
    ("text", "phrase", "hints"),
    [
        ("I see a house and a lamp. The house is north of me.",  # first what there is, then where
         [("house", EAST, GRAY), ("lamp", EAST, NONE), ("house", NORTH, NONE)],
         [("house", NORTH, GRAY), ("lamp", EAST, NONE)]),
        ("A house is north of me. I like it. The house is gray.",  # first where, then of what colour
         [("house", NORTH, NONE), ("house", NEAR, GRAY)],
         [("house", NORTH, GRAY)]),
        ("A small pole is north of me. That's it. The pole's gray.",
         [("small pole", NORTH, NONE), ("pole", NEAR, GRAY)],
         [("small pole", NORTH, GRAY)]),
        ("The road is north of me. The road is east of me.",  # two roads
         [("road", NORTH, NONE), ("road", EAST, NONE)],
         [("road", NORTH, NONE), ("road", EAST, NONE)]),
        ("A house is north of me. A house is gray.",  # of which the second need not be the first
         [("house", NORTH, NONE), ("house", NEAR, GRAY)],
         [("house", NORTH, NONE), ("house", NEAR, GRAY)]),
        ("I see a gray house. The green house is north. The house is green.",
         [("house", NEAR, GRAY), ("house", NORTH, GREEN), ("house", NEAR, GREEN)],
         [("house", NEAR, GRAY), ("house", NORTH, GREEN), ("house", NEAR, GREEN)]),
        ("I see a house. The house is north of me. The house is east of me.",  # the third is another one
         [("house", NEAR, NONE), ("house", NORTH, NONE), ("house", EAST, NONE)],
         [("house", NORTH, NONE), ("house", EAST, NONE)]),
        ("The house is gray. North of me there is a lamp. I am at the house.",
         [("house", EAST, GRAY), ("lamp", NORTH, NONE), ("house", NEAR, NONE)],
         [("house", NEAR, GRAY), ("lamp", NORTH, NONE)]),
        ("I see an intersection of gray roads", [("intersection", NEAR, NONE), ("roads", NEAR, GRAY)],
         [("intersection", NEAR, NONE), ("roads", NEAR, GRAY)]),
        ("a patch of dark green grass, a line of sight and a block of flats north",
         [("patch", NEAR, NONE), ("grass", NORTH, GREEN), ("line", NEAR, NONE), ("block of flats", NORTH, NONE)],
         [("grass", NORTH, GREEN), ("line", NEAR, NONE), ("block of flats", NORTH, NONE)]),
    ],
)  # fmt: skip
def test_what_is_named_again_is_one_thing(text, phrase, hints):
    result, position = [], 0
    for noun, relation, colour in phrase:
        position = text.index(noun, position)
        result.append(ParsedHint(noun, position, position + len(noun), relation, colour, 0.0, None))
        position += len(noun)
    merged = resolve(text, result, ["noun"] * len(result))
    assert [(t.noun, int(t.relation.argmax()), int(t.colour.argmax())) for t in merged] == [
        (noun, int(relation.argmax()), int(colour.argmax())) for noun, relation, colour in hints
    ]


def test_what_is_measured_by_the_patch_keeps_its_distance():
    text = "10 m north of me is a patch of green grass"
    result = things(text, ["patch", "grass"])
    remaining = resolve(text, [replace(result[0], measure=Measure(0, 4, 10.0)), result[1]], ["noun", "noun"])
    assert [(thing.noun, thing.distance_m) for thing in remaining] == [("grass", 10.0)]
