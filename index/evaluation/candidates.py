"""Which cells the hint posterior should look at: vector search, the inverted list over statements, or both."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from index.evaluation.report import Table
from index.map_posterior import MapPosterior
from index.ranking import Ranker
from models.city.queries import Queries

SIZES = (10, 20, 50, 100, 200, 500)  # of the candidate set
SOURCES = ("vector search", "inverted list", "both, in turns")
Order = npt.NDArray[np.integer[Any]]


def candidate_recall(queries: Queries, ranker: Ranker, posterior: MapPosterior) -> list[dict[str, Any]]:
    """Share of the queries whose best cell is among the first N of each source.

    Args:
        queries: with known cells.
        ranker: vector search, and the levels on the best of it.
        posterior: of the same gallery.

    Returns:
        For each of SOURCES "source" and "recall" {N: share}.
    """
    deepest = min(SIZES[-1], len(posterior.gallery.cells))
    place = np.zeros((len(SOURCES), len(queries)), dtype=np.int64)
    posterior.read_ahead(queries.sentences)
    for q, sentences in enumerate(queries.sentences):
        by_vectors = ranker.rank([ranker.retriever.encode_description(sentences)], deepest)[1][0]
        scores = posterior.posterior.cell_scores(posterior.reading(posterior.notice(sentences)))
        by_list = np.argsort(-scores, kind="stable")[:deepest]
        for n, order in enumerate((by_vectors, by_list, in_turns(by_vectors, by_list))):
            found = np.flatnonzero(order == queries.truth[q])
            place[n, q] = found[0] if len(found) else SIZES[-1]
    shares = [{str(size): float((row < size).mean()) for size in SIZES} for row in place]
    return [{"source": name, "recall": share} for name, share in zip(SOURCES, shares, strict=True)]


def in_turns(one: Order, other: Order) -> Order:
    """Cells of two orders, taken in turns, each once."""
    mixed = np.stack([one, other], axis=1).ravel()
    first = np.unique(mixed, return_index=True)[1]
    found: Order = mixed[np.sort(first)]
    return found


def candidate_table(rows: Sequence[dict[str, Any]]) -> Table:
    """Recall of the candidate set by its size."""
    head = ("best cell among the first", *(f"{size}" for size in SIZES))
    return head, [(row["source"], *(f"{row['recall'][str(size)]:.3f}" for size in SIZES)) for row in rows]
