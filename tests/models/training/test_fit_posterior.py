import json
from typing import Any

import numpy as np
import pytest

from models.city.colours import KITTI360_PALETTE
from models.language.grammar.files import load_grammar
from models.language.grammar.labelled_text import Fact
from models.language.lexicon.lexicon import load_lexicon
from models.language.parsed_hint import WINDS
from models.posterior.likelihood import Likelihood
from models.posterior.model import PosteriorConfig, load_posterior
from models.training import fit_posterior
from models.training.places import _slip
from models.training.settings import TrainingConfig


def test_the_posterior_is_trained_calibrated_and_saved(osm_file, tmp_path, monkeypatch):
    small = {"TEXTS": 48, "VALIDATION_TEXTS": 16, "FITTED_TEXTS": 8, "CALIBRATED_TEXTS": 8}
    for name, value in (small | {"FIT_STEPS": 1, "CALIBRATION_STEPS": 1}).items():
        monkeypatch.setattr(fit_posterior, name, value)
    config = TrainingConfig(steps=2, batch_size=16, validate_every=2)
    seen = []
    figures = fit_posterior.train_posterior(
        [osm_file], ("train", "test"), tmp_path, PosteriorConfig(width=32), config, progress=seen.append
    )
    assert [p.step for p in seen] == [1, 2]
    assert 0 <= figures["recall@1"] <= 1
    model = load_posterior(tmp_path)
    assert model.config.radius_scale == pytest.approx(figures["radius_scale"])
    record = json.loads((tmp_path / "config.json").read_text())
    assert record["fingerprint"] == model.fingerprint
    assert record["training"]["validation"] == figures
    assert record["training"]["lexicon_sha256"] == load_lexicon().sha256
    assert model.config.grammar_sha256 == load_grammar("train").sha256
    assert len(model.matcher.names), "stored, so that a start embeds none"


def test_temper_is_chosen_by_what_is_claimed_against_what_is_true(monkeypatch) -> None:
    likelihood = Likelihood()
    fitted = float(likelihood.temper.detach())

    def answers(model, part):
        # What is claimed grows with it, and is true at 0.6.
        scale = np.exp(float(model.temper.detach()) - fitted)
        return np.array([[np.inf, 1.0, 1.0, scale * 0.5 / 0.6], [1.0, 1.0, 0.0, scale * 0.5 / 0.6]])

    monkeypatch.setattr(fit_posterior, "_answers", answers)
    places: list[Any] = [None, None]
    fit_posterior._temper(likelihood, places)
    assert float(likelihood.temper.detach()) - fitted == pytest.approx(np.log(0.6))


def test_a_slip_changes_one_fact_to_what_is_not_true() -> None:
    facts = [Fact("bench", "north", "gray"), Fact("tree", "on-top"), Fact("road", "east", "black")]
    seen = set()
    for seed in range(20):
        said = _slip(facts, KITTI360_PALETTE, ("bench", "tree", "road"), np.random.default_rng(seed))
        [(was, is_now)] = [(a, b) for a, b in zip(facts, said, strict=True) if a != b]
        changed = {name for name in ("label", "relation", "colour") if getattr(was, name) != getattr(is_now, name)}
        seen.add(frozenset(changed))
        assert is_now.relation in (*WINDS, was.relation)
        assert (is_now.colour is None) == (was.colour is None)
    assert seen == {frozenset({"label"}), frozenset({"relation"}), frozenset({"relation", "colour"})}
