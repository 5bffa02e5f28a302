"""A vector store in a FAISS file."""

from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any, Final

import faiss
import numpy as np
import numpy.typing as npt

from index.answering.query import Box
from index.stores.store import Floats, Rows, best_first
from models.errors import IndexBroken
from models.memory import drop_pages

# From 20 queries on, FAISS multiplies matrices, and rounding depends on the batch. Below that each query is scanned
# alone, so its scores do not depend on the other queries.
QUERIES_PER_CALL: Final = 16
MAX_FLOAT_VECTORS: Final = 20_000  # larger stores have 8 bits per number, a quarter of the size
MAX_FLAT_VECTORS: Final = 200_000  # more are put into lists of similar ones, of which the nearest are searched
IVF_LISTS, IVF_PROBES = 1024, 32  # measured: finds .99 of the best 100 in a fiftieth of the time
MAX_PROBED_K: Final = 1000  # searches for more vectors use all lists
TRAINING_VECTORS_PER_LIST: Final = 64
VECTORS_PER_BLOCK: Final = 2**16  # bounds memory; FAISS fills lists in blocks of the same size
QUANTIZERS: Final = {8: faiss.ScalarQuantizer.QT_8bit, 16: faiss.ScalarQuantizer.QT_fp16}


class FaissStore:
    """Inner-product search: exact in small stores, quantized and in inverted lists in large ones.

    IndexFlatIP; over MAX_FLOAT_VECTORS IndexScalarQuantizer, over MAX_FLAT_VECTORS IndexIVFScalarQuantizer with the
    same 8 bits. The centres [N, 2] of the cells, map metres, are needed only for `within`.
    """

    def __init__(self, index: Any, positions_m: npt.NDArray[np.floating[Any]] | None = None) -> None:
        self._index, self._positions_m = index, positions_m
        self.dim = int(index.d)
        self._in_lists = isinstance(index, faiss.IndexIVFScalarQuantizer)

    @classmethod
    def from_vectors(
        cls, vectors: Floats, positions_m: npt.NDArray[np.floating[Any]] | None = None, bits: int | None = None
    ) -> "FaissStore":
        """Build a store of vectors [N, D], float32, with 32, 16 or 8 bits per number."""
        dim, bits = vectors.shape[1], bits or (8 if len(vectors) > MAX_FLOAT_VECTORS else 32)
        index: Any = faiss.IndexFlatIP(dim)
        if bits in QUANTIZERS:
            index = faiss.IndexScalarQuantizer(dim, QUANTIZERS[bits], faiss.METRIC_INNER_PRODUCT)
            index.train(np.stack(_value_range(vectors)))  # only the extremes matter
        if bits == 8 and len(vectors) > MAX_FLAT_VECTORS:
            return cls(_build_lists(vectors, index), positions_m)
        for block in _blocks(vectors):
            index.add(np.ascontiguousarray(block))
        return cls(index, positions_m)

    @classmethod
    def load(cls, path: Path, positions_m: npt.NDArray[np.floating[Any]] | None = None) -> "FaissStore":
        """Open a store, whose vectors stay in the file until they are used; or raise IndexBroken."""
        try:
            index = faiss.read_index(str(path), faiss.IO_FLAG_MMAP_IFC)
        except RuntimeError as error:
            raise IndexBroken(f"{path} cannot be read; rebuild it with 'hereabouts index'") from error
        if not isinstance(index, faiss.IndexFlatIP | faiss.IndexScalarQuantizer | faiss.IndexIVFScalarQuantizer):
            kind = type(index).__name__
            raise IndexBroken(f"{path} holds a {kind}, which is not supported; rebuild it with 'hereabouts index'")
        return cls(index, positions_m)

    def __len__(self) -> int:
        return int(self._index.ntotal)

    def search(self, queries: Floats, k: int, within: Box | None = None) -> tuple[Floats, Rows]:
        """Implement VectorStore."""
        chosen = None if within is None else self._inside(within)
        k = min(k, len(self) if chosen is None else int(chosen.sum()))
        if not k:
            return np.empty((len(queries), 0), np.float32), np.empty((len(queries), 0), np.int64)
        scores, rows = self._search(
            queries, k, self._params(chosen, IVF_PROBES if chosen is None and k <= MAX_PROBED_K else IVF_LISTS)
        )
        if self._in_lists and (rows < 0).any():  # the nearest lists have too few
            scores, rows = self._search(queries, k, self._params(chosen, IVF_LISTS))
        return best_first(scores, rows, k)

    def _search(self, queries: Floats, k: int, params: Any) -> tuple[Floats, Rows]:
        """Return scores and rows [Q, k] as FAISS gives them; a row is -1 where too few vectors were searched."""
        starts = range(0, len(queries), QUERIES_PER_CALL)
        results = [self._index.search(queries[i : i + QUERIES_PER_CALL], k, params=params) for i in starts]
        return np.concatenate([scores for scores, _ in results]), np.concatenate([rows for _, rows in results])

    def _params(self, chosen: npt.NDArray[np.bool_] | None, lists: int) -> Any:
        """Return FAISS's parameters for a search among chosen rows [N] (None for all) in a number of lists."""
        kinds: Any = faiss  # the constructors are patched at import
        selector = {} if chosen is None else {"sel": kinds.IDSelectorBitmap(np.packbits(chosen, bitorder="little"))}
        if self._in_lists:
            return kinds.SearchParametersIVF(nprobe=lists, **selector)
        return kinds.SearchParameters(**selector) if selector else None

    def _inside(self, within: Box) -> npt.NDArray[np.bool_]:
        assert self._positions_m is not None, "a store without positions cannot search within a box"
        x, y = self._positions_m.T
        return np.asarray((x >= within.west) & (x <= within.east) & (y >= within.south) & (y <= within.north))

    def score(self, query: Floats, rows: Rows) -> Floats:
        """Implement VectorStore."""
        return self.vectors(rows) @ query

    def vectors(self, rows: npt.NDArray[np.integer[Any]]) -> Floats:
        """Implement VectorStore."""
        return self._index.reconstruct_batch(np.asarray(rows, np.int64))

    def save(self, path: Path) -> None:
        """Write the file that `load` reads."""
        failed: OSError | None = None
        kinds: Any = faiss  # some of which have no types

        def write(block: bytes) -> int:
            nonlocal failed
            try:
                return file.write(block)
            except OSError as error:  # FAISS would hide the cause
                failed = error
                raise

        with path.open("wb") as file:
            try:
                faiss.write_index(self._index, kinds.PyCallbackIOWriter(write))
            except RuntimeError as error:
                raise failed or error from error


