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
from models.retrieval.instance_encoder import DIGEST
from models.retrieval.level_table import STARTS_FILE

FILE: Final = "encoded.npy"


@dataclass(frozen=True, slots=True, eq=False)
class Earlier:
    """Vectors, by what they were made of.

    Attributes:
        digests: [N] of `CellFeatures.digests`, as numbers, ascending.
        rows: [N] row of each in the store.
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
        digests = _numbers(np.load(directory / FILE, allow_pickle=False))
        rows = np.argsort(digests, kind="stable")
        return cls(digests[rows], rows, FaissStore.load(directory / VECTORS_FILE))

    def known(self, digests: Ints) -> Ints:
        """[C] the row of each that the version has; -1 of the others."""
        wanted = _numbers(digests)
        place = np.minimum(np.searchsorted(self.digests, wanted), len(self.digests) - 1)
        return np.where(self.digests[place] == wanted, self.rows[place], -1)

    def vectors(self, rows: Ints) -> Floats:
        """[C, D] of some rows."""
        return self.store.vectors(rows)


def _numbers(digests: Ints) -> Ints:
    """[N] of bytes [N, DIGEST]."""
    whole = np.zeros((len(digests), 8), np.uint8)
    whole[:, :DIGEST] = digests
    return whole.view(np.uint64).ravel()
