import numpy as np
import pytest
from scipy.sparse import csr_array

from models.posterior.questions import (
    WRONG_REPLY_SHARE,
    entropy,
    expected_entropy,
    expected_entropy_of_names,
    name_with_errors,
    with_errors,
)


def slow_expected_entropy(mass, chance):
    """H(X | A), from the definition."""
    left = 0.0
    for a in range(chance.shape[1]):
        p_a = sum(mass[x] * chance[x, a] for x in range(len(mass)))
        if p_a == 0:
            continue
        posterior = [mass[x] * chance[x, a] / p_a for x in range(len(mass))]
        left += p_a * -sum(p * np.log2(p) for p in posterior if p > 0)
    return left


def test_expected_entropy_is_that_of_the_definition():
    rng = np.random.default_rng(0)
    mass = rng.dirichlet(np.ones(20))
    mass[3] = 0.0
    mass /= mass.sum()
    chance = rng.dirichlet(np.ones(4), size=(6, 20))
    chance[2, :, 3] = 0.0  # a question with three answers
    chance[2] /= chance[2].sum(axis=1, keepdims=True)
    assert expected_entropy(mass, chance) == pytest.approx([slow_expected_entropy(mass, one) for one in chance])


def test_a_question_that_splits_evenly_gains_a_bit_and_one_that_does_not_split_none():
    mass = np.full(8, 1 / 8)
    half = np.eye(2)[np.arange(8) % 2]
    alike = np.full((8, 2), 0.5)
    assert entropy(mass) == pytest.approx(3.0)
    assert expected_entropy(mass, np.stack([half, alike])) == pytest.approx([2.0, 3.0])
    assert 2.0 < expected_entropy(mass, with_errors(half)[None])[0] < 3.0


def test_errors_are_shared_by_the_other_answers():
    true = np.array([[1.0, 0.0, 0.0], [0.5, 0.5, 0.0]])
    chance = with_errors(true)
    assert chance.sum(axis=1) == pytest.approx([1.0, 1.0])
    assert chance[0] == pytest.approx([1 - WRONG_REPLY_SHARE, WRONG_REPLY_SHARE / 2, WRONG_REPLY_SHARE / 2])


@pytest.mark.parametrize(("names", "part"), [(30, 1.0), (30, 0.4), (2, 0.5), (500, 0.02)])
def test_what_a_name_leaves_is_that_of_all_names(names, part):
    """Against all of K names and "I don't know", which changes nothing, from the definition."""
    rng = np.random.default_rng(0)
    mass = rng.dirichlet(np.ones(20))
    mass[3] = 0.0
    mass /= mass.sum()
    true = rng.random((20, names)) * (rng.random((20, names)) < part)
    true[5:8] = 0.0  # nothing to say there
    true /= np.maximum(1.0, true.sum(axis=1, keepdims=True) / rng.uniform(0.5, 1.0, (20, 1)))
    chance = name_with_errors(true, names)
    nothing = (mass * (1 - chance.sum(axis=1))).sum()
    slow = slow_expected_entropy(mass, chance) + nothing * entropy(mass)
    assert expected_entropy_of_names(mass, csr_array(true), names) == pytest.approx(slow)


def test_a_name_is_said_in_error_as_often_as_another_answer():
    true = np.eye(7)[:, :3]
    assert name_with_errors(true, 7) == pytest.approx(with_errors(np.eye(7))[:, :3])
    assert name_with_errors(true[:, :2].sum(axis=1), 7, 2) == pytest.approx(with_errors(np.eye(7))[:, :2].sum(axis=1))
