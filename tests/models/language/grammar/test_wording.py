import itertools
import re
import tomllib
from dataclasses import replace

import numpy as np
import pytest

from models.language.grammar.files import GRAMMARS as FOLDER
from models.language.grammar.files import gist, load_grammar
from models.language.grammar.labelled_text import ObjectFact, opposite
from models.language.grammar.passages import Passage
from models.language.grammar.typos import typos
from models.language.grammar.wording import Wording
from models.language.measures import COMPASS
from models.language.parsed_hint import RELATIONS
from tests.models.language.grammar.passage_rules import problem_of

GRAMMARS = ("train", "val", "test")
FACTS = [
    ObjectFact("trash bin", "north", "bright-gray"),
    ObjectFact("road", "on-top", "gray"),
    ObjectFact("stop", "east"),
    ObjectFact("lamp", "north", "black"),
    ObjectFact("bench", "southwest", None, 12.0),
    ObjectFact("vegetation", "near", "dark-green"),
    ObjectFact("bridge", absent=True),
    ObjectFact("building", "west", name="Stockmann"),
]


@pytest.mark.parametrize("grammar", GRAMMARS)
def test_every_fact_is_mentioned_once_and_where_it_says(grammar) -> None:
    wording = Wording(grammar)
    for seed in range(40):
        spoken = wording.write(FACTS, np.random.default_rng(seed), noise=seed % 2 == 0)
        assert sorted(n for m in spoken.mentions for n in m.facts) == list(range(len(FACTS)))
        for mention in spoken.mentions:
            assert 0 <= mention.start < mention.end <= len(spoken.text)
            if seed % 2:
                assert spoken.text[mention.start : mention.end].lower() == mention.noun.lower()
        assert "{" not in spoken.text


@pytest.mark.parametrize("grammar", GRAMMARS)
def test_the_distance_and_the_name_are_said(grammar) -> None:
    spoken = Wording(grammar).write(FACTS, np.random.default_rng(1), noise=False)
    assert "12" in spoken.text
    assert "Stockmann" in spoken.text


@pytest.mark.parametrize("grammar", GRAMMARS)
def test_phrases_have_only_known_slots_and_no_direction_of_their_own(grammar) -> None:
    phrases = load_grammar(grammar).phrases
    assert not [(p, problem) for p in phrases["passages"] if (problem := problem_of(Passage(p)))]
    for table in phrases.keys() - {"passages"}:
        for phrase in phrases[table]:
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
        for phrase in load_grammar(grammar).phrases.get(table, ()):
            spoken = {number if table != "two_same" else "" for number in re.findall(r"\{[do](\d?)\}", phrase)}
            assert spoken == set(numbers), (table, phrase)


def test_validation_and_test_share_nothing_with_training() -> None:
    tables = {grammar: load_grammar(grammar) for grammar in GRAMMARS}
    for one, other in itertools.combinations(tables.values(), 2):
        for kind in other.phrases.keys() - {"distance"}:
            assert not {*map(gist, one.phrases[kind])} & {*map(gist, other.phrases[kind])}, kind
        for names in ((one.labels, other.labels), (one.colours, other.colours)):
            plain = [{w.lower().replace("-", " ") for words in t.values() for w in words} for t in names]
            assert not plain[0] & plain[1]


@pytest.mark.parametrize("grammar", GRAMMARS)
def test_no_phrase_or_name_stands_twice(grammar) -> None:
    tables = load_grammar(grammar)
    for kind, phrases in tables.phrases.items():
        assert len({*map(gist, phrases)}) == len(phrases), kind
    for names in (tables.labels, tables.colours, tables.compass):
        assert [key for key, words in names.items() if len({*words}) < len(words)] == []


@pytest.mark.parametrize("grammar", GRAMMARS)
def test_each_kind_of_phrase_has_one_file(grammar) -> None:
    files = [tomllib.loads(file.read_text()) for file in (FOLDER / grammar).glob("*.toml")]
    kinds = [kind for file in files for kind in file]
    assert len(set(kinds)) == len(kinds)


def test_the_hash_is_of_the_phrases_alone() -> None:
    tables = load_grammar("val")
    backwards = {kind: phrases[::-1] for kind, phrases in reversed(tables.phrases.items())}
    assert replace(tables, phrases=backwards, labels={}).sha256 == tables.sha256
    for kind in tables.phrases:
        assert replace(tables, phrases={**tables.phrases, kind: tables.phrases[kind][1:]}).sha256 != tables.sha256


def test_all_grammars_can_say_all_directions_and_kitti_classes() -> None:
    classes = set(Wording("train").labels)
    assert len(classes) > 100
    for grammar in GRAMMARS:
        wording = Wording(grammar)
        assert set(wording.compass) == set(COMPASS)
        for relation in RELATIONS:
            assert wording.write([ObjectFact("pole", relation, "gray")], np.random.default_rng(0)).text


def test_the_published_wording_is_the_benchmarks() -> None:
    spoken = Wording("train").published([ObjectFact("pole", "north", "gray"), ObjectFact("stop", "on-top")])
    assert spoken.text == "The pose is north of a gray pole. The pose is on-top of a stop."
    assert [spoken.text[m.start : m.end] for m in spoken.mentions] == ["pole", "stop"]


def test_typos_move_the_mentions_along() -> None:
    spoken = Wording("val").write(FACTS, np.random.default_rng(3), noise=False)
    spoiled = typos(spoken, 12, np.random.default_rng(4))
    assert spoiled.text != spoken.text
    for before, after in zip(spoken.mentions, spoiled.mentions, strict=True):
        noun, result = spoken.text[before.start : before.end], spoiled.text[after.start : after.end]
        assert abs(len(noun) - len(result)) <= 12
        assert set(result) & set(noun)


def test_opposites() -> None:
    assert opposite("north") == "south"
    assert opposite("southwest") == "northeast"
