"""What every model of the fine stage is: hints and a candidate cell into a position inside the cell."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar, Literal

import numpy as np
import numpy.typing as npt
import torch
from pydantic import BaseModel, ConfigDict, Field
from torch import Tensor, nn

from models.language.recent_features import RecentFeatures
from models.language.text_encoder import DEFAULT_TEXT_ENCODER, OnTextEncoder, TextEncoder, TokenFeatures
from models.paper.instance_encoder import (
    DISTANCE,
    OURS,
    CellBatch,
    CellFeatures,
    Input,
    InstanceEncoder,
    columns,
)
from models.paper.layers import HintEncoder
from models.paper.point_encoder import PointEncoder

HINT_CACHE_SIZE = 20_000  # sentences; 10 MB at D = 128
PAIRS = 1024  # of description and cell, located at once
Offsets = npt.NDArray[np.float64]
FineMethod = Literal["regressor", "matching"]


class FineConfig(BaseModel):
    """Shape of a model of the fine stage.

    Attributes:
        text_encoder: "minilm", a directory or a hub id.
        width: D.
        inputs: what of an instance is looked at, see `InstanceEncoder`; "points" needs a `PointEncoder`.
        plain: whether the instances' plain geometry is added to their features, whose normalising blurs coordinates;
            False is the papers'.
        max_instances: of a cell, those nearest to its centre; None for all of them, which measures better than the
            paper's 16.
        rounds: of cross-attention between hints and instances.
        heads: of the attention.
        dropout: in the attention layers, while training.
        error_m: standard deviation of a coordinate, metres, given the right cell; measured on validation data.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    text_encoder: str = DEFAULT_TEXT_ENCODER
    width: int = 128
    inputs: tuple[Input, ...] = Field(default=OURS, min_length=1)
    plain: bool = True
    max_instances: int | None = Field(default=None, ge=1)
    rounds: int = Field(default=2, ge=1)
    heads: int = 4
    dropout: float = 0.1
    error_m: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Instances:
    """What a model sees of B cells.

    Attributes:
        features: [B, I, D].
        geometry: [B, I, 16] see `models.paper.instance_encoder.GEOMETRY`.
        mask: [B, I] bool, True where an instance is real.
        order: [B, I] int64, its column in the batch of cells.
    """

    features: Tensor
    geometry: Tensor
    mask: Tensor
    order: Tensor

    @property
    def center(self) -> Tensor:
        """[B, I, 2] middle of each instance, in cells (0..1 inside)."""
        return self.geometry[..., :2] / 2 + 0.5

    def take(self, rows: Tensor) -> "Instances":
        """Some of the cells, in the given order."""
        return Instances(self.features[rows], self.geometry[rows], self.mask[rows], self.order[rows])

    def meant_by(self, truth: "Truth", hint_mask: Tensor) -> Tensor:
        """[B, H, I] bool, True where a hint, real by hint_mask [B, H], means an instance."""
        is_meant = self.order[:, None, :] == truth.match[:, :, None]
        return is_meant & self.mask[:, None, :] & hint_mask[..., None]


@dataclass(frozen=True, slots=True, eq=False)
class Truth:
    """What is known of B descriptions and their cells.

    Attributes:
        offset: [B, 2] true position in the cell, 0..1.
        match: [B, H] int64, column in the batch of cells of the instance that each hint means; -1 if the cell lacks it.
    """

    offset: Tensor
    match: Tensor


