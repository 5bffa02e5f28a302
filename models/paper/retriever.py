"""The base class of the retrievers, which embed descriptions and cells in one vector space."""

from collections.abc import Iterator, Mapping, Sequence
from typing import ClassVar

import numpy as np
import numpy.typing as npt
import torch
from pydantic import BaseModel, ConfigDict, Field, field_validator
from torch import Tensor
from torch.nn.utils.rnn import pad_sequence

from models.citymap.cells import CELLS_PER_BLOCK
from models.language.recent_features import RecentFeatures
from models.language.text_encoder import DEFAULT_TEXT_ENCODER, TextEncoder, TokenFeatures
from models.paper.instance_encoder import DEFAULT_INPUTS, CellBatch, CellFeatures, Input
from models.paper.levels import Level, Levels, Matching, sum_of_z_scores
from models.paper.point_encoder import PointArchitecture
from models.paper.point_model import PointModel, build_point_encoder, check_point_option

HINT_CACHE_SIZE = 20_000  # sentences; 20 MB at D = 256
ENCODE_BATCH = 256  # cells or descriptions
Vectors = np.ndarray[tuple[int, int], np.dtype[np.float32]]


class RetrieverConfig(BaseModel):
    """Configuration common to all retrievers."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    text_encoder: str = DEFAULT_TEXT_ENCODER  # "minilm", a directory or a hub id
    width: int = Field(default=256, ge=4, multiple_of=4)  # D, size of the vectors
    # features of an instance, see `InstanceEncoder`; "points" adds a `PointEncoder`
    inputs: tuple[Input, ...] = Field(default=DEFAULT_INPUTS, min_length=1)
    # the point encoder, see `PointEncoder`: ours is "small", that of the papers is "official"
    point_encoder: PointArchitecture = "small"
    # whether the point encoder keeps the weights of its training as a classifier; False trains it further, as the
    # papers do, on points drawn anew in each step
    points_frozen: bool = True
    # weight of each of `Retriever.levels` in the score of a cell, fitted on validation data; if empty, the z-scores of
    # the levels over the gallery are added
    level_weights: tuple[float, ...] = ()
    temperature: float = 0.2  # for a description of one hint, see `Retriever.temperature`; fitted on validation data
    temperature_decay: float = 1.0  # how fast the temperature falls with more hints; fitted on validation data
    # the same for a ranking by the global level alone; None if it is the only level
    global_temperature: float | None = None
    global_temperature_decay: float | None = None

    _check_point_option = field_validator("point_encoder", "points_frozen")(check_point_option)


class Retriever(PointModel):
    """A retriever; subclasses define the text branch, the cell branch and the loss."""

    method: ClassVar[str]
    config_type: ClassVar[type[RetrieverConfig]]

    def __init__(self, text_encoder: TextEncoder, config: RetrieverConfig) -> None:
        super().__init__(text_encoder)
        self.config = config
        self.points = build_point_encoder(config)
        self._hint_cache = RecentFeatures(self._read_sentences, HINT_CACHE_SIZE)

    @property
    def levels(self) -> tuple[Level, ...]:
        """The levels that `embed_texts` and `embed_cells` compute."""
        return ("global",)

    @property
    def matching(self) -> Matching:
        """How the vectors of levels other than the global one are compared, see `set_similarity`."""
        return "hints"

    @property
    def reads_whole_text(self) -> bool:
        """Whether descriptions are read as one text, so that the order of their hints matters."""
        return False

    def pop_loss_figures(self) -> dict[str, float]:
        """Return figures of the loss since the last call, to report with a validation."""
        return {}

    def global_only(self) -> "Retriever":
        """Return the model reduced to the global level, which is faster; it shares the weights."""
        return self

    def embed_hints(self, tokens: TokenFeatures) -> Tensor:
        """Return features [S, F] of hint sentences, each encoded alone; F is D for most retrievers."""
        raise NotImplementedError

    def embed_texts(self, hints: Tensor, mask: Tensor) -> Levels:
        """Return the vectors of descriptions from hints [B, H, D] of `embed_hints` with their mask [B, H]."""
        raise NotImplementedError

    def embed_cells(self, batch: CellBatch, label_embeddings: Tensor) -> Levels:
        """Return the vectors of padded cells; label_embeddings [L, W] has the text embedding of each label."""
        raise NotImplementedError

    def loss(self, text: Levels, cells: Levels, same_cell: Tensor) -> Tensor:
        """Return the loss of B descriptions with their cells; pairs with same_cell [B, B] are not negatives."""
        raise NotImplementedError

    def combine(self, scores: Mapping[Level, Vectors]) -> Vectors:
        """Combine similarities [Q, C] by level into one score per cell.

        With `level_weights`, the score of a cell does not depend on the other cells, as an index needs; without, the
        z-scores of the levels over the cells are added (MNCL's code).
        """
        if self.levels == ("global",):
            return scores["global"]
        if not self.config.level_weights:
            summed: Vectors = sum_of_z_scores({n: torch.from_numpy(scores[n]) for n in self.levels}).numpy()
            return summed
        weighted = [w * scores[level] for w, level in zip(self.config.level_weights, self.levels, strict=True)]
        combined: Vectors = np.sum(weighted, axis=0, dtype=np.float32)
        return combined

    def temperature(self, num_hints: int, global_only: bool = False) -> float:
        """Return the T for which softmax(score / T) over a gallery is the probability of each cell.

        The same difference of cosines means more with more hints: T = temperature * num_hints ** -temperature_decay.
        `global_only`: cells are ranked by the global level, although the retriever has others.
        """
        config = self.config
        one_hint, decay = config.temperature, config.temperature_decay
        if global_only and config.global_temperature is not None and config.global_temperature_decay is not None:
            one_hint, decay = config.global_temperature, config.global_temperature_decay
        return float(one_hint * num_hints**-decay)

    def train(self, mode: bool = True) -> "Retriever":
        """Switch between training and evaluation, and clear the cached features of the previous weights."""
        self._hint_cache.clear()
        return super().train(mode)

    @torch.inference_mode()
    def encode_description(self, hints: Sequence[str]) -> Levels:
        """Encode a description of any number of hint sentences, at all levels; B = 1."""
        features = self._hint_cache(hints)
        # Sorted, so that the result does not depend on the order of the hints, unless the text is read as a whole.
        ordered = hints if self.reads_whole_text else sorted(hints)
        stacked = torch.stack([features[hint] for hint in ordered])[None]
        return self.embed_texts(stacked, torch.ones(1, len(hints), dtype=torch.bool, device=stacked.device))

    @torch.inference_mode()
    def encode_texts(self, descriptions: Sequence[Sequence[str]]) -> list[Levels]:
        """Encode descriptions at all levels, each with B = 1; the text encoder runs once for all new sentences."""
        self._hint_cache(hint for hints in descriptions for hint in hints)
        return [self.encode_description(hints) for hints in descriptions]

    @torch.inference_mode()
    def encode_texts_padded(self, descriptions: Sequence[Sequence[str]]) -> list[Levels]:
        """Encode as `encode_texts` does, up to rounding, but in padded batches, which is faster; results on the CPU."""
        features = self._hint_cache(hint for hints in descriptions for hint in hints)
        row, table = {hint: n for n, hint in enumerate(features)}, torch.stack(list(features.values()))
        encoded: list[Levels] = []
        for start in range(0, len(descriptions), ENCODE_BATCH):
            rows = [torch.tensor([row[hint] for hint in hints]) for hints in descriptions[start : start + ENCODE_BATCH]]
            hints = pad_sequence(rows, batch_first=True, padding_value=-1).to(table.device)
            encoded += self.embed_texts(table[hints], hints >= 0).split()
        return encoded

    @torch.inference_mode()
    def encode_cells(
        self, cells: CellFeatures, label_embeddings: Tensor, first: int
    ) -> Iterator[tuple[npt.NDArray[np.intp], Levels]]:
        """Encode a block of a gallery from `with_point_features`; yield the rows and levels of each batch.

        Batches have cells of similar size and never span two blocks, so that shards that end at blocks give the same
        bits as the whole gallery. `first` is the row of the first cell of the block.
        """
        sizes = np.diff(cells.starts[first : first + CELLS_PER_BLOCK + 1])
        order = first + np.argsort(sizes, kind="stable")
        for start in range(0, len(order), ENCODE_BATCH):
            rows = order[start : start + ENCODE_BATCH]
            yield rows, self.embed_cells(cells.batch(rows).to(label_embeddings.device), label_embeddings)

    def cache_features(self, sentences: Sequence[str], features: Vectors) -> None:
        """Add features [S, D] of sentences, for example from an index, to the cache."""
        self._hint_cache.remember(sentences, torch.from_numpy(features))

    @torch.inference_mode()
    def encode_sentences(self, sentences: Sequence[str]) -> Vectors:
        """Return features [S, D] float32 of hint sentences, each encoded alone."""
        features = self._hint_cache(sentences)
        vectors: Vectors = torch.stack([features[sentence] for sentence in sentences]).cpu().numpy()
        return vectors

    def _read_sentences(self, sentences: Sequence[str]) -> Tensor:
        return self.embed_hints(self.text_encoder(sentences))
