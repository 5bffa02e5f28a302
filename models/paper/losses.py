"""Losses of the retrievers."""

import torch
from torch import Tensor

LEAST_DISTANCE = 1e-10  # that the largest of a batch is taken for
NOTHING = -1e9  # logit of what has no part; finite, so that no gradient is lost in inf - inf


def contrastive_loss(scores: Tensor, same_cell: Tensor, temperature: float) -> Tensor:
    """Return InfoNCE in both directions; the ablation a = 0 of MNCL's negative contrastive loss.

    Args:
        scores: [B, B] similarity of description i with cell j; their own are on the diagonal.
        same_cell: [B, B] bool, True where two rows belong to one cell; such pairs are no negatives.
        temperature: tau.

    Returns:
        Scalar, mean over both directions.
    """
    logits = _without_twins(scores / temperature, same_cell)
    target = torch.arange(len(scores), device=scores.device)
    cross_entropy = torch.nn.functional.cross_entropy
    return (cross_entropy(logits, target) + cross_entropy(logits.T, target)) / 2


def negative_contrastive_loss(
    scores: Tensor,
    texts: Tensor,
    cells: Tensor,
    same_cell: Tensor,
    temperature: float,
    exponent: float,
    least_weight: float,
) -> Tensor:
    """Return MNCL's negative contrastive loss (equation 5): negatives become improbable, near ones most of all.

    p is the softmax over a row of scores / tau, q over a column;
    L = mean over i of the sum over j != i of w_ij * (-log(1 - p_ij)), and the same with q. Differs from the paper, as
    its code does: two logarithms, because the sum of two softmaxes in one can exceed 1. Differs from both: no eps in
    the logarithm, whose gradient at p near 1 it cut off, and pairs of one cell are no negatives.

    Args:
        scores: [B, B] similarity of description i with cell j; their own are on the diagonal.
        texts: [B, D] mean vector of each description at this level.
        cells: [B, D] mean vector of each cell at this level.
        same_cell: [B, B] bool, True where two rows belong to one cell.
        temperature: tau.
        exponent: a of `negative_weights`, above 0.
        least_weight: of `negative_weights`.

    Returns:
        Scalar.
    """
    logits = _without_twins(scores / temperature, same_cell)
    weights = negative_weights(texts, cells, exponent, least_weight).masked_fill(same_cell, 0.0)  # the diagonal too
    terms = log_improbable(logits, dim=1) + log_improbable(logits, dim=0)
    return -(weights * terms).sum() / len(scores)


def log_improbable(logits: Tensor, dim: int) -> Tensor:
    """log(1 - p) of each entry, p the softmax over a dimension; exact where p is near 1, and so are its gradients.

    Where p is largest, 1 - p is the share of the others, summed as such; elsewhere p is at most 1/2.
    """
    largest = torch.zeros_like(logits, dtype=torch.bool).scatter(dim, logits.argmax(dim, keepdim=True), True)
    of_others = logits.masked_fill(largest, NOTHING).logsumexp(dim, keepdim=True) - logits.logsumexp(dim, keepdim=True)
    return torch.where(largest, of_others, torch.log1p(-logits.softmax(dim).masked_fill(largest, 0.0)))


def negative_weights(texts: Tensor, cells: Tensor, exponent: float, least: float) -> Tensor:
    """[B, B] w_ij = (1 - d_ij)^(1/a), at least `least`; d is the distance of unit mean vectors over its batch maximum.

    The paper has no least weight, its code has 0.8. No gradient flows through the weights.
    """
    unit = torch.nn.functional.normalize
    with torch.no_grad():
        distance = torch.cdist(unit(texts, dim=-1), unit(cells, dim=-1))
        closeness = 1 - distance / distance.max().clamp(min=LEAST_DISTANCE)
        return closeness.clamp(min=0).pow(1 / exponent).clamp(least, 1.0)


def _without_twins(logits: Tensor, same_cell: Tensor) -> Tensor:
    """Logits in which the pairs of one cell, the diagonal aside, have no part."""
    diagonal = torch.eye(len(logits), dtype=torch.bool, device=logits.device)
    return logits.masked_fill(same_cell & ~diagonal, NOTHING)
