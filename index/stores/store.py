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
        """Return scores [Q, k] and rows [Q, k] of the k best cells of queries [Q, D], equal scores by row.

        `within` is a box for the cells' centres, map metres, edges included. k is cut to the number of cells in the
        store or in the box. Which cells are left out of those that tie with the last one is up to the store. Remote
        stores raise StoreUnavailable.
        """

    def score(self, query: Floats, rows: Rows) -> Floats:
        """Return exact scores [R] of one query [D] with rows [R]."""

    def vectors(self, rows: npt.NDArray[np.integer[Any]]) -> Floats:
        """Return the vectors [R, D] of rows [R]."""


def best_first(scores: Floats, rows: Rows, k: int) -> tuple[Floats, Rows]:
    """Return the k best of each query's scores [Q, M] and rows [Q, M], equal scores by row."""
    order = np.lexsort((rows, -scores), axis=1)[:, :k]
    return np.take_along_axis(scores, order, axis=1), np.take_along_axis(rows, order, axis=1)
