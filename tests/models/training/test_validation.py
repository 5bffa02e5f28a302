import numpy as np
import pytest
import torch

from models.paper.checkpoint import METHODS
from models.paper.retriever import Retriever
from models.sources.source import VALIDATION_SEED
from models.training import validation as validation_module
from models.training.validation import EncodedGallery, Validation, calibrate, fit_weights


@pytest.fixture(scope="module")
def model(mncl):
    return mncl


def true_scores(rng, hints: int, levels: int):
    """Similarities for which softmax of (s_1 + 2 s_2 ...) / (0.3 hints^-0.8) is the truth, drawn until it comes out."""
    truth = rng.integers(20, size=4000)
    scores = rng.normal(size=(levels, 4000, 20)) * 0.5 * hints**-0.8
    logits = np.tensordot(np.arange(1, levels + 1), scores, axes=1) / (0.3 * hints**-0.8)
    answer = np.array([rng.choice(20, p=np.exp(row) / np.exp(row).sum()) for row in logits])
    row = np.arange(4000)
    scores[:, row, answer], scores[:, row, truth] = scores[:, row, truth].copy(), scores[:, row, answer].copy()
    return hints, scores, truth


@pytest.mark.parametrize("levels", [1, 2])
def test_what_is_found_is_what_made_the_answers(levels) -> None:
    rng = np.random.default_rng(0)
    weights, temperature, decay = fit_weights([true_scores(rng, hints, levels) for hints in (1, 2, 4)])
    assert (temperature, decay) == pytest.approx((0.3, 0.8), rel=0.1)
    assert weights == pytest.approx(tuple(range(1, levels + 1)), rel=0.1)


def test_every_level_gets_a_weight(model, region_queries) -> None:
    fields = calibrate(model, [region_queries], np.random.default_rng(0))
    assert len(fields["level_weights"]) == len(model.levels) == 3
    assert fields["level_weights"][0] == 1
    weighted = region_queries.scores(model)
    assert weighted.shape == (len(region_queries.truth), len(region_queries.features))


def test_the_global_level_has_a_temperature_of_its_own(model, region_queries, monkeypatch) -> None:
    scored = [true_scores(np.random.default_rng(hints), hints, 3) for hints in (1, 2, 4)]
    monkeypatch.setattr(validation_module, "_score_queries", lambda *_: scored)
    fields = calibrate(model, [region_queries], np.random.default_rng(0))
    _, *alone = fit_weights([(hints, scores[:1], truth) for hints, scores, truth in scored])
    assert [fields["global_temperature"], fields["global_temperature_decay"]] == pytest.approx(alone)
    assert fields["global_temperature"] > 2 * fields["temperature"], "the least of three levels tells little"


@pytest.fixture(scope="module")
def region_queries(source, model):
    return Validation(source.data.gallery, source.queries(VALIDATION_SEED, 40.0), model)


@pytest.mark.parametrize("method", METHODS)
def test_many_texts_at_a_time_get_the_scores_of_each_alone(source, text_encoder, method, monkeypatch) -> None:
    torch.manual_seed(0)
    retriever = METHODS[method](text_encoder, METHODS[method].config_type(width=32)).eval()
    validation = Validation(source.data.gallery, source.queries(VALIDATION_SEED, 40.0), retriever)
    rng = np.random.default_rng(0)
    texts = [list(hints)[: int(rng.integers(1, 7))] for hints in validation.descriptions]
    gallery, recall = EncodedGallery(retriever, validation.features), validation.recall(retriever)
    together = gallery.level_scores(texts)
    monkeypatch.setattr(type(retriever), "encode_texts_padded", Retriever.encode_texts)
    alone = gallery.level_scores(texts)
    assert list(together) == list(alone)
    assert all(np.abs(together[level] - alone[level]).max() < 1e-5 for level in alone)
    assert recall == pytest.approx(validation.recall(retriever), abs=1e-5)
