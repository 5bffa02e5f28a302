import json
import re
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import torch

from models.citymap.colours import KITTI360_PALETTE
from models.citymap.types import Hint
from models.language.grammar.files import load_grammar
from models.language.grammar.labelled_text import LabelledText
from models.language.grammar.wording import Wording
from models.language.lexicon.lexicon import load_lexicon
from models.language.measures import COMPASS
from models.posterior.likelihood import Likelihood
from models.posterior.model import PosteriorConfig, load_posterior
from models.training.posterior import fit_posterior, training_sites
from models.training.posterior.training_sites import TrainingSite
from models.training.settings import TrainingConfig


@pytest.mark.slow
def test_the_posterior_is_trained_calibrated_and_saved(strip_file, tmp_path, monkeypatch):
    small = {
        "READER_TEXTS": 24,
        "READER_VALIDATION_TEXTS": 8,
        "FIT_TEXTS_PER_SITE": 4,
        "CALIBRATION_TEXTS_PER_SITE": 4,
    }
    for name, value in (small | {"FIT_STEPS": 1, "CALIBRATION_STEPS": 1}).items():
        monkeypatch.setattr(fit_posterior, name, value)
    labelled = fit_posterior.load_training_texts()[:16]
    monkeypatch.setattr(fit_posterior, "load_training_texts", lambda: labelled)
    monkeypatch.setattr(fit_posterior, "EPOCHS", 1)
    calibrate, places = fit_posterior.calibrate_near_factor, []
    monkeypatch.setattr(
        fit_posterior,
        "calibrate_near_factor",
        lambda m, sites, rng: (places.append(len(sites)), calibrate(m, sites, rng))[1],
    )
    config = TrainingConfig(steps=2, batch_size=8, validate_every=2)
    steps = []
    figures = fit_posterior.train_posterior(
        [strip_file], ("train", "test"), tmp_path, PosteriorConfig(width=32), config, progress=steps.append
    )
    assert [p.step for p in steps] == [1, 2]
    assert places == [2], "calibrated on the place that was fitted to and on the other"
    assert 0 <= figures["recall@1"] <= 1
    model = load_posterior(tmp_path)
    assert model.config.radius_held == pytest.approx((figures["held_p50"], figures["held_p90"]))
    record = json.loads((tmp_path / "config.json").read_text())
    assert record["fingerprint"] == model.fingerprint
    assert record["training"]["validation"] == figures
    assert record["training"]["lexicon_sha256"] == load_lexicon().sha256
    assert model.config.grammar_sha256 == load_grammar("train").sha256
    assert len(model.matcher.names), "stored, so that a start embeds none"
    record["training"]["places"] = {"seed": 3}
    (tmp_path / "config.json").write_text(json.dumps(record))
    again = fit_posterior.refit_posterior(tmp_path, [strip_file], ("train", "test"), tmp_path / "again", config)
    assert again == pytest.approx(figures, abs=1e-6), "a refit is the end of the training"
    places_record = json.loads((tmp_path / "again" / "config.json").read_text())["training"]["places"]
    assert places_record == {"seed": 3}, "of parts that stay as they are"
    refitted = load_posterior(tmp_path / "again").state_dict()
    for name, tensor in model.state_dict().items():
        assert torch.allclose(tensor, refitted[name], atol=1e-6), name


def test_temper_is_chosen_by_what_is_claimed_against_what_is_true(monkeypatch) -> None:
    model: Any = SimpleNamespace(likelihood=Likelihood(), config=PosteriorConfig())
    fitted = float(model.likelihood.temper.detach())

    def locate(likelihood, evidence):
        # What is claimed grows with temper; every other answer is true, so it is honest at 0.6.
        claimed = np.exp(float(likelihood.temper.detach()) - fitted) * 0.5 / 0.6
        return SimpleNamespace(
            rows=np.array([int(evidence.hints)]), positions=np.zeros((1, 2)), probability=np.array([claimed]),
            share_within=lambda _: 0.8,
        )  # fmt: skip

    monkeypatch.setattr(fit_posterior, "locate", locate)
    monkeypatch.setattr(fit_posterior, "fit_likelihood", lambda *_: None)
    place: Any = SimpleNamespace(
        hints=[(), ()], read=lambda *_: [True, False], posterior=lambda likelihood: likelihood,
        truth=np.array([1, 1]), positions_m=np.zeros((2, 2)),
        cells=SimpleNamespace(center_m=np.zeros((2, 3)), size_m=30.0, scenes=("town", "town")),
    )  # fmt: skip
    figures = fit_posterior.calibrate_near_factor(model, [place, place], np.random.default_rng(0))
    assert float(model.likelihood.temper.detach()) - fitted == pytest.approx(np.log(0.6))
    assert figures["recall@1"] == 0.5
    assert model.config.radius_held == pytest.approx((0.8, 0.8)), "what a radius of 90 % must hold to hold 90 %"


