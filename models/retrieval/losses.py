"""Losses of the retriever."""

import torch
from torch import Tensor


def contrastive_loss(texts: Tensor, cells: Tensor, same_cell: Tensor, temperature: float) -> Tensor:
    """InfoNCE in both directions; the ablation a = 0 of MNCL's negative contrastive loss.

    Args:
        texts: [B, D] unit vectors of descriptions.
        cells: [B, D] unit vectors of their cells.
        same_cell: [B, B] bool, True where two rows belong to one cell; such pairs are no negatives.
        temperature: tau.

    Returns:
        Scalar, mean over both directions.
    """
    scores = texts @ cells.T / temperature
    diagonal = torch.eye(len(scores), dtype=torch.bool, device=scores.device)
    scores = scores.masked_fill(same_cell & ~diagonal, float("-inf"))
    target = torch.arange(len(scores), device=scores.device)
    cross_entropy = torch.nn.functional.cross_entropy
    return (cross_entropy(scores, target) + cross_entropy(scores.T, target)) / 2
