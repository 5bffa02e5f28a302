"""Benchmark of vector search with FAISS and Milvus on the same vectors and queries."""

import os
import time
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from models.errors import StoreUnavailable

if TYPE_CHECKING:  # so that the command line starts without torch
    from index.answering.localizer import Localizer
    from index.stores.store import VectorStore

NOT_INSTALLED = "not installed"
SCORE_TOLERANCE = 1e-6  # rounding of float32 scores


def measure_searches(localizer: "Localizer", texts: Sequence[tuple[str, ...]]) -> dict[str, Any]:
    """Measure the search for the candidates of one description with FAISS and Milvus, median ms on one thread.

    "found" is the recall of FAISS against exact search.
    """
    from models.posterior.posterior import CANDIDATE_CELLS  # noqa: PLC0415 - heavy

    vectors = np.concatenate([text.global_vectors.cpu().numpy() for text in localizer.retriever.encode_texts(texts)])
    return {
        "candidates": CANDIDATE_CELLS,
        "faiss_ms": _median_ms(localizer.ranker.store, vectors, CANDIDATE_CELLS),
        "found": _recall(localizer.ranker.store, vectors, CANDIDATE_CELLS),
        "milvus": _measure_milvus(localizer, vectors, CANDIDATE_CELLS),
    }


def _median_ms(store: "VectorStore", vectors: Any, count: int) -> float:
    seconds = []
    for vector in vectors:
        start = time.perf_counter()
        store.search(vector[None], count)
        seconds.append(time.perf_counter() - start)
    return round(1000 * float(np.median(seconds)), 2)


def _recall(store: "VectorStore", vectors: Any, count: int) -> float:
    """Return the share of the results that are as good as those of a search in all lists."""
    from index.stores.faiss_store import MAX_PROBED_K  # noqa: PLC0415 - heavy

    worst = [store.search(vector[None], MAX_PROBED_K + 1)[0][0, :count][-1] for vector in vectors]
    scores = [store.search(vector[None], count)[0][0] for vector in vectors]
    return round(float(np.mean([(s >= w - SCORE_TOLERANCE).mean() for s, w in zip(scores, worst, strict=True)])), 4)


def _measure_milvus(localizer: "Localizer", vectors: Any, count: int) -> Any:
    from index.stores.milvus_store import MilvusStore  # noqa: PLC0415 - heavy

    try:
        with _available_milvus() as kind:
            if kind is None:
                return NOT_INSTALLED
            cells, start = localizer.gallery.cells, time.perf_counter()
            gallery = localizer.ranker.store.vectors(np.arange(len(cells)))
            name = f"benchmark_{os.getpid()}_{len(cells)}"
            with MilvusStore.create(name, gallery, cells.center_m[:, :2], cells.scenes) as store, closing(store):
                write_s = time.perf_counter() - start
                search_ms = _median_ms(store, vectors, count)
                store.drop()
            return {"kind": kind, "write_seconds": round(write_s, 1), "ms": search_ms}
    except StoreUnavailable as error:
        return str(error)


@contextmanager
def _available_milvus() -> Iterator[str | None]:
    """Set HEREABOUTS_MILVUS_URI to a milvus-lite file unless it names a server; yield which of them it is."""
    from index.stores.milvus_connection import URI  # noqa: PLC0415 - heavy

    if find_spec("pymilvus") is None or (URI not in os.environ and find_spec("milvus_lite") is None):
        yield None
    elif os.environ.get(URI):
        yield "server"
    else:
        with TemporaryDirectory() as scratch:
            os.environ[URI] = str(Path(scratch) / "vectors.db")
            try:
                yield "milvus-lite"
            finally:
                del os.environ[URI]
