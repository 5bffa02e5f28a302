import numpy as np
import pytest

from models.posterior.locate import _squares


def test_near_distances_are_right_on_a_map_of_many_kilometres() -> None:
    rng = np.random.default_rng(0)
    far = np.array([9000.0, 7000.0])
    around = np.concatenate([rng.uniform(0, 20, (40, 2)), far + rng.uniform(0, 20, (40, 2))])
    exact = ((around[:, None] - around) ** 2).sum(axis=2)
    near = exact < 100
    assert _squares(around).numpy()[near] == pytest.approx(exact[near], abs=0.05)
