"""How far hints tell the cells of a map apart, whatever the model: exact matching of their symbols."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from models.citymap.gallery import MapData
from models.citymap.hints import build_hint_table
from models.citymap.queries import Queries
from models.citymap.types import DIRECTIONS, Hint
from models.training.metrics import RETRIEVAL_KS

QUERIES_AT_ONCE = 1024


def ambiguity(data: MapData, queries: Queries, hints: Sequence[tuple[Hint, ...]]) -> dict[str, Any]:
    """Recall of exact matching.

    A cell fits a hint if the same statement (direction, colour, label) is true at its centre. Cells are ranked by
    the number of hints that fit; ties count as drawn at random.

    Args:
        data: the gallery.
        queries: with known best cells.
        hints: what each says.

    Returns:
        "median_cells_that_fit_as_well" and "exact_matching" {k: recall}.
    """
    symbols, cells = _symbols_of_cells(data)
    asked = _symbols_of_queries(symbols, hints)
    truth = queries.truth
    better, equal = np.zeros(len(truth)), np.ones(len(truth))
    for start in range(0, len(truth), QUERIES_AT_ONCE):
        rows = slice(start, start + QUERIES_AT_ONCE)
        fits = (asked[rows] @ cells.T).toarray()
        own = fits[np.arange(len(fits)), truth[rows]][:, None]
        better[rows], equal[rows] = (fits > own).sum(axis=1), (fits == own).sum(axis=1)
    return {
        "median_cells_that_fit_as_well": float(np.median(better + equal)),
        "exact_matching": {k: float(np.clip((k - better) / equal, 0, 1).mean()) for k in RETRIEVAL_KS},
    }


def _symbols_of_cells(data: MapData) -> tuple[dict[tuple[str, str | None, int], int], csr_array]:
    """A number for each statement that is true at some centre, and [N, S] which are true where."""
    table = build_hint_table(data.palette, data.cells.parts, data.cells.center_m)
    number: dict[tuple[str, str | None, int], int] = {}
    words = (*data.palette.words, None)  # the last, for colour -1
    said = [
        number.setdefault((data.gallery.labels[i], words[c], int(d)), len(number))
        for i, c, d in zip(table.instance, table.colour, table.direction, strict=True)
    ]
    holds = csr_array((np.ones(len(said), np.float32), said, table.starts), shape=(len(data.cells), len(number)))
    holds.sum_duplicates()
    holds.data[:] = 1
    return number, holds


def _symbols_of_queries(number: dict[tuple[str, str | None, int], int], hints: Sequence[tuple[Hint, ...]]) -> csr_array:
    """[Q, S] how often each query makes each statement."""
    asked = [[number.get((h.label, h.colour, DIRECTIONS.index(h.direction)), -1) for h in said] for said in hints]
    query = np.repeat(np.arange(len(asked)), [len(a) for a in asked])
    symbol = np.concatenate([np.array(a, dtype=np.intp) for a in asked])
    known = symbol >= 0
    return csr_array(
        (np.ones(int(known.sum()), np.float32), (query[known], symbol[known])), shape=(len(asked), len(number))
    )
