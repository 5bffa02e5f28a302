import pytest
import torch
from torch import nn

from models.citymap.colours import BASIC_PALETTE, KITTI360_PALETTE
from models.language.grammar.labelled_text import ObjectFact
from models.language.grammar.wording import Wording
from models.language.measures import Measure
from models.language.parsed_hint import RELATIONS, ParsedHint
from models.language.reader import (
    COLOURS,
    TAGS,
    Reader,
    ReaderConfig,
)
from models.posterior.binding import Binding, colour_table
from models.posterior.model import load_posterior
from models.posterior.node_batch import colour_words
from models.training.engine.loop import LoopConfig, run_training
from models.training.posterior.fit_reader import ReadingSet, ReadingTask, draw_facts, example_targets, reading_metrics

KITTI = ("building", "lamp", "pole", "road", "stop", "terrain", "trash bin", "vegetation")


@pytest.fixture
def reader(text_encoder):
    torch.manual_seed(0)
    return Reader(text_encoder, ReaderConfig(width=32)).eval()


@pytest.fixture(scope="module")
def trained():
    return load_posterior()


@pytest.fixture(scope="module")
def matcher(trained):
    return trained.matcher


class Tagging(nn.Module):
    """Tags the tokens of a text as it was told."""

    def __init__(self, tags):
        super().__init__()
        self.logits = nn.functional.one_hot(torch.tensor([tags]), len(TAGS)).float()

    def forward(self, features):
        assert features.shape[:2] == self.logits.shape[:2]
        return self.logits


def test_padding_and_company_change_nothing(reader):
    texts = ["A bench.", "I am north of a gray pole, and far to the west of me there is a long red fence, I think."]
    alone = [reader.read([text])[0] for text in texts]
    for one, other in zip(alone, reader.read(texts), strict=True):
        assert [(n.start, n.end) for n in one] == [(n.start, n.end) for n in other]
        for a, b in zip(one, other, strict=True):
            assert torch.allclose(a.relation, b.relation, atol=1e-5)


def test_targets_mark_the_tokens_of_the_noun(text_encoder):
    phrase = Wording("train").published([ObjectFact("vending machine", "north", "gray"), ObjectFact("lamp", "east")])
    tokens, characters = text_encoder.read([phrase.text], 1)
    tags, ranges = example_targets(phrase.mentions, characters[0], tokens.mask[0])
    for mention, (a, b) in zip(phrase.mentions, ranges, strict=True):
        start, end = int(characters[0, a, 0]), int(characters[0, b - 1, 1])
        assert phrase.text[start:end] == mention.noun
        assert [TAGS[tag] for tag in tags[a:b]] == ["noun"] + ["further"] * (b - a - 1)
    assert int((tags > 0).sum()) == sum(b - a for a, b in ranges)


@pytest.mark.parametrize(
    ("text", "tags", "nouns"),
    [
        ("a patch of ground north", [0, 0, 2, 1, 2, 0, 0], ["patch of ground"]),
        ("a house with shrubs", [0, 0, 2, 1, 2, 0], ["house", "shrubs"]),
        ("a road sign", [0, 0, 2, 2, 0], ["road", "sign"]),
        ("one lamp , another", [0, 0, 2, 0, 4, 0], ["lamp", "another"]),
    ],
)
def test_nouns_are_whole_and_end_where_they_end(reader, text, tags, nouns):
    reader.tag = Tagging(tags)
    assert [text[hint.start : hint.end] for hint in reader.read([text])[0]] == nouns


@pytest.mark.slow
def test_a_small_reader_learns_the_benchmarks_sentences(text_encoder):
    torch.manual_seed(0)
    texts = ReadingSet(text_encoder, 5, "train", 32, 0)
    shape = ReaderConfig(frozen_layers=5, tuned_layers=1, width=64, dropout=0.0)
    task = ReadingTask(Reader(text_encoder, shape), texts, texts, 8)
    before = reading_metrics(task.model.eval(), texts)
    run_training(task, LoopConfig(steps=40, batch_size=8, validate_every=40, learning_rate=2e-3))
    after = reading_metrics(task.model, texts)
    assert after["noun"] > max(0.8, before["noun"])
    assert after["relation"] > before["relation"] + 0.1


def test_a_colour_is_wanted_only_where_it_is_said(text_encoder):
    texts = ReadingSet(text_encoder, 1, "train", 40, 0)
    wanted = iter(texts.batch(range(len(texts))).colour.tolist())
    unsaid = 0
    for facts, phrase in zip(texts.facts, texts.texts, strict=True):
        for mention in phrase.mentions:
            if mention.facts:
                colour = facts[mention.facts[0]].colour
                assert next(wanted) == (COLOURS.index(colour) if mention.coloured else len(COLOURS))
                unsaid += colour is not None and not mention.coloured
    assert unsaid, "colours that are there and are not said occur"
    assert list(wanted) == []


