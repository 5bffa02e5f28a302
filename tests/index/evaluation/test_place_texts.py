import json

import pytest

from index.evaluation.place_texts import evaluate_told, told_tables
from models.sources.place_texts import PlaceText


@pytest.fixture
def texts(localizer):
    goals = [localizer.gallery.cells.center_m[n, :2] for n in (10, 200, 400)]
    where = [tuple(float(v) for v in localizer.frame.to_wgs84(goal)) for goal in goals]
    return [
        PlaceText("I'm on East Street 2, a bench on my left", where[0]),
        PlaceText("Meet me at the corner of East Street 1 and North Path 1, north of you", where[1], where[0]),
        PlaceText("hello", where[2]),
    ]


def test_the_report_has_errors_radii_and_what_each_construction_is_worth(localizer, texts, tmp_path) -> None:
    report = evaluate_told(localizer, texts, tmp_path, lambda *_: None)
    assert report["texts"] == 3
    assert list(report["within"]) == ["10", "30", "100", "250"]
    assert all(share < 0.67 for share in report["within"].values()), "a text without an answer is never within"
    low, high = report["coverage"]["p90"]["interval"]
    assert low <= report["coverage"]["p90"]["true"] <= high
    assert {"street", "corner", "left, right, ahead, behind", "listener"} <= set(report["by_construction"])
    assert report["by_construction"]["corner"]["texts"] == report["without"]["corner"]["texts"] == 1
    assert localizer.posterior.places.without == frozenset(), "nothing is left out afterwards"
    assert json.loads((tmp_path / "told.json").read_text()) == report
    [(head, rows)] = told_tables(report)
    assert all(len(row) == len(head) for row in rows)
    assert (tmp_path / "told.md").read_text().count("as if not said") == len(report["without"])


def test_leaving_a_corner_out_changes_the_answer(localizer, texts) -> None:
    report = evaluate_told(localizer, texts[1:2], None, lambda *_: None)
    assert report["without"]["corner"] != report["by_construction"]["corner"]
