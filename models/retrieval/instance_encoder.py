"""Instances of cells as features: what an instance is, how it looks, how large it is and where it lies."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt
import torch
from torch import Tensor, nn

from models.city.cells import CellTable
from models.city.point_sample import Sampler
from models.city.points import Ints, ranges
from models.errors import WeightsError
from models.retrieval.layers import mlp
from models.retrieval.point_encoder import PointEncoder

GEOMETRY = {"position": 8, "size": 3, "count": 1, "colour": 4}  # widths of the columns of `CellFeatures.geometry`
NUM_GEOMETRY = sum(GEOMETRY.values())
SEEN_AT_ONCE = 512  # instances whose points are looked at together, about


@dataclass(frozen=True, slots=True, eq=False)
class CellFeatures:
    """The instances of all cells of a gallery as numbers, one row an instance and cell; the encoder's input.

    Attributes:
        starts: [N + 1] int64, cell n has the rows starts[n] to starts[n + 1].
        geometry: [R, 16] float32: see GEOMETRY.
        label: [R] int64, index into `labels`.
        labels: L class names.
        sample: gives points of the instances, None where they are not at hand.
        shape: [R, S] what a point encoder makes of them, see `seen`; S = 0 without one.
    """

    starts: npt.NDArray[Any]
    geometry: npt.NDArray[Any]
    label: npt.NDArray[Any]
    labels: tuple[str, ...]
    sample: Sampler | None
    shape: npt.NDArray[Any]

    @classmethod
    def of(cls, cells: CellTable, instance_labels: npt.NDArray[Any]) -> "CellFeatures":
        """Features of a cell table.

        Args:
            cells: the gallery.
            instance_labels: [I] label of each instance of the map.
        """
        parts = cells.parts
        center = cells.center_m[parts.cube].astype(np.float32)
        half = cells.size_m / 2
        to_closest = (parts.closest_m - center)[:, :2] / half
        distance = np.linalg.norm(to_closest, axis=1, keepdims=True)
        known = ~np.isnan(parts.rgb).any(axis=1, keepdims=True)
        geometry = np.concatenate(
            [
                (parts.center_m - center) / half,
                to_closest,
                distance,
                to_closest / np.maximum(distance, 1e-3),
                (parts.high_m - parts.low_m) / cells.size_m,
                np.log1p(parts.count)[:, None] / 10,
                np.where(known, parts.rgb, 0.0),
                known,
            ],
            axis=1,
        ).astype(np.float32)
        labels, index = np.unique(instance_labels[parts.instance], return_inverse=True)
        shape = np.zeros((len(index), 0), dtype=np.float32)
        return cls(parts.starts, geometry, index.astype(np.int64), tuple(labels.tolist()), cells.sample, shape)

    def seen(self, encoder: PointEncoder) -> "CellFeatures":
        """The same with `shape`, computed a few cells at a time.

        Raises:
            WeightsError: the instances' points are not at hand.
        """
        device = next(encoder.parameters()).device
        ends = np.searchsorted(self.starts, np.arange(SEEN_AT_ONCE, self.starts[-1], SEEN_AT_ONCE))
        groups = np.split(np.arange(len(self)), np.unique(ends))
        with torch.inference_mode():
            parts = [encoder(self.points(cells).to(device)).cpu().numpy() for cells in groups if len(cells)]
        return replace(self, shape=np.concatenate(parts))

    def points(self, cells: Ints) -> Tensor:
        """[R, 256, 6] points of the instances of some cells.

        Raises:
            WeightsError: they are not at hand.
        """
        if self.sample is None:
            raise WeightsError(
                "these weights look at points (model.point_encoder), and these cells come without; "
                "take a map or a data set, or other weights"
            )
        return torch.from_numpy(self.sample(cells))

    def __len__(self) -> int:
        return len(self.starts) - 1

    def batch(self, cells: npt.NDArray[Any]) -> "CellBatch":
        """Some cells, padded to the largest of them."""
        sizes = np.diff(self.starts)[cells]
        mask = np.arange(max(1, sizes.max())) < sizes[:, None]
        rows = ranges(self.starts[cells], self.starts[cells + 1])
        geometry = np.zeros((*mask.shape, NUM_GEOMETRY), dtype=np.float32)
        label = np.zeros(mask.shape, dtype=np.int64)
        shape = np.zeros((*mask.shape, self.shape.shape[1]), dtype=np.float32)
        geometry[mask], label[mask], shape[mask] = self.geometry[rows], self.label[rows], self.shape[rows]
        return CellBatch(*(torch.from_numpy(column) for column in (geometry, label, mask, shape)))


@dataclass(frozen=True, slots=True, eq=False)
class CellBatch:
    """Cells as padded tensors.

    Attributes:
        geometry: [B, I, 16] float32.
        label: [B, I] int64.
        mask: [B, I] bool, True where an instance is real.
        shape: [B, I, S] float32, S = 0 without a point encoder.
    """

    geometry: Tensor
    label: Tensor
    mask: Tensor
    shape: Tensor

    def to(self, device: torch.device) -> "CellBatch":
        """The same on a device."""
        return CellBatch(*(x.to(device) for x in (self.geometry, self.label, self.mask, self.shape)))


class InstanceEncoder(nn.Module):
    """Instance features F^C from position, size, point count, colour where known, and the label's text embedding.

    MNCL's point backbone section; differs: the label enters as text, so that any word can be a label,
    and the closest point to the cell's centre stands beside the instance's centre, because hints speak of
    closest points. What a point encoder makes of the points is one more part.

    Args:
        label_width: W, of the text embeddings.
        width: D, of the features.
        shape_width: S, of the point encoder's features; 0 without one.
    """

    def __init__(self, label_width: int, width: int, shape_width: int = 0) -> None:
        super().__init__()
        self.branches = nn.ModuleDict({name: mlp(size, 64, width) for name, size in GEOMETRY.items()})
        self.label = mlp(label_width, width)
        self.shape = mlp(shape_width, width) if shape_width else None
        self.merge = mlp((len(GEOMETRY) + 1 + bool(shape_width)) * width, width, width)

    def padded(self, batch: CellBatch, label_embeddings: Tensor) -> Tensor:
        """[B, I, D] features of cells, 0 at padding; `label_embeddings` [L, W] of each label."""
        mask = batch.mask
        found = self(batch.geometry[mask], label_embeddings[batch.label[mask]], batch.shape[mask])
        features: Tensor = found.new_zeros(*mask.shape, found.shape[-1])
        features[mask] = found
        return features

    def forward(self, geometry: Tensor, label_embedding: Tensor, shape: Tensor | None = None) -> Tensor:
        """Features [R, D].

        Args:
            geometry: [R, 16] columns of GEOMETRY.
            label_embedding: [R, W] text embedding of each instance's label.
            shape: [R, S] of the point encoder.
        """
        columns = dict(zip(GEOMETRY, torch.split(geometry, list(GEOMETRY.values()), dim=-1), strict=True))
        parts = [branch(columns[name]) for name, branch in self.branches.items()]
        parts.append(self.label(label_embedding))
        if self.shape is not None:
            if shape is None or not shape.shape[-1]:
                raise ValueError("cells without what the point encoder makes of them; call Retriever.seen first")
            parts.append(self.shape(shape))
        merged: Tensor = self.merge(torch.cat([nn.functional.normalize(part, dim=-1) for part in parts], dim=-1))
        return merged
