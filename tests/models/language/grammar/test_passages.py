import re
from dataclasses import replace

import numpy as np
import pytest

from models.language.grammar import wording as wording_module
from models.language.grammar.files import load_grammar
from models.language.grammar.labelled_text import ObjectFact
from models.language.grammar.passages import Passage, plural
from models.language.grammar.wording import Wording
from models.language.measures import COMPASS
from tests.models.language.grammar.passage_rules import problem_of

FACTS = [
    ObjectFact("lamp", "north", "black"),
    ObjectFact("road", "on-top", "gray"),
    ObjectFact("lamp", "south", "gray"),
    ObjectFact("tree", "north"),
    ObjectFact("fence", "near", "gray"),
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
        ("{a1} to the {o1} and, opposite it,{x12} {a2}", [0, 2]),
        ("{a1} to the {o13} and, opposite it,{x12} {a2}; there also {a3}", [0, 2, 3]),
        ("I lean on {ns12!}", None),
    ],
)
def test_a_passage_finds_the_facts_of_its_pattern(phrase, facts) -> None:
    passage = Passage(phrase)
    assert problem_of(passage) is None
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
        ("{a1} to the {o1}, {a2} and {a3} opposite{x123}", "is for two things"),
        ("{a1} and, opposite,{x12} {a2}", "needs a direction"),
        ("two {ns12}: {1:the} {c1} one {o1}, {2:another} {o2}", "no article"),
        ("{q1} and {a2} to the {o12}", "unknown slots"),
    ],
)
def test_what_is_wrong_with_a_passage_is_said(phrase, problem) -> None:
    assert problem in problem_of(Passage(phrase))


class Plain:
    """A generator of random numbers that leaves facts in their order, says them in plain words, and nothing besides."""

    permutation = staticmethod(np.arange)

    def random(self):
        return 0.99

    def integers(self, _high):
        return 0


@pytest.fixture
def wording_of(monkeypatch):
    """The training grammar with one passage in place of its own, which is told wherever it can be."""
    tables = load_grammar("train")
    monkeypatch.setattr(wording_module, "PASSAGE_SHARE", 1.0)

    def make(phrase):
        phrases = {**tables.phrases, "passages": [phrase]}
        monkeypatch.setattr(wording_module, "load_grammar", lambda _grammar: replace(tables, phrases=phrases))
        return Wording("train")

    return make


def test_mentions_know_what_they_stand_for_and_whether_the_colour_is_said(wording_of) -> None:
    wording = wording_of("Two {ns12}: {1:one} {c1} and {o1}, {2:the other} {o2}; {theb3} is {o3}.")
    spoken = wording.write(FACTS, Plain(), noise=False)
    assert spoken.text.startswith("Two lamps: one black and ")
    kinds = [(m.kind, m.facts, m.coloured) for m in spoken.mentions[:4]]
    assert kinds == [
        ("plural", (), False), ("stand-in", (0,), True), ("stand-in", (2,), False), ("noun", (3,), False)
    ]  # fmt: skip
    assert [spoken.text[m.start : m.end] for m in spoken.mentions][1:3] == ["one", "the other"]
    both = wording_of("two {c12} {ns12} to my {o12}").write([FACTS[0]] * 2, Plain(), noise=False)
    assert [(m.kind, m.facts, m.coloured) for m in both.mentions] == [("plural", (0, 1), True)]
    apart = [FACTS[0], ObjectFact("lamp", "north", "gray")]
    colours = wording_of("two {ns12}, {c1=} and {c2=}, to my {o12}").write(apart, Plain(), noise=False)
    assert [(m.kind, m.facts) for m in colours.mentions] == [("plural", ()), ("stand-in", (0,)), ("stand-in", (1,))]


def test_opposites_are_no_words_and_a_direction_with_an_ending_is_the_plain_word(wording_of) -> None:
    wording = wording_of("{a1} on the {o1}ern side and, opposite,{x12} {a2}")
    apart = [FACTS[0], ObjectFact("tree", "south")]
    texts = [wording.write(apart, np.random.default_rng(n), noise=False).text for n in range(20)]
    assert all(re.search(" on the (north|south)ern side and, opposite, (a|an|some) ", text) for text in texts)


@pytest.mark.parametrize("grammar", ["train", "val", "test"])
def test_every_passage_tells_facts_that_are_made_to_suit_it(grammar) -> None:
    drawn = [ObjectFact(f"thing {n}", COMPASS[n], None if n % 2 else "gray") for n in range(6)]
    passages = [Passage(phrase) for phrase in load_grammar(grammar).phrases["passages"]]
    for passage in passages:
        assert problem_of(passage) is None, passage.phrase
        facts = passage.suit(drawn[: passage.things], lambda: "black")
        assert passage.match(facts, range(len(facts))) == list(range(len(facts))), passage.phrase


def test_a_whole_description_tells_its_facts() -> None:
    wording, rng = Wording("train"), np.random.default_rng(0)
    drawn = [ObjectFact("lamp", wind) for wind in COMPASS]
    for _ in range(50):
        facts, spoken = wording.whole(drawn, rng)
        assert len(facts) >= 4
        assert sorted(n for m in spoken.mentions for n in m.facts) == list(range(len(facts)))


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
