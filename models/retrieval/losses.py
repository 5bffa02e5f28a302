"""Losses of the retrievers."""

import torch
from torch import Tensor

MOST_CERTAIN = 1e-10  # eps inside the logarithm
LEAST_WEIGHT = 0.8


def contrastive_loss(scores: Tensor, same_cell: Tensor, temperature: float) -> Tensor:
    """InfoNCE in both directions; the ablation a = 0 of MNCL's negative contrastive loss.

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
    scores: Tensor, texts: Tensor, cells: Tensor, same_cell: Tensor, temperature: float, exponent: float
) -> Tensor:
    """MNCL's negative contrastive loss: what is not the answer is made improbable, the more the nearer it lies.

    p is the softmax over a row of scores / tau, q over a column;
    L = mean over i of the sum over j != i of w_ij * (-log(1 - p_ij + eps)), and the same with q. Differs from the
    paper, as its code does: two logarithms, because the sum of two softmaxes in one can exceed 1. Differs from both:
    pairs of one cell are no negatives.

    Args:
        scores: [B, B] similarity of description i with cell j; their own are on the diagonal.
        texts: [B, D] mean vector of each description at this level.
        cells: [B, D] mean vector of each cell at this level.
        same_cell: [B, B] bool, True where two rows belong to one cell.
        temperature: tau.
        exponent: a of `negative_weights`, above 0.

    Returns:
        Scalar.
    """
    logits = _without_twins(scores / temperature, same_cell)
    weights = negative_weights(texts, cells, exponent).masked_fill(same_cell, 0.0)  # the diagonal too
    terms = [weights * -torch.log(1 - p + MOST_CERTAIN) for p in (logits.softmax(dim=1), logits.softmax(dim=0))]
    return (terms[0] + terms[1]).sum() / len(scores)


def negative_weights(texts: Tensor, cells: Tensor, exponent: float) -> Tensor:
    """[B, B] w_ij = (1 - d_ij)^(1/a) in 0.8..1; d is the distance of unit mean vectors over its maximum in the batch.

    No gradient flows through the weights.
    """
    unit = torch.nn.functional.normalize
    with torch.no_grad():
        distance = torch.cdist(unit(texts, dim=-1), unit(cells, dim=-1))
        closeness = 1 - distance / distance.max().clamp(min=MOST_CERTAIN)
        return closeness.clamp(min=0).pow(1 / exponent).clamp(LEAST_WEIGHT, 1.0)


def _without_twins(logits: Tensor, same_cell: Tensor) -> Tensor:
    """Logits in which the pairs of one cell, the diagonal aside, have no part."""
    diagonal = torch.eye(len(logits), dtype=torch.bool, device=logits.device)
    return logits.masked_fill(same_cell & ~diagonal, float("-inf"))
