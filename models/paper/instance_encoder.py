"""Features of the instances of cells: class, colour, size, position and points."""

import hashlib
import logging
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
import torch
from torch import Tensor, nn

from models.citymap.cells import CELLS_PER_BLOCK, CellTable
from models.citymap.point_sample import FIXED_SAMPLING, PointSampling, Sampler
from models.citymap.points import Ints, ranges
from models.errors import WeightsError
from models.files import cache_directory, open_atomic
from models.language.text_encoder import fingerprint_of
from models.paper.layers import mlp
from models.paper.point_encoder import POINT_WIDTH, PointEncoder
from models.paper.relation_attention import InstanceRelation, RelationAttention

Input = Literal["position", "closest", "size", "count", "colour", "label", "points"]
# Columns of `CellFeatures.geometry` per input. "position" is the centre; "closest" is the closest point (2 columns),
# its distance and the direction to it (2 columns), all relative to the centre of the cell.
GEOMETRY_WIDTHS: dict[Input, int] = {"position": 3, "closest": 5, "size": 3, "count": 1, "colour": 4}
GEOMETRY_WIDTH = sum(GEOMETRY_WIDTHS.values())
CLOSEST_DISTANCE_COLUMN = 5  # of `CellFeatures.geometry`
# Inputs that share an MLP.
INPUT_BRANCHES: dict[str, tuple[Input, ...]] = {
    "position": ("position", "closest"), "size": ("size",), "count": ("count",), "colour": ("colour",),
}  # fmt: skip
DEFAULT_INPUTS: tuple[Input, ...] = ("position", "closest", "size", "count", "colour", "label")
PAPER_INPUTS: tuple[Input, ...] = ("points", "colour", "position", "count")
_log = logging.getLogger(__name__)
_CACHE_FORMAT = 2  # increase when the point samples or the point encoder change
CACHE_KEY_CELLS = 8  # cells whose points are part of the key of the cache
INSTANCES_PER_POINT_BATCH = 512  # approximate batch size of the point encoder


