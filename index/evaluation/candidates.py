"""Which cells the hint posterior looks at: those of the vector index, of the inverted list over statements, of both."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from index.answering.posterior_localizer import PosteriorLocalizer
from index.answering.vector_localizer import raw_sentences
from index.evaluation.report import Table
from models.citymap.queries import Queries

SIZES = (10, 20, 50, 100, 200, 500)  # of the candidate set
SOURCES = ("vector index, raw text", "vector index, read and rendered", "inverted list", "both, so many of each")


def candidate_recall(queries: Queries, posterior: PosteriorLocalizer) -> list[dict[str, Any]]:
    """Share of the queries whose best cell is among the first N of each source.

    Args:
        queries: with known cells.
        posterior: of the same gallery.

    Returns:
        For each of SOURCES "source" and "recall" {N: share}.
    """
    deepest = min(SIZES[-1], len(posterior.gallery.cells))
    place = np.full((len(SOURCES), len(queries)), SIZES[-1])
    retriever = posterior.ranker.retriever
    descriptions = ["\n".join(said) for said in queries.sentences]
    rendered = posterior.sentences(descriptions)
    for q, (raw, said) in enumerate(zip(raw_sentences(descriptions), rendered, strict=True)):
        texts = retriever.encode_texts([raw, said or raw])
        hints = posterior.texts.parse(descriptions[q : q + 1])[0]
        by_list = posterior.nodes.cell_scores(posterior.binding.reading(hints)) if hints else np.zeros(deepest)
        orders = [*posterior.ranker.search(texts, deepest)[1], np.argsort(-by_list, kind="stable")[:deepest]]
        for n, order in enumerate(orders):
            found = np.flatnonzero(order == queries.truth[q])
            place[n, q] = found[0] if len(found) else SIZES[-1]
        place[-1, q] = place[1:-1, q].min()
    shares = [{str(size): float((row < size).mean()) for size in SIZES} for row in place]
    return [{"source": name, "recall": share} for name, share in zip(SOURCES, shares, strict=True)]


def candidate_table(rows: Sequence[dict[str, Any]], text: str) -> Table:
    """Recall of the candidate set by its size, for one kind of text."""
    head = (f"{text}: best cell among the first", *(f"{size}" for size in SIZES))
    return head, [(row["source"], *(f"{row['recall'][str(size)]:.3f}" for size in SIZES)) for row in rows]
