import json

import numpy as np
import pytest
import torch

from models.errors import TrainingError
from models.language.mentions.cue_reader import ANGLES, CueReader
from models.posterior.model import load_posterior
from models.training.posterior import fit_cues as fit_cues_module
from models.training.posterior.cue_texts import (
    CueMention,
    CueText,
    augment,
    collect_names,
    load_labelled,
    mirror,
    replace_name,
)
from models.training.posterior.fit_cues import accuracy, fit_cues

TEXTS = [
    CueText("the bank is on my left", (CueMention(4, 8, 0, ANGLES.index(-90.0)),)),
    CueText("the cafe is behind me", (CueMention(4, 8, 0, ANGLES.index(180.0)),)),
    CueText("bring me a bagel please", (CueMention(11, 16, 0, is_meant=False),)),
] * 6


@pytest.fixture
def reader() -> CueReader:
    model = load_posterior()
    torch.manual_seed(0)
    return CueReader(model.text_encoder, model.reader.tuned, model.config.frozen_layers)


def test_it_learns_and_leaves_the_other_reader_as_it_was(reader, monkeypatch) -> None:
    monkeypatch.setattr(fit_cues_module, "WARM_UP_STEPS", 5)
    base = [p.clone() for p in load_posterior().reader.tuned.parameters()]
    losses = []
    fit_cues(reader, TEXTS, 30, np.random.default_rng(0), lambda *row: losses.append(row[2]))
    assert losses[-1] < losses[0] / 1.5
    assert accuracy(reader, TEXTS)["angle"] == 1.0
    assert not reader.read("bring me a bagel please", [(11, 16, "thing")])[0].is_meant
    assert all(torch.equal(a, b) for a, b in zip(base, load_posterior().reader.tuned.parameters(), strict=True))


def test_nothing_to_learn_from_is_refused(reader) -> None:
    with pytest.raises(TrainingError, match="no labelled texts"):
        fit_cues(reader, [], 1, np.random.default_rng(0))


def test_the_mirror_image_of_a_text() -> None:
    text = CueText(
        "On the left is the bank, cafe ahead on the right", (CueMention(19, 23, 0, 8), CueMention(25, 29, 0, 3))
    )
    other = mirror(text)
    assert other.text == "On the right is the bank, cafe ahead on the left"
    assert [other.text[item.start : item.end] for item in other.mentions] == ["bank", "cafe"]
    assert [ANGLES[item.angle] for item in other.mentions] == [90.0, -45.0]


@pytest.mark.parametrize("text", ["the bank is right next to me", "I just left the bank", "the bank"])
def test_what_has_no_mirror_image_is_left_alone(text) -> None:
    start = text.index("bank")
    given = CueText(text, (CueMention(start, start + 4, 0),))
    assert mirror(given) == given


def test_a_thing_gets_another_name_and_keeps_what_is_said_of_it() -> None:
    text = CueText("The bank is left, the cafe is behind.", (CueMention(4, 8, 0, 8), CueMention(22, 26, 0, 6)))
    names = collect_names([CueText("a hairdresser", (CueMention(2, 13, 0),)), CueText("Elmo", (CueMention(0, 4, 0),))])
    variants = {replace_name(text, names, np.random.default_rng(n)) for n in range(20)}
    assert {one.text for one in variants} == {
        "The hairdresser is left, the cafe is behind.",
        "The bank is left, the hairdresser is behind.",
    }
    for one in variants:
        assert sorted(one.text[item.start : item.end] for item in one.mentions)[-1] == "hairdresser"
        assert [item.angle for item in one.mentions] == [8, 6]


def test_what_is_named_twice_keeps_its_name() -> None:
    text = CueText("At the bank, the bank is on my left.", (CueMention(7, 11, 0, 8),))
    names = {(0, False): ["hairdresser"]}
    assert replace_name(text, names, np.random.default_rng(0)) == text


def test_variants_keep_their_mentions_where_they_are() -> None:
    rng = np.random.default_rng(0)
    text = CueText(
        "The bank, on my left, is shut; the cafe's behind me.", (CueMention(4, 8, 0, 8), CueMention(35, 39, 0, 6))
    )
    names = collect_names([text, CueText("a bakery", (CueMention(2, 8, 0),))])
    variants = [augment(text, names, rng) for _ in range(200)]
    assert len({variant.text for variant in variants}) > 20
    for variant in variants:
        for item in variant.mentions:
            assert 0 <= item.start < item.end <= len(variant.text)


@pytest.mark.parametrize("line", ["no json", "{}", json.dumps({"text": "a", "mentions": [{"start": 0, "end": 1}]})])
def test_a_line_that_is_no_labelled_text_is_named(tmp_path, line) -> None:
    path = tmp_path / "texts.jsonl"
    path.write_text(json.dumps({"text": "a", "mentions": []}) + "\n" + line + "\n")
    with pytest.raises(TrainingError, match="line 2"):
        load_labelled(path)
