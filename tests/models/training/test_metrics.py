import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.training.metrics import localization_recall, retrieval_recall


@given(st.integers(0, 2**32 - 1))
def test_against_naive_loops(seed) -> None:
    rng = np.random.default_rng(seed)
    ranked = np.array([rng.permutation(30)[:10] for _ in range(12)])
    truth = rng.integers(0, 30, 12)
    recall = retrieval_recall(ranked, truth)
    for k in (1, 3, 5):
        assert recall[k] == pytest.approx(sum(t in list(r[:k]) for r, t in zip(ranked, truth, strict=True)) / 12)
    errors = rng.choice([1.0, 5.0, 7.0, 10.0, 20.0, np.inf], (12, 10))
    by_radius = localization_recall(errors)
    for k in (1, 5, 10):
        for radius in (5, 10, 15):
            assert by_radius[k][radius] == pytest.approx(sum(min(row[:k]) <= radius for row in errors) / 12)


def test_nothing_found_is_no_hit() -> None:
    assert retrieval_recall(np.full((3, 5), -1), np.array([0, 1, 2])) == {1: 0, 3: 0, 5: 0}
