import re
import threading
import time
from dataclasses import replace
from itertools import pairwise

import pytest
from fake_localizer import FakeLocalizer

from app import limits
from index.answering.answers import Choice, Question
from index.answering.query import Box, Circle, Prior, Query, Reply
from models.citymap.frame import Frame
from models.errors import ReplyError, WeightsError

TREE = {"question": "near:tree", "choice": "yes"}


def test_answer_has_exactly_the_names_of_the_api(api, text):
    body = api.post("/localize", json={"description": text, "top_k": 2}).json()
    assert set(body) == {
        *("request_id", "status", "language", "estimate", "places", "candidates", "other_probability"),
        *("crs", "provenance", "timings_ms", "warnings", "evidence", "heat_map", "question", "ros"),
    }
    estimate = body["estimate"]
    assert estimate["position"] == [0, 0]
    assert estimate["method"] == "cell_center"
    assert estimate["covariance"] == [[100, 0], [0, 100]]
    assert estimate["radius_m"] == {"p50": 12, "p90": 21}
    assert estimate["probability"] == 0.6
    assert estimate["wgs84"] == {"lat": 60.17, "lon": 24.94}
    assert [candidate["rank"] for candidate in body["candidates"]] == [1, 2]
    assert body["candidates"][0] == {
        "rank": 1,
        "cell_id": "fakeville_00001",
        "score": 0.9,
        "probability": 0.6,
        "center": [0, 0],
        "bbox": [-15, -15, 15, 15],
        "position": [1, 2],
        "wgs84": {"lat": 60.17, "lon": 24.94},
    }
    assert [place["probability"] for place in body["places"]] == [0.8, 0.1]
    assert body["places"][0] == {
        "probability": 0.8,
        "position": [0, 0],
        "wgs84": {"lat": 60.17, "lon": 24.94},
        "radius_m": 15,
        "place": None,
        "source_id": "node/1",
        "supports": ["tree: 3 m to the east"],
        "contradicts": [],
    }
    origin = {"lat": 60.17, "lon": 24.94}
    assert body["crs"] == {"frame_id": "map", "epsg": None, "origin": origin, "units": "m", "axes": "ENU"}
    assert body["provenance"] == {
        "index": "default",
        "index_version": "v1",
        "model": "posterior/fake",
        "model_sha256": "cd" * 32,
        "map": "fakeville",
        "attribution": "© nobody",
    }
    assert set(body["timings_ms"]) == {"encode", "search", "estimate", "queue", "total"}


def test_description_goes_on_as_it_is_and_defaults_are_the_apis(api, fake, text):
    api.post("/localize", json={"description": text})
    assert fake.batches == [[Query(text, top_k=5, refine="posterior")]]


def test_hints_filter_and_prior_reach_the_localizer(api, fake):
    where = {"within": {"circle": {"center": [1, 2.5], "radius_m": 30}}, "prior": {"position": [3, 4], "sigma_m": 50}}
    api.post("/localize", json={"hints": [" one tree ", "two trees"], "top_k": 1, **where})
    api.post("/localize", json={"hints": ["a tree"], "within": {"bbox": [24.9, 60.1, 25, 60.2]}, "crs": "wgs84"})
    assert fake.batches == [
        [Query(" one tree \ntwo trees", 1, Circle((1, 2.5), 30), Prior((3, 4), 50), refine="posterior")],
        [Query("a tree", 5, Box(24.9, 60.1, 25, 60.2), crs="wgs84", refine="posterior")],
    ]


def test_no_match_has_no_estimate(api):
    body = api.post("/localize", json={"hints": ["nowhere"]}).json()
    assert (body["status"], body["estimate"], body["candidates"]) == ("no_match", None, [])
    assert body["warnings"] == ["nothing there"]


def test_model_runs_on_the_inference_thread_only(api, fake, text):
    api.post("/localize", json={"description": text})
    assert fake.threads == {"inference"}
    assert threading.current_thread().name != "inference"


def test_geojson_is_lon_lat_and_closed_counter_clockwise(api, text):
    response = api.post("/localize", json={"description": text}, headers={"Accept": "application/geo+json"})
    assert response.headers["content-type"] == "application/geo+json"
    assert response.headers["vary"].startswith("Accept, Accept-Language")
    body = response.json()
    estimate, place, _, first, second = body["features"]
    assert body["type"] == "FeatureCollection"
    assert body["request_id"] == response.headers["x-request-id"]
    assert body["provenance"]["attribution"] == "© nobody"
    assert estimate["geometry"]["type"] == "Point"
    assert estimate["geometry"]["coordinates"] == pytest.approx([24.94, 60.17])
    assert estimate["properties"]["kind"] == "estimate"
    assert estimate["properties"]["radius_m"]["p90"] == 21
    assert (place["id"], place["geometry"]["type"], place["properties"]["probability"]) == ("place-1", "Point", 0.8)
    assert (first["id"], second["id"]) == ("fakeville_00001", "fakeville_00002")
    assert first["properties"]["probability"] == 0.6
    [ring] = first["geometry"]["coordinates"]
    assert ring[0] == ring[-1]
    doubled_area = sum(x1 * y2 - x2 * y1 for (x1, y1), (x2, y2) in pairwise(ring))
    assert doubled_area > 0
    west, south = ring[0]
    assert west < 24.94 < ring[2][0]
    assert south < 60.17 < ring[2][1]


