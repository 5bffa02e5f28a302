"""Vectors in a file of the index: FAISS."""

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
from models.spool import forget

# From 20 queries on, FAISS multiplies matrices, whose rounding depends on the batch; below, each query is
# scanned alone, so that it finds the same bits whatever stands beside it.
QUERIES_PER_CALL: Final = 16
EXACT: Final = 20_000  # vectors; more of them are kept to 8 bits a number, a quarter of the size
MANY: Final = 200_000  # vectors; more of them are put into lists of like ones, and only the nearest lists are searched
LISTS, SEARCHED = 1024, 32  # of which are found .99 of the best 100 that all lists have, in a fiftieth of the time
FEW: Final = 1000  # who wants more vectors gets those of all lists
SAMPLED: Final = 64  # vectors a list that lists are made by
AT_ONCE: Final = 2**16  # vectors that are looked at together; FAISS, too, puts so many into lists at a time
QUANTIZED: Final = {8: faiss.ScalarQuantizer.QT_8bit, 16: faiss.ScalarQuantizer.QT_fp16}


class FaissStore:
    """Search of vectors: of all, or where there are many of those that are alike.

    IndexFlatIP; from `EXACT` on IndexScalarQuantizer, from `MANY` on IndexIVFScalarQuantizer with the same 8 bits.

    Args:
        index: FAISS's.
        positions_m: [N, 2] where the cells are, map metres; None if nobody asks by `within`.
    """

    def __init__(self, index: Any, positions_m: npt.NDArray[np.floating[Any]] | None = None) -> None:
        self._index, self._positions_m = index, positions_m
        self.dim = int(index.d)
        self._in_lists = isinstance(index, faiss.IndexIVFScalarQuantizer)

    @classmethod
    def of(
        cls,
        vectors: Floats,
        positions_m: npt.NDArray[np.floating[Any]] | None = None,
        bits: int | None = None,
    ) -> "FaissStore":
        """A store of vectors [N, D]; see the class.

        Args:
            vectors: float32.
            positions_m: see the class.
            bits: of each number, 32, 16 or 8; None by how many vectors there are.
        """
        dim, bits = vectors.shape[1], bits or (8 if len(vectors) > EXACT else 32)
        index: Any = faiss.IndexFlatIP(dim)
        if bits in QUANTIZED:
            index = faiss.IndexScalarQuantizer(dim, QUANTIZED[bits], faiss.METRIC_INNER_PRODUCT)
            index.train(np.stack(_reach(vectors)))  # the extremes alone set the steps
        if bits == 8 and len(vectors) > MANY:
            return cls(_listed(vectors, index), positions_m)
        for some in _in_turn(vectors):
            index.add(np.ascontiguousarray(some))
        return cls(index, positions_m)

    @classmethod
    def load(cls, path: Path, positions_m: npt.NDArray[np.floating[Any]] | None = None) -> "FaissStore":
        """Open a store, whose vectors stay in the file until they are looked at.

        Raises:
            IndexBroken: the file is not an index of this kind.
        """
        try:
            index = faiss.read_index(str(path), faiss.IO_FLAG_MMAP_IFC)
        except RuntimeError as error:
            raise IndexBroken(f"{path} cannot be read; rebuild it with 'hereabouts index'") from error
        if not isinstance(index, faiss.IndexFlatIP | faiss.IndexScalarQuantizer | faiss.IndexIVFScalarQuantizer):
            kind = type(index).__name__
            raise IndexBroken(f"{path} holds a {kind}, which none of this kind is; rebuild it with 'hereabouts index'")
        return cls(index, positions_m)

    def __len__(self) -> int:
        return int(self._index.ntotal)

    def search(self, queries: Floats, k: int, within: Box | None = None) -> tuple[Floats, Rows]:
        """See VectorStore."""
        chosen = None if within is None else self._inside(within)
        k = min(k, len(self) if chosen is None else int(chosen.sum()))
        if not k:
            return np.empty((len(queries), 0), np.float32), np.empty((len(queries), 0), np.int64)
        scores, rows = self._found(queries, k, self._params(chosen, SEARCHED if chosen is None and k <= FEW else LISTS))
        if self._in_lists and (rows < 0).any():  # the nearest lists hold too few
            scores, rows = self._found(queries, k, self._params(chosen, LISTS))
        return best_first(scores, rows, k)

    def _found(self, queries: Floats, k: int, params: Any) -> tuple[Floats, Rows]:
        """(scores, rows) [Q, k] as FAISS gives them; a row is -1 where too few were looked at."""
        starts = range(0, len(queries), QUERIES_PER_CALL)
        found = [self._index.search(queries[i : i + QUERIES_PER_CALL], k, params=params) for i in starts]
        return np.concatenate([scores for scores, _ in found]), np.concatenate([rows for _, rows in found])

    def _params(self, chosen: npt.NDArray[np.bool_] | None, lists: int) -> Any:
        """FAISS's parameters of a search of some rows [N], None for all, in so many lists, if there are any."""
        kinds: Any = faiss  # what these classes take is changed when it is imported
        of_rows = {} if chosen is None else {"sel": kinds.IDSelectorBitmap(np.packbits(chosen, bitorder="little"))}
        if self._in_lists:
            return kinds.SearchParametersIVF(nprobe=lists, **of_rows)
        return kinds.SearchParameters(**of_rows) if of_rows else None

    def _inside(self, within: Box) -> npt.NDArray[np.bool_]:
        """[N] which cells are in a box."""
        assert self._positions_m is not None, "a store without positions cannot look within"
        x, y = self._positions_m.T
        return np.asarray((x >= within.west) & (x <= within.east) & (y >= within.south) & (y <= within.north))

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
        failed: OSError | None = None
        kinds: Any = faiss  # some of which have no types

        def write(some: bytes) -> int:
            nonlocal failed
            try:
                return file.write(some)
            except OSError as error:  # of which FAISS would not say what it was
                failed = error
                raise

        with path.open("wb") as file:
            try:
                faiss.write_index(self._index, kinds.PyCallbackIOWriter(write))
            except RuntimeError as error:
                raise failed or error from error


