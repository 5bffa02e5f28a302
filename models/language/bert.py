"""BERT's encoder (Devlin et al., NAACL 2019), the parts that MiniLM needs; modules are named as in published weights.

Importing transformers instead would take seven seconds of CPU time and 150 MB in every process.
"""

import json
from pathlib import Path
from typing import Any, Self

import torch
from pydantic import BaseModel
from torch import Tensor, nn

from models.files import map_arrays


class BertConfig(BaseModel):
    """The fields of a published config.json that the encoder uses."""

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
    """An encoder: embeddings of tokens and positions, then attention layers."""

    def __init__(self, config: BertConfig) -> None:
        super().__init__()
        self.config = config
        self.embeddings = _Embeddings(config)
        self.encoder = nn.ModuleDict({"layer": nn.ModuleList(Layer(config) for _ in range(config.num_hidden_layers))})

    @classmethod
    def load(cls, directory: Path) -> Self:
        """Read config.json and map model.safetensors; raise OSError or ValueError if they are no such model."""
        with torch.device("meta"):  # no random weights, which would move the random numbers of a training
            model = cls(BertConfig(**json.loads((directory / "config.json").read_text())))
        weights, wanted = map_arrays(directory / "model.safetensors")[0], model.state_dict()
        if missing := set(wanted) - set(weights):
            raise ValueError(f"{directory / 'model.safetensors'} has no {min(missing)}")
        model.load_state_dict({name: torch.from_numpy(weights[name]) for name in wanted}, assign=True)
        return model


class _Embeddings(nn.Module):
    """Embeddings [S, T, W] of token ids [S, T]."""

    def __init__(self, config: BertConfig) -> None:
        super().__init__()
        width = config.hidden_size
        self.word_embeddings = nn.Embedding(config.vocab_size, width, padding_idx=config.pad_token_id)
        self.position_embeddings = nn.Embedding(config.max_position_embeddings, width)
        self.token_type_embeddings = nn.Embedding(config.type_vocab_size, width)
        self.LayerNorm = nn.LayerNorm(width, config.layer_norm_eps)

    def forward(self, input_ids: Tensor) -> Tensor:
        """Embed tokens; all have token type 0."""
        words = self.word_embeddings(input_ids) + self.token_type_embeddings.weight[0]
        embedded: Tensor = self.LayerNorm(words + self.position_embeddings.weight[: input_ids.shape[1]])
        return embedded


class Layer(nn.Module):
    """A transformer layer: self-attention and a feed-forward network."""

    def __init__(self, config: BertConfig) -> None:
        super().__init__()
        width = config.hidden_size
        self.heads = config.num_attention_heads
        heads = nn.ModuleDict({name: nn.Linear(width, width) for name in ("query", "key", "value")})
        self.attention = nn.ModuleDict({"self": heads, "output": _output_layers(width, width, config)})
        self.intermediate = nn.ModuleDict({"dense": nn.Linear(width, config.intermediate_size)})
        self.output = _output_layers(config.intermediate_size, width, config)

    def forward(self, hidden: Tensor, attention_bias: Tensor | None) -> Tensor:
        """Transform [S, T, W]; `attention_bias` [S, 1, 1, T] is minus infinity at padding."""
        size = (*hidden.shape[:2], self.heads, -1)
        heads: Any = self.attention["self"]
        query, key, value = (heads[name](hidden).view(size).transpose(1, 2) for name in ("query", "key", "value"))
        attended = nn.functional.scaled_dot_product_attention(query, key, value, attention_bias)
        hidden = _add_and_normalize(self.attention["output"], attended.transpose(1, 2).flatten(2), hidden)
        return _add_and_normalize(self.output, nn.functional.gelu(self.intermediate["dense"](hidden)), hidden)


def _output_layers(width: int, out_width: int, config: BertConfig) -> nn.ModuleDict:
    return nn.ModuleDict(
        {"dense": nn.Linear(width, out_width), "LayerNorm": nn.LayerNorm(out_width, config.layer_norm_eps)}
    )


def _add_and_normalize(output: Any, attended: Tensor, hidden: Tensor) -> Tensor:
    """Return the normalised sum of a sublayer's output and its input."""
    added: Tensor = output["LayerNorm"](output["dense"](attended) + hidden)
    return added
