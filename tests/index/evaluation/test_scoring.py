from dataclasses import replace

import numpy as np
import pytest

from index.evaluation.predictions import Predictions
from index.evaluation.scoring import calibration, score


def made_up(queries: int, right: float, rng: np.random.Generator) -> Predictions:
    """Predictions in two scenes of ten cells each, of which a share has the true cell first."""
    truth = rng.integers(20, size=queries)
    ranked = np.array([np.r_[t, rng.permutation(np.delete(np.arange(20), t))] for t in truth])
    wrong = rng.random(queries) >= right
    ranked[wrong] = np.roll(ranked[wrong], 1, axis=1)
    scenes = np.repeat(["a", "b"], 10)
    centers = np.column_stack([np.arange(20) % 10 * 10.0, np.zeros(20)])  # the scenes lie over each other
    return Predictions(
        facts={"data": "made up"},
        cell_ids=np.array([f"{s}_{n}" for n, s in enumerate(scenes)]),
        cell_scenes=scenes,
        cell_centers_m=centers,
        queried_cells=truth,
        positions_m=centers[truth],
        scenes=scenes[truth],
        strategies=np.full(queries, ""),
        ranked=ranked,
        scores=np.zeros(ranked.shape, np.float32),
        predicted_m=centers[ranked[:, :10]],
        probability=np.full(queries, right),
        radius_m=np.full((queries, 2), np.nan),
    )


def test_recall_intervals_and_scenes_of_made_up_predictions() -> None:
    predictions = made_up(2000, 0.3, np.random.default_rng(0))
    report = score(predictions)
    share, (low, high) = report["retrieval"]["1"], report["intervals"]["retrieval"]["1"]
    assert share == pytest.approx(0.3, abs=0.04)
    assert low < share < high
    assert high - low == pytest.approx(2 * 1.96 * np.sqrt(share * (1 - share) / 2000), rel=0.1)
    assert report["localization"]["1"]["5"] == pytest.approx(share), "the cell over it, in the other scene, is no hit"
    assert set(report["by_scene"]) == {"a", "b"}
    assert sum(part["queries"] for part in report["by_scene"].values()) == 2000
    assert report["by_strategy"] == {}
    assert report["chance"]["localization"]["1"]["5"] == pytest.approx(1 / 20)


def test_calibration_of_honest_and_of_vain_probabilities() -> None:
    rng = np.random.default_rng(0)
    honest = rng.random(5000)
    hit = rng.random(5000) < honest
    figures = calibration(honest, hit)
    assert figures["expected_calibration_error"] < 0.03
    assert sum(b["queries"] for b in figures["bins"]) == 5000
    vain = calibration(np.minimum(1, honest + 0.4), hit)
    assert vain["expected_calibration_error"] > 0.2
    assert vain["mean_probability"] > figures["mean_probability"]


def test_no_answer_to_a_query_without_a_cell_is_no_hit() -> None:
    predictions = made_up(50, 1.0, np.random.default_rng(0))
    nowhere = np.full_like(predictions.ranked, -1)
    unread = replace(
        predictions, ranked=nowhere, queried_cells=np.full(50, -1), probability=np.zeros(50)
    )  # nothing was read, off the map
    assert score(unread)["calibration"]["expected_calibration_error"] == 0
    assert score(unread)["retrieval"]["1"] == 0


def test_places_say_where_each_query_was_put_or_that_it_was_put_nowhere() -> None:
    predictions = made_up(50, 0.5, np.random.default_rng(0))
    places = score(predictions)["places"]
    assert places["truth"] == predictions.positions_m.tolist()
    other = predictions.cell_scenes[predictions.ranked[:, 0]] != predictions.scenes
    assert 0 < other.sum() < 50
    assert [estimate is None for estimate in places["estimate"]] == other.tolist()
    error = [np.hypot(*np.subtract(a, b)) for a, b in zip(places["truth"], places["estimate"], strict=True) if b]
    assert error == pytest.approx(predictions.errors_m()[~other, 0])


def test_coverage_is_the_share_of_truths_inside_each_radius() -> None:
    predictions = made_up(4, 1.0, np.random.default_rng(3))
    error_m = np.array([1.0, 3.0, 6.0, 20.0])
    predicted_m = predictions.predicted_m.copy()
    predicted_m[:, 0] = predictions.positions_m + np.column_stack([error_m, np.zeros(4)])
    radius_m = np.array([[2.0, 10.0], [2.0, 10.0], [4.0, 10.0], [4.0, 12.0]])
    report = score(replace(predictions, predicted_m=predicted_m, radius_m=radius_m))
    assert report["coverage"] == {"p50": {"true": 0.25, "median_m": 3.0}, "p90": {"true": 0.75, "median_m": 10.0}}
    assert "coverage" not in score(predictions), "a model without radii"