@dataclass(frozen=True, slots=True, eq=False)
class CellFeatures:
    """The instances of all cells of a gallery as numbers, the input of an encoder; one row per instance and cell."""

    starts: npt.NDArray[Any]  # [N + 1] int64, cell n has the rows starts[n] to starts[n + 1]
    geometry: npt.NDArray[Any]  # [R, 16] float32, see GEOMETRY_WIDTHS
    label: npt.NDArray[Any]  # [R] int32, index into `labels`
    labels: tuple[str, ...]  # L class names
    sample: Sampler | None  # returns points of the instances; None if they are not available
    point_features: npt.NDArray[Any]  # [R, S] output of a point encoder, see `with_point_features`; S = 0 without one

    @classmethod
    def from_cells(
        cls, cells: CellTable, instance_labels: npt.NDArray[Any], rows: range | None = None
    ) -> "CellFeatures":
        """Return the features of a cell table, or of a span of its rows with the labels of all."""
        return next(cls.iterate_spans(cells, instance_labels, [range(len(cells)) if rows is None else rows]))

    @classmethod
    def iterate_spans(
        cls, cells: CellTable, instance_labels: npt.NDArray[Any], spans: Iterable[range]
    ) -> Iterator["CellFeatures"]:
        """Yield the features of one span of cells after the other: all at once would not fit in memory for a city."""
        labels, code = np.unique(instance_labels, return_inverse=True)
        used = np.unique(code[np.bincount(cells.parts.instance, minlength=len(code)) > 0])
        labels, code = labels[used], np.searchsorted(used, code).astype(np.int32)
        for span in spans:
            cells_in_span = cells if len(span) == len(cells) else cells.take(np.arange(span.start, span.stop))
            yield cls._build(cells_in_span, tuple(labels.tolist()), code)

    @classmethod
    def _build(cls, cells: CellTable, labels: tuple[str, ...], code: npt.NDArray[Any]) -> "CellFeatures":
        """Return the features of all cells; `code` [I] indexes `labels` for each instance of the map."""
        parts, half = cells.parts, cells.size_m / 2
        geometry = np.empty((len(parts.instance), GEOMETRY_WIDTH), dtype=np.float32)  # filled in place to save memory
        position, closest, size, count, colour = np.split(
            geometry, np.cumsum(list(GEOMETRY_WIDTHS.values()))[:-1], axis=1
        )
        center = cells.center_m.astype(np.float32)[parts.cube]
        position[:] = (parts.center_m - center) / half
        closest[:, :2] = (parts.closest_m - center)[:, :2] / half
        closest[:, 2] = np.linalg.norm(closest[:, :2], axis=1)
        closest[:, 3:] = closest[:, :2] / np.maximum(closest[:, 2:3], 1e-3)
        size[:] = (parts.high_m - parts.low_m) / cells.size_m
        count[:, 0] = np.log1p(parts.count) / 10
        colour[:, 3] = ~np.isnan(parts.rgb).any(axis=1)
        colour[:, :3] = np.where(colour[:, 3:] > 0, parts.rgb, 0.0)
        label = code[parts.instance]
        point_features = np.zeros((len(label), 0), dtype=np.float32)
        return cls(parts.starts, geometry, label, labels, cells.sample, point_features)

    def with_point_features(self, encoder: PointEncoder | None, cached: bool = True) -> "CellFeatures":
        """Return a copy with `point_features` of an encoder, computed or read from the cache; itself without one.

        Raises:
            WeightsError: there is an encoder, but the points of the instances are not available.
        """
        if encoder is None or not len(self):
            return self
        if not cached:
            return replace(self, point_features=self._encode_points(encoder))
        path = cache_directory() / "points" / f"{self._cache_key(encoder)}.npy"
        try:
            point_features = np.load(path)
        except (OSError, ValueError, EOFError):
            point_features = self._encode_points(encoder)
            try:
                with open_atomic(path) as file:
                    np.save(file, point_features)
            except OSError as error:
                _log.warning("cannot write the cache in %s (%s)", path.parent, error)
        return replace(self, point_features=point_features)

    def _encode_points(self, encoder: PointEncoder) -> npt.NDArray[Any]:
        """Return the point features [R, S] of all instances."""
        device = next(encoder.parameters()).device
        with torch.inference_mode():
            fixed = PointSampling(encoder.frame)
            parts = [encoder(self.points(cells, fixed).to(device)).cpu().numpy() for cells in self._point_batches()]
        return np.concatenate(parts)

    def _point_batches(self) -> Iterator[Ints]:
        """Yield the cells of each batch; no batch spans two blocks (see `Retriever.encode_cells`)."""
        for first in range(0, len(self), CELLS_PER_BLOCK):
            rows = np.arange(first, min(first + CELLS_PER_BLOCK, len(self)))
            begin, end = self.starts[rows[0]], self.starts[rows[-1] + 1]
            ends = np.searchsorted(
                self.starts[rows], np.arange(begin + INSTANCES_PER_POINT_BATCH, end, INSTANCES_PER_POINT_BATCH)
            )
            yield from (batch for batch in np.split(rows, np.unique(ends)) if len(batch))

    def _cache_key(self, encoder: PointEncoder) -> str:
        """Return a sha256 of the encoder, the points of a few cells, and all other features."""
        shape = [(level.count, level.radius, level.neighbours) for level in encoder.levels]
        digest = hashlib.sha256(f"{_CACHE_FORMAT} {shape} {fingerprint_of(encoder.state_dict())}".encode())
        cells = np.linspace(0, len(self) - 1, CACHE_KEY_CELLS).astype(np.int64)
        points = self.points(cells, PointSampling(encoder.frame)).numpy()
        for column in (self.starts, self.geometry, self.label, points):
            digest.update(np.ascontiguousarray(column).tobytes())
        return digest.hexdigest()

    def points(self, cells: Ints, sampling: PointSampling = FIXED_SAMPLING) -> Tensor:
        """Return points [R, 256, 6] of the instances of some cells; raise WeightsError if they are not available."""
        if self.sample is None:
            raise WeightsError(
                "these weights need the points of the instances (model.inputs), which an index does not store; "
                "use a map or a data set, or other weights"
            )
        return torch.from_numpy(self.sample(cells, sampling))

    def __len__(self) -> int:
        return len(self.starts) - 1

    def batch(self, cells: npt.NDArray[Any], sampling: PointSampling | None = None) -> "CellBatch":
        """Return some cells as tensors, padded to the largest of them, and with points if there is a sampling."""
        sizes = np.diff(self.starts)[cells]
        mask = np.arange(max(1, sizes.max())) < sizes[:, None]
        rows = ranges(self.starts[cells], self.starts[cells + 1])
        geometry = np.zeros((*mask.shape, GEOMETRY_WIDTH), dtype=np.float32)
        label = np.zeros(mask.shape, dtype=np.int64)
        point_features = np.zeros((*mask.shape, self.point_features.shape[1]), dtype=np.float32)
        geometry[mask], label[mask], point_features[mask] = (
            self.geometry[rows],
            self.label[rows],
            self.point_features[rows],
        )
        batch = CellBatch(*(torch.from_numpy(column) for column in (geometry, label, mask, point_features)))
        return batch if sampling is None else replace(batch, points=self.points(cells, sampling))


