"""Recall by the protocol of docs/formats.md, with NumPy only."""

from typing import Any

import numpy as np
import numpy.typing as npt

RETRIEVAL_KS = (1, 3, 5)
LOCALIZATION_KS = (1, 5, 10)
LOCALIZATION_RADII_M = (5, 10, 15)
Hits = npt.NDArray[np.bool_]


def retrieval_hits(ranked: npt.NDArray[Any], truth: npt.NDArray[Any]) -> dict[int, Hits]:
    """Return whether the true cell of each query [Q] is among the first k, for each k.

    Args:
        ranked: [Q, K] cells, best first; -1 for no cell.
        truth: [Q] true cell of each query; -1 for none, which is never a hit.
    """
    hits = (ranked == truth[:, None]) & (truth[:, None] >= 0)
    return {k: hits[:, :k].any(axis=1) for k in RETRIEVAL_KS}


def localization_hits(errors_m: npt.NDArray[np.floating[Any]]) -> dict[int, dict[int, Hits]]:
    """Return whether one of the first k predictions of each query [Q] lies within 5, 10 and 15 m, for each k.

    Args:
        errors_m: [Q, K] horizontal distance of each candidate's prediction to the truth, best candidate first;
            infinite for a candidate of another scene.
    """
    return {
        k: {radius: errors_m[:, :k].min(axis=1) <= radius for radius in LOCALIZATION_RADII_M} for k in LOCALIZATION_KS
    }


def retrieval_recall(ranked: npt.NDArray[Any], truth: npt.NDArray[Any]) -> dict[int, float]:
    """Return the share of queries whose true cell is among the first k; arguments as `retrieval_hits`."""
    return {k: float(hits.mean()) for k, hits in retrieval_hits(ranked, truth).items()}


def localization_recall(errors_m: npt.NDArray[np.floating[Any]]) -> dict[int, dict[int, float]]:
    """Return the share of queries with a hit for each k and radius; arguments as `localization_hits`."""
    return {
        k: {radius: float(hits.mean()) for radius, hits in by_radius.items()}
        for k, by_radius in localization_hits(errors_m).items()
    }
