"""BERT's encoder (Devlin et al., NAACL 2019), as much of it as runs MiniLM; its names are those of published weights.

Importing the same from transformers takes seven seconds of a CPU and 150 MB in every process that serves, indexes or
tests.
"""

import json
from pathlib import Path
from typing import Any, Self

import numpy.typing as npt
import torch
from pydantic import BaseModel
from torch import Tensor, nn

from models.files import let_go, map_arrays


class BertConfig(BaseModel):
    """What of a published config.json matters here."""

    hidden_size: int
    intermediate_size: int
    layer_norm_eps: float
    max_position_embeddings: int
    num_attention_heads: int
    num_hidden_layers: int
    pad_token_id: int
    type_vocab_size: int
    vocab_size: int


class Bert(nn.Module):
    """Word, place and kind of text into vectors, and layers of attention over them."""

    def __init__(self, config: BertConfig) -> None:
        super().__init__()
        self.config = config
        self._mapped: npt.NDArray[Any] | None = None
        self.embeddings = _Embeddings(config)
        self.encoder = nn.ModuleDict({"layer": nn.ModuleList(Layer(config) for _ in range(config.num_hidden_layers))})

    @classmethod
    def load(cls, directory: Path) -> Self:
        """Read config.json and map model.safetensors into memory, see `let_go`.

        Raises:
            OSError, ValueError: they are missing, or of another kind of model.
        """
        model = cls(BertConfig(**json.loads((directory / "config.json").read_text())))
        weights, wanted = map_arrays(directory / "model.safetensors")[0], model.state_dict()
        if missing := set(wanted) - set(weights):
            raise ValueError(f"{directory / 'model.safetensors'} has no {min(missing)}")
        model.load_state_dict({name: torch.from_numpy(weights[name]) for name in wanted}, assign=True)
        model._mapped = next(iter(weights.values()))
        return model

    def let_go(self) -> None:
        """Have the system forget the weights that it has read from the file, until they are looked at."""
        if self._mapped is not None:
            let_go(self._mapped)


class _Embeddings(nn.Module):
    """[S, T] token ids to [S, T, W]."""

    def __init__(self, config: BertConfig) -> None:
        super().__init__()
        width = config.hidden_size
        self.word_embeddings = nn.Embedding(config.vocab_size, width, padding_idx=config.pad_token_id)
        self.position_embeddings = nn.Embedding(config.max_position_embeddings, width)
        self.token_type_embeddings = nn.Embedding(config.type_vocab_size, width)
        self.LayerNorm = nn.LayerNorm(width, config.layer_norm_eps)

    def forward(self, input_ids: Tensor) -> Tensor:
        """All tokens are of the first kind of text."""
        words = self.word_embeddings(input_ids) + self.token_type_embeddings.weight[0]
        embedded: Tensor = self.LayerNorm(words + self.position_embeddings.weight[: input_ids.shape[1]])
        return embedded


class Layer(nn.Module):
    """Attention over all tokens, and two linear layers on each."""

    def __init__(self, config: BertConfig) -> None:
        super().__init__()
        width = config.hidden_size
        self.heads = config.num_attention_heads
        heads = nn.ModuleDict({name: nn.Linear(width, width) for name in ("query", "key", "value")})
        self.attention = nn.ModuleDict({"self": heads, "output": _added(width, width, config)})
        self.intermediate = nn.ModuleDict({"dense": nn.Linear(width, config.intermediate_size)})
        self.output = _added(config.intermediate_size, width, config)

    def forward(self, hidden: Tensor, shut: Tensor | None) -> Tensor:
        """[S, T, W] to [S, T, W]; shut [S, 1, 1, T] is added to attention, minus infinity where no token is."""
        size = (*hidden.shape[:2], self.heads, -1)
        heads: Any = self.attention["self"]
        query, key, value = (heads[name](hidden).view(size).transpose(1, 2) for name in ("query", "key", "value"))
        told = nn.functional.scaled_dot_product_attention(query, key, value, shut)
        hidden = _add(self.attention["output"], told.transpose(1, 2).flatten(2), hidden)
        return _add(self.output, nn.functional.gelu(self.intermediate["dense"](hidden)), hidden)


def _added(width: int, to: int, config: BertConfig) -> nn.ModuleDict:
    return nn.ModuleDict({"dense": nn.Linear(width, to), "LayerNorm": nn.LayerNorm(to, config.layer_norm_eps)})


def _add(output: Any, told: Tensor, hidden: Tensor) -> Tensor:
    """What a half of a layer adds, normalised with what went into it."""
    added: Tensor = output["LayerNorm"](output["dense"](told) + hidden)
    return added