class FineModel(OnTextEncoder):
    """A model of the fine stage; subclasses say how hints and instances meet."""

    method: ClassVar[FineMethod]
    config_type: ClassVar[type[FineConfig]]
    config: FineConfig

    def __init__(self, text_encoder: TextEncoder, config: FineConfig) -> None:
        super().__init__(text_encoder)
        self.config = config
        self._hint_cache = RecentFeatures(self._read_sentences, HINT_CACHE_SIZE)
        self._label_cache: dict[tuple[str, ...], Tensor] = {}
        self.hint_encoder = HintEncoder(text_encoder.width, config.width, config.dropout)
        self.points = PointEncoder().requires_grad_(False) if "points" in config.inputs else None
        self.instance_encoder = InstanceEncoder(text_encoder.width, config.width, config.inputs)
        self.columns = columns(config.inputs)
        self.geometry = nn.Linear(len(self.columns), config.width) if config.plain else None
        self.rounds = nn.ModuleList(
            CrossAttentionRound(config.width, config.heads, config.dropout) for _ in range(config.rounds)
        )

    def locate(self, hints: Tensor, hint_mask: Tensor, instances: Instances) -> Tensor:
        """[B, 2] positions in the cells, 0..1 inside.

        Args:
            hints: [B, H, D] of `read`.
            hint_mask: [B, H] bool, True where a hint is real.
            instances: of `look`.
        """
        raise NotImplementedError

    def loss(self, hints: Tensor, hint_mask: Tensor, instances: Instances, truth: Truth) -> Tensor:
        """What training makes small, a scalar; arguments as `locate`."""
        raise NotImplementedError

    @property
    def needs_matches(self) -> bool:
        """Whether `loss` reads `Truth.match`."""
        return True

    @property
    def error_m(self) -> float | None:
        """See FineConfig."""
        return self.config.error_m

    @property
    def device(self) -> torch.device:
        """Where its weights are."""
        return next(self.parameters()).device

    def train(self, mode: bool = True) -> "FineModel":
        """Switch between training and evaluation; features cached under other weights are forgotten."""
        self._hint_cache.clear()
        return super().train(mode)

    def read(self, tokens: TokenFeatures) -> Tensor:
        """[S, D] features of hint sentences, each for itself."""
        features: Tensor = self.hint_encoder(tokens.values.to(self.device), tokens.mask.to(self.device))
        return features

    def seen(self, cells: CellFeatures) -> CellFeatures:
        """Cells as this model takes them, see `Retriever.seen`."""
        return cells.seen(self.points)

    def look(self, cells: CellBatch, label_embeddings: Tensor) -> Instances:
        """Features of the instances of cells, of no more than `max_instances`.

        Args:
            cells: padded cells.
            label_embeddings: [L, W] text embedding of each label.
        """
        order = nearest(cells, self.config.max_instances)
        row = torch.arange(len(order), device=order.device)[:, None]
        geometry, mask = cells.geometry[row, order], cells.mask[row, order]
        real, label, shape = geometry[mask], cells.label[row, order][mask], cells.shape[row, order][mask]
        found = self.instance_encoder(real, label_embeddings[label], shape)
        if self.geometry is not None:
            found = found + self.geometry(real[:, self.columns])
        features = found.new_zeros(*mask.shape, self.config.width)
        features[mask] = found
        return Instances(features, geometry, mask, order)

    def meet(self, hints: Tensor, hint_mask: Tensor, instances: Instances) -> tuple[Tensor, Tensor]:
        """Hints [B, H, D] and instances [B, I, D] after all rounds of cross-attention."""
        seen = instances.features
        for layer in self.rounds:
            hints, seen = layer(hints, hint_mask, seen, instances.mask)
        return hints, seen

    @torch.inference_mode()
    def predict(
        self, descriptions: Sequence[Sequence[str]], cells: CellFeatures, rows: npt.NDArray[np.integer[Any]]
    ) -> Offsets:
        """Where each description's position would be in each of some cells.

        Args:
            descriptions: Q lists of hint sentences, any number in any order.
            cells: the gallery.
            rows: [Q, J] cells to look into; -1 for none.

        Returns:
            [Q, J, 2] offsets, inside the cell (0..1: the nearest that is, which is never further from a position
            inside); the middle where there is no cell.
        """
        labels = self._embed(cells.labels)
        hint_features = self._hint_cache(hint for hints in descriptions for hint in hints)
        offsets = np.full((*rows.shape, 2), 0.5)
        # Descriptions of a like number of hints together, so that little is padding.
        asked = np.argwhere(rows >= 0)
        asked = asked[np.argsort([len(descriptions[q]) for q in asked[:, 0]], kind="stable")]
        for start in range(0, len(asked), PAIRS):
            q, j = asked[start : start + PAIRS].T
            kept, of_pair = np.unique(rows[q, j], return_inverse=True)
            seen = self.look(cells.batch(kept).to(self.device), labels).take(torch.from_numpy(of_pair))
            # In one order: an answer does not depend on the order of the hints.
            hints, mask = _stack([[hint_features[hint] for hint in sorted(descriptions[n])] for n in q])
            offsets[q, j] = self.locate(hints, mask, seen).clamp(0, 1).cpu().numpy()
        return offsets

    def _read_sentences(self, sentences: Sequence[str]) -> Tensor:
        return self.read(self.text_encoder(sentences))

    def _embed(self, labels: tuple[str, ...]) -> Tensor:
        if labels not in self._label_cache:
            self._label_cache = {labels: self.text_encoder.embed(labels)}  # one gallery at a time
        return self._label_cache[labels].to(self.device)


class CrossAttentionRound(nn.Module):
    """Instances look at the hints, then the hints at what the instances have become.

    Text2Loc, cascaded cross-attention transformer. Each look is self-attention, cross-attention and a feed-forward
    layer. Differs from its code: padding is masked, and the norms stand before the layers, which learns faster.
    """

    def __init__(self, width: int, num_heads: int, dropout: float) -> None:
        super().__init__()
        layer = partial(
            nn.TransformerDecoderLayer, width, num_heads, 4 * width, dropout, batch_first=True, norm_first=True
        )
        self.of_instances, self.of_hints = layer(), layer()

    def forward(
        self, hints: Tensor, hint_mask: Tensor, instances: Tensor, instance_mask: Tensor
    ) -> tuple[Tensor, Tensor]:
        """Hints [B, H, D] and instances [B, I, D] with masks [B, H] and [B, I], True where one is real."""
        no_hint, no_instance = ~hint_mask, ~instance_mask
        instances = self.of_instances(
            instances, hints, tgt_key_padding_mask=no_instance, memory_key_padding_mask=no_hint
        )
        hints = self.of_hints(hints, instances, tgt_key_padding_mask=no_hint, memory_key_padding_mask=no_instance)
        return hints, instances


def nearest(cells: CellBatch, count: int | None) -> Tensor:
    """[B, min(I, count)] columns of the instances nearest to the centre of their cell, nearest first."""
    distance = cells.geometry[..., DISTANCE].masked_fill(~cells.mask, float("inf"))
    return distance.argsort(dim=1, stable=True)[:, :count]


def _stack(hints: list[list[Tensor]]) -> tuple[Tensor, Tensor]:
    """Features [B, H, D] and mask [B, H] of descriptions with unlike numbers of hints."""
    features = nn.utils.rnn.pad_sequence([torch.stack(said) for said in hints], batch_first=True)
    sizes = torch.tensor([len(said) for said in hints], device=features.device)
    return features, torch.arange(features.shape[1], device=features.device) < sizes[:, None]
