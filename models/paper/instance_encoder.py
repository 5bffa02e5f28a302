"""Instances of cells as features: what an instance is, how it looks, how large it is and where it lies."""

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

from models.citymap.cells import BLOCK, CellTable
from models.citymap.point_sample import Sampler
from models.citymap.points import Ints, ranges
from models.errors import WeightsError
from models.files import cache_directory, open_atomic
from models.language.text_encoder import fingerprint_of
from models.paper.layers import mlp
from models.paper.point_encoder import POINT_WIDTH, PointEncoder

Input = Literal["position", "closest", "size", "count", "colour", "label", "points"]
# Columns of `CellFeatures.geometry`: the centre; the closest point, how far it is and which way; the rest.
GEOMETRY: dict[Input, int] = {"position": 3, "closest": 5, "size": 3, "count": 1, "colour": 4}
NUM_GEOMETRY = sum(GEOMETRY.values())
DISTANCE = 5  # the column that says how far the closest point lies from the cell's centre
# Inputs that pass an MLP together.
BRANCHES: dict[str, tuple[Input, ...]] = {
    "position": ("position", "closest"), "size": ("size",), "count": ("count",), "colour": ("colour",),
}  # fmt: skip
OURS: tuple[Input, ...] = ("position", "closest", "size", "count", "colour", "label")
PAPERS: tuple[Input, ...] = ("points", "colour", "position", "count")
_log = logging.getLogger(__name__)
_FORMAT = 2  # of what is kept of points; counted up when samples or what is made of them change
KEYED_BY = 8  # cells whose points name what is kept
SEEN_AT_ONCE = 512  # instances whose points are looked at together, about


