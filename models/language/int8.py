"""Frozen attention layers in 8 bits: a quarter of the memory, and less arithmetic.

On a processor with VNNI a new description takes 38 ms of CPU less, of 78; others only save the memory.

Each output of a linear layer has a scale for its weights, and each input row has its own (the vector-wise quantization
of LLM.int8(): Dettmers et al., NeurIPS 2022), so other texts in the batch do not change a result.
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

ROW_STEP: Final = 8  # the rows of a product are padded to a multiple of this
HEADS: Final = ("query", "key", "value")
MAX_INT8: Final = 127  # largest absolute value of a signed byte
Floats32 = npt.NDArray[np.float32]


def _has_int8_products() -> bool:
    """Return whether the processor adds up 8-bit products in 32 bits; earlier ones saturate at 16."""
    capabilities: Mapping[str, Any] = getattr(torch.cpu, "get_capabilities", dict)()
    has_vnni = capabilities.get("avx512_vnni") or capabilities.get("avx_vnni")
    if not (torch.backends.mkldnn.is_available() and has_vnni):
        return False
    rows, weight = (torch.full((count, 1536), MAX_INT8, dtype=torch.int8) for count in (64, 384))
    # Whether oneDNN uses them depends on its configuration.
    return bool((torch._int_mm(rows, weight.T) == 1536 * MAX_INT8**2).all())


HAS_INT8_PRODUCTS: Final = _has_int8_products()


def can_quantize(layers: Iterable[nn.Module], values: Tensor) -> bool:
    """Return whether layers can run in 8 bits on these values: float32 on a CPU, without gradients."""
    is_plain = not torch.is_grad_enabled() and values.device.type == "cpu" and values.dtype == torch.float32
    return is_plain and all(isinstance(layer, Layer) for layer in layers)


def padded_rows(rows: int) -> int:
    """Return the padded number of rows: at most a quarter more, or the next multiple of ROW_STEP."""
    step = max(ROW_STEP, 1 << rows.bit_length() >> 3)
    return -(-rows // step) * step


class Int8Linear:
    """A linear layer [to, from] with weights and rows in 8 bits; processors agree up to rounding.

    Without `has_int8_products` of the processor, the integers are multiplied as floats.
    """

    def __init__(self, weight: Tensor, bias: Tensor, has_int8_products: bool = HAS_INT8_PRODUCTS) -> None:
        quantized, scale = quantize_rows(weight.detach().contiguous())
        self._scale, self._bias = scale, bias.detach().clone().numpy()
        self._weight = (quantized if has_int8_products else quantized.float()).T
        self._has_int8_products = has_int8_products

    def __call__(self, x: Tensor) -> Tensor:
        """Return [R, to] for rows [R, from]."""
        quantized, scale = quantize_rows(x)
        if self._has_int8_products:
            products = torch._int_mm(quantized, self._weight)
        else:
            products = quantized.float() @ self._weight
        out = np.empty((len(x), len(self._bias)), np.float32)
        _dequantize(products.numpy(), scale, self._scale, self._bias, out)
        return torch.from_numpy(out)


class Int8Embeddings:
    """The embeddings of a Bert with its word vectors in 8 bits, so that the float ones can be released."""

    def __init__(self, embeddings: Any) -> None:
        self._words, self._scale = quantize_rows(embeddings.word_embeddings.weight.detach())
        self._places = embeddings.position_embeddings.weight + embeddings.token_type_embeddings.weight[0]
        self._norm = copy.deepcopy(embeddings.LayerNorm)

    def __call__(self, ids: Tensor) -> Tensor:
        """Return [S, T, W] for token ids [S, T]."""
        words = self._words[ids].float() * torch.from_numpy(self._scale)[ids][..., None]
        embedded: Tensor = self._norm(words + self._places[: ids.shape[1]])
        return embedded


class Int8Layer:
    """A copy of a `bert.Layer` in 8 bits, with query, key and value in one matrix.

    oneDNN caches about a megabyte of machine code per number of rows, so rows are padded to few different numbers.
    """

    def __init__(self, layer: Any, weights: Mapping[str, Tensor] | None = None) -> None:
        own = {name: weight.detach() for name, weight in (weights or dict(layer.named_parameters())).items()}
        self._heads, self._eps = layer.heads, layer.output["LayerNorm"].eps
        heads = [f"attention.self.{name}" for name in HEADS]
        weight, bias = (torch.cat([own[f"{name}.{part}"] for name in heads]) for part in ("weight", "bias"))
        self._query_key_value = Int8Linear(weight, bias)
        self._mixed, self._wide, self._narrow = (
            Int8Linear(own[f"{name}.weight"], own[f"{name}.bias"])
            for name in ("attention.output.dense", "intermediate.dense", "output.dense")
        )
        self._norms = [
            (own[f"{name}.LayerNorm.weight"].clone(), own[f"{name}.LayerNorm.bias"].clone())
            for name in ("attention.output", "output")
        ]

    def __call__(self, x: Tensor, size: torch.Size, bias: Tensor | None) -> Tensor:
        """Transform rows [R, W], the first S * T of which are tokens; `bias` as returned by `attention_bias`."""
        texts, tokens, width = size
        heads = self._query_key_value(x)[: texts * tokens].view(texts, tokens, 3, self._heads, -1)
        query, key, value = heads.permute(2, 0, 3, 1, 4)
        attended = nn.functional.scaled_dot_product_attention(query, key, value, bias)
        rows = attended.transpose(1, 2).reshape(texts * tokens, width)
        rows = nn.functional.pad(rows, (0, 0, 0, len(x) - len(rows)))
        x = nn.functional.layer_norm(self._mixed(rows) + x, (width,), *self._norms[0], self._eps)
        wide = nn.functional.gelu(self._wide(x))
        return nn.functional.layer_norm(self._narrow(wide) + x, (width,), *self._norms[1], self._eps)


def run_int8_layers(layers: Iterable[Int8Layer], hidden: Tensor, mask: Tensor) -> Tensor:
    """Run layers on tokens [S, T, W]; the mask [S, T] is False at padding."""
    size = hidden.shape
    rows = size[0] * size[1]
    x = nn.functional.pad(hidden.reshape(rows, -1), (0, 0, 0, padded_rows(rows) - rows))
    bias = attention_bias(mask, hidden)
    for layer in layers:
        x = layer(x, size, bias)
    return x[:rows].view(size)


def attention_bias(mask: Tensor, hidden: Tensor) -> Tensor | None:
    """Return [S, 1, 1, T] to add to attention scores: minus infinity at padding; None without padding."""
    if mask.all():
        return None
    bias = torch.zeros(mask.shape, dtype=hidden.dtype, device=hidden.device).masked_fill(~mask, float("-inf"))
    return bias[:, None, None]


def quantize_rows(x: Tensor) -> tuple[Tensor, Floats32]:
    """Return rows [R, K] as int8, and the scale [R] of each row."""
    quantized, scale = np.empty(x.shape, np.int8), np.empty(len(x), np.float32)
    _quantize_rows(x.numpy(), quantized, scale)
    return torch.from_numpy(quantized), scale


@compiled
def _quantize_rows(x: Floats32, quantized: npt.NDArray[np.int8], scale: Floats32) -> None:
    bits, most = x.view(np.int32), scale.view(np.int32)  # without its sign a float is in the order of its bits
    for r in range(len(x)):
        top = np.int32(0)
        for k in range(x.shape[1]):
            magnitude = bits[r, k] & np.int32(0x7FFFFFFF)
            top = magnitude if magnitude > top else top
        most[r] = top
    for r in range(len(x)):
        scale[r] = np.float32(1) if scale[r] == 0 else scale[r] / np.float32(MAX_INT8)
        parts = np.float32(1) / scale[r]
        for k in range(x.shape[1]):
            quantized[r, k] = np.int8(np.rint(x[r, k] * parts))


@compiled
def _dequantize(products: Any, rows: Floats32, columns: Floats32, bias: Floats32, out: Floats32) -> None:
    """Fill `out` with products [R, N] times the scales of rows [R] and columns [N], plus the bias [N]."""
    for r in range(len(out)):
        for n in range(out.shape[1]):
            out[r, n] = np.float32(products[r, n]) * (rows[r] * columns[n]) + bias[n]
