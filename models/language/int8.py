"""Attention layers that learn nothing more, in 8 bits: a quarter of the memory, and less arithmetic.

Each output of a linear layer has a scale for its weights, and each row that comes in has one of its own (the
vector-wise quantization of LLM.int8(): Dettmers et al., NeurIPS 2022): what stands beside a text changes nothing.
"""

import copy
from collections.abc import Iterable, Mapping
from typing import Any, Final

import numpy as np
import numpy.typing as npt
import torch
from torch import Tensor, nn

from models.compiled import compiled
from models.language.bert import Layer

LEAST_ROWS: Final = 8  # that oneDNN is given; their number is a multiple of it
USUAL_ROWS: Final = 64  # tokens of a text, for which weights are laid out
HEADS: Final = ("query", "key", "value")
MOST: Final = 127  # of 8 bits with a sign
Floats32 = npt.NDArray[np.float32]


def _adds_8_bits() -> bool:
    """Whether products of 8 bits are added up in 32, and fast: earlier processors cut them off at 16."""
    able: Mapping[str, Any] = getattr(torch.cpu, "get_capabilities", dict)()
    if not torch.backends.mkldnn.is_available() or not (able.get("avx512_vnni") or able.get("avx_vnni")):
        return False
    rows, weight = (torch.full((count, 1536), MOST, dtype=torch.int8) for count in (USUAL_ROWS, 384))
    return bool((torch._int_mm(rows, weight.T) == 1536 * MOST**2).all())  # oneDNN may have been told to do without


ADDS_8_BITS: Final = _adds_8_bits()


def may_pack(layers: Iterable[nn.Module], values: Tensor) -> bool:
    """Whether layers can be packed to take values of this kind: on a CPU, where nothing is learnt."""
    is_plain = not torch.is_grad_enabled() and values.device.type == "cpu" and values.dtype == torch.float32
    return is_plain and all(isinstance(layer, Layer) for layer in layers)


