"""Examples for the fine stage: a description, a cell that contains its position, and where in the cell that is."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import torch
from scipy.spatial import cKDTree
from torch import Tensor

from models.citymap.cells import CellTable
from models.citymap.gallery import Gallery
from models.citymap.points import Ints
from models.citymap.queries import Queries
from models.citymap.types import Floats
from models.paper.fine.fine_model import FineModel, FineTargets
from models.paper.instance_encoder import CellBatch, CellFeatures
from models.sources.source import SCENE_GAP_M
from models.training.retrieval_data import SYMMETRIES, TrainingSet, reflect

CLONED = 0.5  # share of the examples whose cell is a neighbour


@dataclass(frozen=True, slots=True, eq=False)
class FineBatch:
    """B descriptions, each with one cell that contains its position.

    Attributes:
        cells: the cells.
        sentences: [B, H] index into the vocabulary.
        hint_mask: [B, H] bool, True where a hint is real.
        truth: what is known of them.
    """

    cells: CellBatch
    sentences: Tensor
    hint_mask: Tensor
    truth: FineTargets


class FineSet:
    """A training set with where its cells are, and which instance each hint means.

    Args:
        training: positions and what can be said there.
        pmc: prototype-based map cloning (Text2Loc): half of the time the cell is not the best one but another that
            contains the position.
    """

    def __init__(self, training: TrainingSet, pmc: bool = True) -> None:
        self.training, self.statements, self.pmc = training, training.statements, pmc
        self.cells, self.positions_m = self.statements.gallery.cells, self.statements.positions_m[:, :2]
        starts, rows = containing_cells(self.cells, self.positions_m, training.best)
        self.neighbour_starts, self.neighbours = starts, rows

    def __len__(self) -> int:
        return len(self.training)

    def draw_cells(self, positions: npt.NDArray[np.intp], rng: np.random.Generator) -> npt.NDArray[np.intp]:
        """A cell for each position: the best, or, with map cloning, half of the time another that contains it."""
        start, end = self.neighbour_starts[positions], self.neighbour_starts[positions + 1]
        cloned = self.pmc & (rng.random(len(positions)) < CLONED) & (end > start)
        picked = start + (rng.random(len(positions)) * (end - start)).astype(np.intp)
        cells: npt.NDArray[np.intp] = np.array(self.training.best[positions])
        cells[cloned] = self.neighbours[picked[cloned]]
        return cells

    def batch(self, size: int, rng: np.random.Generator, with_matches: bool = True) -> FineBatch:
        """Examples with position, cell, hints, wording and orientation drawn at random.

        Args:
            size: B.
            rng: draws them.
            with_matches: whether to look up the instances meant; else all are -1.
        """
        positions = rng.choice(self.training.usable, size)
        cells = self.draw_cells(positions, rng)
        symmetry = rng.integers(len(SYMMETRIES), size=size)
        said = self.training.say(positions, symmetry, rng)
        match = np.full(said.mask.shape, -1, dtype=np.int64)
        for row in range(size) if with_matches else ():
            hints = said.hints[row, said.mask[row]]
            match[row, : len(hints)] = self._match(hints, int(cells[row]), self.positions_m[positions[row]])
        matrix = torch.from_numpy(SYMMETRIES[symmetry])
        offset = offsets_in(self.cells, cells, self.positions_m[positions]).astype(np.float32)
        return FineBatch(
            cells=reflect(self.training.features.batch(cells), matrix),
            sentences=torch.from_numpy(said.sentences),
            hint_mask=torch.from_numpy(said.mask),
            truth=FineTargets(reflect_offset(torch.from_numpy(offset), matrix), torch.from_numpy(match)),
        )

    def _match(self, hints: Ints, cell: int, position_m: Floats) -> Ints:
        """[H] which instance of a cell each hint means; of several parts of one, that nearest to the position."""
        parts = self.cells.parts
        rows = slice(parts.starts[cell], parts.starts[cell + 1])
        low, high = parts.low_m[rows, :2], parts.high_m[rows, :2]
        distance = np.linalg.norm(np.maximum(0, np.maximum(low - position_m, position_m - high)), axis=1)
        said = self.statements.mentioned_number[hints]
        is_meant = (self.statements.part_number[rows] == said[:, None]) & (said >= 0)[:, None]
        nearest: Ints = np.where(is_meant, distance, np.inf).argmin(axis=1)
        return np.where(is_meant.any(axis=1), nearest, -1)


@dataclass(frozen=True, slots=True, eq=False)
class FineValidation:
    """Queries with known positions, in the benchmark's wording.

    Attributes:
        features: the gallery.
        size_m: edge of its cells.
        descriptions: Q lists of sentences.
        rows: [Q, 2] the best cell of each, and another that contains the position (-1 if there is none).
        offset: [Q, 2, 2] the position in these.
    """

    features: CellFeatures
    size_m: float
    descriptions: Sequence[Sequence[str]]
    rows: npt.NDArray[np.intp]
    offset: Floats

    @classmethod
    def of(cls, gallery: Gallery, asked: Queries, model: FineModel) -> "FineValidation":
        """Of queries, each in its best cell and in another that contains its position; cells as a model takes them."""
        cells = gallery.cells
        starts, neighbours = containing_cells(cells, asked.positions_m, asked.truth)
        count = np.diff(starts)
        # The same at every run, and another from query to query.
        pick = starts[:-1] + np.random.default_rng(0).integers(np.maximum(count, 1))
        other = np.where(count > 0, np.append(neighbours, -1)[np.minimum(pick, len(neighbours))], -1)
        rows = np.column_stack([asked.truth, other])
        offset = offsets_in(cells, rows, asked.positions_m[:, None])
        features = model.with_point_features(CellFeatures.from_cells(cells, np.array(gallery.labels)))
        return cls(features, cells.size_m, asked.sentences, rows, offset)

    def residuals_m(self, model: FineModel) -> Floats:
        """[Q, 2, 2] metres from the truth to what a model predicts, (east, north), in each of the two cells."""
        predicted = model.predict(self.descriptions, self.features, self.rows)
        return (predicted - self.offset) * self.size_m

    def figures(self, model: FineModel) -> dict[str, float]:
        """Shares of the predictions within 5 and 10 m, given the best cell, and given the other."""
        return self._shares(np.linalg.norm(self.residuals_m(model), axis=-1))

    def center_figures(self) -> dict[str, float]:
        """The same of the cell's centre."""
        return self._shares(np.linalg.norm(0.5 - self.offset, axis=-1) * self.size_m)

    def _shares(self, error_m: Floats) -> dict[str, float]:
        known = self.rows[:, 1] >= 0
        errors = {"": error_m[:, 0], "neighbour_": error_m[known, 1]}
        return {
            f"{of}within_{radius}m": float((e <= radius).mean()) if len(e) else 0.0
            for of, e in errors.items()
            for radius in (5, 10)
        }


