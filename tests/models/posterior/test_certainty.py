from dataclasses import astuple, replace

import numpy as np
import pytest

from models.posterior.certainty import DISTANCES_M, Certainty, TextFacts, probability_within, radius_of
from models.training.posterior.fit_certainty import CityTexts, fit_certainty

FACTS = TextFacts.count(unknown=0, understood=2, unexplained=0, other=0.1, anchor=True, foreign=False, meeting=False)


def city(rng: np.random.Generator, count: int, overconfidence: float) -> CityTexts:
    """Return texts with powers of the true odds as masses; unknown names triple the errors."""
    unknown = rng.random(count) < 0.5
    scale_m = np.exp(rng.uniform(2.0, 5.0, count))
    error_m = scale_m * rng.exponential(1.0, count) * np.where(unknown, 3.0, 1.0)
    true = 1.0 - np.exp(-DISTANCES_M / scale_m[:, None])
    odds = (true / (1.0 - true).clip(min=1e-9)) ** overconfidence
    facts = [replace(FACTS, unknown_names=float(name)) for name in unknown]
    none = np.zeros((0, 4)), np.zeros(0)
    return CityTexts("a", error_m, odds / (1.0 + odds), facts, 5000.0, *none)


@pytest.mark.parametrize("overconfidence", [0.7, 1.5])
def test_probabilities_match_the_outcomes(overconfidence) -> None:
    rng = np.random.default_rng(0)
    certainty = fit_certainty([city(rng, 400, overconfidence) for _ in range(3)])
    test = city(rng, 2000, overconfidence)
    curves = [certainty.curve(*each) for each in zip(test.shares, test.facts, strict=True)]
    for metres in (10.0, 30.0, 100.0):
        claimed = np.array([probability_within(curve, metres) for curve in curves])
        assert claimed.mean() == pytest.approx((test.error_m <= metres).mean(), abs=0.04)
        sure = claimed > np.median(claimed)
        assert claimed[sure].mean() == pytest.approx((test.error_m[sure] <= metres).mean(), abs=0.06)
    inside = [error <= radius_of(curve, 0.9) for error, curve in zip(test.error_m, curves, strict=True)]
    assert np.mean(inside) == pytest.approx(0.9, abs=0.03)


def test_the_regression_is_the_formula() -> None:
    """A loop over distances and facts, apart from the code."""
    rng = np.random.default_rng(1)
    levels, facts = rng.normal(size=len(DISTANCES_M)), rng.normal(size=(7, 2))
    certainty = Certainty(levels=tuple(levels), share=(1.1, -0.2), facts=tuple(map(tuple, facts)), evidence=())
    shares = np.linspace(0.05, 0.9, len(DISTANCES_M))
    highest, expected = 0.0, []
    for metres, level, share in zip(DISTANCES_M, levels, shares, strict=True):
        step = np.log(metres / 30.0) / 3.0
        z = level + (1.1 - 0.2 * step) * np.log(share / (1 - share))
        z += sum(value * (at_30 + change * step) for value, (at_30, change) in zip(astuple(FACTS), facts, strict=True))
        highest = max(highest, 1 / (1 + np.exp(-z)))
        expected.append(highest)
    assert certainty.curve(shares, FACTS) == pytest.approx(np.array(expected))


def test_radii_and_probabilities_are_one_curve() -> None:
    curve = np.linspace(0.1, 0.95, len(DISTANCES_M))
    for probability in (0.05, 0.5, 0.9):
        assert probability_within(curve, radius_of(curve, probability)) == pytest.approx(probability)
    assert radius_of(curve, 0.96) == np.inf
    steps = [radius_of(curve, p) for p in np.linspace(0.01, 0.95, 500)]
    assert max(np.diff(np.log(steps))) < 0.1 + np.log(3 / 0.5), "no cliff"


def test_places_that_the_map_lacks_are_never_within() -> None:
    rng = np.random.default_rng(2)
    lost = replace(city(rng, 300, 1.0), error_m=np.full(300, np.inf))
    curve = fit_certainty([lost]).curve(lost.shares[0], lost.facts[0])
    assert probability_within(curve, 100.0) < 0.2