@dataclass(frozen=True, slots=True, eq=False)
class UncutCells:
    """The cells of an index of a map, which are cut when a batch needs them: cutting all takes seconds for a city."""

    cells: CellTable
    code: Ints  # [I] index into `labels` of each instance of the map
    labels: tuple[str, ...]  # L class names

    @classmethod
    def from_cells(cls, cells: CellTable, instance_labels: npt.NDArray[Any]) -> "UncutCells":
        """Return the cells of a table, of which none is cut yet."""
        labels, code = np.unique(instance_labels, return_inverse=True)
        return cls(cells, code.astype(np.int32), tuple(labels.tolist()))

    def __len__(self) -> int:
        return len(self.cells)

    def with_point_features(self, encoder: PointEncoder | None) -> "UncutCells":
        """Return itself; raise WeightsError if there is an encoder, because an index has no points."""
        if encoder is not None:
            self._cut(np.zeros(0, np.int64)).points(np.zeros(0, np.int64))
        return self

    def batch(self, cells: npt.NDArray[Any]) -> "CellBatch":
        """Do as `CellFeatures.batch`, and cut these cells alone."""
        return self._cut(cells).batch(np.arange(len(cells)))

    def _cut(self, rows: Ints) -> CellFeatures:
        return CellFeatures._build(self.cells.take(rows), self.labels, self.code)


@dataclass(frozen=True, slots=True, eq=False)
class CellBatch:
    """Cells as padded tensors."""

    geometry: Tensor  # [B, I, 16] float32
    label: Tensor  # [B, I] int64
    mask: Tensor  # [B, I] bool, True where an instance is real
    point_features: Tensor  # [B, I, S] float32, S = 0 without a point encoder
    points: Tensor | None = None  # [R, 256, 6] of the real instances, cell after cell, to encode in a training step

    def to(self, device: torch.device) -> "CellBatch":
        """Return a copy on a device."""
        batch = CellBatch(*(x.to(device) for x in (self.geometry, self.label, self.mask, self.point_features)))
        return batch if self.points is None else replace(batch, points=self.points.to(device))

    def with_point_features(self, encoder: PointEncoder | None) -> "CellBatch":
        """Return a copy with the features of its points, through which gradients reach the encoder; itself without."""
        if encoder is None or self.points is None:
            return self
        encoded = encoder(self.points)
        point_features = encoded.new_zeros(*self.mask.shape, encoded.shape[-1])
        point_features[self.mask] = encoded
        return replace(self, point_features=point_features, points=None)


