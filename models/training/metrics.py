"""Recall by the protocol of kitti360pose.md. NumPy only."""

from typing import Any

import numpy as np
import numpy.typing as npt

RETRIEVAL_KS = (1, 3, 5)
LOCALIZATION_KS = (1, 5, 10)
LOCALIZATION_RADII_M = (5, 10, 15)


def retrieval_recall(ranked: npt.NDArray[Any], truth: npt.NDArray[Any]) -> dict[int, float]:
    """Share of queries whose true cell is among the first k.

    Args:
        ranked: [Q, K] cells, best first; -1 where there is none.
        truth: [Q] the best cell of each query, 0 or greater.
    """
    hits = ranked == truth[:, None]
    return {k: float(hits[:, :k].any(axis=1).mean()) for k in RETRIEVAL_KS}


def localization_recall(errors_m: npt.NDArray[np.floating[Any]]) -> dict[int, dict[int, float]]:
    """Share of queries with one of the first k predictions within 5, 10 and 15 m.

    Args:
        errors_m: [Q, K] distance in the plane of each candidate's prediction to the truth, best candidate first;
            infinite for a candidate of another scene.
    """
    return {
        k: {radius: float((errors_m[:, :k].min(axis=1) <= radius).mean()) for radius in LOCALIZATION_RADII_M}
        for k in LOCALIZATION_KS
    }
