"""Losses of the retrievers."""

from typing import Literal

import torch
from torch import Tensor

MIN_DISTANCE_SCALE = 1e-10  # avoids a division by zero if all vectors of a batch are equal
MASKED_LOGIT = -1e9  # finite, because inf - inf would give NaN gradients
MAX_DISTANCE = 2.0  # of two unit vectors
MIN_COMPLEMENT = 1e-6  # of 1 - p - q in one logarithm, about the resolution of float32 near 1
Distance = Literal["batch", "unit"]
Logarithms = Literal["two", "one"]


def contrastive_loss(scores: Tensor, same_cell: Tensor, temperature: float) -> Tensor:
    """Return InfoNCE, the mean of both directions; the ablation a = 0 of MNCL's negative contrastive loss.

    scores [B, B] is the similarity of description i with cell j; true pairs are on the diagonal. same_cell [B, B] is
    True where two rows belong to one cell; such pairs are not negatives. The temperature is tau.
    """
    logits = _mask_same_cell(scores / temperature, same_cell)
    target = torch.arange(len(scores), device=scores.device)
    cross_entropy = torch.nn.functional.cross_entropy
    return (cross_entropy(logits, target) + cross_entropy(logits.T, target)) / 2


def negative_contrastive_loss(
    scores: Tensor, weights: Tensor, same_cell: Tensor, temperature: float, logarithms: Logarithms
) -> Tensor:
    """Return MNCL's negative contrastive loss (equation 5): negatives become improbable, close ones most of all.

    p is the softmax over a row of scores / tau, q over a column; L = mean over i of the sum over j != i of
    w_ij * (-log(1 - p_ij - q_ij)) with one logarithm, as in the paper, or of w_ij * (-log(1 - p_ij) - log(1 - q_ij))
    with two, as in the released code. p + q can exceed 1, where one logarithm is not defined: 1 - p - q is then clamped
    to MIN_COMPLEMENT, and such a pair has no gradient of its own. Differs from both: two logarithms have no eps, which
    cuts off the gradient at p near 1, and pairs of one cell are not negatives.

    Arguments as of `contrastive_loss`; weights w [B, B] are of `negative_weights`.
    """
    logits = _mask_same_cell(scores / temperature, same_cell)
    if logarithms == "one":
        terms = _complement(logits).clamp(min=MIN_COMPLEMENT).log()
    else:
        terms = log_complement(logits, dim=1) + log_complement(logits, dim=0)
    return -(weights.masked_fill(same_cell, 0.0) * terms).sum() / len(scores)  # without the diagonal too


def clamped_share(scores: Tensor, same_cell: Tensor, temperature: float) -> Tensor:
    """Return the share of the negatives whose 1 - p - q one logarithm clamps, a scalar; arguments as of the losses."""
    with torch.no_grad():
        clamped = _complement(_mask_same_cell(scores / temperature, same_cell)) < MIN_COMPLEMENT
        return (clamped & ~same_cell).sum() / (~same_cell).sum().clamp(min=1)


def _complement(logits: Tensor) -> Tensor:
    """Return 1 - p - q, for the softmax p over a row and q over a column."""
    return 1 - logits.softmax(dim=1) - logits.softmax(dim=0)


def log_complement(logits: Tensor, dim: int) -> Tensor:
    """Return log(1 - p) for the softmax p over a dimension, with exact values and gradients for p near 1.

    For the largest p, 1 - p is computed as the sum of the others; every other p is at most 1/2.
    """
    largest = torch.zeros_like(logits, dtype=torch.bool).scatter(dim, logits.argmax(dim, keepdim=True), True)
    log_sum_of_others = logits.masked_fill(largest, MASKED_LOGIT).logsumexp(dim, keepdim=True) - logits.logsumexp(
        dim, keepdim=True
    )
    return torch.where(largest, log_sum_of_others, torch.log1p(-logits.softmax(dim).masked_fill(largest, 0.0)))


def negative_weights(texts: Tensor, cells: Tensor, exponent: float, least: float, scale: Distance) -> Tensor:
    """Return w_ij = (1 - d_ij)^(1/a), at least `least`, [B, B], for the mean vectors [B, D] of texts and cells.

    d is the distance of the unit vectors, divided by its maximum in the batch (scale "batch", as in the released code)
    or by 2, its maximum for any two unit vectors ("unit": half the distance, not (1 - cosine) / 2). The paper does not
    normalise d, which must be at most 1. It has no least weight; its code has 0.8. The weights have no gradient; the
    exponent a is above 0.
    """
    unit = torch.nn.functional.normalize
    with torch.no_grad():
        distance = torch.cdist(unit(texts, dim=-1), unit(cells, dim=-1))
        largest = distance.max().clamp(min=MIN_DISTANCE_SCALE) if scale == "batch" else MAX_DISTANCE
        return (1 - distance / largest).clamp(min=0).pow(1 / exponent).clamp(least, 1.0)


def _mask_same_cell(logits: Tensor, same_cell: Tensor) -> Tensor:
    """Mask the logits of pairs of one cell, except the diagonal."""
    diagonal = torch.eye(len(logits), dtype=torch.bool, device=logits.device)
    return logits.masked_fill(same_cell & ~diagonal, MASKED_LOGIT)
