"""What a store of vectors can do; tests/index/stores/test_contract.py holds every backend to it."""

from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from index.answering.query import Box

Floats = npt.NDArray[np.float32]
Rows = npt.NDArray[np.int64]


class VectorStore(Protocol):
    """Unit vectors of cells, found by inner product."""

    dim: int

    def __len__(self) -> int: ...

    def search(self, queries: Floats, k: int, within: Box | None = None) -> tuple[Floats, Rows]:
        """The k best cells of each query.

        Args:
            queries: [Q, D] finite.
            k: how many; cut to the size of the store, or to how many cells lie inside.
            within: where their centres must be, map metres, its edges included; None is anywhere.

        Returns:
            scores [Q, k] and rows [Q, k], best first, equal scores by row. Which cells are left out of those that
            score as the last one does is up to the store.

        Raises:
            StoreUnavailable: the store is elsewhere and does not answer.
        """
        ...

    def score(self, query: Floats, rows: Rows) -> Floats:
        """[len(rows)] exact scores of one query [D] with some rows; may raise as `search`."""
        ...

    def vectors(self, rows: npt.NDArray[np.integer[Any]]) -> Floats:
        """[len(rows), D] the vectors of some rows; may raise as `search`."""
        ...


def best_first(scores: Floats, rows: Rows, k: int) -> tuple[Floats, Rows]:
    """The k best of each query's scores [Q, M] and rows [Q, M], equal scores by row."""
    order = np.lexsort((rows, -scores), axis=1)[:, :k]
    return np.take_along_axis(scores, order, axis=1), np.take_along_axis(rows, order, axis=1)
