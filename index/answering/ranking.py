"""Ranking of cells for a description: vector search by the global level, then re-ranking by all levels."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from index.stores.faiss_store import FaissStore
from index.stores.store import Floats, Rows, VectorStore
from models.citymap.cells import CellTable
from models.paper.instance_encoder import CellFeatures
from models.paper.level_table import EMPTY_LEVEL_TABLE, LevelTable, encode_gallery
from models.paper.levels import Levels
from models.paper.retriever import Retriever

RERANKED_CELLS = 100  # cells re-ranked by the other levels


class Ranker:
    """Ranks the cells of a gallery by the global level in `store` and the other levels in `table`.

    `depth` cells are ranked again by the other levels: none for 0, all as in MNCL's released code.
    """

    def __init__(
        self, retriever: Retriever, store: VectorStore, table: LevelTable, depth: int = RERANKED_CELLS
    ) -> None:
        self.retriever, self.store, self.table, self.depth = retriever, store, table, depth

    @classmethod
    def from_cells(
        cls, retriever: Retriever, cells: CellTable, labels: Sequence[str], depth: int = RERANKED_CELLS
    ) -> "Ranker":
        """Encode a gallery."""
        features = retriever.with_point_features(CellFeatures.from_cells(cells, np.array(labels)))
        vectors, table = encode_gallery(retriever, features)
        return cls(retriever, FaissStore.from_vectors(vectors), table, depth)

    @classmethod
    def load(cls, retriever: Retriever, directory: Path, store: VectorStore) -> "Ranker":
        """Read the levels other than the global one, which is in the store; IndexBroken if they cannot be read."""
        table = EMPTY_LEVEL_TABLE if retriever.levels == ("global",) else LevelTable.load(directory, retriever.levels)
        return cls(retriever, store, table)

    def search(self, texts: Sequence[Levels], k: int) -> tuple[Floats, Rows]:
        """Return the k best cells by the global level alone, as `rank`."""
        return self.store.search(np.concatenate([text.global_vectors.cpu().numpy() for text in texts]), k)

    def rank(self, texts: Sequence[Levels], k: int) -> tuple[Floats, Rows]:
        """Return scores [Q, k] and rows [Q, k] of the k best cells of each description, equal scores by row."""
        scores, rows = self.search(texts, k if self._is_global else max(k, self.depth))
        if not self._is_global:
            scores = np.stack([self._refine(*part) for part in zip(texts, rows, scores, strict=True)])
            order = np.lexsort((rows, -scores), axis=1)
            scores, rows = np.take_along_axis(scores, order, axis=1), np.take_along_axis(rows, order, axis=1)
        return scores[:, :k], rows[:, :k]

    def score(self, text: Levels, rows: npt.NDArray[np.int64]) -> Floats:
        """Return the scores of some cells, comparable with those of `rank`."""
        global_scores = self.store.score(text.global_vectors[0].cpu().numpy(), rows)
        if self._is_global or not len(rows):
            return global_scores
        order = np.argsort(-global_scores, kind="stable")
        scores = np.empty_like(global_scores)
        scores[order] = self._refine(text, rows[order], global_scores[order])
        return scores

    def temperature(self, num_hints: int) -> float:
        """Return the temperature of the probabilities, as `Retriever.temperature`."""
        return self.retriever.temperature(num_hints, self._is_global)

    def margin_nats(self, scores: Floats, num_hints: int) -> float:
        """Return the log ratio of the probabilities of a text's first and last cell, given their scores by `search`."""
        return float(scores[0] - scores[-1]) / self.retriever.temperature(num_hints, global_only=True)

    @property
    def _is_global(self) -> bool:
        return self.table.is_empty or not self.depth

    def _refine(self, text: Levels, rows: npt.NDArray[np.integer[Any]], global_scores: Floats) -> Floats:
        """Return scores [C] of cells in global order; cells beyond the depth cannot rise above the others."""
        first = rows[: self.depth]
        by_level = {
            **self.table.scores([text], first, self.retriever.matching),
            "global": global_scores[None, : len(first)],
        }
        refined = self.retriever.combine(by_level)[0]
        rest = global_scores[len(first) :] + (refined - global_scores[: len(first)]).min()
        return np.concatenate([refined, rest]).astype(np.float32)
