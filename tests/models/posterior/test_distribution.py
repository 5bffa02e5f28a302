from dataclasses import replace

import numpy as np
import pytest

from models.posterior.distribution import PositionDistribution


@pytest.fixture
def located() -> PositionDistribution:
    """A tenth in each of nine places 10, 20, ... 90 m away, and a tenth elsewhere."""
    points = np.column_stack([np.arange(10.0, 91.0, 10.0), np.zeros(9)])
    return PositionDistribution(
        rows=np.array([0]), score=np.zeros(1), probability=np.array([0.9]), other=0.1, positions=np.zeros((1, 2)),
        points_m=points, points=np.arange(9), weight=np.full(9, 0.1), spacing_m=0.5, extent_m=1000.0,
    )  # fmt: skip


def test_radii_hold_their_shares(located) -> None:
    assert located.radii_m(0.25, 0.55, 0.95) == pytest.approx((30.0, 60.0, 1000.0), abs=0.1)


@pytest.mark.parametrize("metres", [5.0, 31.0, 62.0, 95.0, 500.0])
def test_what_is_within_a_radius_is_the_share_that_it_holds(located, metres) -> None:
    share = located.share_within(metres)
    assert share == pytest.approx(min(metres // 10, 9) / 10)
    if 0 < share < 0.9:
        assert located.radii_m(share - 0.05)[0] <= metres < located.radii_m(share + 0.05)[0]


def test_radii_are_as_honest_as_validation_says(located) -> None:
    honest = replace(located, calibrated_masses=(0.35, 0.75))
    assert honest.radii_m(0.5, 0.9) == pytest.approx(located.radii_m(0.35, 0.75))
    assert honest.radii_m(0.7) == pytest.approx(located.radii_m(0.55)), "between them, in proportion"
    assert honest.probability_within(35.0) == pytest.approx(0.5 * 0.3 / 0.35)
    assert honest.probability_within(1000.0) == 1.0
