import numpy as np
import pytest

from models.posterior.locate import _mass, _squares
from models.posterior.posterior import Field


def test_near_distances_are_right_on_a_map_of_many_kilometres() -> None:
    rng = np.random.default_rng(0)
    far = np.array([9000.0, 7000.0])
    around = np.concatenate([rng.uniform(0, 20, (40, 2)), far + rng.uniform(0, 20, (40, 2))])
    exact = ((around[:, None] - around) ** 2).sum(axis=2)
    near = exact < 100
    assert _squares(around).numpy()[near] == pytest.approx(exact[near], abs=0.05)


def test_a_cell_that_a_prior_rules_out_has_no_mass_and_spoils_no_other() -> None:
    log_p = np.array([0.0, 0.0, -np.inf, -np.inf, -1.0])
    mass = _mass(Field(np.arange(4), np.arange(5), np.array([0, 0, 1, 1, 3]), log_p))
    assert mass.tolist() == pytest.approx([np.log(2), -np.inf, -np.inf, -1.0])
