"""Examples for the fine stage: a description, a cell that contains its position, and the offset in the cell."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

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
from models.training.retrieval_data import SYMMETRIES, DrawnHints, TrainingSet

CLONED_SHARE = 0.5  # of the examples use another cell than the best one (map cloning)
# Of Text2Loc's map cloning: how far away the centre of a cell may be on each axis, and how many hints it may lack.
CLONE_REACH_M, CLONE_MISMATCHES = 12.0, 1
MIN_CLONE_DISTANCE_M = 0.1  # avoids a division by zero where a position is at a centre
CloningMode = Literal["none", "containing", "published"]


@dataclass(frozen=True, slots=True, eq=False)
class FineBatch:
    """A batch of B descriptions, each with one cell that contains its position."""

    cells: CellBatch
    sentences: Tensor  # [B, H] index into the vocabulary
    hint_mask: Tensor  # [B, H] False at padding
    targets: FineTargets


class FineSet:
    """A training set of a fine stage, with the offset in the cell and the instance of each hint.

    With prototype-based map cloning (Text2Loc), half of the examples use another cell instead of the best one: with
    `pmc` "containing" any that contains the position; with "published" one whose centre is within 12 m of it on both
    axes and which lacks the instance of at most one hint, drawn by inverse distance to its centre, as in Text2Loc.
    """

    def __init__(self, training: TrainingSet, pmc: CloningMode = "containing") -> None:
        self.training, self.statements, self.pmc = training, training.statements, pmc
        self.cells, self.positions_m = self.statements.gallery.cells, self.statements.positions_m[:, :2]
        starts, rows = containing_cells(self.cells, self.positions_m, training.best)
        self.neighbour_starts, self.neighbours = starts, rows

    def __len__(self) -> int:
        return len(self.training)

    def draw_cells(self, positions: npt.NDArray[np.intp], rng: np.random.Generator) -> npt.NDArray[np.intp]:
        """Draw a cell for each position: the best one or, with "containing" cloning, often another that contains it."""
        start, end = self.neighbour_starts[positions], self.neighbour_starts[positions + 1]
        cloned = (self.pmc == "containing") & (rng.random(len(positions)) < CLONED_SHARE) & (end > start)
        picked = start + (rng.random(len(positions)) * (end - start)).astype(np.intp)
        cells: npt.NDArray[np.intp] = np.array(self.training.best[positions])
        cells[cloned] = self.neighbours[picked[cloned]]
        return cells

    def draw_published(
        self, positions: npt.NDArray[np.intp], drawn: DrawnHints, rng: np.random.Generator
    ) -> npt.NDArray[np.intp]:
        """Draw a cell for each position and its drawn hints, often another than the best one, as Text2Loc does."""
        cells: npt.NDArray[np.intp] = np.array(self.training.best[positions])
        for row in np.flatnonzero(rng.random(len(positions)) < CLONED_SHARE):
            position = positions[row]
            candidates, distance_m = self.clones(int(position), drawn.hints[row, drawn.mask[row]])
            if len(candidates):
                closeness = 1 / np.maximum(distance_m, MIN_CLONE_DISTANCE_M)
                cells[row] = rng.choice(candidates, p=closeness / closeness.sum())
        return cells

    def clones(self, position: int, hints: Ints) -> tuple[Ints, Floats]:
        """Return the cells that Text2Loc may clone for a position and its hints, and the distance to their centres."""
        position_m = self.positions_m[position]
        others = self.neighbours[self.neighbour_starts[position] : self.neighbour_starts[position + 1]]
        away_m = np.abs(self.cells.center_m[others, :2] - position_m)
        within = away_m.max(axis=1) < CLONE_REACH_M
        known = int((self.statements.mentioned_number[hints] >= 0).sum())
        few = [known - (self._match(hints, int(cell), position_m) >= 0).sum() <= CLONE_MISMATCHES for cell in others]
        valid = within & np.array(few, dtype=bool)
        return others[valid], np.linalg.norm(away_m[valid], axis=1)

    def batch(self, size: int, rng: np.random.Generator, with_matches: bool = True) -> FineBatch:
        """Draw examples with random position, cell, hints, wording and orientation; without matches, all are -1."""
        positions = rng.choice(self.training.usable, size)
        cells = self.draw_cells(positions, rng)
        symmetry = rng.integers(len(SYMMETRIES), size=size)
        drawn = self.training.draw_hints(positions, symmetry, rng)
        if self.pmc == "published":
            cells = self.draw_published(positions, drawn, rng)
        match = np.full(drawn.mask.shape, -1, dtype=np.int64)
        for row in range(size) if with_matches else ():
            hints = drawn.hints[row, drawn.mask[row]]
            match[row, : len(hints)] = self._match(hints, int(cells[row]), self.positions_m[positions[row]])
        matrix = torch.from_numpy(SYMMETRIES[symmetry])
        offset = cell_offsets(self.cells, cells, self.positions_m[positions]).astype(np.float32)
        return FineBatch(
            cells=self.training.draw_cells(cells, symmetry, rng),
            sentences=torch.from_numpy(drawn.sentences),
            hint_mask=torch.from_numpy(drawn.mask),
            targets=FineTargets(reflect_offset(torch.from_numpy(offset), matrix), torch.from_numpy(match)),
        )

    def _match(self, hints: Ints, cell: int, position_m: Floats) -> Ints:
        """Return the instance [H] of a cell that each hint refers to; of several parts, the nearest to the position."""
        parts = self.cells.parts
        rows = slice(parts.starts[cell], parts.starts[cell + 1])
        low, high = parts.low_m[rows, :2], parts.high_m[rows, :2]
        distance = np.linalg.norm(np.maximum(0, np.maximum(low - position_m, position_m - high)), axis=1)
        number = self.statements.mentioned_number[hints]
        is_match = (self.statements.part_number[rows] == number[:, None]) & (number >= 0)[:, None]
        nearest: Ints = np.where(is_match, distance, np.inf).argmin(axis=1)
        return np.where(is_match.any(axis=1), nearest, -1)


@dataclass(frozen=True, slots=True, eq=False)
class FineValidation:
    """Validation queries of a fine stage, in the wording of the benchmark."""

    features: CellFeatures  # of the gallery
    size_m: float  # edge of a cell
    descriptions: Sequence[Sequence[str]]  # Q lists of sentences
    # [Q, 2] best cell of each query, and another that contains the position; -1 for none
    rows: npt.NDArray[np.intp]
    offset: Floats  # [Q, 2, 2] true position in these cells, 0..1

    @classmethod
    def from_queries(cls, gallery: Gallery, queries: Queries, model: FineModel) -> "FineValidation":
        """Return the validation set of queries, each with its best cell and another cell that contains its position."""
        cells = gallery.cells
        starts, neighbours = containing_cells(cells, queries.positions_m, queries.truth)
        count = np.diff(starts)
        # Seeded, so that every run validates with the same cells.
        pick = starts[:-1] + np.random.default_rng(0).integers(np.maximum(count, 1))
        other = np.where(count > 0, np.append(neighbours, -1)[np.minimum(pick, len(neighbours))], -1)
        rows = np.column_stack([queries.truth, other])
        offset = cell_offsets(cells, rows, queries.positions_m[:, None])
        features = CellFeatures.from_cells(cells, np.array(gallery.labels))
        if model.config.points_frozen:
            features = model.with_point_features(features)
        return cls(features, cells.size_m, queries.sentences, rows, offset)

    def residuals_m(self, model: FineModel) -> Floats:
        """Return the errors [Q, 2, 2] of a model's predictions in the two cells, metres (east, north)."""
        predicted = model.predict(self.descriptions, model.validation_features(self.features), self.rows)
        return (predicted - self.offset) * self.size_m

    def metrics(self, model: FineModel) -> dict[str, float]:
        """Return the shares of predictions within 5 and 10 m, in the best cell and in the other one."""
        return self._shares(np.linalg.norm(self.residuals_m(model), axis=-1))

    def center_metrics(self) -> dict[str, float]:
        """Return the same shares for the centre of the cell as the prediction."""
        return self._shares(np.linalg.norm(0.5 - self.offset, axis=-1) * self.size_m)

    def _shares(self, error_m: Floats) -> dict[str, float]:
        known = self.rows[:, 1] >= 0
        errors = {"": error_m[:, 0], "neighbour_": error_m[known, 1]}
        return {
            f"{prefix}within_{radius}m": float((e <= radius).mean()) if len(e) else 0.0
            for prefix, e in errors.items()
            for radius in (5, 10)
        }


