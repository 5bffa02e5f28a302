import json

import pytest

from index.evaluation.place_texts import constructions_of, evaluate_texts, text_tables
from models.language.languages.english import English
from models.language.mentions.reader import find_mentions
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


def test_the_report_has_errors_and_radii_of_all_texts_and_by_construction(localizer, texts, tmp_path) -> None:
    report = evaluate_texts(localizer, texts, tmp_path, lambda *_: None)
    assert report["texts"] == 3
    assert list(report["within"]) == ["10", "30", "100", "250"]
    assert all(share < 0.67 for share in report["within"].values()), "a text without an answer is never within"
    low, high = report["coverage"]["p90"]["interval"]
    assert low <= report["coverage"]["p90"]["true"] <= high
    assert {"street", "corner", "left, right, ahead, behind", "listener"} <= set(report["by_construction"])
    assert report["by_construction"]["corner"]["texts"] == 1
    assert json.loads((tmp_path / "told.json").read_text()) == report
    [(head, rows)] = text_tables(report)
    assert all(len(row) == len(head) for row in rows)
    assert [row[0] for row in rows] == ["all", *report["by_construction"]]
    assert (tmp_path / "told.md").read_text().count("\n") == len(rows) + 2


def test_the_constructions_of_a_mention(localizer) -> None:
    posterior = localizer.posterior
    mentions = find_mentions("A bench is 20 m ahead.", posterior.places._lookup, English(posterior.weights.cues))
    [mention] = [mention for mention in mentions if mention.form == "thing"]
    assert constructions_of(mention) == {"kind", "left, right, ahead, behind", "distance"}
