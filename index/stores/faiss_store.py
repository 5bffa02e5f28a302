"""Vectors in memory, from a file of the index: FAISS."""

from pathlib import Path
from typing import Any, Final

import faiss
import numpy as np
import numpy.typing as npt

from index.query import Box
from index.stores.store import Floats, Rows, best_first
from models.errors import IndexBroken

# From 20 queries on, FAISS multiplies matrices, whose rounding depends on the batch; below, each query is
# scanned alone, so that it finds the same bits whatever stands beside it.
QUERIES_PER_CALL: Final = 16
EXACT: Final = 20_000  # vectors; more of them are kept to 8 bits a number, a quarter of the size
QUANTIZED: Final = {8: faiss.ScalarQuantizer.QT_8bit, 16: faiss.ScalarQuantizer.QT_fp16}


class FaissStore:
    """Search of all vectors, in memory (IndexFlatIP; of many IndexScalarQuantizer).

    Args:
        index: FAISS's.
        positions_m: [N, 2] where the cells are, map metres; None if nobody asks by `within`.
    """

    def __init__(self, index: Any, positions_m: npt.NDArray[np.floating[Any]] | None = None) -> None:
        self._index, self._positions_m = index, positions_m
        self.dim = int(index.d)

    @classmethod
    def of(
        cls,
        vectors: Floats,
        positions_m: npt.NDArray[np.floating[Any]] | None = None,
        bits: int | None = None,
        like: "FaissStore | None" = None,
    ) -> "FaissStore":
        """A store of vectors [N, D]; see the class.

        Args:
            vectors: float32.
            positions_m: see the class.
            bits: of each number, 32, 16 or 8; None by how many vectors there are.
            like: a store that some of them are from: if it has 8 bits, so has this, in the same steps, and what is from
                there stays as it is; but for numbers of which some lie beyond the steps, which become longer.
        """
        steps = None if like is None else like._steps_for(vectors)
        dim, bits = vectors.shape[1], bits or (8 if len(vectors) > EXACT or steps is not None else 32)
        index: Any = faiss.IndexFlatIP(dim)
        if bits in QUANTIZED:
            index = faiss.IndexScalarQuantizer(dim, QUANTIZED[bits], faiss.METRIC_INNER_PRODUCT)
            if bits == 8 and steps is not None:
                faiss.copy_array_to_vector(steps, index.sq.trained)
                index.is_trained = True
            else:
                index.train(np.ascontiguousarray(vectors))
        index.add(np.ascontiguousarray(vectors))
        return cls(index, positions_m)

    @classmethod
    def load(cls, path: Path, positions_m: npt.NDArray[np.floating[Any]] | None = None) -> "FaissStore":
        """Read a store.

        Raises:
            IndexBroken: the file is not an index of this kind.
        """
        try:
            index = faiss.read_index(str(path))
        except RuntimeError as error:
            raise IndexBroken(f"{path} cannot be read; rebuild it with 'hereabouts index'") from error
        if not isinstance(index, faiss.IndexFlatIP | faiss.IndexScalarQuantizer):
            kind = type(index).__name__
            raise IndexBroken(f"{path} holds a {kind}, which none of this kind is; rebuild it with 'hereabouts index'")
        return cls(index, positions_m)

    def __len__(self) -> int:
        return int(self._index.ntotal)

    def search(self, queries: Floats, k: int, within: Box | None = None) -> tuple[Floats, Rows]:
        """See VectorStore."""
        params, k = None, min(k, len(self))
        if within is not None:
            chosen = self._inside(within)
            params, k = _only(chosen), min(k, len(chosen))
        if not k:
            return np.empty((len(queries), 0), np.float32), np.empty((len(queries), 0), np.int64)
        found = [
            self._index.search(queries[i : i + QUERIES_PER_CALL], k, params=params)
            for i in range(0, len(queries), QUERIES_PER_CALL)
        ]
        return best_first(np.concatenate([f[0] for f in found]), np.concatenate([f[1] for f in found]), k)

    def _steps_for(self, vectors: Floats) -> Floats | None:
        """[2 D] where the 8 bits of each number begin and how far they reach, for these too; None without 8 bits."""
        if getattr(self._index, "sq", None) is None or self._index.sq.qtype != QUANTIZED[8]:
            return None
        least, span = faiss.vector_to_array(self._index.sq.trained).reshape(2, -1)
        half = span / 255 * np.float32(0.51)  # a step: what was rounded to the last one lies so far beyond it
        low, high = vectors.min(axis=0, initial=np.inf), vectors.max(axis=0, initial=-np.inf)
        begin = np.where(low < least - half, low, least)
        end = np.where(high > least + span + half, high, least + span)
        is_same = (begin == least) & (end == least + span)
        steps: Floats = np.concatenate([begin, np.where(is_same, span, end - begin)]).astype(np.float32)
        return steps

    def _inside(self, within: Box) -> Rows:
        """The rows of the cells in a box."""
        assert self._positions_m is not None, "a store without positions cannot look within"
        x, y = self._positions_m.T
        return np.flatnonzero((x >= within.west) & (x <= within.east) & (y >= within.south) & (y <= within.north))

    def score(self, query: Floats, rows: Rows) -> Floats:
        """See VectorStore."""
        scores: Floats = self.vectors(rows) @ query
        return scores

    def vectors(self, rows: npt.NDArray[np.integer[Any]]) -> Floats:
        """See VectorStore."""
        vectors: Floats = self._index.reconstruct_batch(np.asarray(rows, np.int64))
        return vectors

    def save(self, path: Path) -> None:
        """Write the vectors to a file, which `load` reads."""
        path.write_bytes(faiss.serialize_index(self._index).data)  # FAISS itself does not say if the end is not written


def _only(rows: Rows) -> Any:
    """FAISS's parameters of a search in some rows alone."""
    search: Any = faiss.SearchParameters  # its keywords are added when faiss is imported
    return search(sel=faiss.IDSelectorBatch(rows))
