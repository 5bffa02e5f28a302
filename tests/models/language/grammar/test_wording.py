import itertools
import re

import numpy as np
import pytest

from models.language.grammar.files import load_grammar
from models.language.grammar.labelled_text import RELATIONS, WINDS, Fact, opposite
from models.language.grammar.passages import Passage
from models.language.grammar.typos import typos
from models.language.grammar.wording import Wording

GRAMMARS = ("train", "val", "test")
FACTS = [
    Fact("trash bin", "north", "bright-gray"),
    Fact("road", "on-top", "gray"),
    Fact("stop", "east"),
    Fact("lamp", "north", "black"),
    Fact("bench", "southwest", None, 12.0),
    Fact("vegetation", "near", "dark-green"),
    Fact("bridge", absent=True),
    Fact("building", "west", name="Stockmann"),
]


@pytest.mark.parametrize("grammar", GRAMMARS)
def test_every_fact_is_mentioned_once_and_where_it_says(grammar) -> None:
    wording = Wording(grammar)
    for seed in range(40):
        said = wording.write(FACTS, np.random.default_rng(seed), noise=seed % 2 == 0)
        assert sorted(n for m in said.mentions for n in m.facts) == list(range(len(FACTS)))
        for mention in said.mentions:
            assert 0 <= mention.start < mention.end <= len(said.text)
            if seed % 2:
                assert said.text[mention.start : mention.end].lower() == mention.noun.lower()
        assert "{" not in said.text


@pytest.mark.parametrize("grammar", GRAMMARS)
def test_the_distance_and_the_name_are_said(grammar) -> None:
    said = Wording(grammar).write(FACTS, np.random.default_rng(1), noise=False)
    assert "12" in said.text
    assert "Stockmann" in said.text


@pytest.mark.parametrize("grammar", GRAMMARS)
def test_phrases_have_only_known_slots_and_no_direction_of_their_own(grammar) -> None:
    tables = load_grammar(grammar)
    assert not [(p, problem) for p in tables["passages"]["phrases"] if (problem := Passage(p).problem())]
    for table in tables.keys() - {"passages"}:
        for phrase in tables[table].get("phrases", ()):
            slots = set(re.findall(r"\{([a-zA-Z]+)\d?\}", phrase))
            assert slots <= {"d", "o", "a", "A", "the", "The", "n", "b", "theb", "c", "dist", "name", "m"}, phrase
            assert not re.search(r"\b(north|south|east|west)", phrase.lower()), (table, phrase)


@pytest.mark.parametrize("grammar", GRAMMARS)
def test_each_kind_says_what_it_is_for(grammar) -> None:
    directed = {
        **dict.fromkeys(("one", "pronoun", "colour_apart", "far_one", "named", "bare", "two_same"), ("",)),
        **dict.fromkeys(("two", "two_bare", "two_loose"), ("1", "2")),
        "three": ("1", "2", "3"), "one_near": ("1",), "one_on_top": ("1",),
        **dict.fromkeys(("near", "on_top", "absent", "named_near", "two_near"), ()),
    }  # fmt: skip
    for table, numbers in directed.items():
        for phrase in load_grammar(grammar).get(table, {}).get("phrases", ()):
            said = {number if table != "two_same" else "" for number in re.findall(r"\{[do](\d?)\}", phrase)}
            assert said == set(numbers), (table, phrase)


def test_validation_and_test_share_nothing_with_training() -> None:
    tables = {grammar: load_grammar(grammar) for grammar in GRAMMARS}
    for one, other in itertools.combinations(GRAMMARS, 2):
        for name in tables[other]:
            if name in ("compass", "distance"):
                continue
            ours, theirs = (tables[g][name] for g in (one, other))
            if "phrases" in theirs:
                assert not set(ours["phrases"]) & set(theirs["phrases"]), name
            else:
                plain = [{w.lower().replace("-", " ") for words in t.values() for w in words} for t in (ours, theirs)]
                assert not plain[0] & plain[1], name


def test_all_grammars_can_say_all_directions_and_kitti_classes() -> None:
    classes = set(Wording("train").labels)
    assert len(classes) > 100
    for grammar in GRAMMARS:
        wording = Wording(grammar)
        assert set(wording.compass) == set(WINDS)
        for relation in RELATIONS:
            assert wording.write([Fact("pole", relation, "gray")], np.random.default_rng(0)).text


def test_the_published_wording_is_the_benchmarks() -> None:
    said = Wording("train").published([Fact("pole", "north", "gray"), Fact("stop", "on-top")])
    assert said.text == "The pose is north of a gray pole. The pose is on-top of a stop."
    assert [said.text[m.start : m.end] for m in said.mentions] == ["pole", "stop"]


def test_typos_move_the_mentions_along() -> None:
    said = Wording("val").write(FACTS, np.random.default_rng(3), noise=False)
    spoiled = typos(said, 12, np.random.default_rng(4))
    assert spoiled.text != said.text
    for before, after in zip(said.mentions, spoiled.mentions, strict=True):
        noun, found = said.text[before.start : before.end], spoiled.text[after.start : after.end]
        assert abs(len(noun) - len(found)) <= 12
        assert set(found) & set(noun)


def test_opposites() -> None:
    assert opposite("north") == "south"
    assert opposite("southwest") == "northeast"
