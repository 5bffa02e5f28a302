import numpy as np
import pytest

from index.answering.answers import Evidence
from index.evaluation.certainty import _is_right, certainty_table, measure, read_city
from models.posterior.certainty import DISTANCES_M
from models.sources.place_texts import PlaceText, WrittenMention
from models.training.posterior.fit_certainty import fit_certainty


@pytest.fixture
def texts(localizer):
    """A text, the same with a wrong label, one that names no place, and one about a place that is not there."""
    center = localizer.gallery.cells.center_m
    goal = tuple(float(v) for v in localizer.frame.to_wgs84(center[200, :2]))
    words = "I'm on East Street 2"
    named = WrittenMention(7, 20, "East Street 2")
    return [
        PlaceText(words, goal, mentions=(named,)),
        PlaceText(words, goal, mentions=(WrittenMention(7, 20, "East Street 1"),)),
        PlaceText("hello", goal),
        PlaceText(words, None),
    ]


def test_a_city_is_read_without_calibration(localizer, texts) -> None:
    city = read_city(localizer, texts, lambda *_: None)
    assert len(city.error_m) == len(city.facts) == 3, "a text that names no place is left out"
    assert city.shares.shape == (3, len(DISTANCES_M))
    assert (np.diff(city.shares, axis=1) >= 0).all()
    assert np.isfinite(city.error_m).tolist() == [True, True, False]
    assert city.is_right.tolist() == [1.0, 0.0]
    assert city.evidence[:, 0].tolist() == [0.0, 1.0]


def test_figures_of_a_city_by_its_certainty(localizer, texts) -> None:
    city = read_city(localizer, texts, lambda *_: None)
    figures = measure(fit_certainty([city]), city)
    assert figures["texts"] == 3
    assert figures["within"]["250"] == pytest.approx(2 / 3, abs=1e-4)
    assert 0 <= figures["p50_holds"] <= figures["p90_holds"] <= 1
    head, [row] = certainty_table({"here": figures})
    assert len(head) == len(row)


@pytest.mark.parametrize(
    ("relation", "away_m", "source_id", "is_right"),
    [
        ("near", 30.0, "node/1", True),
        ("near", 104.0, "node/1", False),
        ("far", 104.0, "node/1", True),
        ("north", 104.0, "node/1", True),
        ("near", 30.0, "node/2", False),
        ("corner", None, None, True),
    ],
)
def test_right_evidence_is_the_object_meant_in_its_relation(relation, away_m, source_id, is_right) -> None:
    evidence = Evidence(
        "cafe", (0, 4), "cafe", None, relation, None, absent=False, explained=0.9, source_id=source_id, away_m=away_m
    )
    assert _is_right(evidence, ["node/1", None], 50.0) is is_right
