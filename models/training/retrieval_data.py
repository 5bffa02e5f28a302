"""Training examples of retrieval: positions of a map or a data set, their hints and their cells."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
import torch
from scipy.spatial import cKDTree
from torch import Tensor

from models.citymap.hints import NUM_HINTS, STRATEGIES, choose_hints
from models.citymap.point_sample import PointFrame, PointSampling
from models.citymap.points import Ints
from models.citymap.queries import PositionStatements
from models.citymap.templates import TEMPLATES, render_hint
from models.citymap.types import DIRECTIONS, Hint
from models.errors import DataError
from models.language.text_encoder import TextEncoder, TokenFeatures
from models.paper.instance_encoder import CellBatch, CellFeatures
from models.training.engine.feature_cache import frozen_features

MIN_HINTS, MAX_HINTS = 2, 8
# Shares of the hints of varied wording that name the colour, and that use the first template.
COLOUR_SHARE, CANONICAL_SHARE = 0.8, 0.5
WordingMode = Literal["varied", "published"]
HARD_NEGATIVE_RADIUS_M = 40.0
# The 8 symmetries of the compass as [2, 2] matrices on (east, north).
SYMMETRIES = np.array(
    [[[fx, 0], [0, fy]] for fx in (1, -1) for fy in (1, -1)] + [[[0, fx], [fy, 0]] for fx in (1, -1) for fy in (1, -1)],
    dtype=np.float32,
)
_COMPASS = np.array([[0, 1], [0, -1], [1, 0], [-1, 0], [0, 0]], dtype=np.float32)  # (east, north) of DIRECTIONS
DIRECTION_UNDER_SYMMETRY = np.array(
    [[int(np.abs(_COMPASS - matrix @ vector).sum(axis=1).argmin()) for vector in _COMPASS] for matrix in SYMMETRIES]
)


@dataclass(frozen=True, slots=True, eq=False)
class Batch:
    """A batch of B descriptions with their cells."""

    cells: CellBatch  # the true cells
    sentences: Tensor  # [B, H] index into the vocabulary
    hint_mask: Tensor  # [B, H] False at padding
    cell: Tensor  # [B] int64, row of the true cell in the features of the training set

    @property
    def same_cell(self) -> Tensor:
        """[B, B] bool, True where two rows belong to one cell."""
        return self.cell[:, None] == self.cell[None, :]


@dataclass(frozen=True, slots=True, eq=False)
class DrawnHints:
    """The drawn hints of B positions."""

    sentences: npt.NDArray[np.int64]  # [B, H] index into the vocabulary, 0 at padding
    mask: npt.NDArray[np.bool_]  # [B, H] False at padding
    hints: npt.NDArray[np.int64]  # [B, H] row of the hint table, -1 at padding


class HintVocabulary:
    """All possible hint sentences of a region with their token features, computed once and cached on disk.

    `pairs` [n, 2] are those of label and colour that occur, -1 for no colour.
    """

    def __init__(self, encoder: TextEncoder, labels: tuple[str, ...], words: tuple[str, ...], pairs: Any) -> None:
        self._pair = np.full((len(labels), len(words) + 1), -1, dtype=np.int64)  # the last column is no colour
        self._pair[pairs[:, 0], pairs[:, 1]] = np.arange(len(pairs))
        sentences = [
            render_hint(Hint(direction, labels[label], words[colour] if colour >= 0 else None), template)
            for label, colour in pairs
            for direction in DIRECTIONS
            for template in range(len(TEMPLATES))
        ]
        features = frozen_features(encoder, sentences)
        self.mask, self._ids, self._values = features.mask, features.ids, features.values

    def to(self, device: torch.device) -> None:
        """Move the token features to a device."""
        self.mask, self._ids, self._values = (x.to(device) for x in (self.mask, self._ids, self._values))

    def tokens(self, sentences: Tensor) -> TokenFeatures:
        """Return token features of sentences [S], padded to the longest of them."""
        mask = self.mask[sentences]
        longest = int(mask.sum(dim=1).max())
        values = self._values[sentences, :longest].float()
        return TokenFeatures(values, mask[:, :longest], self._ids[sentences, :longest])

    def features(self, read: Callable[[TokenFeatures], Tensor], sentences: Tensor, mask: Tensor) -> Tensor:
        """Return the features [B, H, D] of the hints of a batch, 0 at padding; encodes each distinct sentence once.

        `read` encodes the tokens of S sentences as [S, D]; `sentences` and `mask` are [B, H].
        """
        different, row = torch.unique(sentences[mask], return_inverse=True)
        features = read(self.tokens(different))
        hints = features.new_zeros(*mask.shape, features.shape[-1])
        hints[mask] = features[row]
        return hints

    def sentence(self, label: Any, colour: Any, direction: Any, template: Any) -> npt.NDArray[np.int64]:
        """Return indices of sentences; the arguments broadcast."""
        pair = self._pair[label, colour]
        return (pair * len(DIRECTIONS) + direction) * len(TEMPLATES) + template


class TrainingSet:
    """Training positions with all possible hints of each.

    "varied" wording draws the hints, their number and their wording, and sometimes omits colours; "published" uses the
    hints of the data set (in a map, the nearest six) in the wording of the benchmark. `wrong_share` of the hints are
    replaced by those of other positions in the batch.

    Raises:
        DataError: no position has enough hints.
    """

    def __init__(
        self,
        statements: PositionStatements,
        encoder: TextEncoder,
        wording: WordingMode = "varied",
        wrong_share: float = 0.0,
    ) -> None:
        self.statements, self.table, self.best = statements, statements.table, statements.best
        self.wording, self.wrong_share = wording, wrong_share
        self.features = CellFeatures.from_cells(statements.gallery.cells, np.array(statements.gallery.labels))
        self.usable = np.flatnonzero(np.diff(self.table.starts) >= MIN_HINTS)
        if not len(self.usable):
            raise DataError(f"none of {len(self.best)} positions has {MIN_HINTS} objects nearby; use a larger map")
        self._tree = cKDTree(statements.positions_m[self.usable])
        names, self.label_of = np.unique(statements.labels, return_inverse=True)
        coloured = np.column_stack([self.label_of[self.table.instance], self.table.colour])
        plain = np.column_stack([coloured[:, 0], np.full(len(coloured), -1)])
        pairs = np.unique(np.concatenate([coloured, plain]), axis=0)
        self.vocabulary = HintVocabulary(encoder, tuple(names.tolist()), statements.words, pairs)
        self.label_embeddings = encoder.embed(self.features.labels)
        self.point_frame: PointFrame | None = None  # of the points that are drawn in each step; None draws none

    def __len__(self) -> int:
        return len(self.usable)

    def to(self, device: torch.device) -> None:
        """Move the vocabulary and the label embeddings to a device."""
        self.vocabulary.to(device)
        self.label_embeddings = self.label_embeddings.to(device)

    def draw(self, size: int, cluster: int, rng: np.random.Generator) -> npt.NDArray[np.intp]:
        """Draw positions in groups of `cluster` that are near each other, as hard negatives."""
        groups = max(1, size // cluster)
        seeds = rng.choice(self.usable, groups, replace=len(self.usable) < groups)
        near = self._tree.query_ball_point(self.statements.positions_m[seeds], HARD_NEGATIVE_RADIUS_M)
        return self.usable[np.concatenate([rng.choice(group, cluster) for group in near])]

    def batch(self, positions: npt.NDArray[np.intp], rng: np.random.Generator) -> Batch:
        """Return examples at some positions, with random hints, wording and orientation."""
        symmetry = rng.integers(len(SYMMETRIES), size=len(positions))
        drawn = self.draw_hints(positions, symmetry, rng)
        best = self.best[positions]
        return Batch(
            cells=self.draw_cells(best, symmetry, rng),
            sentences=torch.from_numpy(drawn.sentences),
            hint_mask=torch.from_numpy(drawn.mask),
            cell=torch.from_numpy(best.astype(np.int64)),
        )

    def draw_cells(self, rows: Ints, symmetry: Ints, rng: np.random.Generator) -> CellBatch:
        """Return some cells, each turned by one of SYMMETRIES, with points drawn anew if `point_frame` is set."""
        sampling = None if self.point_frame is None else PointSampling(self.point_frame, rng)
        return reflect_cells(self.features.batch(rows, sampling), torch.from_numpy(SYMMETRIES[symmetry]))

    def draw_hints(
        self, positions: npt.NDArray[np.intp], symmetry: npt.NDArray[Any], rng: np.random.Generator
    ) -> DrawnHints:
        """Draw hints at some positions, each position turned by one of SYMMETRIES."""
        varied = self.wording == "varied"
        hints = np.zeros((len(positions), MAX_HINTS), dtype=np.int64)
        mask = np.zeros(hints.shape, dtype=bool)
        for row, position in enumerate(positions):
            rows = self._draw_rows(int(position), rng) if varied else self._published_rows(int(position))
            hints[row, : len(rows)], mask[row, : len(rows)] = rows, True
        if self.wrong_share:
            hints = replace_hints(hints, mask, self.wrong_share, rng)
        colour, template = self.table.colour[hints], np.zeros_like(hints)
        if varied:
            colour = np.where(rng.random(hints.shape) < COLOUR_SHARE, colour, -1)
            drawn_template = rng.integers(len(TEMPLATES), size=hints.shape)
            template = np.where(rng.random(hints.shape) < CANONICAL_SHARE, 0, drawn_template)
        direction = DIRECTION_UNDER_SYMMETRY[symmetry[:, None], self.table.direction[hints]]
        label = self.label_of[self.table.instance[hints]]
        sentences = np.where(mask, self.vocabulary.sentence(label, colour, direction, template), 0)
        return DrawnHints(sentences, mask, np.where(mask, hints, -1))

    def _draw_rows(self, position: int, rng: np.random.Generator) -> npt.NDArray[Any]:
        count = int(rng.integers(MIN_HINTS, MAX_HINTS + 1)) if rng.random() < 0.5 else NUM_HINTS
        strategy = STRATEGIES[rng.integers(len(STRATEGIES))]
        return choose_hints(self.table, position, self.label_of, strategy, count)

    def _published_rows(self, position: int) -> npt.NDArray[Any]:
        start, end = self.table.starts[position], self.table.starts[position + 1]
        return np.arange(start, min(end, start + NUM_HINTS))


def replace_hints(
    hints: npt.NDArray[np.int64], mask: npt.NDArray[np.bool_], share: float, rng: np.random.Generator
) -> npt.NDArray[np.int64]:
    """Return hints [B, H] in which some real ones (mask [B, H], True first) are those of another row, by chance."""
    row, column = np.nonzero(mask & (rng.random(mask.shape) < share))
    other = (row + rng.integers(1, len(mask), size=len(row))) % len(mask)
    replaced = hints.copy()
    replaced[row, column] = hints[other, rng.integers(mask.sum(axis=1)[other])]
    return replaced


def reflect_cells(batch: CellBatch, matrix: Tensor) -> CellBatch:
    """Apply symmetries of the compass [B, 2, 2], on (east, north), to cells; point features already computed stay."""
    geometry = batch.geometry.clone()
    for columns in (slice(0, 2), slice(3, 5), slice(6, 8)):  # centre, closest point, direction to it
        geometry[..., columns] = torch.einsum("bij,bnj->bni", matrix, geometry[..., columns])
    geometry[..., 8:10] = torch.einsum("bij,bnj->bni", matrix.abs(), geometry[..., 8:10])  # sizes stay positive
    points = batch.points
    if points is not None:
        each = matrix.repeat_interleave(batch.mask.sum(dim=1), dim=0)  # [R, 2, 2]
        turned = torch.einsum("rij,rpj->rpi", each, points[..., :2])
        points = torch.cat([turned, points[..., 2:]], dim=-1)
    return replace(batch, geometry=geometry, points=points)