def test_geojson_of_no_match_has_no_features(api):
    response = api.post("/localize", json={"hints": ["nowhere"]}, headers={"Accept": "application/geo+json"})
    assert (response.json()["features"], response.json()["status"]) == ([], "no_match")


def test_map_without_georeference_has_no_geojson(settings, start, problem):
    fake = FakeLocalizer(Frame())
    with start(settings, fake) as api:
        ask = {"json": {"description": "a tree"}}
        headers = {"Accept": "application/geo+json"}
        problem(api.post("/localize", **ask, headers=headers), 406, "no_georeference")
        assert fake.batches == []
        headers = {"Accept": "application/geo+json, application/json;q=0.1"}
        assert api.post("/localize", **ask, headers=headers).headers["content-type"] == "application/json"


def test_unknown_format_is_406_before_anything_is_computed(api, fake, problem):
    problem(api.post("/localize", json={"description": "a"}, headers={"Accept": "text/html"}), 406, "not_acceptable")
    assert fake.batches == []


def test_fault_is_500_without_internals_and_others_go_on(api, problem):
    body = problem(api.post("/localize", json={"description": "a bad tree"}), 500, "internal_error")
    body.pop("request_id")  # hexadecimal digits may spell "bad"
    assert not re.search("secret|bad|Runtime", str(body))
    assert api.post("/localize", json={"description": "a good tree"}).status_code == 200


def test_nan_from_the_model_is_a_fault_and_never_null(api, problem):
    problem(api.post("/localize", json={"description": "a nan tree"}), 500, "internal_error")


def test_deadline_is_kept_while_the_model_is_busy(api, fake, problem):
    fake.gate.clear()
    started = time.monotonic()
    problem(api.post("/localize", json={"description": "a tree", "deadline_ms": 50}), 504, "deadline_exceeded")
    assert time.monotonic() - started < 5


def test_full_queue_is_429_with_retry_after(settings, fake, start, until, problem, monkeypatch):
    monkeypatch.setattr(limits, "MAX_WAITING_QUERIES", 1)
    with start(settings, fake) as api:
        fake.gate.clear()
        statuses = []
        ask, ask_headers = {"json": {"description": "a tree"}}, {"Content-Type": "application/json"}
        threads = [threading.Thread(target=lambda: statuses.append(api.post("/localize", **ask).status_code))]
        threads[0].start()
        assert fake.entered.acquire(timeout=60)
        threads.append(threading.Thread(target=lambda: statuses.append(api.post("/localize", **ask).status_code)))
        threads[1].start()
        until(lambda: len(api.app.state.indexes.queue()._pending) == 1)
        response = api.post("/localize", **ask)
        problem(response, 429, "queue_full")
        assert response.headers["retry-after"] == "1"
        at_the_door = api.post("/localize", content=b"{" * 60_000, headers=ask_headers)
        problem(at_the_door, 429, "queue_full")
        fake.gate.set()
        for thread in threads:
            thread.join(60)
        problem(api.post("/localize", content=b"{" * 60_000, headers=ask_headers), 400, "invalid_json")
    assert statuses == [200, 200]


def test_refine_reaches_the_localizer_and_is_a_known_word(api, fake, text):
    assert api.post("/localize", json={"description": text, "refine": "regressor"}).status_code == 200
    assert api.post("/localize", json={"description": text}).status_code == 200
    assert [batch[0].refine for batch in fake.batches] == ["regressor", "posterior"]
    answer = api.post("/localize", json={"description": text, "refine": "magic"})
    assert (answer.status_code, answer.json()["errors"][0]["field"]) == (422, "refine")


def test_a_service_without_a_fine_stage_says_so(api, fake, text, monkeypatch):
    def missing(queries):
        raise WeightsError("no weights in /secret/place")

    monkeypatch.setattr(fake, "localize", missing)
    answer = api.post("/localize", json={"description": text, "refine": "regressor"})
    assert (answer.status_code, answer.json()["errors"][0]["field"]) == (422, "refine")
    assert "secret" not in answer.text


def test_answers_reach_the_localizer_and_what_it_asks_comes_back(api, fake, text, monkeypatch):
    question = Question("near:tree", "Is there a tree?", (Choice("yes", "Yes"), Choice("unknown", "I don't know")))
    answer = fake._answer
    monkeypatch.setattr(fake, "_answer", lambda query: replace(answer(query), question=question))
    body = api.post("/localize", json={"description": text, "answers": [TREE]}).json()
    assert fake.batches == [[Query(text, replies=(Reply("near:tree", "yes"),))]]
    choices = [{"value": "yes", "text": "Yes"}, {"value": "unknown", "text": "I don't know"}]
    assert body["question"] == {"id": "near:tree", "text": "Is there a tree?", "choices": choices, "is_open": False}


def test_an_answer_to_what_was_not_asked_is_named(api, fake, text, problem, monkeypatch):
    def refuse(_queries):
        raise ReplyError(1, "choice", "is no choice")

    monkeypatch.setattr(fake, "localize", refuse)
    answers = [TREE, {"question": "near:lamp", "choice": "maybe"}]
    response = api.post("/localize", json={"description": text, "answers": answers})
    body = problem(response, 422, "invalid_request", "answers[1].choice")
    assert body["detail"] == "answers[1].choice: is no choice"
