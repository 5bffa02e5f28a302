"""Distances of pixels, beside a distance transform."""

import numpy as np
import pytest
from scipy.ndimage import distance_transform_edt

from models.citymap.gazetteer.distance_transform import (
    MAX_SQUARED_REACH_PX,
    column_distances,
    pixel_distances,
    squared_distances,
)


@pytest.mark.parametrize("drawn", [0, 1, 3, 40, 400])
def test_distances_of_pixels_are_those_of_a_distance_transform(drawn) -> None:
    rng, shape, reach = np.random.default_rng(drawn), (40, 70), 9
    pixels = rng.choice(shape[0] * shape[1], drawn, replace=False)
    empty = np.ones(shape, np.bool_)
    empty.ravel()[pixels] = False
    truth = distance_transform_edt(empty).ravel() if drawn else np.full(empty.size, np.inf)
    requested = rng.permutation(empty.size)[:900]
    result = pixel_distances(column_distances(pixels, shape, reach), requested, reach)
    near = truth[requested] <= reach
    assert result[near] == pytest.approx(truth[requested][near])
    assert np.isinf(result[~near]).all()
    squares = squared_distances(column_distances(pixels, shape, reach), reach).ravel()
    near = truth <= reach
    assert squares[near].tolist() == np.round(truth[near] ** 2).tolist()
    assert (squares[~near] > reach**2).all()


def test_the_largest_reach_does_not_overflow() -> None:
    most_px = 253
    away = column_distances(np.array([0]), (600, 2), most_px)
    result = pixel_distances(away, np.array([0, 2 * most_px, 2 * (most_px + 1), 2 * 599]), most_px)
    assert result.tolist() == [0, most_px, np.inf, np.inf]
    squares = squared_distances(column_distances(np.array([0]), (600, 400), MAX_SQUARED_REACH_PX), MAX_SQUARED_REACH_PX)
    assert squares[[0, MAX_SQUARED_REACH_PX, 0, 3], [0, 0, MAX_SQUARED_REACH_PX, 4]].tolist() == [
        0,
        MAX_SQUARED_REACH_PX**2,
        MAX_SQUARED_REACH_PX**2,
        25,
    ]
    assert (squares[MAX_SQUARED_REACH_PX + 1 :] > MAX_SQUARED_REACH_PX**2).all()
    assert (squares[:, MAX_SQUARED_REACH_PX + 1 :] > MAX_SQUARED_REACH_PX**2).all()
