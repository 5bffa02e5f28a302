"""Calibrate how probably the objects shown as evidence are the ones meant."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from index.answering.answers import Evidence
from models.citymap.types import Floats
from models.posterior.certainty import EVIDENCE_M, evidence_features
from models.posterior.distribution import PositionDistribution

DOUBTFUL: Final = 0.5  # what is less stays so: an object of the kind, but with another name
MIN_EXPLAINED: Final = 0.05  # less is not calibrated: nothing near the estimate fits


def calibrated_evidence(evidence: Sequence[Evidence], located: PositionDistribution) -> tuple[Evidence, ...]:
    """Return evidence with calibrated `explained`; as it is for texts that name no places."""
    if located.certainty is None or located.facts is None or not evidence:
        return tuple(evidence)
    within = np.full(len(evidence), located.probability_within(EVIDENCE_M))
    shares = located.certainty.explained(evidence_features(evidence_facts(evidence), within))
    return tuple(_calibrated(*each) for each in zip(evidence, shares.tolist(), strict=True))


def _calibrated(item: Evidence, share: float) -> Evidence:
    if item.explained < MIN_EXPLAINED:
        return item
    return replace(item, explained=round(min(share, DOUBTFUL if item.explained < DOUBTFUL else 1.0), 4))


def evidence_facts(evidence: Sequence[Evidence]) -> Floats:
    """Return the first argument of `evidence_features` for evidence that is not calibrated yet."""
    rows = [(item.explained, item.exact is True, item.exact is None) for item in evidence]
    return np.array(rows, np.float64).reshape(len(rows), 3)
