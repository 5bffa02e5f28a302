"""Recall of the posterior's candidates: from the vector index, from the inverted list, and from both."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from index.answering.posterior_localizer import PosteriorLocalizer
from index.answering.vector_localizer import raw_sentences
from index.evaluation.report import Table
from models.citymap.queries import Queries

CANDIDATE_COUNTS = (10, 20, 50, 100, 200, 500)  # sizes of the candidate set
SOURCES = ("vector index, raw text", "vector index, read and rendered", "inverted list", "both, so many of each")


def candidate_recall(queries: Queries, posterior: PosteriorLocalizer) -> list[dict[str, Any]]:
    """Return for each of SOURCES the share of queries whose best cell is among the first N candidates."""
    deepest = min(CANDIDATE_COUNTS[-1], len(posterior.gallery.cells))
    rank_of_truth = np.full((len(SOURCES), len(queries)), CANDIDATE_COUNTS[-1])
    retriever = posterior.ranker.retriever
    descriptions = ["\n".join(sentences) for sentences in queries.sentences]
    rendered = posterior.sentences(descriptions)
    for q, (raw, sentences) in enumerate(zip(raw_sentences(descriptions), rendered, strict=True)):
        texts = retriever.encode_texts([raw, sentences or raw])
        hints = posterior.chunk_reader.parse(descriptions[q : q + 1])[0]
        by_list = posterior.nodes.cell_scores(posterior.binding.bind(hints)) if hints else np.zeros(deepest)
        orders = [*posterior.ranker.search(texts, deepest)[1], np.argsort(-by_list, kind="stable")[:deepest]]
        for n, order in enumerate(orders):
            position = np.flatnonzero(order == queries.truth[q])
            rank_of_truth[n, q] = position[0] if len(position) else CANDIDATE_COUNTS[-1]
        rank_of_truth[-1, q] = rank_of_truth[1:-1, q].min()
    shares = [{str(size): float((row < size).mean()) for size in CANDIDATE_COUNTS} for row in rank_of_truth]
    return [{"source": name, "recall": share} for name, share in zip(SOURCES, shares, strict=True)]


def candidate_table(rows: Sequence[dict[str, Any]], text: str) -> Table:
    """Return the table of candidate recall for one kind of text."""
    head = (f"{text}: best cell among the first", *(f"{size}" for size in CANDIDATE_COUNTS))
    return head, [(row["source"], *(f"{row['recall'][str(size)]:.3f}" for size in CANDIDATE_COUNTS)) for row in rows]
