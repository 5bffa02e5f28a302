"""What every retriever is: hint sentences and cells into vectors, near each other where they belong together."""

from collections.abc import Iterator, Mapping, Sequence
from typing import ClassVar

import numpy as np
import numpy.typing as npt
import torch
from pydantic import BaseModel, ConfigDict, Field
from torch import Tensor
from torch.nn.utils.rnn import pad_sequence

from models.citymap.cells import BLOCK
from models.language.recent_features import RecentFeatures
from models.language.text_encoder import DEFAULT_TEXT_ENCODER, OnTextEncoder, TextEncoder, TokenFeatures
from models.paper.instance_encoder import OURS, CellBatch, CellFeatures, Input
from models.paper.levels import Level, Levels, sum_of_z_scores
from models.paper.point_encoder import PointEncoder

HINT_CACHE_SIZE = 20_000  # sentences; 20 MB at D = 256
ENCODE_BATCH = 256  # cells, or descriptions
Vectors = np.ndarray[tuple[int, int], np.dtype[np.float32]]


class RetrieverConfig(BaseModel):
    """What every retriever can be told.

    Attributes:
        text_encoder: "minilm", a directory or a hub id.
        width: D, size of the vectors.
        inputs: what of an instance is looked at, see `InstanceEncoder`; "points" needs a `PointEncoder`.
        level_weights: of each level in a cell's score, in order of `Retriever.levels`; fitted on validation data; empty
            until then: the levels' z-scores over the gallery are added.
        temperature: of a description of one hint, see `Retriever.temperature`; fitted on validation data.
        temperature_decay: how fast it falls with more hints; fitted on validation data.
        global_temperature, global_temperature_decay: the same where cells are ranked by the global level alone; None
            where that is the only one.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    text_encoder: str = DEFAULT_TEXT_ENCODER
    width: int = 256
    inputs: tuple[Input, ...] = Field(default=OURS, min_length=1)
    level_weights: tuple[float, ...] = ()
    temperature: float = 0.2
    temperature_decay: float = 1.0
    global_temperature: float | None = None
    global_temperature_decay: float | None = None


class Retriever(OnTextEncoder):
    """A retriever; subclasses say how hints are read, described and compared with cells."""

    method: ClassVar[str]
    config_type: ClassVar[type[RetrieverConfig]]

    def __init__(self, text_encoder: TextEncoder, config: RetrieverConfig) -> None:
        super().__init__(text_encoder)
        self.config = config
        self.points = PointEncoder().requires_grad_(False) if "points" in config.inputs else None
        self._hint_cache = RecentFeatures(self._read_sentences, HINT_CACHE_SIZE)

    @property
    def levels(self) -> tuple[Level, ...]:
        """The levels that `describe` and `look` give."""
        return ("global",)

    def global_alone(self) -> "Retriever":
        """The same model, weights and all, that makes the global level only, which is a part of the work."""
        return self

    def read(self, tokens: TokenFeatures) -> Tensor:
        """[S, D] features of hint sentences, each for itself."""
        raise NotImplementedError

    def describe(self, hints: Tensor, mask: Tensor) -> Levels:
        """Descriptions from features of their hints.

        Args:
            hints: [B, H, D] of `read`.
            mask: [B, H] bool, True where a hint is real.
        """
        raise NotImplementedError

    def look(self, batch: CellBatch, label_embeddings: Tensor) -> Levels:
        """Cells from their instances.

        Args:
            batch: padded cells.
            label_embeddings: [L, W] text embedding of each label.
        """
        raise NotImplementedError

    def loss(self, text: Levels, cells: Levels, same_cell: Tensor) -> Tensor:
        """What training makes small, a scalar.

        Args:
            text: B descriptions.
            cells: the cell of each.
            same_cell: [B, B] bool, True where two rows belong to one cell; such pairs are no negatives.
        """
        raise NotImplementedError

    def combine(self, scores: Mapping[Level, Vectors]) -> Vectors:
        """[Q, C] the levels' similarities with C cells in one score.

        Weighted by `level_weights`, a cell's score does not depend on which others stand beside it, so that an index
        can serve it; without, the levels' z-scores among the cells are added (MNCL's code).

        Args:
            scores: [Q, C] by level.
        """
        if self.levels == ("global",):
            return scores["global"]
        if not self.config.level_weights:
            summed: Vectors = sum_of_z_scores({n: torch.from_numpy(scores[n]) for n in self.levels}).numpy()
            return summed
        weighted = [w * scores[level] for w, level in zip(self.config.level_weights, self.levels, strict=True)]
        combined: Vectors = np.sum(weighted, axis=0, dtype=np.float32)
        return combined

    def temperature(self, num_hints: int, global_alone: bool = False) -> float:
        """T for which softmax(score / T) over a gallery is the probability of each cell.

        A similarity is a cosine however much was said, so more hints make the same difference mean more:
        T = temperature * num_hints ** -temperature_decay.

        Args:
            num_hints: of the description.
            global_alone: whether cells are ranked by the global level, though the retriever has others.
        """
        config = self.config
        of_one, decay = config.temperature, config.temperature_decay
        if global_alone and config.global_temperature is not None and config.global_temperature_decay is not None:
            of_one, decay = config.global_temperature, config.global_temperature_decay
        return float(of_one * num_hints**-decay)

    def train(self, mode: bool = True) -> "Retriever":
        """Switch between training and evaluation; features cached under other weights are forgotten."""
        self._hint_cache.clear()
        return super().train(mode)

    def seen(self, cells: CellFeatures) -> CellFeatures:
        """Cells as this model takes them: with what its point encoder makes of their points, if it has one.

        Raises:
            WeightsError: it has one, and the points are not at hand.
        """
        return cells.seen(self.points)

    @torch.inference_mode()
    def encode_description(self, hints: Sequence[str]) -> Levels:
        """One description, any number of hint sentences in any order, at all levels; B = 1."""
        features = self._hint_cache(hints)
        # In one order: a description's bits depend on nothing but its hints.
        stacked = torch.stack([features[hint] for hint in sorted(hints)])[None]
        return self.describe(stacked, torch.ones(1, len(hints), dtype=torch.bool, device=stacked.device))

    @torch.inference_mode()
    def encode_texts(self, descriptions: Sequence[Sequence[str]]) -> list[Levels]:
        """Descriptions at all levels, each with B = 1; the text encoder runs once for all that is new to it."""
        self._hint_cache(hint for hints in descriptions for hint in hints)
        return [self.encode_description(hints) for hints in descriptions]

    @torch.inference_mode()
    def encode_together(self, descriptions: Sequence[Sequence[str]]) -> list[Levels]:
        """As `encode_texts`, but padded, many at a time, and on the CPU: faster, and the same up to rounding."""
        features = self._hint_cache(hint for hints in descriptions for hint in hints)
        row, table = {hint: n for n, hint in enumerate(features)}, torch.stack(list(features.values()))
        found: list[Levels] = []
        for start in range(0, len(descriptions), ENCODE_BATCH):
            said = [torch.tensor([row[hint] for hint in hints]) for hints in descriptions[start : start + ENCODE_BATCH]]
            hints = pad_sequence(said, batch_first=True, padding_value=-1).to(table.device)
            found += self.describe(table[hints], hints >= 0).each()
        return found

    def encode_descriptions(self, descriptions: Sequence[Sequence[str]]) -> Vectors:
        """[Q, D] float32 unit vectors of descriptions, the global level."""
        vectors: Vectors = np.concatenate([text.whole.cpu().numpy() for text in self.encode_texts(descriptions)])
        return vectors

    @torch.inference_mode()
    def encode_cells(
        self, cells: CellFeatures, label_embeddings: Tensor, first: int
    ) -> Iterator[tuple[npt.NDArray[np.intp], Levels]]:
        """A block of a gallery (`seen`) at all levels, in batches of about equal size: the rows of each, and it.

        No batch has cells of two blocks, so that a gallery that is cut at blocks gives the bits of the whole one.

        Args:
            cells: the gallery.
            label_embeddings: [L, W] what the text encoder makes of its labels.
            first: row of the block's first cell.
        """
        sizes = np.diff(cells.starts[first : first + BLOCK + 1])
        order = first + np.argsort(sizes, kind="stable")
        for start in range(0, len(order), ENCODE_BATCH):
            rows = order[start : start + ENCODE_BATCH]
            yield rows, self.look(cells.batch(rows).to(label_embeddings.device), label_embeddings)

    def remember(self, sentences: Sequence[str], features: Vectors) -> None:
        """Take up features [S, D] of sentences that were read before, so that they are not read again."""
        self._hint_cache.remember(sentences, torch.from_numpy(features))

    @torch.inference_mode()
    def encode_sentences(self, sentences: Sequence[str]) -> Vectors:
        """[S, D] float32 features of hint sentences, each for itself."""
        features = self._hint_cache(sentences)
        vectors: Vectors = torch.stack([features[sentence] for sentence in sentences]).cpu().numpy()
        return vectors

    def _read_sentences(self, sentences: Sequence[str]) -> Tensor:
        return self.read(self.text_encoder(sentences))
