import json

import numpy as np
import pytest

from index.evaluation import QuerySet, _ambiguity, _calibration, evaluate
from models.city.hints import hint_table
from models.city.types import DIRECTIONS
from models.errors import MapError


@pytest.fixture(scope="module")
def report(osm_file, model, tmp_path_factory):
    directory = tmp_path_factory.mktemp("report")
    evaluate(osm_file, None, directory, model)
    return json.loads((directory / "report.json").read_text())


def test_the_report_has_the_fixed_names(report) -> None:
    assert set(report["retrieval"]) == {"1", "3", "5"}
    assert set(report["localization"]) == {"1", "5", "10"}
    assert all(set(row) == {"5", "10", "15"} for row in report["localization"].values())
    assert report["cells"] > 400
    assert report["queries"] > 400


def test_recalls_grow_and_stay_under_the_oracle(report) -> None:
    r = report["retrieval"]
    assert 0 <= r["1"] <= r["3"] <= r["5"] <= 1
    assert report["oracle"]["1"]["15"] == 1, "the best cell's centre is within 15 m by definition"
    for k in ("1", "5", "10"):
        row, oracle = report["localization"][k], report["oracle"][k]
        assert row["5"] <= row["10"] <= row["15"]
        assert row["5"] <= oracle["5"] or k != "1"


def test_chance_is_what_random_candidates_reach(report, osm_file) -> None:
    queries = QuerySet.of(osm_file, None)
    rng = np.random.default_rng(0)
    errors = [
        np.linalg.norm(
            queries.cells.center_m[rng.integers(len(queries.cells), size=5), :2] - p.position_m[:2], axis=1
        ).min()
        for p in queries.poses
        for _ in range(10)
    ]
    expected = report["chance"]["localization"]["5"]["15"]
    assert np.mean(np.array(errors) <= 15) == pytest.approx(expected, abs=0.01)


def test_it_is_the_same_twice(report, osm_file, model) -> None:
    assert evaluate(osm_file, None, None, model) == report


def test_regions_ask_only_about_themselves(osm_file) -> None:
    everything, test = QuerySet.of(osm_file, None), QuerySet.of(osm_file, "test")
    assert 0 < len(test.poses) < len(everything.poses)
    assert min(p.position_m[0] for p in test.poses) > test.cells.center_m[:, 0].min() - 15
    with pytest.raises(MapError, match="no split"):
        QuerySet.of(osm_file, "east")


def test_exact_matching_against_a_naive_count(osm_file) -> None:
    whole = QuerySet.of(osm_file, "val")
    queries = QuerySet(whole.city_map, whole.cells, whole.poses[::9], whole.truth[::9])
    table = hint_table(queries.city_map, queries.cells.parts, queries.cells.center_m)
    words = (*queries.city_map.palette.words, None)
    true_at = [
        {
            (
                queries.city_map.instances[table.instance[r]].label,
                words[table.colour[r]],
                DIRECTIONS[table.direction[r]],
            )
            for r in range(table.starts[n], table.starts[n + 1])
        }
        for n in range(len(queries.cells))
    ]
    ranks = []
    for pose, truth in zip(queries.poses, queries.truth, strict=True):
        fits = [sum((h.label, h.colour, h.direction) in said for h in pose.description.hints) for said in true_at]
        better, equal = sum(f > fits[truth] for f in fits), sum(f == fits[truth] for f in fits)
        ranks.append((better, equal))
    found = _ambiguity(queries)
    assert found["median_cells_that_fit_as_well"] == np.median([b + e for b, e in ranks])
    for k in (1, 3, 5):
        assert found["exact_matching"][k] == pytest.approx(np.mean([min(1, max(0, (k - b) / e)) for b, e in ranks]))


def test_calibration_of_honest_and_of_vain_probabilities() -> None:
    rng = np.random.default_rng(0)
    logits = np.sort(rng.normal(size=(5000, 10)) * 3, axis=1)[:, ::-1]
    weights = np.exp(logits)
    hit = rng.random(5000) < weights[:, 0] / weights.sum(axis=1)
    assert _calibration(logits, hit)["expected_calibration_error"] < 0.03
    assert _calibration(logits * 20, hit)["expected_calibration_error"] > 0.2
