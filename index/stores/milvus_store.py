"""Vectors in a Milvus server: a collection an index version."""

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from index.answering.query import Box
from index.stores.milvus_connection import MilvusConnection
from index.stores.store import Floats, Rows, best_first
from models.errors import IndexBroken, StoreUnavailable

BATCH: Final = 1000  # rows a message
WRITE_S: Final = 300.0  # for Milvus to put a whole map on its disk, or into its memory
MOST: Final = 16_384  # that Milvus gives of one search
# A collection is written once and then only read, and `write` ends by counting its rows at STRONG: later searches need
# not wait for changes, of which there are none. STRONG makes each wait for the server's next tick, 200 ms.
STRONG: Final = "Strong"
READ: Final = "Bounded"
ALIAS: Final = "hereabouts_{}"


def collection_of(version: str) -> str:
    """The name of a version's collection; Milvus takes letters, digits and underscores."""
    return "hereabouts_" + re.sub(r"\W", "_", version, flags=re.ASCII)


class MilvusStore:
    """Exact search (FLAT) in a collection; nothing is asked of Milvus before the first search.

    Args:
        collection: its name.
        dim: of the vectors.
        rows: how many there are.

    Raises:
        StoreUnavailable: pymilvus is not installed, or nothing says where Milvus is.
    """

    def __init__(self, collection: str, dim: int, rows: int) -> None:
        self.collection, self.dim, self._rows = collection, dim, rows
        self._milvus = MilvusConnection()

    @classmethod
    @contextmanager
    def written(
        cls, version: str, vectors: Floats, positions_m: npt.NDArray[np.floating[Any]], regions: Sequence[str]
    ) -> Iterator["MilvusStore"]:
        """Write a version's collection, which stays if the block ends well, and else is dropped.

        Args:
            version: of the index.
            vectors: [N, D].
            positions_m: [N, 2] where the cells are, map metres.
            regions: N names of what each cell is part of.

        Raises:
            StoreUnavailable: Milvus does not answer, or refuses.
        """
        store = cls(collection_of(version), vectors.shape[1], len(vectors))
        try:
            store._write(version, vectors, positions_m, regions)
            yield store
        except BaseException:
            with suppress(StoreUnavailable):
                store.drop()
            raise

    def _write(
        self, version: str, vectors: Floats, positions_m: npt.NDArray[np.floating[Any]], regions: Sequence[str]
    ) -> None:
        self._create()
        for start in range(0, len(vectors), BATCH):
            rows = [
                {
                    "row": row,
                    "vector": vectors[row],
                    "x": float(positions_m[row, 0]),
                    "y": float(positions_m[row, 1]),
                    "region": regions[row],
                    "version": version,
                }
                for row in range(start, min(start + BATCH, len(vectors)))
            ]
            self._milvus.call("upsert", self.collection, rows, timeout_s=WRITE_S)
        self._milvus.call("flush", self.collection, timeout_s=WRITE_S)
        self._milvus.call("load_collection", self.collection, timeout_s=WRITE_S)
        self.check()

    def _create(self) -> None:
        from pymilvus import DataType, MilvusClient  # noqa: PLC0415  # an extra, which few have

        schema = MilvusClient.create_schema(auto_id=False, enable_dynamic_field=False)
        schema.add_field("row", DataType.INT64, is_primary=True)
        schema.add_field("vector", DataType.FLOAT_VECTOR, dim=self.dim)
        for name in ("x", "y"):
            schema.add_field(name, DataType.DOUBLE)
        for name in ("region", "version"):
            schema.add_field(name, DataType.VARCHAR, max_length=512)
        index = MilvusClient.prepare_index_params()
        index.add_index("vector", index_type="FLAT", metric_type="IP")
        self._milvus.call(
            "create_collection",
            self.collection,
            schema=schema,
            index_params=index,
            consistency_level=READ,
            timeout_s=WRITE_S,
        )

    def __len__(self) -> int:
        return self._rows

    def search(self, queries: Floats, k: int, within: Box | None = None) -> tuple[Floats, Rows]:
        """See VectorStore."""
        k = min(k, len(self))
        # More than Milvus gives at once is asked for part by part.
        starts = range(0, len(self), MOST) if k > MOST else [None]
        rules = [_filter(within, start) for start in starts]
        found = [[self._found(query, k, rule) for rule in rules] for query in queries]
        scores = np.array([np.concatenate([part[0] for part in parts]) for parts in found], np.float32)
        rows = np.array([np.concatenate([part[1] for part in parts]) for parts in found], np.int64)
        if within is None and rows.shape[1] < k:
            raise StoreUnavailable(f"Milvus has {rows.shape[1]} of {k} rows of {self.collection} at hand; ask again")
        return best_first(scores, rows, k)

    def _found(self, query: Floats, k: int, rule: str) -> tuple[list[float], list[int]]:
        """Scores and rows of one query: several in a message would change each other's rounding."""
        [hits] = self._milvus.call(
            "search",
            self.collection,
            data=[query],
            limit=min(k, MOST),
            filter=rule,
            output_fields=["row"],
            search_params={"metric_type": "IP"},
            anns_field="vector",
            consistency_level=READ,
        )
        return [hit["distance"] for hit in hits], [hit["entity"]["row"] for hit in hits]

    def score(self, query: Floats, rows: Rows) -> Floats:
        """See VectorStore."""
        scores: Floats = self.vectors(rows) @ query
        return scores

    def vectors(self, rows: npt.NDArray[np.integer[Any]]) -> Floats:
        """See VectorStore."""
        unique, back = np.unique(rows, return_inverse=True)
        vectors = np.empty((len(unique), self.dim), np.float32)
        for start in range(0, len(unique), BATCH):
            asked = unique[start : start + BATCH]
            fields = ["row", "vector"]
            found = self._milvus.call(
                "get", self.collection, ids=asked.tolist(), output_fields=fields, consistency_level=READ
            )
            if len(found) < len(asked):
                raise StoreUnavailable(f"Milvus has {len(found)} of {len(asked)} rows that were asked for; ask again")
            at = np.searchsorted(unique, [each["row"] for each in found])
            vectors[at] = [each["vector"] for each in found]
        return vectors[back]

    def check(self) -> None:
        """Pass if the collection is there, with as many rows as it should have.

        Raises:
            IndexBroken: it is not, or it has others.
            StoreUnavailable: Milvus does not answer.
        """
        if not self._milvus.call("has_collection", self.collection):
            raise IndexBroken(f"Milvus has no collection {self.collection}; build it again with 'hereabouts index'")
        count = ["count(*)"]
        [counted] = self._milvus.call(
            "query", self.collection, filter="", output_fields=count, consistency_level=STRONG
        )
        if counted["count(*)"] != self._rows:
            raise IndexBroken(
                f"Milvus has {counted['count(*)']} rows of {self.collection}, the index says {self._rows}; "
                "build it again with 'hereabouts index'"
            )

    def move_alias(self, alias: str) -> None:
        """Let Milvus's alias of an index's alias name this collection, for those who look into Milvus itself.

        Raises:
            StoreUnavailable: Milvus does not answer, or refuses.
        """
        name = ALIAS.format(alias)
        try:
            self._milvus.call("alter_alias", self.collection, name)
        except StoreUnavailable:  # there is none yet, or no server
            self._milvus.call("create_alias", self.collection, name)

    def drop(self) -> None:
        """Delete the collection, if there is one.

        Raises:
            StoreUnavailable: Milvus does not answer, or refuses.
        """
        self._milvus.call("drop_collection", self.collection)

    def close(self) -> None:
        """Hang up."""
        self._milvus.close()


def _filter(within: Box | None, start: int | None) -> str:
    """Milvus's expression for the cells in a box, and for the rows of a part that begins at `start`."""
    rules = [] if start is None else [f"row >= {start}", f"row < {start + MOST}"]
    if within is not None:
        rules += [f"x >= {within.west!r}", f"x <= {within.east!r}", f"y >= {within.south!r}", f"y <= {within.north!r}"]
    return " and ".join(rules)
