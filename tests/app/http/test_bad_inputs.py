"""Bad inputs to every operation: each is refused in a few words that help; nothing of it is said again, or stays."""

import gzip
import json
import re
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import quote

import bad_values as values
import pytest
from fake_localizer import FakeLocalizer
from good_requests import GOOD, IN_PATH, JSON, WITH_BODY, ask
from local_client import local_client

from app import limits
from app.jobs import runner
from app.jobs.job import EvaluationJob
from app.main import create_app
from app.settings import Settings
from models.citymap.scenery.files import SceneryPart

KEY = "read-key-1"
MOST_BYTES = 2_000_000
ECHO = re.compile(rf"{values.MARK}|9876|98\.76|passwd|<script|alert|\\u0000|[\x00-\x08]", re.I)
MACHINERY = re.compile(r"Traceback|\.py\b|pydantic|/(home|root|tmp|usr|var|work|etc|app)/|0x[0-9a-f]{6}")
ADVICE = re.compile(
    r"\b(must|should|send|gives?|use|choose|describe|say|try|accept|leave|start|lists|at most \d+)\b", re.I
)
FLEETING = ("request_id", "timings_ms", "time")
NEGOTIATED = ("POST /localize", "GET /cells", "GET /cells/{cell_id}")
CASES = {  # of what is the same for every operation with a body: all for the first, some for each of the others
    operation: slice(n % 6, None, 6 if n else 1) for n, operation in enumerate(WITH_BODY)
}
NAMED = {  # the parameter in an operation's path, and what is said of one that nothing has
    "GET /evaluate/{job}": ("job", "job_not_found"),
    "DELETE /evaluate/{job}": ("job", "job_not_found"),
    "GET /evaluate/{job}/events": ("job", "job_not_found"),
    "GET /cells/{cell_id}": ("cell_id", "cell_not_found"),
    "GET /maps/{name}": ("name", "map_not_found"),
    "GET /maps/{name}/points": ("name", "map_not_found"),
}
GOOD_AFTER = {  # where the operation's own good request is not answered alike each time
    **dict.fromkeys(("GET /evaluate/{job}", "DELETE /evaluate/{job}", "GET /evaluate/{job}/events"), "POST /evaluate"),
    "GET /metrics": "GET /info",
}


class Bad(NamedTuple):
    """A bad input to an operation, and the code of the refusal."""

    operation: str
    about: str
    code: str
    method: str
    path: str
    sent: dict[str, Any]


def bad(operation, about, code="invalid_request", in_path=None, method=None, below="", **sent):
    own, _, path = operation.partition(" ")
    path = path.format(**(IN_PATH | (in_path or {}))) + below
    return Bad(operation, about, code, method or own, path, GOOD[operation] | sent)


def body(content):
    """As it is, or as JSON, in which escapes stand for lone surrogates."""
    return {"content": content if isinstance(content, bytes) else json.dumps(content), "headers": JSON}


def bad_bodies():
    for operation, share in CASES.items():
        base = values.BASES.get(operation, GOOD[operation]["json"])
        for content in values.RAW[share]:
            yield bad(operation, "raw", "invalid_json", **body(content))
        for content in (*values.NO_OBJECT[share], *values.WHOLE.get(operation, ())):
            yield bad(operation, "body", **body(content))
        for name in values.UNKNOWN[share]:
            yield bad(operation, "unknown", **body(base | {name: values.MARK}))
        for field, wrong in values.FIELDS.get(operation, {}).items():
            for value in wrong:
                yield bad(operation, field, **body(base | {field: value}))
        yield bad(operation, "size", "body_too_large", **body(b" " * (MOST_BYTES + 1)))


def bad_headers():
    for operation, share in CASES.items():
        for header, wrong in (("Content-Type", values.CONTENT_TYPES), ("Content-Encoding", values.CODINGS)):
            for value in wrong[share]:
                yield bad(operation, header, "unsupported_media_type", headers={header: value})
    for operation in NEGOTIATED:
        for value in values.ACCEPTS:
            yield bad(operation, "Accept", "not_acceptable", headers={"Accept": value})
    for operation in WITH_BODY:
        for key in values.KEYS:
            yield bad(operation, "key", "key_wrong", headers=key)


def bad_queries():
    for operation, parameters in values.QUERIES.items():
        good = GOOD[operation].get("params", {})
        for parameter, wrong in parameters.items():
            for value in wrong:
                yield bad(operation, parameter, params={**good, "email": values.MARK, parameter: value})
        for parameter in good:
            yield bad(operation, "too few", params={name: good[name] for name in good if name != parameter})


