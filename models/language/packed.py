"""Attention layers that learn nothing more: their weights lie as oneDNN takes them, so that no text turns them over."""

from collections.abc import Iterable, Mapping
from typing import Any, Final

import torch
from torch import Tensor, nn

from models.language.bert import Layer

LEAST_ROWS: Final = 8  # that oneDNN is given; their number is a multiple of it
USUAL_ROWS: Final = 64  # tokens of a text, for which weights are laid out
HAS_ONEDNN: Final = torch.backends.mkldnn.is_available()
HEADS: Final = ("query", "key", "value")


def may_pack(layers: Iterable[nn.Module], values: Tensor) -> bool:
    """Whether layers can be packed to take values of this kind: on a CPU, where nothing is learnt."""
    is_plain = not torch.is_grad_enabled() and values.device.type == "cpu" and values.dtype == torch.float32
    return HAS_ONEDNN and is_plain and all(isinstance(layer, Layer) for layer in layers)


def rows_given(rows: int) -> int:
    """How many rows oneDNN is given for some: at most a quarter more, or up to the next LEAST_ROWS."""
    step = max(LEAST_ROWS, 1 << rows.bit_length() >> 3)
    return -(-rows // step) * step


class PackedLayer:
    """A `bert.Layer` but for the last bits, the three heads' weights in one matrix. What changes later is not seen.

    Torch's own asks MKL, which on the processors of other makers than its own is half as fast, or has oneDNN turn the
    weights over for each text, which takes as long as the arithmetic. oneDNN keeps machine code for every number of
    rows that it has met, about a megabyte: so it meets few, with more rows below that nobody reads.

    Args:
        layer: any.
        weights: by name; None for its own.
    """

    def __init__(self, layer: Any, weights: Mapping[str, Tensor] | None = None) -> None:
        own = {name: weight.detach() for name, weight in (weights or dict(layer.named_parameters())).items()}
        self._heads, self._eps = layer.heads, layer.output["LayerNorm"].eps
        heads = [f"attention.self.{name}" for name in HEADS]
        self._told = _pack(*(torch.cat([own[f"{name}.{part}"] for name in heads]) for part in ("weight", "bias")))
        self._mixed, self._wide, self._narrow = (
            _pack(own[f"{name}.weight"], own[f"{name}.bias"])
            for name in ("attention.output.dense", "intermediate.dense", "output.dense")
        )
        self._norms = [
            (own[f"{name}.LayerNorm.weight"], own[f"{name}.LayerNorm.bias"]) for name in ("attention.output", "output")
        ]

    def __call__(self, x: Tensor, size: torch.Size, shut: Tensor | None) -> Tensor:
        """[R, W] of rows [R, W], the first of which are those of tokens [S, T, W]; shut as `shut_of`."""
        texts, tokens, width = size
        heads = _linear(x, self._told)[: texts * tokens].view(texts, tokens, 3, self._heads, -1).permute(2, 0, 3, 1, 4)
        told = nn.functional.scaled_dot_product_attention(heads[0], heads[1], heads[2], shut)
        rows = told.transpose(1, 2).reshape(texts * tokens, width)
        rows = nn.functional.pad(rows, (0, 0, 0, len(x) - len(rows)))
        x = nn.functional.layer_norm(_linear(rows, self._mixed) + x, (width,), *self._norms[0], self._eps)
        wide = torch.ops.mkldnn._linear_pointwise(x, *self._wide, "gelu", [], "none")
        return nn.functional.layer_norm(_linear(wide, self._narrow) + x, (width,), *self._norms[1], self._eps)


def run_packed(layers: Iterable[PackedLayer], hidden: Tensor, mask: Tensor) -> Tensor:
    """[S, T, W] after some layers; padding, where the mask [S, T] is False, takes no part."""
    size = hidden.shape
    rows = size[0] * size[1]
    x = nn.functional.pad(hidden.reshape(rows, -1), (0, 0, 0, rows_given(rows) - rows))
    shut = shut_of(mask, hidden)
    for layer in layers:
        x = layer(x, size, shut)
    return x[:rows].view(size)


def shut_of(mask: Tensor, hidden: Tensor) -> Tensor | None:
    """[S, 1, 1, T] what is added to attention: minus infinity where no token is; None where all are tokens."""
    if mask.all():
        return None
    shut = torch.zeros(mask.shape, dtype=hidden.dtype, device=hidden.device).masked_fill(~mask, float("-inf"))
    return shut[:, None, None]


def _pack(weight: Tensor, bias: Tensor) -> tuple[Tensor, Tensor]:
    return torch.ops.mkldnn._reorder_linear_weight(weight.contiguous(), USUAL_ROWS), bias


def _linear(x: Tensor, weights: tuple[Tensor, Tensor]) -> Tensor:
    made: Tensor = torch.ops.mkldnn._linear_pointwise(x, *weights, "none", [], "")
    return made