def test_facts_are_varied():
    import numpy as np

    wording, rng = Wording("train"), np.random.default_rng(0)
    facts = [fact for _ in range(300) for fact in draw_facts(wording, rng)]
    assert {fact.relation for fact in facts} == set(RELATIONS)
    assert {fact.colour for fact in facts} == {None, *COLOURS}
    assert any(f.absent for f in facts)
    assert any(f.distance_m for f in facts)
    assert any(f.name for f in facts)


@pytest.mark.parametrize(
    ("text", "measures"),
    [
        ("A wall is two blocks east of me.", {"wall": 220.0}),
        ("There is a bench twenty-five meters north of me and a tree 1,200 m east.", {"bench": 25.0, "tree": 1200.0}),
        ("A pole is sixteen metres north of me, a bench is sixty paces south.", {"pole": 16.0, "bench": 45.0}),
        ("A building is half a mile to my north.", {"building": 804.5}),
        ("Two buildings are north of me.", {"buildings": None}),
    ],
)
def test_the_measures_of_hints(trained, text, measures):
    assert {hint.noun: hint.distance_m for hint in trained.reader.read([text])[0]} == measures


@pytest.mark.parametrize(
    ("text", "nouns"),
    [
        ("I am east of a small dark green pole.", ["small pole"]),
        ("I am east of a small pole.", ["small pole"]),
        ("There is a tall one, and a gray pole is north of me.", ["pole"]),
        ("A low wall is near green vegetation.", ["low wall", "vegetation"]),
        ("I am a short distance from gray poles.", ["poles"]),
        ("The hedge is low. A gray pole is north of me.", ["hedge", "pole"]),
    ],
)
def test_a_size_belongs_to_the_noun_that_its_colour_parts_it_from(trained, text, nouns):
    assert [hint.noun for hint in trained.reader.read([text])[0]] == nouns


def test_a_label_fits_as_well_as_all_its_names_together(matcher):
    bound, nouns = matcher.bind(("building", "lamp")), matcher.embed(["street light", "house", "giraffe"])
    logits = matcher.scale.exp() * nouns @ bound.names.T
    by_hand = [logits[:, bound.label == n].logsumexp(dim=1) for n in range(3)]
    by_hand[2] = torch.logaddexp(by_hand[2], matcher.scale.exp() * matcher.unknown)
    assert torch.allclose(matcher(nouns, bound), torch.stack(by_hand, dim=1).log_softmax(dim=1), atol=1e-4)


def test_nouns_find_their_label(matcher):
    with torch.no_grad():
        bound = matcher.bind(KITTI)
        result = matcher(
            matcher.embed(["streetlight", "garbage can", "house", "office building", "lawn", "giraffe"]), bound
        )
    assert torch.allclose(result.exp().sum(dim=1), torch.ones(6), atol=1e-4)
    names = [*KITTI, None]
    assert [names[i] for i in result.argmax(dim=1)] == ["lamp", "trash bin", "building", "building", "terrain", None]


@pytest.mark.parametrize("palette", [KITTI360_PALETTE, BASIC_PALETTE])
def test_colours_keep_their_word_or_go_to_the_most_alike(palette):
    table, words = colour_table(palette), colour_words(palette)
    assert torch.allclose(table.sum(dim=1), torch.ones(len(COLOURS) + 1), atol=1e-5)
    for word in words:
        assert table[COLOURS.index(word), words.index(word)] == 1.0
    if palette is KITTI360_PALETTE:
        assert words[int(table[COLOURS.index("white")].argmax())] == "bright-gray"


def test_a_binding_reads_what_was_noticed(matcher):
    binding = Binding(matcher, KITTI, KITTI360_PALETTE)
    sure = torch.eye(10)[2]
    grey = torch.eye(len(COLOURS) + 1)[COLOURS.index("gray")]
    reading = binding.bind(
        [
            ParsedHint("lamp post", 0, 9, sure, grey, 0.0, Measure(0, 3, 4.0)),
            ParsedHint("tree", 0, 4, sure, grey, 1.0, None),
        ]
    )
    assert KITTI[int(reading.label[0].argmax())] == "lamp"
    assert KITTI[int(reading.label[1].argmax())] == "vegetation"
    assert reading.colour[0].argmax() == colour_words(KITTI360_PALETTE).index("gray")
    assert reading.distance_m[0] == 4.0
    assert reading.distance_m[1].isnan()
    assert binding.uninformative_hint().label.shape == (1, len(KITTI))


def test_layers_that_were_packed_are_forgotten_in_training(reader, text_encoder) -> None:
    tokens, _ = text_encoder.read(["The bank is north of me."], reader.config.frozen_layers)
    with torch.no_grad():
        before = reader(tokens)
        assert reader._int8_layers is not None
        try:
            reader.train()
            assert reader._int8_layers is None
        finally:
            reader.eval()
        assert torch.equal(reader(tokens), before)
