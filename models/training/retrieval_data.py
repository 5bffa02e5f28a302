"""Training examples: positions of a map or a data set, whatever can be said there, and the cells around."""

from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
import torch
from scipy.spatial import cKDTree
from torch import Tensor

from models.citymap.hints import NUM_HINTS, STRATEGIES, choose_hints
from models.citymap.queries import PositionStatements
from models.citymap.templates import TEMPLATES, render_hint
from models.citymap.types import DIRECTIONS, Hint
from models.errors import DataError
from models.language.text_encoder import TextEncoder, TokenFeatures
from models.paper.instance_encoder import CellBatch, CellFeatures
from models.training.engine.feature_cache import frozen_features

MIN_HINTS, MAX_HINTS = 2, 8
KNOWS_COLOUR, CANONICAL = 0.8, 0.5  # shares of the hints of varied wording: people leave colours out
Wording = Literal["varied", "published"]
NEIGHBOUR_M = 40.0  # hard negatives are drawn this near
# The 8 symmetries of the compass: each [2, 2] matrix moves (east, north); directions move along.
SYMMETRIES = np.array(
    [[[fx, 0], [0, fy]] for fx in (1, -1) for fy in (1, -1)] + [[[0, fx], [fy, 0]] for fx in (1, -1) for fy in (1, -1)],
    dtype=np.float32,
)
_COMPASS = np.array([[0, 1], [0, -1], [1, 0], [-1, 0], [0, 0]], dtype=np.float32)  # of DIRECTIONS, (east, north)
DIRECTION_UNDER_SYMMETRY = np.array(
    [[int(np.abs(_COMPASS - matrix @ vector).sum(axis=1).argmin()) for vector in _COMPASS] for matrix in SYMMETRIES]
)


@dataclass(frozen=True, slots=True, eq=False)
class Batch:
    """B descriptions with their cells, as the trainer takes them.

    Attributes:
        cells: the best cells.
        sentences: [B, H] index into the vocabulary.
        hint_mask: [B, H] bool, True where a hint is real.
        cell: [B] int64, the best cell's row in the training set's features.
    """

    cells: CellBatch
    sentences: Tensor
    hint_mask: Tensor
    cell: Tensor

    @property
    def same_cell(self) -> Tensor:
        """[B, B] bool, True where two rows belong to one cell."""
        return self.cell[:, None] == self.cell[None, :]


@dataclass(frozen=True, slots=True, eq=False)
class DrawnHints:
    """What is said at B positions.

    Attributes:
        sentences: [B, H] index into the vocabulary, 0 where nothing is said.
        mask: [B, H] bool, True where a hint is real.
        hints: [B, H] row of the hint table, -1 where nothing is said.
    """

    sentences: npt.NDArray[np.int64]
    mask: npt.NDArray[np.bool_]
    hints: npt.NDArray[np.int64]