def geometry_columns(inputs: Sequence[Input]) -> list[int]:
    """Return the columns of `CellFeatures.geometry` that belong to some inputs."""
    start = dict(zip(GEOMETRY_WIDTHS, accumulate(GEOMETRY_WIDTHS.values(), initial=0), strict=False))
    return [start[name] + k for name, width in GEOMETRY_WIDTHS.items() if name in inputs for k in range(width)]


class InstanceEncoder(nn.Module):
    """The instance features F^C [R, D], from several inputs with an MLP each (MNCL's point backbone).

    The paper's inputs are PAPER_INPUTS: points through PointNet++, mean colour, centre, number of points. The default
    leaves the points out and adds the size, the label as a text embedding, so that any word can be a label, and the
    point closest to the cell's centre, because hints refer to closest points. Differs: the number of points enters as
    its logarithm, and a column says whether the colour is known.

    With `relations`, the point features of a cell go through relation-enhanced attention, as in MNCL's code.
    """

    def __init__(
        self,
        label_width: int,
        width: int,
        inputs: Sequence[Input] = DEFAULT_INPUTS,
        relations: bool = False,
        dropout: float = 0.0,  # of this attention
    ) -> None:
        super().__init__()
        of_branch = {
            name: geometry_columns([part for part in parts if part in inputs]) for name, parts in INPUT_BRANCHES.items()
        }
        self.columns = {name: columns for name, columns in of_branch.items() if columns}
        self.branches = nn.ModuleDict({name: mlp(len(columns), 64, width) for name, columns in self.columns.items()})
        self.label = mlp(label_width, width) if "label" in inputs else None
        self.shape = mlp(POINT_WIDTH, width) if "points" in inputs else None
        parts = len(self.columns) + sum(part is not None for part in (self.label, self.shape))
        self.merge = mlp(parts * width, width, width)
        self.relation = InstanceRelation(width) if relations else None
        self.attention = RelationAttention(width, dropout) if relations else None

    def encode_padded(self, batch: CellBatch, label_embeddings: Tensor) -> Tensor:
        """Return features [B, I, D] of cells, 0 at padding; `label_embeddings` [L, W] has one row per label."""
        mask = batch.mask
        encoded = self(batch.geometry[mask], label_embeddings[batch.label[mask]], batch.point_features[mask], mask)
        features: Tensor = encoded.new_zeros(*mask.shape, encoded.shape[-1])
        features[mask] = encoded
        return features

    def forward(
        self,
        geometry: Tensor,
        label_embedding: Tensor,
        point_features: Tensor | None = None,
        mask: Tensor | None = None,
    ) -> Tensor:
        """Return features [R, D] from geometry [R, 16], label vectors [R, W] and point features [R, S].

        The mask [B, I] of the cells, whose real entries are the rows, is for relations alone.
        """
        parts = [branch(geometry[:, self.columns[name]]) for name, branch in self.branches.items()]
        if self.label is not None:
            parts.append(self.label(label_embedding))
        if self.shape is not None:
            if point_features is None or not point_features.shape[-1]:
                raise ValueError("the cells have no point features; call `with_point_features` first")
            shape = self.shape(point_features)
            parts.append(shape if self.attention is None else self._relate(shape, geometry, mask))
        merged: Tensor = self.merge(torch.cat([nn.functional.normalize(part, dim=-1) for part in parts], dim=-1))
        return merged

    def _relate(self, shape: Tensor, geometry: Tensor, mask: Tensor | None) -> Tensor:
        """Return point features [R, D] after attention among those of each cell."""
        assert self.attention is not None
        assert self.relation is not None
        assert mask is not None, "relations are among the instances of a cell"
        padded, centers = shape.new_zeros(*mask.shape, shape.shape[-1]), geometry.new_zeros(*mask.shape, 3)
        padded[mask], centers[mask] = shape, geometry[:, :3]
        return self.attention.attend(padded, self.relation(centers, mask), mask)[mask]
