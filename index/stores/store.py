"""The interface of vector stores; tests/index/stores/test_contract.py tests every implementation."""

from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from index.answering.query import Box

Floats = npt.NDArray[np.float32]
Rows = npt.NDArray[np.int64]


class VectorStore(Protocol):
    """Unit vectors of cells, searched by inner product."""

    dim: int

    def __len__(self) -> int: ...

    def search(self, queries: Floats, k: int, within: Box | None = None) -> tuple[Floats, Rows]:
        """Return the k best cells of each query.

        Args:
            queries: [Q, D] finite.
            k: number of cells; cut to the number of cells in the store or inside `within`.
            within: box for the cells' centres, map metres, edges included; None for no box.

        Returns:
            Scores [Q, k] and rows [Q, k], best first, equal scores by row. Which cells are left
            out of those that tie with the last one is up to the store.

        Raises:
            StoreUnavailable: the store is remote and does not answer.
        """
        ...

    def score(self, query: Floats, rows: Rows) -> Floats:
        """Return exact scores [R] of one query [D] with rows [R]; raises as `search`."""
        ...

    def vectors(self, rows: npt.NDArray[np.integer[Any]]) -> Floats:
        """Return the vectors [R, D] of rows [R]; raises as `search`."""
        ...


def best_first(scores: Floats, rows: Rows, k: int) -> tuple[Floats, Rows]:
    """Return the k best of each query's scores [Q, M] and rows [Q, M], equal scores by row."""
    order = np.lexsort((rows, -scores), axis=1)[:, :k]
    return np.take_along_axis(scores, order, axis=1), np.take_along_axis(rows, order, axis=1)
