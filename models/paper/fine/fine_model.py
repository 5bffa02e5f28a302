"""The base class of the fine stages, which predict a position within a candidate cell from hints."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar, Literal

import numpy as np
import numpy.typing as npt
import torch
from pydantic import BaseModel, ConfigDict, Field, field_validator
from torch import Tensor, nn

from models.language.recent_features import RecentFeatures
from models.language.text_encoder import DEFAULT_TEXT_ENCODER, TextEncoder, TokenFeatures
from models.paper.instance_encoder import (
    CLOSEST_DISTANCE_COLUMN,
    DEFAULT_INPUTS,
    CellBatch,
    CellFeatures,
    Input,
    InstanceEncoder,
    UncutCells,
    geometry_columns,
)
from models.paper.layers import HintEncoder
from models.paper.point_encoder import PointArchitecture
from models.paper.point_model import PointModel, build_point_encoder, check_point_option

HINT_CACHE_SIZE = 20_000  # sentences; 10 MB at D = 128
PAIRS_PER_BATCH = 1024  # pairs of description and cell; bounds the memory of a prediction
Offsets = npt.NDArray[np.float64]
FineMethod = Literal["regressor", "matching"]


class FineConfig(BaseModel):
    """Configuration common to all fine stages."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    text_encoder: str = DEFAULT_TEXT_ENCODER  # "minilm", a directory or a hub id
    width: int = Field(default=128, ge=1)  # D
    # features of an instance, see `InstanceEncoder`; "points" adds a `PointEncoder`
    inputs: tuple[Input, ...] = Field(default=DEFAULT_INPUTS, min_length=1)
    # the point encoder, see `PointEncoder`: ours is "small", that of the papers is "official"
    point_encoder: PointArchitecture = "small"
    # whether the point encoder keeps the weights of its training as a classifier; False trains it further, as the
    # papers do, on points drawn anew in each step
    points_frozen: bool = True
    # whether a linear map of the geometry is added to the features of the instances, because their normalisation blurs
    # coordinates; False in the papers
    plain: bool = True
    # number of instances of a cell to use, those nearest to its centre; None for all, which is more accurate than the
    # 16 of the paper
    max_instances: int | None = Field(default=None, ge=1)
    rounds: int = Field(default=2, ge=1)  # rounds of cross-attention between hints and instances
    heads: int = Field(default=4, ge=1)  # of the attention
    dropout: float = Field(default=0.1, ge=0, lt=1)  # of the attention layers in training
    # standard deviation of a coordinate in metres, given the right cell; measured on validation data
    error_m: float | None = None

    _check_point_option = field_validator("point_encoder", "points_frozen")(check_point_option)


@dataclass(frozen=True, slots=True, eq=False)
class InstanceFeatures:
    """Encoded instances of B cells."""

    features: Tensor  # [B, I, D]
    geometry: Tensor  # [B, I, 16], see `models.paper.instance_encoder.GEOMETRY_WIDTHS`
    mask: Tensor  # [B, I] bool, True where an instance is real
    order: Tensor  # [B, I] int64, column of each instance in the batch of cells

    @property
    def center(self) -> Tensor:
        """Centres [B, I, 2] of the instances, in cell units (0..1 inside)."""
        return self.geometry[..., :2] / 2 + 0.5

    def take(self, rows: Tensor) -> "InstanceFeatures":
        """Return some of the cells, in the given order."""
        return InstanceFeatures(self.features[rows], self.geometry[rows], self.mask[rows], self.order[rows])

    def match_mask(self, targets: "FineTargets", hint_mask: Tensor) -> Tensor:
        """Return a mask [B, H, I], True where a real hint (hint_mask [B, H]) refers to an instance."""
        is_match = self.order[:, None, :] == targets.match[:, :, None]
        return is_match & self.mask[:, None, :] & hint_mask[..., None]


@dataclass(frozen=True, slots=True, eq=False)
class FineTargets:
    """The training targets of B descriptions and their cells."""

    offset: Tensor  # [B, 2] true position in the cell, 0..1
    # [B, H] int64, column in the batch of cells of the instance that each hint refers to; -1 if the cell does not
    # contain it
    match: Tensor


