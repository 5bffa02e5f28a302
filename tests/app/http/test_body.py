"""Bodies that are no plain JSON, and the traps that FastAPI leaves open by default."""

import asyncio
import json

import pytest
from starlette.datastructures import Headers

from app import limits
from app.http import bodies
from app.http.bodies import LARGE_BODY_BYTES, MAX_JSON_VALUES, LargeBodies, check_headers, check_json, read_body
from app.http.errors import Problem

JSON = {"Content-Type": "application/json"}


def post(api, content, headers=JSON):
    return api.post("/localize", content=content, headers=headers)


@pytest.mark.parametrize(
    ("content", "phrase"),
    [
        (b'{"description": "\xff\xfe"}', "not UTF-8"),
        (b'{"a":' * 20_000 + b"1" + b"}" * 20_000, "more than 32 nested levels"),
        (b'{"prior": NaN}', "NaN"),
        (b'{"a": 1, "a": 2}', "twice"),
        (b'{"top_k": ' + b"9" * 5000 + b"}", "too many digits"),
        (b'{"a":\n x}', "line 2 column 2"),
    ],
)
def test_detail_says_what_is_wrong(api, problem, content, phrase):
    assert phrase in problem(post(api, content), 400, "invalid_json")["detail"]


def test_nesting_up_to_the_limit_passes():
    check_json(b"[" * 32 + b"]" * 32)
    with pytest.raises(Problem, match="nested"):
        check_json(b"[" * 33 + b"]" * 33)


def test_infinity_by_exponent_is_422(api, problem):
    content = b'{"description": "a tree", "prior": {"position": [0, 1e999], "sigma_m": 5}}'
    problem(post(api, content), 422, "invalid_request", "prior.position[1]")


def test_lone_surrogate_is_422(api, problem):
    problem(post(api, rb'{"description": "a \ud800 tree"}'), 422, "invalid_request", "description")
    problem(post(api, rb'{"hints": ["a \udfff tree"]}'), 422, "invalid_request", "hints[0]")
    problem(post(api, rb'{"description": "a tree", "\ud800": 1}'), 422, "invalid_request")


def test_surrogate_pair_is_a_character(api):
    assert post(api, rb'{"description": "a tree \ud83c\udf33"}').status_code == 200


def test_short_unknown_field_is_named(api, problem):
    problem(api.post("/localize", json={"description": "a tree", "topk": 1}), 422, "invalid_request", "topk")


def test_a_parameter_that_is_read_in_two_places_is_wrong_once(api, problem):
    body = problem(api.get("/cells?index=../x"), 422, "invalid_request", "index")
    assert len(body["errors"]) == 1
    assert "more" not in body["detail"]


def test_many_errors_are_a_short_answer(api, problem):
    body = problem(api.post("/localize", json={f"x{n}": 1 for n in range(5000)}), 422, "invalid_request")
    assert 5 < len(body["errors"]) <= 20
    assert "4999 more" in body["detail"]


def test_five_megabytes_are_a_short_413(api, problem):
    content = json.dumps({"description": "a" * 5_000_000}).encode()
    problem(post(api, content), 413, "body_too_large")
    problem(post(api, iter([content])), 413, "body_too_large")


def test_limit_is_the_last_byte_that_passes(settings, fake, start, problem, monkeypatch):
    body = b'{"description": "a tree"}'
    monkeypatch.setattr(limits, "MAX_BODY_BYTES", len(body))
    with start(settings, fake) as api:
        assert post(api, body).status_code == 200
        problem(post(api, body + b" "), 413, "body_too_large")
        problem(post(api, iter([body, b" "])), 413, "body_too_large")


def test_a_body_is_read_no_further_than_the_limit():
    reads = 0

    async def receive():
        nonlocal reads
        reads += 1
        return {"type": "http.request", "body": b"x" * 10, "more_body": True}

    with pytest.raises(Problem, match="more than 25 bytes"):
        asyncio.run(read_body(receive, 25, lambda _size: None))
    assert reads == 3