def bad_paths():
    for operation in GOOD:
        yield bad(operation, "path", "not_found", below=f"/{values.MARK}/{values.MARK}")
        if operation != "DELETE /evaluate/{job}":  # whose path GET has
            yield bad(operation, "method", "method_not_allowed", method=values.MARK)
    for operation, (parameter, code) in NAMED.items():
        for name in values.IDS:
            code_here = "not_found" if "/" in name else code
            yield bad(operation, parameter, code_here, {parameter: quote(name, safe="")})


BAD = [*bad_bodies(), *bad_headers(), *bad_queries(), *bad_paths()]


@pytest.fixture(scope="module")
def fake(tmp_path_factory):
    part = tmp_path_factory.mktemp("parts") / "0.gz"
    part.write_bytes(gzip.compress(b"geometry", mtime=0))
    return FakeLocalizer(parts=[SceneryPart(part, "ab" * 32)])


@pytest.fixture(scope="module")
def api(fake, until, versions_dir, tmp_path_factory):
    """A client, with the key, of a service whose evaluations are not run."""

    async def submit(_jobs, _evaluation):
        return EvaluationJob(Path("nowhere"), "the-job")

    file = tmp_path_factory.mktemp("corrections") / "corrections.jsonl"
    settings = Settings(index_dir=versions_dir, read_key=KEY, corrections_file=file)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(runner.EvaluationJobs, "submit", submit)
        patch.setattr(limits, "MAX_EVALUATE_BODY_BYTES", MOST_BYTES)
        with local_client(create_app(settings, lambda: fake), headers={"X-API-Key": KEY}) as api:
            until(lambda: api.get("/readyz").status_code == 200)
            yield api


def lasting(answer):
    """Return the part that two answers to one request have in common."""
    if isinstance(answer, dict):
        return {name: lasting(value) for name, value in answer.items() if name not in FLEETING}
    return [lasting(value) for value in answer] if isinstance(answer, list) else answer


@pytest.fixture(scope="module")
def good_answer(api):
    """operation -> the answer to its good request, or to one that takes its place."""

    def answer(operation):
        response = ask(api, GOOD_AFTER.get(operation, operation))
        assert response.status_code < 300
        is_json = response.headers["content-type"] == "application/json"
        return lasting(response.json()) if is_json else response.content

    return answer


@pytest.fixture(scope="module")
def answers_before(good_answer):
    return {operation: good_answer(operation) for operation in GOOD}


def check_words(content, refusal):
    """A problem is short, helps, and has nothing of the input or of the machinery."""
    assert len(content) <= 1024
    assert ADVICE.search(refusal["detail"]), refusal["detail"]
    text = content.decode().replace(refusal["request_id"], "")  # whose digits may be anything
    assert not ECHO.search(text), text
    assert not MACHINERY.search(text), text


def test_there_are_many_and_no_two_are_alike():
    assert len({repr(one[3:]) for one in BAD}) == len(BAD) >= 300
    documented = create_app(Settings()).openapi()["paths"]
    assert {one.operation for one in BAD} == {
        f"{method.upper()} {path}" for path, operations in documented.items() for method in operations
    }


@pytest.mark.parametrize("one", BAD, ids=[f"{one.operation} {one.about} {n}" for n, one in enumerate(BAD)])
def test_it_is_refused_and_leaves_nothing_behind(api, fake, problem, good_answer, answers_before, one):
    computed = len(fake.batches)
    response = api.request(one.method, one.path, **one.sent)
    refusal = problem(response, response.status_code, one.code)
    assert 400 <= response.status_code < 500
    assert len(fake.batches) == computed
    check_words(response.content, refusal)
    assert good_answer(one.operation) == answers_before[one.operation]


def test_as_items_of_a_batch_they_fail_alone(api):
    base = values.BASES["POST /localize"]
    items = [base | {field: value} for field, wrong in values.FIELDS["POST /localize"].items() for value in wrong]
    for start in range(0, len(items), 63):
        sent = [*items[start : start + 63], {"description": "a tree"}]
        response = api.post("/localize/batch", **body({"items": sent}))
        *errors, good = response.json()["items"]
        assert good["result"]["status"] == "ok"
        for item in errors:
            assert item["result"] is None
            assert item["error"]["code"] == "invalid_request"
            check_words(json.dumps(item["error"]).encode(), item["error"])