class HintVocabulary:
    """Every sentence that can be said about a region, with its token features, computed once and cached on disk.

    Args:
        encoder: the frozen text encoder.
        labels: class names.
        words: the palette's colour words.
        pairs: [n, 2] the (label, colour) pairs that occur, -1 for no colour.
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
        """Token features of sentences [S], padded to the longest of them."""
        mask = self.mask[sentences]
        longest = int(mask.sum(dim=1).max())
        values = self._values[sentences, :longest].float()
        return TokenFeatures(values, mask[:, :longest], self._ids[sentences, :longest])

    def sentence(self, label: Any, colour: Any, direction: Any, template: Any) -> npt.NDArray[np.int64]:
        """Indices of sentences; the arguments broadcast."""
        pair = self._pair[label, colour]
        index: npt.NDArray[np.int64] = (pair * len(DIRECTIONS) + direction) * len(TEMPLATES) + template
        return index


class TrainingSet:
    """Positions to train on, with everything that can be said at each of them.

    Args:
        statements: the positions.
        encoder: the frozen text encoder.
        wording: "varied" draws which hints are said, how many, in which words, and leaves colours out now and then;
            "published" says what the data set says (of a map: the nearest six), in the benchmark's words.

    Raises:
        DataError: no position has hints enough.
    """

    def __init__(self, statements: PositionStatements, encoder: TextEncoder, wording: Wording = "varied") -> None:
        self.statements, self.table, self.best, self.wording = statements, statements.table, statements.best, wording
        self.features = CellFeatures.from_cells(statements.gallery.cells, np.array(statements.gallery.labels))
        self.usable = np.flatnonzero(np.diff(self.table.starts) >= MIN_HINTS)
        if not len(self.usable):
            raise DataError(f"none of {len(self.best)} positions has {MIN_HINTS} things around it; take a larger map")
        self._tree = cKDTree(statements.positions_m[self.usable])
        names, self.label_of = np.unique(statements.labels, return_inverse=True)
        said = np.column_stack([self.label_of[self.table.instance], self.table.colour])
        pairs = np.unique(np.concatenate([said, np.column_stack([said[:, 0], np.full(len(said), -1)])]), axis=0)
        self.vocabulary = HintVocabulary(encoder, tuple(names.tolist()), statements.words, pairs)
        self.label_embeddings = encoder.embed(self.features.labels)

    def __len__(self) -> int:
        return len(self.usable)

    def to(self, device: torch.device) -> None:
        """Move what the model looks up while training to a device."""
        self.vocabulary.to(device)
        self.label_embeddings = self.label_embeddings.to(device)

    def draw(self, size: int, cluster: int, rng: np.random.Generator) -> npt.NDArray[np.intp]:
        """Positions for a batch: groups of `cluster` near each other, whose cells are hard to tell apart."""
        groups = max(1, size // cluster)
        seeds = rng.choice(self.usable, groups, replace=len(self.usable) < groups)
        near = self._tree.query_ball_point(self.statements.positions_m[seeds], NEIGHBOUR_M)
        drawn: npt.NDArray[np.intp] = self.usable[np.concatenate([rng.choice(group, cluster) for group in near])]
        return drawn

    def batch(self, positions: npt.NDArray[np.intp], rng: np.random.Generator) -> Batch:
        """Examples at some positions, with hints, wording and orientation drawn at random."""
        symmetry = rng.integers(len(SYMMETRIES), size=len(positions))
        said = self.draw_hints(positions, symmetry, rng)
        best = self.best[positions]
        return Batch(
            cells=reflect_cells(self.features.batch(best), torch.from_numpy(SYMMETRIES[symmetry])),
            sentences=torch.from_numpy(said.sentences),
            hint_mask=torch.from_numpy(said.mask),
            cell=torch.from_numpy(best.astype(np.int64)),
        )

    def draw_hints(
        self, positions: npt.NDArray[np.intp], symmetry: npt.NDArray[Any], rng: np.random.Generator
    ) -> DrawnHints:
        """Hints at some positions, each position turned by one of SYMMETRIES, worded as `wording` says."""
        varied = self.wording == "varied"
        hints = np.zeros((len(positions), MAX_HINTS), dtype=np.int64)
        mask = np.zeros(hints.shape, dtype=bool)
        for row, position in enumerate(positions):
            drawn = self._draw(int(position), rng) if varied else self._first(int(position))
            hints[row, : len(drawn)], mask[row, : len(drawn)] = drawn, True
        colour, template = self.table.colour[hints], np.zeros_like(hints)
        if varied:
            colour = np.where(rng.random(hints.shape) < KNOWS_COLOUR, colour, -1)
            drawn_template = rng.integers(len(TEMPLATES), size=hints.shape)
            template = np.where(rng.random(hints.shape) < CANONICAL, 0, drawn_template)
        direction = DIRECTION_UNDER_SYMMETRY[symmetry[:, None], self.table.direction[hints]]
        label = self.label_of[self.table.instance[hints]]
        sentences = np.where(mask, self.vocabulary.sentence(label, colour, direction, template), 0)
        return DrawnHints(sentences, mask, np.where(mask, hints, -1))

    def _draw(self, position: int, rng: np.random.Generator) -> npt.NDArray[Any]:
        count = int(rng.integers(MIN_HINTS, MAX_HINTS + 1)) if rng.random() < 0.5 else NUM_HINTS
        strategy = STRATEGIES[rng.integers(len(STRATEGIES))]
        return choose_hints(self.table, position, self.label_of, strategy, count)

    def _first(self, position: int) -> npt.NDArray[Any]:
        start, end = self.table.starts[position], self.table.starts[position + 1]
        return np.arange(start, min(end, start + NUM_HINTS))


def reflect_cells(batch: CellBatch, matrix: Tensor) -> CellBatch:
    """Cells seen under a symmetry of the compass; what a point encoder made of their points stays as it is.

    Args:
        batch: padded cells.
        matrix: [B, 2, 2] what each cell's (east, north) is multiplied with.
    """
    geometry = batch.geometry.clone()
    for columns in (slice(0, 2), slice(3, 5), slice(6, 8)):  # centre, closest point, direction to it
        geometry[..., columns] = torch.einsum("bij,bnj->bni", matrix, geometry[..., columns])
    geometry[..., 8:10] = torch.einsum("bij,bnj->bni", matrix.abs(), geometry[..., 8:10])  # sizes stay positive
    return replace(batch, geometry=geometry)