@dataclass(frozen=True, slots=True, eq=False)
class CellFeatures:
    """The instances of all cells of a gallery as numbers, one row an instance and cell; the encoder's input.

    Attributes:
        starts: [N + 1] int64, cell n has the rows starts[n] to starts[n + 1].
        geometry: [R, 16] float32: see GEOMETRY.
        label: [R] int32, index into `labels`.
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
    def of(cls, cells: CellTable, instance_labels: npt.NDArray[Any], rows: range | None = None) -> "CellFeatures":
        """Features of a cell table.

        Args:
            cells: the gallery.
            instance_labels: [I] label of each instance of the map.
            rows: those of some cells, one after the other, with the labels of all; None for all.
        """
        return next(cls.in_turn(cells, instance_labels, [range(len(cells)) if rows is None else rows]))

    @classmethod
    def in_turn(
        cls, cells: CellTable, instance_labels: npt.NDArray[Any], spans: Iterable[range]
    ) -> Iterator["CellFeatures"]:
        """Features of some cells, then of others: those of a city take more room than all else of it; as `of`."""
        known, number = np.unique(instance_labels, return_inverse=True)
        used = np.unique(number[np.bincount(cells.parts.instance, minlength=len(number)) > 0])
        known, number = known[used], np.searchsorted(used, number).astype(np.int32)
        for span in spans:
            some = cells if len(span) == len(cells) else cells.take(np.arange(span.start, span.stop))
            yield cls._of(some, tuple(known.tolist()), number)

    @classmethod
    def _of(cls, cells: CellTable, labels: tuple[str, ...], number: npt.NDArray[Any]) -> "CellFeatures":
        """Features of all of some cells; `number` [I] the label of each instance of the map."""
        parts, half = cells.parts, cells.size_m / 2
        geometry = np.empty((len(parts.instance), NUM_GEOMETRY), dtype=np.float32)  # filled without another of its size
        position, closest, size, count, colour = np.split(geometry, np.cumsum(list(GEOMETRY.values()))[:-1], axis=1)
        center = cells.center_m.astype(np.float32)[parts.cube]
        position[:] = (parts.center_m - center) / half
        closest[:, :2] = (parts.closest_m - center)[:, :2] / half
        closest[:, 2] = np.linalg.norm(closest[:, :2], axis=1)
        closest[:, 3:] = closest[:, :2] / np.maximum(closest[:, 2:3], 1e-3)
        size[:] = (parts.high_m - parts.low_m) / cells.size_m
        count[:, 0] = np.log1p(parts.count) / 10
        colour[:, 3] = ~np.isnan(parts.rgb).any(axis=1)
        colour[:, :3] = np.where(colour[:, 3:] > 0, parts.rgb, 0.0)
        label = number[parts.instance]
        shape = np.zeros((len(label), 0), dtype=np.float32)
        return cls(parts.starts, geometry, label, labels, cells.sample, shape)

    def seen(self, encoder: PointEncoder | None) -> "CellFeatures":
        """The same with `shape`, computed a few cells at a time, or read where an earlier process left it.

        Raises:
            WeightsError: there is an encoder, and the instances' points are not at hand.
        """
        if encoder is None or not len(self):
            return self
        path = cache_directory() / "points" / f"{self._key(encoder)}.npy"
        try:
            shape = np.load(path)
        except (OSError, ValueError, EOFError):
            shape = self._look(encoder)
            try:
                with open_atomic(path) as file:
                    np.save(file, shape)
            except OSError as error:
                _log.warning("no cache in %s (%s)", path.parent, error)
        return replace(self, shape=shape)

    def _look(self, encoder: PointEncoder) -> npt.NDArray[Any]:
        """[R, S] what an encoder makes of all instances."""
        device = next(encoder.parameters()).device
        with torch.inference_mode():
            parts = [encoder(self.points(cells).to(device)).cpu().numpy() for cells in self._groups()]
        return np.concatenate(parts)

    def _groups(self) -> Iterator[Ints]:
        """Cells that are looked at together; none has cells of two blocks (see `Retriever.encode_cells`)."""
        for first in range(0, len(self), BLOCK):
            rows = np.arange(first, min(first + BLOCK, len(self)))
            begin, end = self.starts[rows[0]], self.starts[rows[-1] + 1]
            ends = np.searchsorted(self.starts[rows], np.arange(begin + SEEN_AT_ONCE, end, SEEN_AT_ONCE))
            yield from (group for group in np.split(rows, np.unique(ends)) if len(group))

    def _key(self, encoder: PointEncoder) -> str:
        """sha256 of the encoder, of points of some cells, and of what is known of all instances beside their points."""
        shape = [(level.count, level.radius, level.neighbours) for level in encoder.levels]
        digest = hashlib.sha256(f"{_FORMAT} {shape} {fingerprint_of(encoder.state_dict())}".encode())
        some = self.points(np.linspace(0, len(self) - 1, KEYED_BY).astype(np.int64)).numpy()
        for column in (self.starts, self.geometry, self.label, some):
            digest.update(np.ascontiguousarray(column).tobytes())
        return digest.hexdigest()

    def points(self, cells: Ints) -> Tensor:
        """[R, 256, 6] points of the instances of some cells.

        Raises:
            WeightsError: they are not at hand.
        """
        if self.sample is None:
            raise WeightsError(
                "these weights look at points (model.inputs), and these cells come without; "
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


def columns(inputs: Sequence[Input]) -> list[int]:
    """Which columns of `CellFeatures.geometry` some inputs are."""
    start = dict(zip(GEOMETRY, accumulate(GEOMETRY.values(), initial=0), strict=False))
    return [start[name] + k for name, width in GEOMETRY.items() if name in inputs for k in range(width)]


class InstanceEncoder(nn.Module):
    """Instance features F^C of what is known of an instance, each input through layers of its own.

    MNCL's point backbone. The paper's inputs are PAPERS: points through PointNet++, mean colour, centre, number of
    points. Ours leave the points out and add the label, as text, so that any word can be one, the point closest to the
    cell's centre, because hints speak of closest points, and the size. Differs: the number of points enters as its
    logarithm, and a column says whether a colour is known.

    Args:
        label_width: W, of the text embeddings.
        width: D, of the features.
        inputs: what is looked at.
    """

    def __init__(self, label_width: int, width: int, inputs: Sequence[Input] = OURS) -> None:
        super().__init__()
        looked_at = {name: columns([part for part in parts if part in inputs]) for name, parts in BRANCHES.items()}
        self.columns = {name: found for name, found in looked_at.items() if found}
        self.branches = nn.ModuleDict({name: mlp(len(found), 64, width) for name, found in self.columns.items()})
        self.label = mlp(label_width, width) if "label" in inputs else None
        self.shape = mlp(POINT_WIDTH, width) if "points" in inputs else None
        parts = len(self.columns) + sum(part is not None for part in (self.label, self.shape))
        self.merge = mlp(parts * width, width, width)

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
        parts = [branch(geometry[:, self.columns[name]]) for name, branch in self.branches.items()]
        if self.label is not None:
            parts.append(self.label(label_embedding))
        if self.shape is not None:
            if shape is None or not shape.shape[-1]:
                raise ValueError("cells without what the point encoder makes of them; call `seen` first")
            parts.append(self.shape(shape))
        merged: Tensor = self.merge(torch.cat([nn.functional.normalize(part, dim=-1) for part in parts], dim=-1))
        return merged
