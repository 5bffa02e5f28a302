from dataclasses import replace

import numpy as np
import pytest

from index.answering.query import Query
from index.answering.result import LocalizerResult, to_answer
from models.posterior.distribution import PositionDistribution


def distribution(spread_m: float) -> PositionDistribution:
    """Return a distribution over a ring, whose 50 % radius is its radius."""
    angle = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    ring_m = spread_m * np.column_stack([np.cos(angle), np.sin(angle)])
    return PositionDistribution(
        rows=np.array([0]), score=np.zeros(1), probability=np.ones(1), other=0.0, positions=np.zeros((1, 2)),
        points_m=ring_m, points=np.arange(64), weight=np.full(64, 1 / 64), spacing_m=0.1, extent_m=500.0,
    )  # fmt: skip


@pytest.mark.parametrize(("times", "status"), [(0.9, "ok"), (1.1, "ambiguous")])
def test_a_radius_beyond_the_size_of_a_cell_is_ambiguous(localizer, times, status) -> None:
    cells = localizer.gallery.cells
    result = LocalizerResult(distribution(times * cells.size_m))
    answer = to_answer(Query("a tree"), result, localizer.vector_localizer("none"), cells, localizer.frame)
    assert answer.estimate.radius_m.p50 == pytest.approx(times * cells.size_m, rel=0.02)
    assert answer.status == status
    [place] = answer.places
    assert place.position == answer.estimate.position
    assert place.probability == pytest.approx(1.0)


def test_an_answer_that_may_well_be_far_off_is_ambiguous(localizer) -> None:
    near = distribution(5.0)
    weight = np.where(np.arange(64) < 16, 0.2 / 16, 0.8 / 48)
    far_m = np.where((np.arange(64) < 16)[:, None], near.points_m + 300.0, near.points_m)
    cells = localizer.gallery.cells
    for located, status in ((near, "ok"), (replace(near, points_m=far_m, weight=weight), "ambiguous")):
        answer = to_answer(
            Query("a tree"), LocalizerResult(located), localizer.vector_localizer("none"), cells, localizer.frame
        )
        assert answer.estimate.radius_m.p50 < 10.0
        assert answer.status == status
        assert answer.estimate.within_m[100] == pytest.approx(1.0 if status == "ok" else 0.8, abs=0.02)


def test_a_refused_result_has_no_estimate(localizer) -> None:
    refused = LocalizerResult(distribution(1.0), "nothing there", warnings=("a warning",))
    answer = to_answer(
        Query("a tree"), refused, localizer.vector_localizer("none"), localizer.gallery.cells, localizer.frame
    )
    assert (answer.status, answer.estimate, answer.candidates) == ("no_match", None, ())
    assert answer.warnings == ("nothing there", "a warning")
