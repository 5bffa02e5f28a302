"""Layers that several encoders share."""

from itertools import pairwise

import torch
from torch import Tensor, nn


def masked_max(x: Tensor, mask: Tensor) -> Tensor:
    """Return the maximum [..., D] of x [..., K, D] over the real entries, at least one of mask [..., K]."""
    return x.masked_fill(~mask[..., None], float("-inf")).amax(dim=-2)


def group_by_size(mask: Tensor, size: int = 8) -> list[tuple[Tensor, int]]:
    """Group the rows of a mask [B, K] by their number of real entries, to compute little for padding.

    Returns the rows [up to `size`] of each group, and the length that contains all their real entries.
    """
    length = (mask * torch.arange(1, mask.shape[1] + 1, device=mask.device)).amax(dim=1)
    order = length.argsort(stable=True)
    return [(rows, int(length[rows[-1]])) for rows in order.split(size)]


def mlp(*widths: int) -> nn.Sequential:
    """Return linear layers with ReLU between them."""
    layers: list[nn.Module] = []
    for i, (width_in, width_out) in enumerate(pairwise(widths)):
        layers += [nn.ReLU()] if i else []
        layers.append(nn.Linear(width_in, width_out))
    return nn.Sequential(*layers)


class SetTransformer(nn.Module):
    """Self-attention layers over a set, without positions and with padding masked."""

    def __init__(self, width: int, num_layers: int, num_heads: int, dropout: float) -> None:
        super().__init__()
        self.layers = nn.ModuleList(
            nn.TransformerEncoderLayer(width, num_heads, 2 * width, dropout, batch_first=True)
            for _ in range(num_layers)
        )

    def forward(self, x: Tensor, mask: Tensor) -> Tensor:
        """Return features [B, K, D] of sets with mask [B, K], True where an entry is real."""
        for layer in self.layers:
            x = layer(x, src_key_padding_mask=~mask)
        return torch.where(mask[..., None], x, 0.0)


class HintEncoder(nn.Module):
    """The hint features F^T from token features (MNCL, text backbone).

    Differs: tokens are projected to D before the transformer layer; a third of the time at the same recall.
    """

    def __init__(self, text_width: int, width: int, dropout: float) -> None:
        super().__init__()
        self.project = nn.Linear(text_width, width)
        self.tokens = SetTransformer(width, num_layers=1, num_heads=4, dropout=dropout)
        self.head = nn.Linear(width, width)
        self.norm = nn.BatchNorm1d(width)

    def forward(self, tokens: Tensor, mask: Tensor) -> Tensor:
        """Return features [S, D] of sentences from token features [S, T, W] with mask [S, T]."""
        pooled = masked_max(self.tokens(self.project(tokens), mask), mask)
        features: Tensor = self.norm(self.head(pooled))
        return features
