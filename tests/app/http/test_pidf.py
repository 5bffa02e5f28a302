"""Answers as PIDF-LO, checked with the schemas of the RFCs in pidf/ (the elements that answers use)."""

from dataclasses import replace
from datetime import datetime
from pathlib import Path

import pytest
from fake_localizer import FakeLocalizer
from lxml import etree

from app.http.formats.pidf import NAMESPACES
from index.answering.answers import Choice, Question
from models.citymap.frame import Frame

PIDF = {"Accept": "application/pidf+xml"}
NAMES = NAMESPACES | {"pidf": NAMESPACES[""]}
del NAMES[""]


@pytest.fixture(scope="module")
def schema():
    return etree.XMLSchema(file=Path(__file__).parent / "pidf" / "pidf.xsd")


@pytest.fixture
def presence(api, schema):
    """(description) -> the valid presence document of its answer."""

    def ask(description):
        response = api.post("/localize", json={"description": description}, headers=PIDF)
        assert response.status_code == 200
        assert response.headers["content-type"] == "application/pidf+xml"
        assert response.headers["vary"].startswith("Accept, Accept-Language")
        document = etree.fromstring(response.content)
        schema.assertValid(document)
        assert document.get("entity") == f"pres:{response.headers['x-request-id']}@hereabouts.invalid"
        return document

    return ask


def texts(document, path):
    return [element.text for element in document.iterfind(f".//{path}", NAMES)]


def test_one_circle_contains_the_person_with_90_percent(presence, text):
    document = presence(text)
    assert len(document.findall("pidf:tuple", NAMES)) == 1  # though the answer has two places
    assert texts(document, "gs:Circle/gml:pos") == ["60.1700000 24.9400000"]
    assert texts(document, "gs:Circle/gs:radius") == ["21.0"]
    [confidence] = document.iterfind(".//gp:location-info/con:confidence", NAMES)
    assert (confidence.text, confidence.get("pdf")) == ("90", "normal")
    assert texts(document, "gp:method") == ["Derived"]
    assert texts(document, "pidf:note") == ["status: ok", "© nobody"]


@pytest.mark.parametrize(
    ("covariance", "orientation"),
    [
        (((400.0, 0.0), (0.0, 100.0)), "90.0"),  # east and west
        (((100.0, 0.0), (0.0, 400.0)), "0.0"),
        (((250.0, 150.0), (150.0, 250.0)), "45.0"),  # northeast, clockwise from north
    ],
)
def test_a_long_distribution_is_an_ellipse_of_the_circle_s_area(presence, fake, monkeypatch, covariance, orientation):
    def long(query):
        answer = FakeLocalizer._answer(fake, query)
        return replace(answer, estimate=replace(answer.estimate, covariance=covariance))

    monkeypatch.setattr(fake, "_answer", long)
    document = presence("a tree")
    [major], [minor] = texts(document, "gs:Ellipse/gs:semiMajorAxis"), texts(document, "gs:Ellipse/gs:semiMinorAxis")
    assert float(major) / float(minor) == pytest.approx(2, rel=0.01)
    assert float(major) * float(minor) == pytest.approx(21**2, rel=0.01)
    assert texts(document, "gs:Ellipse/gs:orientation") == [orientation]
    assert texts(document, "gs:Circle") == []


def test_the_location_is_kept_for_a_day_and_not_sent_on(presence, text):
    document = presence(text)
    [expiry], [made] = texts(document, "gbp:retention-expiry"), texts(document, "pidf:timestamp")
    assert (datetime.fromisoformat(expiry) - datetime.fromisoformat(made)).total_seconds() == 86_400
    assert texts(document, "gbp:retransmission-allowed") == ["false"]


def test_without_a_position_there_is_no_tuple(presence):
    document = presence("nowhere")
    assert document.findall("pidf:tuple", NAMES) == []
    assert texts(document, "pidf:note") == ["status: no_match", "warning: nothing there", "© nobody"]


def test_notes_are_escaped(presence, fake, monkeypatch):
    hostile = "<script>&]]>\x01\ufffe\ud800 \U0001f6b2"
    fake.facts = replace(fake.facts, attribution=hostile.replace("\ud800", ""))
    monkeypatch.setattr(
        fake,
        "_answer",
        lambda query: replace(
            FakeLocalizer._answer(fake, query), question=Question("name", "<b>?", (Choice("unknown", "?"),), True)
        ),
    )
    notes = texts(presence("a tree"), "pidf:note")
    assert notes == ["status: ok", "question: <b>?", "<script>&]]>\ufffd\ufffd \U0001f6b2"]


def test_a_map_without_georeference_has_no_pidf(settings, start, problem):
    fake = FakeLocalizer(Frame())
    with start(settings, fake) as api:
        problem(api.post("/localize", json={"description": "a tree"}, headers=PIDF), 406, "no_georeference")
        assert fake.batches == []


def test_cells_have_no_pidf(api, problem):
    problem(api.get("/cells", headers=PIDF), 406, "not_acceptable")


def test_errors_stay_json(api, problem):
    problem(api.post("/localize", json={}, headers=PIDF), 422, "invalid_request")