def containing_cells(cells: CellTable, positions_m: Floats, best: npt.NDArray[np.intp]) -> tuple[Ints, Ints]:
    """The other cells whose square contains a position: the prototypes of Text2Loc's map cloning.

    Args:
        cells: on their grid.
        positions_m: [N, 2].
        best: [N] the best cell of each, which says its scene and is left out.

    Returns:
        starts [N + 1] and cells: position n has cells[starts[n]:starts[n + 1]], ascending.
    """
    scene = np.unique(cells.scenes, return_inverse=True)[1] * SCENE_GAP_M
    tree = cKDTree(np.column_stack([cells.center_m[:, :2], scene]))
    found = tree.query_ball_point(np.column_stack([positions_m, scene[best]]), cells.size_m / 2, p=np.inf)
    others = [sorted(set(rows) - {int(own)}) for rows, own in zip(found, best, strict=True)]
    starts = np.concatenate([[0], np.cumsum([len(rows) for rows in others])]).astype(np.int64)
    return starts, np.array([row for rows in others for row in rows], dtype=np.int64)


def offsets_in(cells: CellTable, rows: npt.NDArray[Any], positions_m: Floats) -> Floats:
    """[..., 2] positions [..., 2] (metres) in some cells [...], 0..1 inside."""
    offset: Floats = (positions_m - cells.center_m[rows, :2]) / cells.size_m + 0.5
    return offset


def reflect_offset(offset: Tensor, matrix: Tensor) -> Tensor:
    """Positions [B, 2] in cells (0..1) under symmetries of the compass [B, 2, 2], as `reflect`."""
    return torch.einsum("bij,bj->bi", matrix, offset - 0.5) + 0.5