def test_length_that_is_too_great_is_refused_unread():
    with pytest.raises(Problem, match="more than 25 bytes"):
        check_headers(Headers({"content-type": "application/json", "content-length": "26"}), 25)
    with pytest.raises(Problem, match="more than 25 bytes"):
        check_headers(Headers({"content-type": "application/json", "content-length": "9" * 5000}), 25)


def test_client_that_leaves_in_the_body_is_no_body():
    async def receive():
        return {"type": "http.disconnect"}

    assert asyncio.run(read_body(receive, 25, lambda _size: None)) is None


@pytest.mark.parametrize("parameters", ["", "; charset=UTF-8", ';charset="utf-8"', "; v=1", ";"])
def test_json_content_type_passes(api, parameters):
    content_type = "Application/JSON" + parameters
    assert post(api, b'{"description": "a tree"}', {"Content-Type": content_type}).status_code == 200


def test_unknown_path_is_404_whatever_the_body(api, problem):
    problem(api.post("/nothing", content=b"x"), 404, "not_found")
    problem(api.get("/../etc/passwd"), 404, "not_found")


def test_wrong_method_is_405_with_allow(api, problem):
    response = api.get("/localize")
    problem(response, 405, "method_not_allowed")
    assert response.headers["allow"] == "POST"
    assert api.options("/evaluate/x").headers["allow"] == "DELETE, GET, HEAD"
    problem(api.post("/cells/x", content=b"x"), 405, "method_not_allowed")


@pytest.mark.parametrize("piece", [b"[],", b"{},", b"1,"])
def test_a_body_of_many_values_is_refused_before_it_is_parsed(api, problem, monkeypatch, piece):
    content = b"[" + piece * MAX_JSON_VALUES + b"1]"
    problem(api.post("/evaluate", content=content, headers=JSON), 413, "body_too_large")
    monkeypatch.setattr(bodies, "json", None)
    with pytest.raises(Problem, match="values"):
        check_json(content)


def test_a_large_body_with_few_values_is_taken(api, problem):
    content = json.dumps({"queries": "a" * 10_000_000}).encode()
    problem(api.post("/evaluate", content=content, headers=JSON), 422, "invalid_request", "queries")


def test_large_bodies_have_a_bound_together():
    large = LargeBodies(3 * LARGE_BODY_BYTES)
    with large.reservation() as one, large.reservation() as two, large.reservation() as three:
        one(LARGE_BODY_BYTES)
        one(2 * LARGE_BODY_BYTES)
        two(LARGE_BODY_BYTES - 1)
        two(LARGE_BODY_BYTES)
        three(LARGE_BODY_BYTES - 1)
        with pytest.raises(Problem, match="Retry-After"):
            three(LARGE_BODY_BYTES)
    assert large.bytes == 0
    with large.reservation() as again:
        again(3 * LARGE_BODY_BYTES)


def test_a_body_that_does_not_come_is_given_up(settings, fake, start, monkeypatch):
    monkeypatch.setattr(bodies, "BODY_TIMEOUT_S", 0.05)
    sent = []

    async def ask(app):
        async def receive():
            await asyncio.sleep(0 if not sent else 10)
            return {"type": "http.request", "body": b"{", "more_body": True}

        async def send(message):
            sent.append(message)

        headers = [(b"content-type", b"application/json")]
        scope = {"type": "http", "method": "POST", "path": "/localize", "headers": headers, "query_string": b""}
        sent.append(None)  # the body begins to be late at once
        await app(scope | {"app": app, "raw_path": b"/localize", "root_path": "", "scheme": "http"}, receive, send)

    with start(settings, fake) as api:
        asyncio.run(ask(api.app))
    assert sent[1]["status"] == 408
    assert (b"connection", b"close") in sent[1]["headers"]
    assert json.loads(sent[2]["body"])["code"] == "body_too_slow"
