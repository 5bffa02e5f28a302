"""The losses against the equations written as loops."""

import math

import pytest
import torch

from models.paper.losses import (
    clamped_share,
    contrastive_loss,
    log_complement,
    negative_contrastive_loss,
    negative_weights,
)

TAU = 0.3


@pytest.fixture
def batch():
    torch.manual_seed(0)
    unit = torch.nn.functional.normalize
    cells = torch.randn(6, 8, dtype=torch.float64)
    cells[3] = cells[2] + 0.1  # near each other: weights above their least
    texts, cells = unit(cells + 0.2 * torch.randn(6, 8, dtype=torch.float64), dim=-1), unit(cells, dim=-1)
    same = torch.eye(6, dtype=torch.bool)
    same[1, 4] = same[4, 1] = True  # two descriptions of one cell
    return texts, cells, same


def softmax_of(row, column, columns):
    return math.exp(row[column] / TAU) / sum(math.exp(row[j] / TAU) for j in columns)


def test_contrastive_loss_against_a_loop(batch) -> None:
    texts, cells, same = batch
    scores = (texts @ cells.T).tolist()
    total = 0.0
    for i in range(6):
        columns = [j for j in range(6) if j == i or not same[i, j]]
        total -= math.log(softmax_of(scores[i], i, columns))
        total -= math.log(softmax_of([row[i] for row in scores], i, columns))
    assert contrastive_loss(texts @ cells.T, same, TAU).item() == pytest.approx(total / 12)


@pytest.mark.parametrize("scale", ["batch", "unit"])
@pytest.mark.parametrize("least", [0.0, 0.8])
@pytest.mark.parametrize("exponent", [1.0, 2.0, 4.0])
def test_negative_contrastive_loss_against_a_loop(batch, exponent, least, scale) -> None:
    texts, cells, same = batch
    scores = (texts @ cells.T).tolist()
    distance = [[math.dist(t, c) for c in cells.tolist()] for t in texts.tolist()]
    farthest = max(max(row) for row in distance) if scale == "batch" else 2
    total = 0.0
    for i in range(6):
        columns = [j for j in range(6) if j == i or not same[i, j]]
        for j in (j for j in range(6) if not same[i, j]):
            weight = min(1.0, max(least, (1 - distance[i][j] / farthest) ** (1 / exponent)))
            total -= weight * math.log(1 - softmax_of(scores[i], j, columns))
            column = [row[j] for row in scores]
            others = [k for k in range(6) if k == j or not same[k, j]]
            total -= weight * math.log(1 - softmax_of(column, i, others))
    weights = negative_weights(5 * texts, 3 * cells, exponent, least, scale)  # of the directions alone
    loss = negative_contrastive_loss(texts @ cells.T, weights, same, TAU, "two")
    assert loss.item() == pytest.approx(total / 6)


def test_one_logarithm_is_of_both_probabilities_and_clamped_where_they_exceed_1(batch) -> None:
    texts, cells, same = batch
    scores = texts @ cells.T
    scores[0, 5] = 2.0  # certain, and wrong: p + q is above 1
    rows, total, clamped, pairs = scores.tolist(), 0.0, 0, 0
    weights = negative_weights(texts, cells, 2.0, 0.0, "unit")
    for i in range(6):
        for j in (j for j in range(6) if not same[i, j]):
            p = softmax_of(rows[i], j, [k for k in range(6) if k == i or not same[i, k]])
            q = softmax_of([row[j] for row in rows], i, [k for k in range(6) if k == j or not same[k, j]])
            clamped, pairs = clamped + (p + q > 1), pairs + 1
            total -= weights[i, j].item() * math.log(max(1 - p - q, 1e-6))
    assert clamped == 1
    assert clamped_share(scores, same, TAU).item() == pytest.approx(clamped / pairs)
    assert clamped_share(scores, torch.ones(6, 6, dtype=torch.bool), TAU) == 0
    scores.requires_grad_()
    loss = negative_contrastive_loss(scores, weights, same, TAU, "one")
    assert loss.item() == pytest.approx(total / 6)
    loss.backward()
    assert torch.isfinite(scores.grad).all()


def test_gradients_are_those_of_the_loss(batch) -> None:
    texts, cells, same = batch
    scores = (texts @ cells.T).requires_grad_()
    assert torch.autograd.gradcheck(lambda s: contrastive_loss(s, same, TAU), scores)
    weights = negative_weights(texts, cells, 2.0, 0.0, "batch")
    assert torch.autograd.gradcheck(lambda s: negative_contrastive_loss(s, weights, same, TAU, "two"), scores)


def test_weights_are_bounded_and_fall_with_distance(batch) -> None:
    texts, cells, _ = batch
    weights, distance = negative_weights(texts, cells, 2.0, 0.8, "batch"), torch.cdist(texts, cells)
    assert 0.8 <= weights.min() < weights.max() <= 1
    order = distance.flatten().argsort()
    assert (weights.flatten()[order].diff() <= 1e-9).all()
    without_least = negative_weights(texts, cells, 2.0, 0.0, "batch")
    assert without_least.min() == 0, "the farthest pair of the batch has no weight"
    assert torch.equal(without_least.clamp(min=0.8), weights)
    assert not negative_weights(texts.clone().requires_grad_(), cells, 2.0, 0.8, "batch").requires_grad


def test_weights_by_unit_distance_do_not_depend_on_the_batch(batch) -> None:
    texts, cells, _ = batch
    weights = negative_weights(texts, cells, 2.0, 0.0, "unit")
    assert torch.allclose(negative_weights(texts[:2], cells[:2], 2.0, 0.0, "unit"), weights[:2, :2])
    assert weights.min() > 0
    opposite = negative_weights(texts[:1], -texts[:1], 2.0, 0.0, "unit")
    assert opposite.item() == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize("logarithms", ["two", "one"])
def test_certain_answers_stay_finite(logarithms) -> None:
    scores = torch.tensor([[1.0, -1.0], [1.0, -1.0]], requires_grad=True)  # the second is certain, and wrong
    loss = negative_contrastive_loss(scores, torch.ones(2, 2), torch.eye(2, dtype=torch.bool), 1e-3, logarithms)
    loss.backward()
    assert torch.isfinite(loss)
    assert torch.isfinite(scores.grad).all()


@pytest.mark.parametrize("lead", [0.0, 5.0, 15.0, 18.0, 40.0])
def test_gradients_near_certainty_are_those_of_double_precision(lead) -> None:
    """1 - p is lost in float32 from 16 nats on; what is wrong and certain must be pushed back all the same."""

    def gradient(dtype: torch.dtype) -> torch.Tensor:
        logits = torch.tensor([[lead, 0.0, -1.0, 0.5]], dtype=dtype, requires_grad=True)
        log_complement(logits, dim=1)[0, 0].backward()
        return logits.grad.double()

    exact = gradient(torch.float64)
    assert torch.allclose(gradient(torch.float32), exact, atol=1e-5)
    assert exact.abs().max() <= 1


@pytest.mark.parametrize("logarithms", ["two", "one"])
def test_a_batch_of_one_cell_has_nothing_to_tell_apart(logarithms) -> None:
    scores, ones = torch.rand(3, 3, requires_grad=True), torch.ones(3, 3)
    loss = negative_contrastive_loss(scores, ones, ones.bool(), 0.05, logarithms)
    loss.backward()
    assert loss == 0
    assert (scores.grad == 0).all()
