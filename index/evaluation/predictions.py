"""Predictions for queries with known positions: saved first, scored afterwards."""

import json
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from models.citymap.types import Floats
from models.errors import DataError
from models.files import open_atomic

PREDICTIONS_FILE = "predictions.npz"
FACTS_FIELD = "facts"
Ints = npt.NDArray[np.integer[Any]]
Words = npt.NDArray[np.str_]


@dataclass(frozen=True, slots=True, eq=False)
class Predictions:
    """Predictions for Q queries in a gallery of N cells."""

    facts: dict[str, Any]  # data, split, model and other facts for the report
    cell_ids: Words
    cell_scenes: Words  # [N]
    cell_centers_m: Floats  # [N, 2] float64
    queried_cells: Ints  # [Q] row of the true best cell, -1 if the gallery has none
    positions_m: Floats
    scenes: Words
    strategies: Words
    ranked: Ints  # [Q, K] rows of cells, best first; -1 where the gallery ends
    scores: Floats  # [Q, K] float32
    predicted_m: Floats  # [Q, J, 2] float64, in each of the first J cells
    probability: Floats  # [Q] that the first cell is the true one
    radius_m: Floats  # [Q, 2] radii around the first prediction for probability 0.5 and 0.9; NaN if unknown

    def save(self, path: Path) -> None:
        """Write one .npz file, completely or not at all."""
        arrays = {f.name: getattr(self, f.name) for f in fields(self) if f.name != FACTS_FIELD}
        with open_atomic(path) as file:
            np.savez_compressed(file, facts=np.array(json.dumps(self.facts)), **arrays)

    @classmethod
    def load(cls, path: Path) -> "Predictions":
        """Read the file that `save` wrote; DataError if it is missing or invalid."""
        try:
            with np.load(path, allow_pickle=False) as file:
                arrays = {f.name: file[f.name] for f in fields(cls)}
            predictions = cls(**arrays | {FACTS_FIELD: json.loads(str(arrays[FACTS_FIELD]))})
        except FileNotFoundError:
            raise DataError(
                f"{path}: no such file; make it with 'hereabouts evaluate --data ... --report DIR'"
            ) from None
        except Exception as error:  # zip, numpy and JSON raise different errors
            raise DataError(f"{path}: contains no predictions ({error}); evaluate again") from error
        predictions._check(path)
        return predictions

    def _check(self, path: Path) -> None:
        cells, queries = len(self.cell_ids), len(self.queried_cells)
        for name in (f.name for f in fields(self) if f.name != FACTS_FIELD):
            count, expected = len(getattr(self, name)), cells if name.startswith("cell_") else queries
            if count != expected:
                raise DataError(f"{path}: field '{name}' has {count} rows, expected {expected}; evaluate again")
        for name in ("ranked", "queried_cells"):
            rows = getattr(self, name)
            if rows.size and not -1 <= rows.min() <= rows.max() < cells:
                raise DataError(f"{path}: field '{name}' points outside the gallery; evaluate again")

    def errors_m(self) -> Floats:
        """Return the errors [Q, J] of the predicted positions in the plane; infinite in another scene."""
        return np.where(self._same_scene(self.ranked[:, : self.predicted_m.shape[1]]), self.distances_m(), np.inf)

    def distances_m(self) -> Floats:
        """Return the distances [Q, J] to the truth in the common frame, also in another scene."""
        return np.linalg.norm(self.predicted_m - self.positions_m[:, None], axis=2)

    def center_errors_m(self, rows: Ints) -> Floats:
        """Return the distances [Q, J] from cell centres to the truth in the plane; infinite in another scene."""
        distance: Floats = np.linalg.norm(self.cell_centers_m[rows] - self.positions_m[:, None], axis=2)
        return np.where(self._same_scene(rows), distance, np.inf)

    def _same_scene(self, rows: Ints) -> npt.NDArray[np.bool_]:
        return (rows >= 0) & (self.cell_scenes[rows] == self.scenes[:, None])
