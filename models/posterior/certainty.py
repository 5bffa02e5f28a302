"""The calibrated probability that the speaker is within a distance of the estimate (docs/method.md, M33).

A logistic regression for each of some distances, with the mass of the distribution within it and facts about how the
text was understood; fitted to texts about cities (`models.training.posterior.fit_certainty`).
"""

from dataclasses import astuple, dataclass
from typing import Final

import numpy as np
from pydantic import BaseModel, ConfigDict

from models.citymap.types import Floats

DISTANCES_M: Final = np.array(
    [3, 5, 7, 10, 15, 20, 30, 40, 50, 70, 100, 150, 200, 250, 350, 500, 700, 1000, 1500, 2500], np.float64
)
MIN_SHARE: Final = 1e-4  # of masses, whose logit is taken
LOG_STEPS: Final = np.log(DISTANCES_M / 30.0) / 3.0  # how far a distance is from 30 m, by which weights change
EVIDENCE_M: Final = 100.0
NEAREST_M: Final = 0.5  # within which the curve begins


@dataclass(frozen=True, slots=True)
class TextFacts:
    """How a text was understood."""

    unknown_names: float  # names that the map lacks, 0 to 1
    has_anchor: float  # 1 with a whole name of few objects, a corner, span or address; else 0
    understood: float  # log(1 + mentions and hints on the map)
    unexplained: float  # other mentions and hints that nothing at the estimate explains, 0 to 1
    is_foreign: float  # 1 if the text is not English
    is_meeting: float  # 1 if it describes a meeting point
    other: float  # logit of the mass outside the candidates, by 4

    @classmethod
    def count(
        cls,
        unknown: int,
        understood: int,
        unexplained: int,
        other: float,
        *,
        anchor: bool,
        foreign: bool,
        meeting: bool,
    ) -> "TextFacts":
        """Scale counts and the mass outside the candidates."""
        return cls(
            unknown_names=min(unknown, 2) / 2,
            has_anchor=float(anchor),
            understood=float(np.log1p(understood)),
            unexplained=min(unexplained, 3) / 3,
            is_foreign=float(foreign),
            is_meeting=float(meeting),
            other=logit_of(other) / 4,
        )


class Certainty(BaseModel):
    """The weights: at 30 m, and their change per `LOG_STEPS`."""

    model_config = ConfigDict(frozen=True)

    levels: tuple[float, ...]  # [G] of each distance
    share: tuple[float, float]  # of the logit of the mass within the distance
    facts: tuple[tuple[float, float], ...]  # of each field of TextFacts
    evidence: tuple[float, ...]  # of `evidence_features`

    def explained(self, features: Floats) -> Floats:
        """Return the probabilities [n] that mentions mean the objects shown for them, by `evidence_features` [n, E]."""
        shares: Floats = 1.0 / (1.0 + np.exp(-features @ np.array(self.evidence)))
        return shares

    def curve(self, shares: Floats, facts: TextFacts) -> Floats:
        """Return the probabilities [G] of being within DISTANCES_M, from the masses [G] within them."""
        z = np.array(self.levels) + (self.share[0] + self.share[1] * LOG_STEPS) * logit(shares)
        weights = np.array(self.facts)
        z = z + np.array(astuple(facts)) @ (weights[:, :1] + weights[:, 1:] * LOG_STEPS)
        return np.maximum.accumulate(1.0 / (1.0 + np.exp(-z)))


def evidence_features(evidence: Floats, within: Floats) -> Floats:
    """Return the features [n, E] of mentions and hints.

    Args:
        evidence: [n, 3] probability that the object shown explains it if the estimate is right; 1 where the words are
            a whole name, else 0; 1 for hints about nearby objects, else 0.
        within: [n] calibrated probability that the estimate is right, to `EVIDENCE_M`.
    """
    return np.column_stack([np.ones(len(evidence)), logit(evidence[:, 0]), evidence[:, 1:], logit(within)])


def logit_of(share: float) -> float:
    """Return `logit` of one probability."""
    return float(logit(np.array([share]))[0])


def logit(shares: Floats) -> Floats:
    """Return log(p / (1 - p)) of probabilities, which are kept off 0 and 1."""
    clipped = np.clip(shares, MIN_SHARE, 1.0 - MIN_SHARE)
    odds: Floats = np.log(clipped / (1.0 - clipped))
    return odds


def probability_within(curve: Floats, metres: float) -> float:
    """Return the probability of being within a distance by a curve [G]."""
    return float(np.interp(np.log(max(metres, NEAREST_M)), *_line(curve)))


def radius_of(curve: Floats, probability: float) -> float:
    """Return the distance within which the speaker is with a probability; infinite beyond the last distance."""
    log_m, reached = _line(curve)
    return float(np.exp(np.interp(probability, reached, log_m))) if probability <= reached[-1] else np.inf


def _line(curve: Floats) -> tuple[Floats, Floats]:
    """Return the logs of distances and probabilities between which a curve [G] is a line, from 0 on."""
    return np.log(np.append(NEAREST_M, DISTANCES_M)), np.append(0.0, curve)