def _build_lists(vectors: Floats, flat: Any) -> Any:
    """Put vectors [N, D] into lists of similar ones, quantized to 8 bits by a trained index.

    Lists get their final size at once, because a growing list takes up to twice the memory.
    """
    kinds: Any = faiss  # some of which have no types
    index = _train_lists(vectors, flat)
    lists = kinds.downcast_InvertedLists(index.invlists)
    list_numbers = np.concatenate(
        [index.quantizer.search(block, 1)[1][:, 0].astype(np.int16) for block in _blocks(vectors)]
    )
    for number, size in enumerate(np.bincount(list_numbers, minlength=IVF_LISTS).tolist()):
        lists.resize(number, size)
    filled, row = np.zeros(IVF_LISTS, np.int64), 0
    for block in _blocks(vectors):
        block_lists = list_numbers[row : row + len(block)]
        order = np.argsort(block_lists, kind="stable")
        ids, codes = row + order, flat.sa_encode(block)[order]
        ends = np.cumsum(np.bincount(block_lists, minlength=IVF_LISTS))
        for number, (first, last) in enumerate(pairwise([0, *ends.tolist()])):
            entries = kinds.swig_ptr(ids[first:last]), kinds.swig_ptr(codes[first:last])
            lists.update_entries(number, int(filled[number]), last - first, *entries)
        filled, row = filled + np.diff(ends, prepend=0), row + len(block)
    index.ntotal = len(vectors)
    index.make_direct_map()  # maps rows to vectors
    return index


def _train_lists(vectors: Floats, flat: Any) -> Any:
    dim = vectors.shape[1]
    # by_residual is off, so a vector has the same bits in any list and in a store without lists.
    arguments = dim, IVF_LISTS, QUANTIZERS[8], faiss.METRIC_INNER_PRODUCT, False
    index: Any = faiss.IndexIVFScalarQuantizer(faiss.IndexFlatIP(dim), *arguments)
    index.cp.max_points_per_centroid = TRAINING_VECTORS_PER_LIST
    sample = np.random.default_rng(0).choice(
        len(vectors), min(len(vectors), TRAINING_VECTORS_PER_LIST * IVF_LISTS), replace=False
    )
    is_sampled = np.zeros(len(vectors), np.bool_)
    is_sampled[sample] = True
    chosen = zip(
        _blocks(vectors), np.split(is_sampled, range(VECTORS_PER_BLOCK, len(vectors), VECTORS_PER_BLOCK)), strict=True
    )
    index.train(np.concatenate([block[chosen_rows] for block, chosen_rows in chosen]))
    faiss.copy_array_to_vector(faiss.vector_to_array(flat.sq.trained), index.sq.trained)
    return index


def _blocks(vectors: Floats) -> Iterator[Floats]:
    """Yield blocks of vectors [N, D]; pages of a mapped file are dropped after use."""
    for first in range(0, len(vectors), VECTORS_PER_BLOCK):
        yield vectors[first : first + VECTORS_PER_BLOCK]
        drop_pages()


def _value_range(vectors: Floats) -> tuple[Floats, Floats]:
    """Return the lowest and the highest value [D] of vectors [N, D]; infinite if there are none."""
    dim = vectors.shape[1]
    low, high = np.full(dim, np.inf, np.float32), np.full(dim, -np.inf, np.float32)
    for block in _blocks(vectors):
        low, high = np.minimum(low, block.min(axis=0)), np.maximum(high, block.max(axis=0))
    return low, high