def rows_given(rows: int) -> int:
    """How many rows oneDNN is given for some: at most a quarter more, or up to the next LEAST_ROWS."""
    step = max(LEAST_ROWS, 1 << rows.bit_length() >> 3)
    return -(-rows // step) * step


class PackedLinear:
    """A linear layer with weights and rows in 8 bits; the same on any processor, but for the last bits.

    Args:
        weight: [to, from].
        bias: [to].
        adds_8_bits: as the processor does; else whole numbers are multiplied as floats.
    """

    def __init__(self, weight: Tensor, bias: Tensor, adds_8_bits: bool = ADDS_8_BITS) -> None:
        small, scale = to_8_bits(weight.detach().contiguous())
        self._scale, self._bias = scale, bias.detach().clone().numpy()
        self._weight = small.T
        self._adds_8_bits = adds_8_bits
        if not adds_8_bits:
            self._weight = small.float()
            if torch.backends.mkldnn.is_available():  # twice as fast as MKL on processors of other makers than its own
                self._weight = torch.ops.mkldnn._reorder_linear_weight(self._weight, USUAL_ROWS)

    def __call__(self, x: Tensor) -> Tensor:
        """[R, to] of rows [R, from]."""
        small, scale = to_8_bits(x)
        made = np.empty((len(x), len(self._bias)), np.float32)
        _put_together(self._products(small).numpy(), scale, self._scale, self._bias, made)
        return torch.from_numpy(made)

    def _products(self, rows: Tensor) -> Tensor:
        """[R, to] whole numbers."""
        if self._adds_8_bits:
            return torch._int_mm(rows, self._weight)
        if self._weight.is_mkldnn:
            made: Tensor = torch.ops.mkldnn._linear_pointwise(rows.float(), self._weight, None, "none", [], "")
            return made
        return nn.functional.linear(rows.float(), self._weight)


class PackedEmbeddings:
    """What `bert.Bert.embeddings` makes of tokens, with words in 8 bits: what is left of them when it is let go of.

    Args:
        embeddings: of a Bert.
    """

    def __init__(self, embeddings: Any) -> None:
        self._words, self._scale = to_8_bits(embeddings.word_embeddings.weight.detach())
        self._places = embeddings.position_embeddings.weight + embeddings.token_type_embeddings.weight[0]
        self._norm = copy.deepcopy(embeddings.LayerNorm)

    def __call__(self, ids: Tensor) -> Tensor:
        """[S, T, W] of tokens [S, T]."""
        words = self._words[ids].float() * torch.from_numpy(self._scale)[ids][..., None]
        embedded: Tensor = self._norm(words + self._places[: ids.shape[1]])
        return embedded


class PackedLayer:
    """A `bert.Layer` in 8 bits, the three heads' weights in one matrix. What changes later is not seen.

    oneDNN keeps machine code for every number of rows that it has met, about a megabyte: so it meets few, with more
    rows below that nobody reads.

    Args:
        layer: any.
        weights: by name; None for its own.
    """

    def __init__(self, layer: Any, weights: Mapping[str, Tensor] | None = None) -> None:
        own = {name: weight.detach() for name, weight in (weights or dict(layer.named_parameters())).items()}
        self._heads, self._eps = layer.heads, layer.output["LayerNorm"].eps
        heads = [f"attention.self.{name}" for name in HEADS]
        weight, bias = (torch.cat([own[f"{name}.{part}"] for name in heads]) for part in ("weight", "bias"))
        self._told = PackedLinear(weight, bias)
        self._mixed, self._wide, self._narrow = (
            PackedLinear(own[f"{name}.weight"], own[f"{name}.bias"])
            for name in ("attention.output.dense", "intermediate.dense", "output.dense")
        )
        self._norms = [
            (own[f"{name}.LayerNorm.weight"].clone(), own[f"{name}.LayerNorm.bias"].clone())
            for name in ("attention.output", "output")
        ]

    def __call__(self, x: Tensor, size: torch.Size, shut: Tensor | None) -> Tensor:
        """[R, W] of rows [R, W], the first of which are those of tokens [S, T, W]; shut as `shut_of`."""
        texts, tokens, width = size
        heads = self._told(x)[: texts * tokens].view(texts, tokens, 3, self._heads, -1).permute(2, 0, 3, 1, 4)
        told = nn.functional.scaled_dot_product_attention(heads[0], heads[1], heads[2], shut)
        rows = told.transpose(1, 2).reshape(texts * tokens, width)
        rows = nn.functional.pad(rows, (0, 0, 0, len(x) - len(rows)))
        x = nn.functional.layer_norm(self._mixed(rows) + x, (width,), *self._norms[0], self._eps)
        wide = nn.functional.gelu(self._wide(x))
        return nn.functional.layer_norm(self._narrow(wide) + x, (width,), *self._norms[1], self._eps)


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


def to_8_bits(x: Tensor) -> tuple[Tensor, Floats32]:
    """Rows [R, K] as whole numbers of at most MOST, int8, and the scale [R] that each is in."""
    small, scale = np.empty(x.shape, np.int8), np.empty(len(x), np.float32)
    _to_8_bits(x.numpy(), small, scale)
    return torch.from_numpy(small), scale


@compiled
def _to_8_bits(x: Floats32, small: npt.NDArray[np.int8], scale: Floats32) -> None:
    bits, most = x.view(np.int32), scale.view(np.int32)  # without its sign a float is in the order of its bits
    for r in range(len(x)):
        top = np.int32(0)
        for k in range(x.shape[1]):
            here = bits[r, k] & np.int32(0x7FFFFFFF)
            top = here if here > top else top
        most[r] = top
    for r in range(len(x)):
        scale[r] = np.float32(1) if scale[r] == 0 else scale[r] / np.float32(MOST)
        parts = np.float32(1) / scale[r]
        for k in range(x.shape[1]):
            small[r, k] = np.int8(np.rint(x[r, k] * parts))


@compiled
def _put_together(products: Any, rows: Floats32, columns: Floats32, bias: Floats32, made: Floats32) -> None:
    """Fill in products [R, N] in the scales of their rows [R] and columns [N], plus bias [N]."""
    for r in range(len(made)):
        for n in range(made.shape[1]):
            made[r, n] = np.float32(products[r, n]) * (rows[r] * columns[n]) + bias[n]
