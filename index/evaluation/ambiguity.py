"""Ambiguity of hints, independent of any model: exact matching of their statements."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from models.citymap.gallery import MapData
from models.citymap.hints import build_hint_table
from models.citymap.queries import Queries
from models.citymap.types import DIRECTIONS, Hint
from models.training.metrics import RETRIEVAL_KS

QUERIES_PER_BLOCK = 1024


def ambiguity(data: MapData, queries: Queries, hints: Sequence[tuple[Hint, ...]]) -> dict[str, Any]:
    """Compute the recall of exact matching.

    A cell matches a hint if the same statement (direction, colour, label) is true at its centre. Cells are ranked by
    the number of matching hints; ties are in random order.
    """
    symbols, cells = _cell_statements(data)
    query_statements = _query_statements(symbols, hints)
    truth = queries.truth
    better, equal = np.zeros(len(truth)), np.ones(len(truth))
    for start in range(0, len(truth), QUERIES_PER_BLOCK):
        rows = slice(start, start + QUERIES_PER_BLOCK)
        fits = (query_statements[rows] @ cells.T).toarray()
        own = fits[np.arange(len(fits)), truth[rows]][:, None]
        better[rows], equal[rows] = (fits > own).sum(axis=1), (fits == own).sum(axis=1)
    return {
        "median_cells_that_fit_as_well": float(np.median(better + equal)),
        "exact_matching": {k: float(np.clip((k - better) / equal, 0, 1).mean()) for k in RETRIEVAL_KS},
    }


def _cell_statements(data: MapData) -> tuple[dict[tuple[str, str | None, int], int], csr_array]:
    """Return a number for each statement true at some centre, and which statements hold in which cells [N, S]."""
    table = build_hint_table(data.palette, data.cells.parts, data.cells.center_m)
    number: dict[tuple[str, str | None, int], int] = {}
    words = (*data.palette.words, None)  # the last, for colour -1
    columns = [
        number.setdefault((data.gallery.labels[i], words[c], int(d)), len(number))
        for i, c, d in zip(table.instance, table.colour, table.direction, strict=True)
    ]
    holds = csr_array((np.ones(len(columns), np.float32), columns, table.starts), shape=(len(data.cells), len(number)))
    holds.sum_duplicates()
    holds.data[:] = 1
    return number, holds


def _query_statements(number: dict[tuple[str, str | None, int], int], hints: Sequence[tuple[Hint, ...]]) -> csr_array:
    """Return how often each query makes each statement [Q, S]."""
    query_statements = [
        [number.get((h.label, h.colour, DIRECTIONS.index(h.direction)), -1) for h in query_hints]
        for query_hints in hints
    ]
    query = np.repeat(np.arange(len(query_statements)), [len(a) for a in query_statements])
    symbol = np.concatenate([np.array(a, dtype=np.intp) for a in query_statements])
    known = symbol >= 0
    return csr_array(
        (np.ones(int(known.sum()), np.float32), (query[known], symbol[known])),
        shape=(len(query_statements), len(number)),
    )
