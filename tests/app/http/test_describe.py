import math

import pytest
from fake_localizer import FakeLocalizer

from app.http.routes.localize import check_positions
from app.http.schemas.requests import DescribeRequest
from models.citymap.frame import Frame

PATH = "/describe"


def test_answer_has_exactly_the_names_of_the_api(api):
    response = api.post(PATH, json={"position": [0, -2.5]})
    assert response.status_code == 200, response.text
    body = response.json()
    assert body.pop("request_id") == response.headers["x-request-id"]
    assert set(body.pop("timings_ms")) == {"total"}
    origin = {"lat": 60.17, "lon": 24.94}
    tree = {"text": "A green tree is 3 m to my east.", "instance": "tree", "name": None, "source_id": "node/1"}
    road = {"text": "I stand on the road.", "instance": "road", "name": "Main Street", "source_id": "way/2"}
    assert body == {
        "description": "A green tree is 3 m to my east. I stand on the road.",
        "hints": [
            {**tree, "at": [3, 0], "away_m": 3, "bearing_deg": 90},
            {**road, "at": [0, -2.5], "away_m": 0, "bearing_deg": None},
        ],
        "place": "on Main Street",
        "position": [0, -2.5],
        "wgs84": origin,
        "cell_id": "fakeville_00001",
        "crs": {"frame_id": "map", "epsg": None, "origin": origin, "units": "m", "axes": "ENU"},
        "provenance": {
            "index": "default",
            "index_version": "v1",
            "model": "fake",
            "model_sha256": "ab" * 32,
            "map": "fakeville",
            "attribution": "© nobody",
        },
    }


def test_degrees_are_the_same_place(api, fake):
    lat, lon = fake.frame.to_wgs84([12.0, 34.0])
    assert api.post(PATH, json={"position": [12, 34]}).status_code == 200
    assert api.post(PATH, json={"position": [float(lon), float(lat)], "crs": "wgs84"}).status_code == 200
    metres, degrees = fake.positions
    assert metres == (12.0, 34.0)
    assert degrees == pytest.approx(metres, abs=1e-3)


def test_it_does_not_wait_for_the_inference_thread(api, fake):
    api.post(PATH, json={"position": [0, 0]})
    assert "inference" not in fake.threads
    assert fake.batches == []


@pytest.mark.parametrize(
    ("body", "field"),
    [
        ({}, "position"),
        ({"position": None}, "position"),
        ({"position": "0,0"}, "position"),
        ({"position": [0]}, "position[1]"),
        ({"position": [0, 0, 0]}, "position"),
        ({"position": [True, 0]}, "position[0]"),
        ({"position": [0, "1"]}, "position[1]"),
        ({"position": [0, math.nan]}, "position[1]"),
        ({"position": [math.inf, 0]}, "position[0]"),
        ({"position": [0, 10**400]}, "position[1]"),
        ({"position": [1e9, 0]}, "position[0]"),
        ({"position": [181, 0], "crs": "wgs84"}, "position"),
        ({"position": [60, 91], "crs": "wgs84"}, "position"),
        ({"position": [114.94, 0], "crs": "wgs84"}, "position"),  # the other side of the Earth
        ({"position": [0, 0], "crs": "utm"}, "crs"),
        ({"position": [0, 0], "deadline_ms": 0}, "deadline_ms"),
        ({"position": [0, 0], "deadline_ms": 60_001}, "deadline_ms"),
        ({"position": [0, 0], "deadline_ms": True}, "deadline_ms"),
        ({"position": [0, 0], "radius": 5}, "radius"),
    ],
)
def test_wrong_field_is_named(refused, body, field):
    fields, _ = refused(lambda body: check_positions(DescribeRequest.model_validate(body), FakeLocalizer()), body)
    assert field in fields


@pytest.mark.parametrize(
    ("body", "status", "code", "field"),
    [
        (b'{"position": [0, NaN]}', 400, "invalid_json", None),
        (b'{"position": [0, 0', 400, "invalid_json", None),
        (b"[0, 0]", 422, "invalid_request", "(body)"),
        (b'{"position": [0, 0, 0]}', 422, "invalid_request", "position"),
        (b'{"position": [0, 0], "x": 1}', 422, "invalid_request", "x"),
        (b'{"position": [5000, 0]}', 422, "invalid_request", "position"),
        (b'{"position": [30.0, 60.0], "crs": "wgs84"}', 422, "invalid_request", "position"),
    ],
)
def test_bad_input_is_a_problem(api, problem, body, status, code, field):
    response = api.post(PATH, content=body, headers={"Content-Type": "application/json"})
    problem(response, status, code, field)


def test_a_place_off_the_map_is_told_what_to_do(api, problem):
    refusal = problem(api.post(PATH, json={"position": [0, 1e8]}), 422, "invalid_request", "position")
    assert "choose a position" in refusal["detail"]


def test_degrees_need_a_georeference(settings, start, problem):
    with start(settings, FakeLocalizer(Frame())) as api:
        request_body = {"position": [24.94, 60.17], "crs": "wgs84"}
        problem(api.post(PATH, json=request_body), 422, "invalid_request", "crs")
        assert api.post(PATH, json={"position": [0, 0]}).json()["wgs84"] is None


def test_no_answer_before_the_deadline_is_504(api, fake, problem):
    fake.gate.clear()
    try:
        problem(api.post(PATH, json={"position": [0, 0], "deadline_ms": 20}), 504, "deadline_exceeded")
    finally:
        fake.gate.set()


def test_example_is_true(api):
    schemas = api.get("/openapi.json").json()["components"]["schemas"]
    answer = api.post(PATH, json=schemas["DescribeRequest"]["examples"][0]).json()
    example = schemas["DescribeResponse"]["examples"][0]
    assert set(example) == set(answer)
    assert set(example["hints"][0]) == set(answer["hints"][0])
    assert example["description"] == " ".join(hint["text"] for hint in example["hints"])
