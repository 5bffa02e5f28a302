"""Descriptions with known positions for evaluation, and all true hints at positions for training."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from models.citymap.cells import CellTable
from models.citymap.gallery import Gallery
from models.citymap.hints import BEST_CELL_REACH_M, HintTable
from models.citymap.templates import render_hint
from models.citymap.types import Floats, Hint


@dataclass(frozen=True, slots=True, eq=False)
class Queries:
    """Q descriptions with known positions."""

    # The hint sentences of each description, in the benchmark's wording or the user's own
    sentences: Sequence[tuple[str, ...]]
    positions_m: Floats  # [Q, 2] float64 true positions, map frame
    truth: npt.NDArray[np.intp]  # [Q] row of the best cell, -1 if no centre is within 15 m of the position
    scenes: Sequence[str]  # scene of each query; a result in another scene is wrong
    strategies: Sequence[str]  # how the hints were chosen, "" if unknown
    hints: Sequence[tuple[Hint, ...]] | None = None  # the hints of each description; None where only text is known

    @classmethod
    def from_text(cls, sentences: Sequence[tuple[str, ...]], positions_m: Floats, cells: CellTable) -> "Queries":
        """Build queries from texts and the positions [Q, 2] described; the best cell has the nearest centre."""
        distance, nearest = cKDTree(cells.center_m[:, :2]).query(positions_m)
        scenes = [cells.scenes[n] for n in nearest]
        truth = np.where(distance <= BEST_CELL_REACH_M, nearest, -1)
        return cls(sentences, positions_m, truth, scenes, [""] * len(sentences))

    @classmethod
    def from_hints(
        cls,
        hints: Sequence[tuple[Hint, ...]],
        positions_m: Floats,
        truth: npt.NDArray[np.intp],
        strategies: Sequence[str],
        cells: CellTable,
    ) -> "Queries":
        """Build queries in the benchmark's wording; arguments as the attributes, for the gallery `cells`."""
        sentences = [tuple(render_hint(hint) for hint in description) for description in hints]
        return cls(sentences, positions_m, truth, [cells.scenes[n] for n in truth], strategies, hints)

    @classmethod
    def concatenate(cls, parts: Sequence["Queries"]) -> "Queries":
        """Return the queries of several groups over one gallery, all with hints, as one."""

        def all_of(name: str) -> list[Any]:
            return [one for part in parts for one in getattr(part, name)]

        positions_m, truth = (
            np.concatenate([getattr(part, name) for part in parts]) for name in ("positions_m", "truth")
        )
        return cls(all_of("sentences"), positions_m, truth, *map(all_of, ("scenes", "strategies", "hints")))

    def __len__(self) -> int:
        return len(self.truth)

    def take(self, rows: npt.NDArray[np.intp]) -> "Queries":
        """Return the given queries."""
        return Queries(
            sentences=[self.sentences[q] for q in rows],
            positions_m=self.positions_m[rows],
            truth=self.truth[rows],
            scenes=[self.scenes[q] for q in rows],
            strategies=[self.strategies[q] for q in rows],
            hints=None if self.hints is None else [self.hints[q] for q in rows],
        )


@dataclass(frozen=True, slots=True, eq=False)
class PositionStatements:
    """Positions with all hints that are true there."""

    gallery: Gallery
    positions_m: Floats  # [N, 2 or more] positions; those of different scenes are far from each other
    best: npt.NDArray[np.intp]  # [N] best cell of each position
    table: HintTable
    labels: Sequence[str]  # label of each instance in the table
    words: tuple[str, ...]  # colour words that the table numbers
    part_number: npt.NDArray[Any]  # [R] number of the instance of each row of the cells' parts
    mentioned_number: npt.NDArray[Any]  # [H] number of the instance of each row of the table, -1 if unknown
