"""A vector store in Milvus: one collection per index version."""

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

ROWS_PER_MESSAGE: Final = 1000  # rows a message
WRITE_TIMEOUT_S: Final = 300.0  # Milvus flushes and loads a whole map
MAX_HITS_PER_SEARCH: Final = 16_384  # Milvus's limit
# A collection is written once and then only read, and writing ends with a count at strong consistency. Later searches
# need not wait for changes; with strong consistency each would wait for the server's next tick, 200 ms.
COUNT_CONSISTENCY: Final = "Strong"
READ_CONSISTENCY: Final = "Bounded"
ALIAS_FORMAT: Final = "hereabouts_{}"


def collection_name(version: str) -> str:
    """Return the name of a version's collection; Milvus allows letters, digits and underscores."""
    return "hereabouts_" + re.sub(r"\W", "_", version, flags=re.ASCII)


class MilvusStore:
    """Exact search (FLAT) in a collection; it connects at the first search. All calls may raise StoreUnavailable."""

    def __init__(self, collection: str, dim: int, rows: int) -> None:
        self.collection, self.dim, self._rows = collection, dim, rows
        self._milvus = MilvusConnection()

    @classmethod
    @contextmanager
    def create(
        cls, version: str, vectors: Floats, positions_m: npt.NDArray[np.floating[Any]], regions: Sequence[str]
    ) -> Iterator["MilvusStore"]:
        """Write a version's collection of vectors [N, D] of cells with centres [N, 2]; drop it if the block raises."""
        store = cls(collection_name(version), vectors.shape[1], len(vectors))
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
        self._create_collection()
        for start in range(0, len(vectors), ROWS_PER_MESSAGE):
            rows = [
                {
                    "row": row,
                    "vector": vectors[row],
                    "x": float(positions_m[row, 0]),
                    "y": float(positions_m[row, 1]),
                    "region": regions[row],
                    "version": version,
                }
                for row in range(start, min(start + ROWS_PER_MESSAGE, len(vectors)))
            ]
            self._milvus.call("upsert", self.collection, rows, timeout_s=WRITE_TIMEOUT_S)
        self._milvus.call("flush", self.collection, timeout_s=WRITE_TIMEOUT_S)
        self._milvus.call("load_collection", self.collection, timeout_s=WRITE_TIMEOUT_S)
        self.check()

    def _create_collection(self) -> None:
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
            consistency_level=READ_CONSISTENCY,
            timeout_s=WRITE_TIMEOUT_S,
        )

    def __len__(self) -> int:
        return self._rows

    def search(self, queries: Floats, k: int, within: Box | None = None) -> tuple[Floats, Rows]:
        """Implement VectorStore."""
        k = min(k, len(self))
        # More hits than Milvus's limit are fetched block by block.
        starts = range(0, len(self), MAX_HITS_PER_SEARCH) if k > MAX_HITS_PER_SEARCH else [None]
        rules = [_filter(within, start) for start in starts]
        results = [[self._search_one(query, k, rule) for rule in rules] for query in queries]
        scores = np.array([np.concatenate([part[0] for part in parts]) for parts in results], np.float32)
        rows = np.array([np.concatenate([part[1] for part in parts]) for parts in results], np.int64)
        if within is None and rows.shape[1] < k:
            raise StoreUnavailable(f"Milvus has {rows.shape[1]} of {k} rows of {self.collection} loaded; try again")
        return best_first(scores, rows, k)

    def _search_one(self, query: Floats, k: int, rule: str) -> tuple[list[float], list[int]]:
        """Search for one query; queries in one message would change each other's rounding."""
        [hits] = self._milvus.call(
            "search",
            self.collection,
            data=[query],
            limit=min(k, MAX_HITS_PER_SEARCH),
            filter=rule,
            output_fields=["row"],
            search_params={"metric_type": "IP"},
            anns_field="vector",
            consistency_level=READ_CONSISTENCY,
        )
        return [hit["distance"] for hit in hits], [hit["entity"]["row"] for hit in hits]

    def score(self, query: Floats, rows: Rows) -> Floats:
        """Implement VectorStore."""
        return self.vectors(rows) @ query

    def vectors(self, rows: npt.NDArray[np.integer[Any]]) -> Floats:
        """Implement VectorStore."""
        unique, back = np.unique(rows, return_inverse=True)
        vectors = np.empty((len(unique), self.dim), np.float32)
        for start in range(0, len(unique), ROWS_PER_MESSAGE):
            batch = unique[start : start + ROWS_PER_MESSAGE]
            fields = ["row", "vector"]
            records = self._milvus.call(
                "get", self.collection, ids=batch.tolist(), output_fields=fields, consistency_level=READ_CONSISTENCY
            )
            if len(records) < len(batch):
                raise StoreUnavailable(f"Milvus has {len(records)} of {len(batch)} requested rows; try again")
            positions = np.searchsorted(unique, [each["row"] for each in records])
            vectors[positions] = [each["vector"] for each in records]
        return vectors[back]

    def check(self) -> None:
        """Raise IndexBroken unless the collection exists and has the expected number of rows."""
        if not self._milvus.call("has_collection", self.collection):
            raise IndexBroken(f"Milvus has no collection {self.collection}; build it again with 'hereabouts index'")
        count = ["count(*)"]
        [counted] = self._milvus.call(
            "query", self.collection, filter="", output_fields=count, consistency_level=COUNT_CONSISTENCY
        )
        if counted["count(*)"] != self._rows:
            raise IndexBroken(
                f"Milvus has {counted['count(*)']} rows of {self.collection}, the index says {self._rows}; "
                "build it again with 'hereabouts index'"
            )

    def move_alias(self, alias: str) -> None:
        """Point Milvus's alias to this collection, for people who look into Milvus itself."""
        name = ALIAS_FORMAT.format(alias)
        try:
            self._milvus.call("alter_alias", self.collection, name)
        except StoreUnavailable:  # the alias does not exist yet, or the server is gone
            self._milvus.call("create_alias", self.collection, name)

    def drop(self) -> None:
        """Drop the collection, if it exists."""
        self._milvus.call("drop_collection", self.collection)

    def close(self) -> None:
        """Close the connection."""
        self._milvus.close()


def _filter(within: Box | None, start: int | None) -> str:
    """Return Milvus's expression for the cells in a box, and for a block of rows from `start`."""
    rules = [] if start is None else [f"row >= {start}", f"row < {start + MAX_HITS_PER_SEARCH}"]
    if within is not None:
        rules += [f"x >= {within.west!r}", f"x <= {within.east!r}", f"y >= {within.south!r}", f"y <= {within.north!r}"]
    return " and ".join(rules)
