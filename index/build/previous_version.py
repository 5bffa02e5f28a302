"""The vectors of an earlier version, for cells that have not changed since: `hereabouts index --update`."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from index.build.artifact import open_version
from index.build.manifest import check_model
from index.stores.faiss_store import FaissStore
from index.stores.opening import VECTORS_FILE
from index.stores.store import Floats
from models.citymap.points import Ints
from models.errors import IndexBroken
from models.paper.level_table import NO_LEVELS, STARTS_FILE, LevelTable
from models.paper.levels import Level

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
        levels: the retriever's others, of all cells; none if they are not wanted.
    """

    digests: Ints
    rows: Ints
    store: FaissStore
    levels: LevelTable

    @classmethod
    def open(cls, index_dir: Path, fingerprint: str, levels: Sequence[Level]) -> "Earlier":
        """Those of the version that "default" names.

        Args:
            index_dir: which has it.
            fingerprint: of the retriever.
            levels: that are wanted of it.

        Raises:
            IndexBroken: there is none, it is not whole, or it has no vectors, of these levels, that could be kept.
            IndexMismatch: another model made it.
        """
        directory, manifest = open_version(index_dir)
        check_model(manifest, fingerprint)
        is_rich, has_levels = tuple(levels) != ("global",), STARTS_FILE in manifest.files
        lacks = None
        if FILE not in manifest.files:
            lacks = "it does not say what they were made of; give --map in place of --update"
        elif manifest.store == "milvus":
            lacks = "they are in Milvus; give --map in place of --update"
        elif is_rich and not has_levels:
            lacks = "it was made without --levels; give --map in place of --update"
        elif has_levels and not is_rich:
            lacks = "it was made with --levels; give that too"
        if lacks is not None:
            raise IndexBroken(f"{directory} has no vectors that can be kept: {lacks}")
        short = np.load(directory / FILE, allow_pickle=False)
        whole = np.zeros((len(short), 8), np.uint8)
        whole[:, :BYTES] = short
        digests = whole.view(np.uint64).ravel()
        rows = np.argsort(digests, kind="stable")
        rows = rows[digests[rows] > 0]
        table = LevelTable.load(directory, levels) if is_rich else NO_LEVELS
        return cls(digests[rows], rows, FaissStore.load(directory / VECTORS_FILE), table)

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