def read_texts(monkeypatch, wording, **shares) -> list[str]:
    """Twenty texts about three things, as they are given to the reader."""
    for name, value in shares.items():
        monkeypatch.setattr(training_sites, name, value)
    shipped, texts = load_posterior(), []

    def read(batch):
        texts.extend(batch)
        return [[] for _ in batch]

    model: Any = SimpleNamespace(matcher=shipped.matcher, reader=SimpleNamespace(read=read))
    hints = (Hint("north", "bench", "gray"), Hint("on-top", "tree", None), Hint("east", "road", "black"))
    there = (Hint("north", "fountain", None),)
    nowhere: Any = None
    place = TrainingSite(
        nowhere, SimpleNamespace(scenes=("town", "other")), np.zeros(0, np.int64),
        ("bench", "fountain", "road", "tree"),
        KITTI360_PALETTE, [*[hints] * 20, there, there, there],
        np.array([*[(0.0, 0.0)] * 20, (45.0, 0.0), (70.0, 0.0), (40.0, 0.0)]), np.array([0] * 22 + [1]),
    )  # fmt: skip
    place.read(model, np.arange(20), (wording,), np.random.default_rng(0))
    assert len(texts) == 20
    return texts


def test_some_texts_tell_of_less(monkeypatch) -> None:
    whole = read_texts(monkeypatch, None, SLIP_SHARE=0.0, OMISSION_SHARE=0.0)
    assert {text.count("The pose") for text in whole} == {3}
    shorter = read_texts(monkeypatch, None, SLIP_SHARE=0.0, OMISSION_SHARE=1.0)
    assert {text.count("The pose") for text in shorter} == {2}


@pytest.mark.parametrize("measured", [0.0, 1.0])
def test_some_texts_tell_of_what_is_further_off(monkeypatch, measured) -> None:
    """A thing from the hints of a position 45 m away in the same scene."""
    given = {"SLIP_SHARE": 0.0, "OMISSION_SHARE": 0.0, "MEASURED_SHARE": measured}
    stated_facts = []
    monkeypatch.setattr(Wording, "write", lambda self, facts, rng: stated_facts.extend(facts) or LabelledText("", ()))
    read_texts(monkeypatch, "train", **given, DISTANT_SHARE=1.0)
    distant = [fact for fact in stated_facts if fact.label == "fountain"]
    assert len(distant) == 20
    assert {(fact.relation, fact.distance_m) for fact in distant} == {("west", 45.0 if measured else None)}


def test_a_slip_changes_one_fact_to_what_is_not_true(monkeypatch) -> None:
    """Checked on texts in the wording of the benchmark."""
    texts = read_texts(monkeypatch, None, SLIP_SHARE=1.0, OMISSION_SHARE=0.0)
    facts = [("north", "gray bench"), ("on-top", "tree"), ("east", "black road")]
    kinds = set()
    for text in texts:
        stated = re.findall(r"The pose is (\S+) of a ([^.]+)\.", text)
        [(was, is_now)] = [(a, b) for a, b in zip(facts, stated, strict=True) if a != b]
        (*colour, label), (*now_colour, now_label) = was[1].split(), is_now[1].split()
        changes = {"relation": was[0] != is_now[0], "colour": colour != now_colour, "label": label != now_label}
        kinds.add(frozenset(name for name, is_changed in changes.items() if is_changed))
        assert is_now[0] in (*COMPASS, was[0])
        assert len(colour) == len(now_colour)
    assert len(texts) == 20
    assert kinds == {frozenset({"label"}), frozenset({"relation"}), frozenset({"relation", "colour"})}
