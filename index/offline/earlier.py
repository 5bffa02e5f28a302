"""The vectors of an earlier version, for cells that have not changed since: `hereabouts index --update`."""

from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from index.artifact import open_version
from index.manifest import check_model
from index.stores.faiss_store import FaissStore
from index.stores.opening import VECTORS_FILE
from index.stores.store import Floats
from models.city.points import Ints
from models.errors import IndexBroken
from models.retrieval.level_table import STARTS_FILE

FILE: Final = "encoded.npy"
BYTES: Final = 5  # of a digest that are kept: a cell that changed is taken for one of a million once in a million times
SHORT: Final = np.uint64((1 << 8 * BYTES) - 1)


@dataclass(frozen=True, slots=True, eq=False)
class Earlier:
    """Vectors, by what they were made of.

    Attributes:
        digests: [K] uint64 what `save_digests` kept, ascending.
        rows: [K] row of each in the store.
        store: of all cells.
    """

    digests: Ints
    rows: Ints
    store: FaissStore

    @classmethod
    def open(cls, index_dir: Path, fingerprint: str) -> "Earlier":
        """Those of the version that "default" names.

        Args:
            index_dir: which has it.
            fingerprint: of the retriever.

        Raises:
            IndexBroken: there is none, it is not whole, or it has no vectors that could be kept.
            IndexMismatch: another model made it.
        """
        directory, manifest = open_version(index_dir)
        check_model(manifest, fingerprint)
        lacks = "its vectors are in Milvus" if manifest.store == "milvus" else None
        lacks = "it has the retriever's other levels" if STARTS_FILE in manifest.files else lacks
        lacks = lacks if FILE in manifest.files else "it does not say what they were made of"
        if lacks is not None:
            raise IndexBroken(f"{directory} has no vectors that can be kept: {lacks}; give --map in place of --update")
        short = np.load(directory / FILE, allow_pickle=False)
        whole = np.zeros((len(short), 8), np.uint8)
        whole[:, :BYTES] = short
        digests = whole.view(np.uint64).ravel()
        rows = np.argsort(digests, kind="stable")
        rows = rows[digests[rows] > 0]
        return cls(digests[rows], rows, FaissStore.load(directory / VECTORS_FILE))

    def known(self, digests: Ints) -> Ints:
        """[C] the row of each of `CellFeatures.digests` that the version has; -1 of the others."""
        if not len(self.rows):
            return np.full(len(digests), -1)
        wanted = digests & SHORT
        place = np.minimum(np.searchsorted(self.digests, wanted), len(self.digests) - 1)
        return np.where(self.digests[place] == wanted, self.rows[place], -1)

    def vectors(self, rows: Ints) -> Floats:
        """[C, D] of some rows."""
        return self.store.vectors(rows)


def save_digests(directory: Path, digests: Ints) -> None:
    """Keep some bytes of `CellFeatures.digests` [N]; of cells whose bytes are the same though they differ, zeros."""
    short = digests & SHORT
    order = np.lexsort((digests, short))
    alike = (np.diff(short[order]) == 0) & (np.diff(digests[order]) != 0)
    kept = np.where(np.isin(short, short[order[1:][alike]]), np.uint64(0), short)
    np.save(directory / FILE, np.ascontiguousarray(kept.view(np.uint8).reshape(-1, 8)[:, :BYTES]))
