"""Where vectors live: one protocol, one class a backend."""

from pathlib import Path
from typing import Any, Protocol

import faiss
import numpy as np
import numpy.typing as npt

from models.errors import IndexBroken

Floats = npt.NDArray[np.float32]
Rows = npt.NDArray[np.int64]
# From 20 queries on, FAISS multiplies matrices, whose rounding depends on the batch; below, each query is
# scanned alone, so that it finds the same bits whatever stands beside it.
QUERIES_PER_CALL = 16


class VectorStore(Protocol):
    """Unit vectors of cells, found by inner product."""

    dim: int

    def __len__(self) -> int: ...

    def search(self, queries: Floats, k: int) -> tuple[Floats, Rows]:
        """The k best cells of each query.

        Args:
            queries: [Q, D] finite.
            k: how many; cut to the size of the store.

        Returns:
            scores [Q, k] and rows [Q, k], best first, equal scores by row.
        """
        ...

    def score(self, query: Floats, rows: Rows) -> Floats:
        """[len(rows)] exact scores of one query [D] with some rows."""
        ...

    def vectors(self, rows: npt.NDArray[np.integer[Any]]) -> Floats:
        """[len(rows), D] the vectors of some rows."""
        ...

    def save(self, path: Path) -> None:
        """Write the vectors to a file."""
        ...


class FaissStore:
    """Exact search in memory (IndexFlatIP)."""

    def __init__(self, index: Any) -> None:
        self._index = index
        self.dim = int(index.d)
        self._vectors = faiss.rev_swig_ptr(index.get_xb(), index.ntotal * self.dim).reshape(index.ntotal, self.dim)

    @classmethod
    def of(cls, vectors: Floats) -> "FaissStore":
        """A store of vectors [N, D]."""
        index = faiss.IndexFlatIP(vectors.shape[1])
        index.add(np.ascontiguousarray(vectors))
        return cls(index)

    @classmethod
    def load(cls, path: Path) -> "FaissStore":
        """Read a store.

        Raises:
            IndexBroken: the file is not an index of this kind.
        """
        try:
            index = faiss.read_index(str(path))
        except RuntimeError as error:
            raise IndexBroken(f"{path} cannot be read; rebuild it with 'hereabouts index'") from error
        if not isinstance(index, faiss.IndexFlatIP):
            raise IndexBroken(
                f"{path} holds a {type(index).__name__}, expected IndexFlatIP; rebuild it with 'hereabouts index'"
            )
        return cls(index)

    def __len__(self) -> int:
        return int(self._index.ntotal)

    def search(self, queries: Floats, k: int) -> tuple[Floats, Rows]:
        """See VectorStore."""
        k = min(k, len(self))
        found = [
            self._index.search(queries[i : i + QUERIES_PER_CALL], k) for i in range(0, len(queries), QUERIES_PER_CALL)
        ]
        scores, rows = np.concatenate([f[0] for f in found]), np.concatenate([f[1] for f in found])
        order = np.lexsort((rows, -scores), axis=1)
        return np.take_along_axis(scores, order, axis=1), np.take_along_axis(rows, order, axis=1)

    def score(self, query: Floats, rows: Rows) -> Floats:
        """See VectorStore."""
        scores: Floats = self._vectors[rows] @ query
        return scores

    def vectors(self, rows: npt.NDArray[np.integer[Any]]) -> Floats:
        """See VectorStore."""
        vectors: Floats = self._vectors[rows]
        return vectors

    def save(self, path: Path) -> None:
        """See VectorStore."""
        path.write_bytes(faiss.serialize_index(self._index).data)  # FAISS itself does not say if the end is not written
