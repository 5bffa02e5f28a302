"""Vector search alone: FAISS, which ships, and Milvus, on the same vectors and queries."""

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
ROUNDING = 1e-6


def measure_searches(localizer: "Localizer", texts: Sequence[tuple[str, ...]]) -> dict[str, Any]:
    """Median milliseconds of a search for the candidates of one description, one thread; how many it finds.

    Args:
        localizer: of an index whose vectors are a file.
        texts: descriptions, each the sentences of one.

    Returns:
        "candidates" how many are searched for, "faiss_ms", "found" the share of the best that FAISS gives, and
        "milvus": its "kind" (milvus-lite, or the server that HEREABOUTS_MILVUS_URI names), "write_seconds" and "ms"; or
        "not installed"; or why it does not answer.
    """
    from models.posterior.posterior import CANDIDATES  # noqa: PLC0415 - heavy

    vectors = np.concatenate([text.global_vectors.cpu().numpy() for text in localizer.retriever.encode_texts(texts)])
    return {
        "candidates": CANDIDATES,
        "faiss_ms": _median_ms(localizer.ranker.store, vectors, CANDIDATES),
        "found": _found(localizer.ranker.store, vectors, CANDIDATES),
        "milvus": _measure_milvus(localizer, vectors, CANDIDATES),
    }


def _median_ms(store: "VectorStore", vectors: Any, count: int) -> float:
    seconds = []
    for vector in vectors:
        start = time.perf_counter()
        store.search(vector[None], count)
        seconds.append(time.perf_counter() - start)
    return round(1000 * float(np.median(seconds)), 2)


def _found(store: "VectorStore", vectors: Any, count: int) -> float:
    """Share of what is found that is as good as the best of all lists."""
    from index.stores.faiss_store import MAX_PROBED_K  # noqa: PLC0415 - heavy

    worst = [store.search(vector[None], MAX_PROBED_K + 1)[0][0, :count][-1] for vector in vectors]
    scores = [store.search(vector[None], count)[0][0] for vector in vectors]
    return round(float(np.mean([(s >= w - ROUNDING).mean() for s, w in zip(scores, worst, strict=True)])), 4)


def _measure_milvus(localizer: "Localizer", vectors: Any, count: int) -> Any:
    from index.stores.milvus_store import MilvusStore  # noqa: PLC0415 - heavy

    try:
        with _somewhere() as kind:
            if kind is None:
                return NOT_INSTALLED
            cells, start = localizer.gallery.cells, time.perf_counter()
            known = localizer.ranker.store.vectors(np.arange(len(cells)))
            name = f"benchmark_{os.getpid()}_{len(cells)}"
            with MilvusStore.create(name, known, cells.center_m[:, :2], cells.scenes) as store, closing(store):
                write_s = time.perf_counter() - start
                found = _median_ms(store, vectors, count)
                store.drop()
            return {"kind": kind, "write_seconds": round(write_s, 1), "ms": found}
    except StoreUnavailable as error:
        return str(error)


@contextmanager
def _somewhere() -> Iterator[str | None]:
    """Let HEREABOUTS_MILVUS_URI name a Milvus: the one that it names already, or a file, where milvus-lite is there."""
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