def _listed(vectors: Floats, flat: Any) -> Any:
    """Vectors [N, D] in lists of like ones, with the 8 bits of a trained index.

    Each list is made as long as it gets: one that grows takes up to twice that.
    """
    kinds: Any = faiss  # some of which have no types
    index = _trained(vectors, flat)
    lists = kinds.downcast_InvertedLists(index.invlists)
    of = np.concatenate([index.quantizer.search(some, 1)[1][:, 0].astype(np.int16) for some in _in_turn(vectors)])
    for number, size in enumerate(np.bincount(of, minlength=LISTS).tolist()):
        lists.resize(number, size)
    place, row = np.zeros(LISTS, np.int64), 0
    for some in _in_turn(vectors):
        here = of[row : row + len(some)]
        order = np.argsort(here, kind="stable")
        ids, codes, at = row + order, flat.sa_encode(some)[order], np.cumsum(np.bincount(here, minlength=LISTS))
        for number, (first, last) in enumerate(pairwise([0, *at.tolist()])):
            of_list = kinds.swig_ptr(ids[first:last]), kinds.swig_ptr(codes[first:last])
            lists.update_entries(number, int(place[number]), last - first, *of_list)
        place, row = place + np.diff(at, prepend=0), row + len(some)
    index.ntotal = len(vectors)
    index.make_direct_map()  # of each row, where its vector is
    return index


def _trained(vectors: Floats, flat: Any) -> Any:
    """Empty lists for vectors [N, D] like these, of the 8 bits of a trained index."""
    dim = vectors.shape[1]
    # Not of what is left of a vector beside its list's middle: so its bits are the same in any list, and without.
    given = dim, LISTS, QUANTIZED[8], faiss.METRIC_INNER_PRODUCT, False
    index: Any = faiss.IndexIVFScalarQuantizer(faiss.IndexFlatIP(dim), *given)
    index.cp.max_points_per_centroid = SAMPLED
    sample = np.random.default_rng(0).choice(len(vectors), min(len(vectors), SAMPLED * LISTS), replace=False)
    is_sampled = np.zeros(len(vectors), np.bool_)
    is_sampled[sample] = True
    chosen = zip(_in_turn(vectors), np.split(is_sampled, range(AT_ONCE, len(vectors), AT_ONCE)), strict=True)
    index.train(np.concatenate([some[kept] for some, kept in chosen]))
    faiss.copy_array_to_vector(faiss.vector_to_array(flat.sq.trained), index.sq.trained)
    return index


def _in_turn(vectors: Floats) -> Iterator[Floats]:
    """Vectors [N, D], some after the other; of a file, what was looked at takes no memory any more."""
    for first in range(0, len(vectors), AT_ONCE):
        yield vectors[first : first + AT_ONCE]
        forget([vectors])


def _reach(vectors: Floats) -> tuple[Floats, Floats]:
    """The lowest and the highest of each number [D] of vectors [N, D]; infinite if there are none."""
    dim = vectors.shape[1]
    low, high = np.full(dim, np.inf, np.float32), np.full(dim, -np.inf, np.float32)
    for some in _in_turn(vectors):
        low, high = np.minimum(low, some.min(axis=0)), np.maximum(high, some.max(axis=0))
    return low, high
