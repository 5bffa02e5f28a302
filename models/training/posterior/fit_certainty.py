"""Fit the calibration of `models.posterior.certainty` to texts about several cities."""

from collections.abc import Sequence
from dataclasses import astuple, dataclass, fields
from typing import Final

import numpy as np
from scipy.optimize import minimize

from models.citymap.types import Floats
from models.posterior.certainty import (
    DISTANCES_M,
    EVIDENCE_M,
    LOG_STEPS,
    Certainty,
    TextFacts,
    evidence_features,
    logit,
    probability_within,
)

TEXTS_PER_CITY: Final = 60  # cities with more texts count no more than this
RIDGE: Final = 1.0  # pull of the weights of facts to 0
SMOOTHNESS: Final = 5.0  # pull of the levels to a line
MAX_UNKNOWN_NAMES_WEIGHT: Final = -0.5  # set by hand: texts with a made-up name are else as right as others
DIGITS: Final = 4


@dataclass(frozen=True, slots=True, eq=False)
class CityTexts:
    """The uncalibrated answers to Q texts about a city."""

    city: str
    error_m: Floats  # [Q] inf where every answer is wrong
    shares: Floats  # [Q, G] masses within DISTANCES_M
    facts: Sequence[TextFacts]  # [Q]
    extent_m: float
    evidence: Floats  # [L, 4] labelled evidence of all texts: the row of its text, and as for `evidence_features`
    is_right: Floats  # [L] 1 where it shows the object that the writer meant, else 0


def fit_certainty(cities: Sequence[CityTexts]) -> Certainty:
    """Fit the calibration by penalised maximum likelihood; the distances of a text count as separate outcomes."""
    distances, count = len(DISTANCES_M), len(fields(TextFacts))
    start = np.zeros(distances + 2 + 2 * count)
    start[distances] = 1.0
    batches = [
        (
            logit(city.shares),
            np.array([astuple(facts) for facts in city.facts]).reshape(len(city.facts), count),
            city.error_m[:, None] <= DISTANCES_M,
            min(1.0, TEXTS_PER_CITY / max(1, len(city.error_m))),
        )
        for city in cities
    ]

    def loss(weights: Floats) -> tuple[float, Floats]:
        levels, share, facts = np.split(weights, [distances, distances + 2])
        total, gradient = 0.0, np.zeros_like(weights)
        for odds, features, hit, weight in batches:
            by_fact = features @ facts[:count], features @ facts[count:]
            z = (
                levels
                + (share[0] + share[1] * LOG_STEPS) * odds
                + by_fact[0][:, None]
                + by_fact[1][:, None] * LOG_STEPS
            )
            total += weight * float(np.logaddexp(0.0, np.where(hit, -z, z)).sum())
            residual = weight * (1.0 / (1.0 + np.exp(-z)) - hit)
            stepped = residual * LOG_STEPS
            gradient += np.concatenate(
                [
                    residual.sum(axis=0),
                    [(residual * odds).sum(), (stepped * odds).sum()],
                    features.T @ residual.sum(axis=1),
                    features.T @ stepped.sum(axis=1),
                ]
            )
        bend = np.diff(levels, 2)
        total += SMOOTHNESS * float(bend @ bend) + RIDGE * float(facts @ facts)
        pull = np.zeros(distances)
        for offset, factor in enumerate((1.0, -2.0, 1.0)):
            pull[offset : offset + len(bend)] += 2.0 * SMOOTHNESS * factor * bend
        gradient += np.concatenate([pull, [0.0, 0.0], 2.0 * RIDGE * facts])
        return total, gradient

    names = {distances + 2: MAX_UNKNOWN_NAMES_WEIGHT, distances + 2 + count: 0.0}
    bounds = [(None, names.get(n)) for n in range(len(start))]
    optimum = minimize(loss, start, jac=True, method="L-BFGS-B", bounds=bounds, options={"maxiter": 2000})
    weights = optimum.x.round(DIGITS).tolist()
    by_fact = weights[distances + 2 :]
    certainty = Certainty(
        levels=tuple(weights[:distances]),
        share=(weights[distances], weights[distances + 1]),
        facts=tuple(zip(by_fact[:count], by_fact[count:], strict=True)),
        evidence=(),
    )
    features = np.concatenate([labelled_features(certainty, city) for city in cities])
    evidence = _fit_evidence(features, np.concatenate([city.is_right for city in cities]))
    return certainty.model_copy(update={"evidence": evidence})


def labelled_features(certainty: Certainty, city: CityTexts) -> Floats:
    """Return the features [L, E] of the labelled evidence of a city."""
    rows = city.evidence[:, 0].astype(int)
    within = [
        probability_within(certainty.curve(shares, facts), EVIDENCE_M)
        for shares, facts in zip(city.shares, city.facts, strict=True)
    ]
    return evidence_features(city.evidence[:, 1:], np.array(within)[rows])


def _fit_evidence(features: Floats, is_right: Floats) -> tuple[float, ...]:
    """Fit a logistic regression of labelled evidence: features [L, E], right or not [L]."""
    pull = RIDGE * np.append(0.0, np.ones(features.shape[1] - 1))

    def loss(weights: Floats) -> tuple[float, Floats]:
        z = features @ weights
        total = float(np.logaddexp(0.0, np.where(is_right > 0, -z, z)).sum()) + float(pull @ weights**2)
        return total, features.T @ (1.0 / (1.0 + np.exp(-z)) - is_right) + 2.0 * pull * weights

    start = np.zeros(features.shape[1])
    return tuple(minimize(loss, start, jac=True, method="L-BFGS-B").x.round(DIGITS).tolist())
