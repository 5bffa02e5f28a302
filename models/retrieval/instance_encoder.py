"""Instances of cells as features: what an instance is, how it looks, how large it is and where it lies."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import torch
from torch import Tensor, nn

from models.city.cells import CellTable
from models.city.points import ranges
from models.retrieval.layers import mlp

GEOMETRY = {"position": 8, "size": 3, "count": 1, "colour": 4}  # widths of the columns of `CellFeatures.geometry`
NUM_GEOMETRY = sum(GEOMETRY.values())


@dataclass(frozen=True, slots=True, eq=False)
class CellFeatures:
    """The instances of all cells of a gallery as numbers, one row an instance and cell; the encoder's input.

    Attributes:
        starts: [N + 1] int64, cell n has the rows starts[n] to starts[n + 1].
        geometry: [R, 16] float32: see GEOMETRY.
        label: [R] int64, index into `labels`.
        labels: L class names.
    """

    starts: npt.NDArray[Any]
    geometry: npt.NDArray[Any]
    label: npt.NDArray[Any]
    labels: tuple[str, ...]

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
        return cls(parts.starts, geometry, index.astype(np.int64), tuple(labels.tolist()))

    def __len__(self) -> int:
        return len(self.starts) - 1

    def batch(self, cells: npt.NDArray[Any]) -> "CellBatch":
        """Some cells, padded to the largest of them."""
        sizes = np.diff(self.starts)[cells]
        mask = np.arange(max(1, sizes.max())) < sizes[:, None]
        rows = ranges(self.starts[cells], self.starts[cells + 1])
        geometry = np.zeros((*mask.shape, NUM_GEOMETRY), dtype=np.float32)
        label = np.zeros(mask.shape, dtype=np.int64)
        geometry[mask], label[mask] = self.geometry[rows], self.label[rows]
        return CellBatch(torch.from_numpy(geometry), torch.from_numpy(label), torch.from_numpy(mask))


@dataclass(frozen=True, slots=True, eq=False)
class CellBatch:
    """Cells as padded tensors.

    Attributes:
        geometry: [B, I, 16] float32.
        label: [B, I] int64.
        mask: [B, I] bool, True where an instance is real.
    """

    geometry: Tensor
    label: Tensor
    mask: Tensor

    def to(self, device: torch.device) -> "CellBatch":
        """The same on a device."""
        return CellBatch(self.geometry.to(device), self.label.to(device), self.mask.to(device))


class InstanceEncoder(nn.Module):
    """Instance features F^C from position, size, point count, colour where known, and the label's text embedding.

    MNCL's point backbone section; differs: the label enters as text, so that any word can be a label,
    and the closest point to the cell's centre stands beside the instance's centre, because hints speak of
    closest points.
    """

    def __init__(self, label_width: int, width: int) -> None:
        super().__init__()
        self.branches = nn.ModuleDict({name: mlp(size, 64, width) for name, size in GEOMETRY.items()})
        self.label = mlp(label_width, width)
        self.merge = mlp((len(GEOMETRY) + 1) * width, width, width)

    def forward(self, geometry: Tensor, label_embedding: Tensor) -> Tensor:
        """Features [R, D].

        Args:
            geometry: [R, 16] columns of GEOMETRY.
            label_embedding: [R, W] text embedding of each instance's label.
        """
        columns = dict(zip(GEOMETRY, torch.split(geometry, list(GEOMETRY.values()), dim=-1), strict=True))
        parts = [branch(columns[name]) for name, branch in self.branches.items()]
        parts.append(self.label(label_embedding))
        merged: Tensor = self.merge(torch.cat([nn.functional.normalize(part, dim=-1) for part in parts], dim=-1))
        return merged