def containing_cells(cells: CellTable, positions_m: Floats, best: npt.NDArray[np.intp]) -> tuple[Ints, Ints]:
    """Return the cells other than the best [N] that contain each position [N, 2], for Text2Loc's map cloning.

    Returns starts [N + 1] and cells; position n has cells[starts[n]:starts[n + 1]], ascending.
    """
    scene = np.unique(cells.scenes, return_inverse=True)[1] * SCENE_GAP_M
    tree = cKDTree(np.column_stack([cells.center_m[:, :2], scene]))
    containing = tree.query_ball_point(np.column_stack([positions_m, scene[best]]), cells.size_m / 2, p=np.inf)
    others = [sorted(set(rows) - {int(own)}) for rows, own in zip(containing, best, strict=True)]
    starts = np.concatenate([[0], np.cumsum([len(rows) for rows in others])]).astype(np.int64)
    return starts, np.array([row for rows in others for row in rows], dtype=np.int64)


def cell_offsets(cells: CellTable, rows: npt.NDArray[Any], positions_m: Floats) -> Floats:
    """Return the offsets [..., 2] of positions [..., 2] in cells [...], 0..1 inside."""
    return (positions_m - cells.center_m[rows, :2]) / cells.size_m + 0.5


def reflect_offset(offset: Tensor, matrix: Tensor) -> Tensor:
    """Apply symmetries of the compass [B, 2, 2] to offsets [B, 2] in cells, as `reflect_cells` does."""
    return torch.einsum("bij,bj->bi", matrix, offset - 0.5) + 0.5
