"""Distances of pixels, beside a distance transform."""

import numpy as np
import pytest
from scipy.ndimage import distance_transform_edt

from models.citymap.gazetteer.distance_transform import (
    MOST_REACH,
    MOST_SQUARED,
    columns_away,
    pixels_away,
    squares_away,
)


@pytest.mark.parametrize("drawn", [0, 1, 3, 40, 400])
def test_distances_of_pixels_are_those_of_a_distance_transform(drawn) -> None:
    rng, shape, reach = np.random.default_rng(drawn), (40, 70), 9
    pixels = rng.choice(shape[0] * shape[1], drawn, replace=False)
    empty = np.ones(shape, np.bool_)
    empty.ravel()[pixels] = False
    truth = distance_transform_edt(empty).ravel() if drawn else np.full(empty.size, np.inf)
    asked = rng.permutation(empty.size)[:900]
    found = pixels_away(columns_away(pixels, shape, reach), asked, reach)
    near = truth[asked] <= reach
    assert found[near] == pytest.approx(truth[asked][near])
    assert np.isinf(found[~near]).all()
    squares = squares_away(columns_away(pixels, shape, reach), reach).ravel()
    near = truth <= reach
    assert squares[near].tolist() == np.round(truth[near] ** 2).tolist()
    assert (squares[~near] > reach**2).all()


def test_the_largest_reach_does_not_overflow() -> None:
    away = columns_away(np.array([0]), (600, 2), MOST_REACH)
    found = pixels_away(away, np.array([0, 2 * MOST_REACH, 2 * (MOST_REACH + 1), 2 * 599]), MOST_REACH)
    assert found.tolist() == [0, MOST_REACH, np.inf, np.inf]
    squares = squares_away(columns_away(np.array([0]), (600, 400), MOST_SQUARED), MOST_SQUARED)
    assert squares[[0, MOST_SQUARED, 0, 3], [0, 0, MOST_SQUARED, 4]].tolist() == [
        0,
        MOST_SQUARED**2,
        MOST_SQUARED**2,
        25,
    ]
    assert (squares[MOST_SQUARED + 1 :] > MOST_SQUARED**2).all()
    assert (squares[:, MOST_SQUARED + 1 :] > MOST_SQUARED**2).all()