class FineModel(PointModel):
    """A fine stage; subclasses define how a position follows from hints and instances."""

    method: ClassVar[FineMethod]
    config_type: ClassVar[type[FineConfig]]
    config: FineConfig

    def __init__(self, text_encoder: TextEncoder, config: FineConfig) -> None:
        super().__init__(text_encoder)
        self.config = config
        self._hint_cache = RecentFeatures(self._read_sentences, HINT_CACHE_SIZE)
        self._label_cache: dict[tuple[str, ...], Tensor] = {}
        self.hint_encoder = HintEncoder(text_encoder.width, config.width, config.dropout)
        self.points = build_point_encoder(config)
        self.instance_encoder = InstanceEncoder(text_encoder.width, config.width, config.inputs)
        self.columns = geometry_columns(config.inputs)
        self.geometry = nn.Linear(len(self.columns), config.width) if config.plain else None
        self.rounds = nn.ModuleList(
            CrossAttentionRound(config.width, config.heads, config.dropout) for _ in range(config.rounds)
        )

    def locate(self, hints: Tensor, hint_mask: Tensor, instances: InstanceFeatures) -> Tensor:
        """Return positions [B, 2] in the cells, 0..1 inside, from hints [B, H, D] and their mask [B, H]."""
        raise NotImplementedError

    def loss(self, hints: Tensor, hint_mask: Tensor, instances: InstanceFeatures, targets: FineTargets) -> Tensor:
        """Return the training loss, a scalar; arguments as `locate`."""
        raise NotImplementedError

    @property
    def needs_matches(self) -> bool:
        """Whether `loss` uses `FineTargets.match`."""
        return True

    @property
    def error_m(self) -> float | None:
        """Standard deviation of a coordinate in metres, see FineConfig."""
        return self.config.error_m

    @property
    def device(self) -> torch.device:
        """The device of the weights."""
        return next(self.parameters()).device

    def train(self, mode: bool = True) -> "FineModel":
        """Switch between training and evaluation, and clear the cached features of the previous weights."""
        self._hint_cache.clear()
        return super().train(mode)

    def embed_hints(self, tokens: TokenFeatures) -> Tensor:
        """Return features [S, D] of hint sentences, each encoded alone."""
        features: Tensor = self.hint_encoder(tokens.values.to(self.device), tokens.mask.to(self.device))
        return features

    def embed_instances(self, cells: CellBatch, label_embeddings: Tensor) -> InstanceFeatures:
        """Encode the instances of padded cells, at most `max_instances` per cell; label_embeddings is [L, W]."""
        order = nearest_instances(cells, self.config.max_instances)
        row = torch.arange(len(order), device=order.device)[:, None]
        geometry, mask = cells.geometry[row, order], cells.mask[row, order]
        real, label = geometry[mask], cells.label[row, order][mask]
        encoded = self.instance_encoder(real, label_embeddings[label], cells.point_features[row, order][mask])
        if self.geometry is not None:
            encoded = encoded + self.geometry(real[:, self.columns])
        features = encoded.new_zeros(*mask.shape, self.config.width)
        features[mask] = encoded
        return InstanceFeatures(features, geometry, mask, order)

    def cross_attend(self, hints: Tensor, hint_mask: Tensor, instances: InstanceFeatures) -> tuple[Tensor, Tensor]:
        """Return hints [B, H, D] and instances [B, I, D] after all rounds of cross-attention."""
        features = instances.features
        for layer in self.rounds:
            hints, features = layer(hints, hint_mask, features, instances.mask)
        return hints, features

    @torch.inference_mode()
    def predict(
        self,
        descriptions: Sequence[Sequence[str]],
        cells: CellFeatures | UncutCells,
        rows: npt.NDArray[np.integer[Any]],
    ) -> Offsets:
        """Predict the position of each of Q descriptions in each of its candidate cells.

        Args:
            descriptions: lists of hint sentences, any number in any order.
            cells: the gallery.
            rows: [Q, J] candidate cells; -1 for none.

        Returns:
            Offsets [Q, J, 2], clipped to the cell (0..1); the centre where there is no cell.
        """
        labels = self._embed(cells.labels)
        hint_features = self._hint_cache(hint for hints in descriptions for hint in hints)
        offsets = np.full((*rows.shape, 2), 0.5)
        # Sorted by the number of hints, to compute little for padding.
        pairs = np.argwhere(rows >= 0)
        pairs = pairs[np.argsort([len(descriptions[q]) for q in pairs[:, 0]], kind="stable")]
        for start in range(0, len(pairs), PAIRS_PER_BATCH):
            q, j = pairs[start : start + PAIRS_PER_BATCH].T
            cell_rows, of_pair = np.unique(rows[q, j], return_inverse=True)
            batch = cells.batch(cell_rows).to(self.device)
            instances = self.embed_instances(batch, labels).take(torch.from_numpy(of_pair))
            # Sorted, so that the result does not depend on the order of the hints.
            hints, mask = _stack([[hint_features[hint] for hint in sorted(descriptions[n])] for n in q])
            offsets[q, j] = self.locate(hints, mask, instances).clamp(0, 1).cpu().numpy()
        return offsets

    def _read_sentences(self, sentences: Sequence[str]) -> Tensor:
        return self.embed_hints(self.text_encoder(sentences))

    def _embed(self, labels: tuple[str, ...]) -> Tensor:
        if labels not in self._label_cache:
            self._label_cache = {labels: self.text_encoder.embed(labels)}  # of the last gallery only
        return self._label_cache[labels].to(self.device)


class CrossAttentionRound(nn.Module):
    """Instances attend to the hints, then the hints to the updated instances (Text2Loc, cascaded cross-attention).

    Each step is self-attention, cross-attention and a feed-forward layer. Differs from the released code: padding is
    masked, and the norms come before the layers, which trains faster.
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
        """Update hints [B, H, D] and instances [B, I, D] with masks [B, H] and [B, I], True where an entry is real."""
        no_hint, no_instance = ~hint_mask, ~instance_mask
        instances = self.of_instances(
            instances, hints, tgt_key_padding_mask=no_instance, memory_key_padding_mask=no_hint
        )
        hints = self.of_hints(hints, instances, tgt_key_padding_mask=no_hint, memory_key_padding_mask=no_instance)
        return hints, instances


def nearest_instances(cells: CellBatch, count: int | None) -> Tensor:
    """Return columns [B, min(I, count)] of the instances nearest to the centre of their cell, nearest first."""
    distance = cells.geometry[..., CLOSEST_DISTANCE_COLUMN].masked_fill(~cells.mask, float("inf"))
    return distance.argsort(dim=1, stable=True)[:, :count]


def _stack(hints: list[list[Tensor]]) -> tuple[Tensor, Tensor]:
    """Pad the hints of descriptions to features [B, H, D] with mask [B, H]."""
    features = nn.utils.rnn.pad_sequence([torch.stack(sequence) for sequence in hints], batch_first=True)
    sizes = torch.tensor([len(sequence) for sequence in hints], device=features.device)
    return features, torch.arange(features.shape[1], device=features.device) < sizes[:, None]
