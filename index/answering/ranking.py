"""Cells in order for a description: vector search by the global level, then all levels on the best of them."""

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

RERANKED = 100  # cells whose other levels are looked at


class Ranker:
    """Scores of a gallery's cells, by as many levels as there are.

    Args:
        retriever: the model that made store and table.
        store: the gallery's vectors, global level.
        table: its other levels; empty if the retriever has none, or they are not needed.
        depth: cells whose other levels are looked at: 0 is the global level alone, the size of the gallery MNCL's
            released code.
    """

    def __init__(self, retriever: Retriever, store: VectorStore, table: LevelTable, depth: int = RERANKED) -> None:
        self.retriever, self.store, self.table, self.depth = retriever, store, table, depth

    @classmethod
    def of(
        cls,
        retriever: Retriever,
        cells: CellTable,
        labels: Sequence[str],
        depth: int = RERANKED,
    ) -> "Ranker":
        """Encode a gallery.

        Args:
            retriever: the model.
            cells: the gallery.
            labels: of each instance that its parts name.
            depth: see Ranker.
        """
        features = retriever.with_point_features(CellFeatures.from_cells(cells, np.array(labels)))
        vectors, table = encode_gallery(retriever, features)
        return cls(retriever, FaissStore.of(vectors), table, depth)

    @classmethod
    def load(cls, retriever: Retriever, directory: Path, store: VectorStore) -> "Ranker":
        """Read the levels other than the global one, if there are any; the store keeps that.

        Args:
            retriever: the model that made it; its levels are read.
            directory: where it is.
            store: the vectors of the global level.

        Raises:
            IndexBroken: it is not an index of this model.
        """
        table = EMPTY_LEVEL_TABLE if retriever.levels == ("global",) else LevelTable.load(directory, retriever.levels)
        return cls(retriever, store, table)

    def search(self, texts: Sequence[Levels], k: int) -> tuple[Floats, Rows]:
        """The k best cells of each description by the global level alone; arguments and return as `rank`."""
        return self.store.search(np.concatenate([text.global_vectors.cpu().numpy() for text in texts]), k)

    def rank(self, texts: Sequence[Levels], k: int) -> tuple[Floats, Rows]:
        """The k best cells of each description.

        Args:
            texts: Q descriptions (`Retriever.encode_description`).
            k: how many; cut to the size of the gallery.

        Returns:
            scores [Q, k] and rows [Q, k], best first, equal scores by row.
        """
        scores, rows = self.search(texts, k if self._is_global else max(k, self.depth))
        if not self._is_global:
            scores = np.stack([self._refine(*part) for part in zip(texts, rows, scores, strict=True)])
            order = np.lexsort((rows, -scores), axis=1)
            scores, rows = np.take_along_axis(scores, order, axis=1), np.take_along_axis(rows, order, axis=1)
        return scores[:, :k], rows[:, :k]

    def score(self, text: Levels, rows: npt.NDArray[np.int64]) -> Floats:
        """[len(rows)] scores of some cells, comparable with those of `rank`."""
        whole = self.store.score(text.global_vectors[0].cpu().numpy(), rows)
        if self._is_global or not len(rows):
            return whole
        order = np.argsort(-whole, kind="stable")
        scores = np.empty_like(whole)
        scores[order] = self._refine(text, rows[order], whole[order])
        return scores

    def temperature(self, num_hints: int) -> float:
        """See `Retriever.temperature`."""
        return self.retriever.temperature(num_hints, self._is_global)

    @property
    def _is_global(self) -> bool:
        """Whether no other level is looked at."""
        return self.table.is_empty or not self.depth

    def _refine(self, text: Levels, rows: npt.NDArray[np.integer[Any]], whole: Floats) -> Floats:
        """[C] scores of cells in order of the global level; those beyond the depth count as no better at the others."""
        first = rows[: self.depth]
        by_level = {**self.table.scores([text], first), "global": whole[None, : len(first)]}
        refined = self.retriever.combine(by_level)[0]
        rest = whole[len(first) :] + (refined - whole[: len(first)]).min()
        return np.concatenate([refined, rest]).astype(np.float32)
