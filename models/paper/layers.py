"""Layers that several encoders share."""

from itertools import pairwise

import torch
from torch import Tensor, nn

CAUCHY_SCALES = 0.25, 0.5, 1.0, 2.0  # initial gammas of `CauchyLayer`, in half cells: 4 to 30 m in cells of 30 m


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


class CauchyTransformer(nn.Module):
    """Self-attention layers over a set with positions, less to far entries and none to padding, see `CauchyLayer`."""

    def __init__(self, width: int, num_layers: int, num_heads: int, dropout: float) -> None:
        super().__init__()
        self.layers = nn.ModuleList(CauchyLayer(width, num_heads, dropout) for _ in range(num_layers))

    def forward(self, x: Tensor, mask: Tensor, positions: Tensor) -> Tensor:
        """Return features [B, K, D] of sets with mask [B, K] and positions [B, K, 3]."""
        squared_distance = (positions[:, :, None] - positions[:, None]).square().sum(dim=-1)
        for layer in self.layers:
            x = layer(x, mask, squared_distance)
        return torch.where(mask[..., None], x, 0.0)


class CauchyLayer(nn.Module):
    """A transformer layer whose attention falls with the distance, by a mixture of Cauchy kernels (CMMLoc, CVPR 2025).

    The weight of entry j for entry i, after the softmax, is multiplied by
    m(d_ij) = sum over k of w_k / (1 + (d_ij / gamma_k)^2) and normalised again; so log m is added to the logits. The
    scales gamma_k and the shares w_k, which sum to 1, are learned.

    Differs: d is the distance of the positions; in the released code, of the indices in the padded list. It multiplies
    logits, not weights, so that far entries with a negative logit gain; it has one layer for each of seven given scales
    and one without a kernel, and adds their outputs by learned shares.
    """

    def __init__(self, width: int, num_heads: int, dropout: float) -> None:
        super().__init__()
        # Not nn.TransformerEncoderLayer: in evaluation it converts a mask of numbers to booleans.
        self.attention = nn.MultiheadAttention(width, num_heads, dropout, batch_first=True)
        self.feed_forward = nn.Sequential(
            nn.Linear(width, 2 * width), nn.ReLU(), nn.Dropout(dropout), nn.Linear(2 * width, width)
        )
        self.norms = nn.ModuleList(nn.LayerNorm(width) for _ in range(2))
        self.dropout = nn.Dropout(dropout)
        self.log_scales = nn.Parameter(torch.tensor(CAUCHY_SCALES).log())
        self.share_logits = nn.Parameter(torch.zeros(len(CAUCHY_SCALES)))

    def forward(self, x: Tensor, mask: Tensor, squared_distance: Tensor) -> Tensor:
        """Return features [B, K, D] of sets with mask [B, K] and squared distances [B, K, K]."""
        bias = self.log_mixture(squared_distance).masked_fill(~mask[:, None], float("-inf"))
        bias = bias.repeat_interleave(self.attention.num_heads, dim=0)
        attended, _ = self.attention(x, x, x, attn_mask=bias, need_weights=False)
        x = self.norms[0](x + self.dropout(attended))
        features: Tensor = self.norms[1](x + self.dropout(self.feed_forward(x)))
        return features

    def log_mixture(self, squared_distance: Tensor) -> Tensor:
        """Return log m(d) of squared distances [B, K, K]."""
        kernels = 1 / (1 + squared_distance[..., None] * (-2 * self.log_scales).exp())
        return (kernels @ self.share_logits.softmax(dim=0)).log()


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
