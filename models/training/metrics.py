"""Recall by the protocol of docs/formats.md. NumPy only."""

from typing import Any

import numpy as np
import numpy.typing as npt

RETRIEVAL_KS = (1, 3, 5)
LOCALIZATION_KS = (1, 5, 10)
LOCALIZATION_RADII_M = (5, 10, 15)
Hits = npt.NDArray[np.bool_]


def retrieval_hits(ranked: npt.NDArray[Any], truth: npt.NDArray[Any]) -> dict[int, Hits]:
    """[Q] whether a query's true cell is among the first k, for each k.

    Args:
        ranked: [Q, K] cells, best first; -1 where there is none.
        truth: [Q] the best cell of each query; -1 if it has none, which no candidate hits.
    """
    hits = (ranked == truth[:, None]) & (truth[:, None] >= 0)
    return {k: hits[:, :k].any(axis=1) for k in RETRIEVAL_KS}


def localization_hits(errors_m: npt.NDArray[np.floating[Any]]) -> dict[int, dict[int, Hits]]:
    """[Q] whether one of the first k predictions lies within 5, 10 and 15 m, for each k and radius.

    Args:
        errors_m: [Q, K] distance in the plane of each candidate's prediction to the truth, best candidate first;
            infinite for a candidate of another scene.
    """
    return {
        k: {radius: errors_m[:, :k].min(axis=1) <= radius for radius in LOCALIZATION_RADII_M} for k in LOCALIZATION_KS
    }


def retrieval_recall(ranked: npt.NDArray[Any], truth: npt.NDArray[Any]) -> dict[int, float]:
    """Share of queries whose true cell is among the first k; arguments as `retrieval_hits`."""
    return {k: float(hits.mean()) for k, hits in retrieval_hits(ranked, truth).items()}


def localization_recall(errors_m: npt.NDArray[np.floating[Any]]) -> dict[int, dict[int, float]]:
    """Share of queries with one of the first k predictions within 5, 10 and 15 m; arguments as `localization_hits`."""
    return {
        k: {radius: float(hits.mean()) for radius, hits in by.items()} for k, by in localization_hits(errors_m).items()
    }
