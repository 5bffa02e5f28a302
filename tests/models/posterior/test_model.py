import json
import logging
from dataclasses import replace

import pytest
import torch

from models.language import labels as labels_module
from models.language.lexicon.lexicon import load_lexicon
from models.posterior.model import POSTERIORS, load_posterior, save_posterior

MAP = ("bench", "building", "tree")


@pytest.fixture
def other_lexicon(monkeypatch):
    """A lexicon with one name more, and few besides."""
    lexicon = load_lexicon()
    labels = {label: lexicon.labels[label] for label in MAP}
    other = replace(lexicon, labels=labels | {"bench": [*labels["bench"], "perch for walkers"]})
    monkeypatch.setattr(labels_module, "load_lexicon", lambda: other)
    return other


def test_the_shipped_names_are_the_lexicons() -> None:
    model = load_posterior()
    matcher = model.matcher
    stored = matcher.names.clone()
    with torch.no_grad():
        bound = matcher.bind(MAP)
    assert stored.equal(matcher.names), "nothing was embedded anew"
    phrases, _ = matcher.lexicon.map_names_to_labels(MAP)
    part = range(0, len(phrases), 40)
    fresh = model.reader.text_encoder.embed([phrases[n].lower().replace("-", " ") for n in part])
    assert ((bound.names[list(part)] * fresh).sum(dim=1) > 0.98).all(), "but for half precision, and layers in 8 bits"


def test_a_changed_lexicon_changes_the_fingerprint_and_is_embedded_anew(tmp_path, other_lexicon, caplog) -> None:
    with caplog.at_level(logging.WARNING):
        model = load_posterior()
    assert "the lexicon has changed since training" in caplog.text
    record = json.loads((POSTERIORS.default / "config.json").read_text())
    assert model.fingerprint != record["fingerprint"]
    with torch.no_grad():
        bound = model.matcher.bind(MAP)
        assert bound.names.shape == (len(other_lexicon.map_names_to_labels(MAP)[0]), 384)
        perch = model.matcher(model.matcher.embed(["perch for walkers"]), bound)
    assert perch.argmax() == 0
    save_posterior(model, tmp_path, {})
    caplog.clear()
    assert load_posterior(tmp_path).matcher.names.equal(model.matcher.names)
    assert not caplog.text
