"""The retriever: descriptions and cells as unit vectors, near each other where they belong together."""

import hashlib
from collections import OrderedDict
from collections.abc import Sequence

import numpy as np
import torch
from pydantic import BaseModel, ConfigDict
from torch import Tensor, nn

from models.language.text_encoder import DEFAULT_TEXT_ENCODER, TextEncoder, fingerprint_of
from models.retrieval.hint_encoder import HintEncoder
from models.retrieval.instance_encoder import CellBatch, CellFeatures, InstanceEncoder
from models.retrieval.layers import SetTransformer, masked_max

HINT_CACHE_SIZE = 20_000  # sentences; 20 MB at D = 256
ENCODE_BATCH = 256  # cells


class RetrieverConfig(BaseModel):
    """Shape of a retriever.

    Attributes:
        text_encoder: "minilm", a directory or a hub id.
        width: D, size of the vectors.
        cell_layers: attention layers over the instances of a cell.
        hint_layers: attention layers over the hints of a description.
        dropout: in the attention layers, while training.
        temperature: of a description of one hint, see `Retriever.temperature`; fitted on validation data.
        temperature_decay: how fast it falls with more hints; fitted on validation data.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    text_encoder: str = DEFAULT_TEXT_ENCODER
    width: int = 256
    cell_layers: int = 2
    hint_layers: int = 1
    dropout: float = 0.1
    temperature: float = 0.2
    temperature_decay: float = 1.0


class Retriever(nn.Module):
    """MNCL's retriever, first form: one global vector a description and one a cell.

    The frozen text encoder is used, not owned: its weights are neither trained nor saved here.
    """

    def __init__(self, text_encoder: TextEncoder, config: RetrieverConfig) -> None:
        super().__init__()
        self.config = config
        self._text = (text_encoder,)  # a tuple hides it from state_dict
        self.hints = HintEncoder(text_encoder.width, config.width, config.dropout)
        self.description = SetTransformer(config.width, config.hint_layers, num_heads=4, dropout=config.dropout)
        self.instances = InstanceEncoder(text_encoder.width, config.width)
        self.cell = SetTransformer(config.width, config.cell_layers, num_heads=4, dropout=config.dropout)
        self._hint_cache: OrderedDict[str, Tensor] = OrderedDict()

    @property
    def name(self) -> str:
        """What kind of model this is, for people."""
        return f"retriever/{self.text_encoder.source}/{self.config.width}"

    @property
    def fingerprint(self) -> str:
        """sha256 of all weights, the frozen ones included: what makes two models give the same vectors."""
        return hashlib.sha256((fingerprint_of(self) + self.text_encoder.fingerprint).encode()).hexdigest()

    @property
    def text_encoder(self) -> TextEncoder:
        """The frozen language model."""
        return self._text[0]

    def temperature(self, num_hints: int) -> float:
        """T for which softmax(similarity / T) over a gallery is the probability of each cell.

        A similarity is a cosine however much was said, so more hints make the same difference mean more:
        T = temperature * num_hints ** -temperature_decay.
        """
        decay: float = num_hints**-self.config.temperature_decay
        return self.config.temperature * decay

    def train(self, mode: bool = True) -> "Retriever":
        """Switch between training and evaluation; features cached under other weights are forgotten."""
        self._hint_cache.clear()
        return super().train(mode)

    def pool_hints(self, hints: Tensor, mask: Tensor) -> Tensor:
        """[B, D] unit vectors of descriptions from hint features [B, H, D] with mask [B, H]."""
        return nn.functional.normalize(masked_max(hints + self.description(hints, mask), mask), dim=-1)

    def pool_instances(self, batch: CellBatch, label_embeddings: Tensor) -> Tensor:
        """[B, D] unit vectors of cells.

        Args:
            batch: padded cells.
            label_embeddings: [L, W] text embedding of each label.
        """
        mask = batch.mask
        features = batch.geometry.new_zeros(*mask.shape, self.config.width)
        features[mask] = self.instances(batch.geometry[mask], label_embeddings[batch.label[mask]])  # real ones only
        return nn.functional.normalize(masked_max(self.cell(features, mask), mask), dim=-1)

    @torch.inference_mode()
    def encode_descriptions(
        self, descriptions: Sequence[Sequence[str]]
    ) -> np.ndarray[tuple[int, int], np.dtype[np.float32]]:
        """[Q, D] float32 unit vectors of descriptions, each any number of hint sentences in any order."""
        features = self._hint_features(dict.fromkeys(hint for hints in descriptions for hint in hints))
        vectors = np.empty((len(descriptions), self.config.width), dtype=np.float32)
        for row, hints in enumerate(descriptions):
            # Alone and in one order: a description's bits depend on nothing but its hints.
            stacked = torch.stack([features[hint] for hint in sorted(hints)])[None]
            vectors[row] = self.pool_hints(stacked, torch.ones(1, len(hints), dtype=torch.bool))[0].numpy()
        return vectors

    @torch.inference_mode()
    def encode_cells(self, cells: CellFeatures) -> np.ndarray[tuple[int, int], np.dtype[np.float32]]:
        """[N, D] float32 unit vectors of a gallery, in batches of cells with about equally many instances."""
        label_embeddings = self.text_encoder.embed(cells.labels)
        order = np.argsort(np.diff(cells.starts), kind="stable")
        vectors = np.empty((len(cells), self.config.width), dtype=np.float32)
        for start in range(0, len(order), ENCODE_BATCH):
            rows = order[start : start + ENCODE_BATCH]
            vectors[rows] = self.pool_instances(cells.batch(rows), label_embeddings).numpy()
        return vectors

    def _hint_features(self, sentences: dict[str, None]) -> dict[str, Tensor]:
        """Features [D] of sentences; the frozen text encoder runs only for those not seen lately."""
        cache = self._hint_cache
        missing = [sentence for sentence in sentences if sentence not in cache]
        for start in range(0, len(missing), ENCODE_BATCH):
            batch = missing[start : start + ENCODE_BATCH]
            tokens = self.text_encoder(batch)
            cache.update(zip(batch, self.hints(tokens.values, tokens.mask), strict=True))
        features = {}
        for sentence in sentences:
            cache.move_to_end(sentence)
            features[sentence] = cache[sentence]
        while len(cache) > HINT_CACHE_SIZE:
            cache.popitem(last=False)
        return features
