import numpy as np
import pytest

from models.language.paraphrase import Wording
from models.language.passages import Passage, plural
from models.language.said import Fact

FACTS = [
    Fact("lamp", "north", "black"),
    Fact("road", "on-top", "gray"),
    Fact("lamp", "south", "gray"),
    Fact("tree", "north"),
    Fact("fence", "near", "gray"),
]


@pytest.mark.parametrize(
    ("phrase", "facts"),
    [
        ("{a1} to the {o1}, {a2} to the {o2}", [0, 2]),
        ("to the {o12}: {a1} and {a2}", [0, 3]),
        ("two {ns12}: {1:one} to the {o1}, {2:the other} to the {o2}", [0, 2]),
        ("{the1!} under my feet and {a2} {o2} of me", [1, 0]),
        ("{a1~} beside me, {a2} {o2}", [4, 0]),
        ("{theb1} {o1} of me is {c1}, like {the2!}, both {c12}", [2, 1]),
        ("two {c12} {ns12} to my {o12}", None),
        ("{a1~} and {a2~}", None),
    ],
)
def test_a_passage_finds_the_facts_of_its_pattern(phrase, facts) -> None:
    passage = Passage(phrase)
    assert passage.problem() is None
    assert passage.match(FACTS, range(len(FACTS))) == facts


@pytest.mark.parametrize(
    ("phrase", "problem"),
    [
        ("{a1} to the {o1}", "two to six"),
        ("{a1} to the {o1}, {a3} to the {o3}", "without a gap"),
        ("{a1} to the {o1}, {a2} beside it", "needs a direction"),
        ("{a1!} to the {o1}, {a2} to the {o2}", "not both"),
        ("{a1} north, {a2} to the {o12}", "directions are slots"),
        ("two {ns12} to my {o1} and {o2}", "one direction"),
        ("two {ns12} to my {o12}, {1:one} {c1}", "or none"),
        ("{a1} and {1:that} to the {o12}, {a2}", "only where"),
        ("{q1} and {a2} to the {o12}", "unknown slots"),
    ],
)
def test_what_is_wrong_with_a_passage_is_said(phrase, problem) -> None:
    assert problem in Passage(phrase).problem()


def test_mentions_know_what_they_stand_for_and_whether_the_colour_is_said() -> None:
    wording = Wording("train")
    passage = Passage("Two {ns12}: {1:one} {c1} and {o1}, {2:the other} {o2}; {theb3} is {o3}.")
    said = wording._fill(passage, FACTS, [2, 0, 3], np.random.default_rng(0))
    kinds = [(m.kind, m.facts, m.coloured) for m in said.mentions]
    assert kinds == [
        ("plural", (), False), ("stand-in", (2,), True), ("stand-in", (0,), False), ("noun", (3,), False)
    ]  # fmt: skip
    assert [said.text[m.start : m.end] for m in said.mentions][1:3] == ["one", "the other"]
    both = wording._fill(Passage("two {c12} {ns12} to my {o12}"), [FACTS[0]] * 2, [0, 1], np.random.default_rng(0))
    assert [(m.kind, m.facts, m.coloured) for m in both.mentions] == [("plural", (0, 1), True)]
    colours = wording._fill(
        Passage("two {ns12}, {c1=} and {c2=}, to my {o12}"), FACTS, [0, 2], np.random.default_rng(0)
    )
    assert [(m.kind, m.facts) for m in colours.mentions] == [("plural", ()), ("stand-in", (0,)), ("stand-in", (2,))]


@pytest.mark.parametrize(
    ("noun", "plurals"),
    [
        ("lamp", "lamps"), ("bench", "benches"), ("grit box", "grit boxes"), ("library", "libraries"),
        ("railway", "railways"), ("set of lights at night", "sets of lights at night"), ("steps", "steps"),
        ("bus", "buses"), ("stretch of grass", "stretches of grass"),
    ],
)  # fmt: skip
def test_plurals(noun, plurals) -> None:
    assert plural(noun) == plurals
