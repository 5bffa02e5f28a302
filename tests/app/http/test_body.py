"""Bodies that are no plain JSON, and the traps that FastAPI leaves open by default."""

import asyncio
import json

import pytest
from starlette.datastructures import Headers

from app.http.errors import Problem
from app.http.middleware import check_headers, check_json, read_body

JSON = {"Content-Type": "application/json"}


def post(api, content, headers=JSON):
    return api.post("/localize", content=content, headers=headers)


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"{",
        b"description=a+tree",
        b'{"description": "a tree"} {}',
        b'{"description": "a tree",}',
        b'{"description": "a\x00tree"}',
        b'{"description": "\xff\xfe"}',
        '{"description": "a tree"}'.encode("utf-16"),
        b'\xef\xbb\xbf{"description": "a tree"}',
        b'{"prior": NaN}',
        b'{"prior": -Infinity}',
        b'{"description": "a tree", "description": "a pole"}',
        b'{"description": "a tree", "within": {"bbox": 1, "bbox": 2}}',
        b'{"top_k": ' + b"9" * 5000 + b"}",
        b'{"x": ' + b"[" * 40 + b"]" * 40 + b"}",
        b"[" * 100_000,
        b'{"a":' * 20_000 + b"1" + b"}" * 20_000,
    ],
)
def test_not_plain_json_is_400(api, fake, problem, content):
    problem(post(api, content), 400, "invalid_json")
    assert fake.batches == []


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b'{"description": "\xff\xfe"}', "not UTF-8"),
        (b'{"a":' * 20_000 + b"1" + b"}" * 20_000, "nested more than 32"),
        (b'{"prior": NaN}', "NaN"),
        (b'{"a": 1, "a": 2}', "twice"),
        (b'{"top_k": ' + b"9" * 5000 + b"}", "too many digits"),
        (b'{"a":\n x}', "line 2 column 2"),
    ],
)
def test_detail_says_what_is_wrong(api, problem, content, said):
    assert said in problem(post(api, content), 400, "invalid_json")["detail"]


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


def test_input_is_never_echoed(api, problem):
    secret = "x1secret2x"
    for body in (
        {"description": secret + "\u0000"},
        {"description": secret * 600},
        {"hints": [secret, 5]},
        {"description": "a tree", "crs": secret},
        {"description": "a tree", "top_k": secret},
        {"description": "a tree", secret + " <script>": 1},
        {"description": "a tree", secret * 100: 1},
        {"description": "a tree", "within": {secret + "\n": 1}},
    ):
        response = api.post("/localize", json=body)
        problem(response, 422, "invalid_request")
        assert secret not in response.text


def test_short_unknown_field_is_named(api, problem):
    problem(api.post("/localize", json={"description": "a tree", "topk": 1}), 422, "invalid_request", "topk")


def test_many_errors_are_a_short_answer(api, problem):
    body = problem(api.post("/localize", json={f"x{n}": 1 for n in range(5000)}), 422, "invalid_request")
    assert len(body["errors"]) == 20
    assert "4999 more" in body["detail"]


def test_five_megabytes_are_a_short_413(api, problem):
    content = json.dumps({"description": "a" * 5_000_000}).encode()
    problem(post(api, content), 413, "body_too_large")
    response = post(api, iter([content]))
    problem(response, 413, "body_too_large")
    assert response.headers["connection"] == "close"


def test_limit_is_the_last_byte_that_passes(settings, fake, start, problem):
    body = b'{"description": "a tree"}'
    with start(settings.model_copy(update={"max_bytes": len(body)}), fake) as api:
        assert post(api, body).status_code == 200
        problem(post(api, body + b" "), 413, "body_too_large")
        problem(post(api, iter([body, b" "])), 413, "body_too_large")


def test_excess_is_not_read():
    reads = 0

    async def receive():
        nonlocal reads
        reads += 1
        return {"type": "http.request", "body": b"x" * 10, "more_body": True}

    with pytest.raises(Problem, match="more than 25 bytes"):
        asyncio.run(read_body(receive, 25))
    assert reads == 3


def test_length_that_is_too_great_is_refused_unread():
    with pytest.raises(Problem, match="more than 25 bytes"):
        check_headers(Headers({"content-type": "application/json", "content-length": "26"}), 25)
    with pytest.raises(Problem, match="more than 25 bytes"):
        check_headers(Headers({"content-type": "application/json", "content-length": "9" * 5000}), 25)


def test_client_that_leaves_in_the_body_is_no_body():
    async def receive():
        return {"type": "http.disconnect"}

    assert asyncio.run(read_body(receive, 25)) is None


@pytest.mark.parametrize(
    "content_type",
    [
        "",
        "text/plain",
        "application/x-www-form-urlencoded",
        "multipart/form-data; boundary=x",
        "application/jsonx",
        "application/geo+json",
        "application/json; charset=latin-1",
        "application/json; charset=utf-16",
    ],
)
def test_other_content_type_is_415(api, fake, problem, content_type):
    problem(post(api, b'{"description": "a tree"}', {"Content-Type": content_type}), 415, "unsupported_media_type")
    assert fake.batches == []


def test_compressed_body_is_415(api, problem):
    problem(post(api, b"x", {**JSON, "Content-Encoding": "gzip"}), 415, "unsupported_media_type")


@pytest.mark.parametrize("content_type", ["application/json", "Application/JSON; charset=UTF-8"])
def test_json_content_type_passes(api, content_type):
    assert post(api, b'{"description": "a tree"}', {"Content-Type": content_type}).status_code == 200


def test_unknown_path_is_404_whatever_the_body(api, problem):
    problem(api.post("/nothing", content=b"x"), 404, "not_found")
    problem(api.post("/localize/", content=b"x"), 404, "not_found")
    problem(api.get("/../etc/passwd"), 404, "not_found")


def test_wrong_method_is_405_with_allow(api, problem):
    response = api.get("/localize")
    problem(response, 405, "method_not_allowed")
    assert response.headers["allow"] == "POST"
    problem(api.post("/cells/x", content=b"x"), 405, "method_not_allowed")
