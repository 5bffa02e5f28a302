"""The read key: what is open without it, what counts as sending it, and what is said of it."""

import asyncio
from pathlib import Path

import httpx
import pytest
from fake_localizer import FakeLocalizer
from fastapi import APIRouter
from fastapi.routing import iter_route_contexts
from fastapi.testclient import TestClient
from local_client import local_client
from structlog.testing import capture_logs

from app.http.keys import OPEN, KeyCheck, open_routes
from app.jobs import runner
from app.jobs.job import EvaluationJob
from app.main import create_app
from app.settings import Settings

KEY = "correct-horse"
BEARER = {"Authorization": f"Bearer {KEY}"}
OPEN_PATHS = {"/", "/page.js", "/docs", "/docs/oauth2-redirect", "/openapi.json"}
OPEN_PATHS |= {"/healthz", "/readyz", "/info", "/metrics"}


@pytest.fixture
def page_dir(tmp_path):
    (tmp_path / "index.html").write_text("<!doctype html>")
    (tmp_path / "page.js").write_text("")
    return tmp_path


@pytest.fixture
def closed(fake, page_dir, until):
    """A client of a service with a key."""
    with TestClient(create_app(Settings(read_key=KEY), lambda: fake, page_dir)) as api:
        until(lambda: api.get("/readyz").status_code == 200)
        yield api


def refused(response, problem, code):
    body = problem(response, 401, code)
    challenge = 'Bearer realm="hereabouts"' + (', error="invalid_token"' if code == "key_wrong" else "")
    assert response.headers["www-authenticate"] == challenge
    assert "key" in body["detail"]
    return body


def test_every_route_is_closed_but_these(closed, problem):
    requested = set()
    for route in iter_route_contexts(closed.app.routes):
        for method in getattr(route, "methods", None) or {"GET"}:
            response = closed.request(method, route.path)
            requested.add(route.path)
            if route.path in OPEN_PATHS:
                assert response.status_code == 200, route.path
            else:
                refused(response, problem, "key_required")
    assert requested > OPEN_PATHS | {"/localize", "/evaluate", "/evaluate/{job}/events", "/cells/{cell_id}"}


def test_what_is_open_is_so_for_get_and_head_alone(closed, problem):
    problem(closed.post("/info"), 401, "key_required")
    assert closed.head("/info").status_code == 200
    assert closed.head("/localize").status_code == 401


def test_assets_of_docs_are_open_and_nothing_beside_them(closed, problem):
    assert closed.get("/static-offline-docs/swagger-ui.css").status_code == 200
    assert closed.get("/static-offline-docs/none").status_code == 404
    assert closed.get("/static-offline-docs/..%2flocalize").status_code == 404
    refused(closed.get("/static-offline-docs-2"), problem, "key_required")
    refused(closed.post("/static-offline-docs/x"), problem, "key_required")


def test_a_new_route_is_closed_and_one_that_says_it_is_open_is_so_for_its_method_alone(problem):
    router = APIRouter()
    router.add_api_route("/said", lambda: 1, openapi_extra={**OPEN, "x-more": 1})
    router.add_api_route("/said", lambda: 2, methods=["POST"])
    router.add_api_route("/unsaid", lambda: 3)
    assert open_routes([router]) == {("GET", "/said")}
    app = create_app(Settings(read_key=KEY), FakeLocalizer)
    app.include_router(router)
    api = TestClient(app)
    for method, path in (("GET", "/said"), ("POST", "/said"), ("GET", "/unsaid"), ("GET", "/nothing")):
        refused(api.request(method, path), problem, "key_required")  # the service was made before it was said
    assert api.get("/unsaid", headers=BEARER).json() == 3
    problem(api.get("/nothing", headers=BEARER), 404, "not_found")


@pytest.mark.parametrize(
    "headers",
    [
        BEARER,
        {"Authorization": f"bearer   {KEY} "},
        {"X-API-Key": KEY},
        {**BEARER, "X-API-Key": KEY},
        {"Authorization": "Basic dXNlcjpwYXNz", "X-API-Key": KEY},
        [("X-API-Key", KEY), ("X-API-Key", KEY)],
    ],
)
def test_key_lets_in(closed, fake, headers):
    assert closed.post("/localize", json={"description": "a tree"}, headers=headers).status_code == 200
    assert len(fake.batches) == 1


@pytest.mark.parametrize(
    "headers",
    [
        {},
        {"Authorization": ""},
        {"Authorization": "Bearer"},
        {"Authorization": "Bearer  "},
        {"Authorization": KEY},
        {"Authorization": f"Bearer\t{KEY}"},
        {"Authorization": "Basic Y29ycmVjdC1ob3JzZTo="},
        {"Authorization": b"\xff\xfe"},
        {"X-API-Key": ""},
        {"X-API-Key": "  "},
        {"Cookie": f"key={KEY}"},
    ],
)
def test_without_a_key_it_is_asked_for(closed, fake, problem, headers):
    refused(closed.post("/localize", json={"description": "a tree"}, headers=headers), problem, "key_required")
    assert fake.batches == []


@pytest.mark.parametrize(
    "headers",
    [
        {"X-API-Key": KEY[:-1]},
        {"X-API-Key": KEY + "x"},
        {"X-API-Key": KEY.upper()},
        {"X-API-Key": f"{KEY}, {KEY}"},
        {"X-API-Key": f"Bearer {KEY}"},
        {"X-API-Key": "schlüssel".encode()},
        {"Authorization": b"Bearer \xff\x00"},
        {"Authorization": f"Bearer {KEY} {KEY}"},
        {**BEARER, "X-API-Key": "another"},
        {"Authorization": "Bearer another", "X-API-Key": KEY},
        [("X-API-Key", KEY), ("X-API-Key", "another")],
        [("Authorization", "Bearer another"), ("Authorization", f"Bearer {KEY}")],
    ],
)
def test_a_wrong_key_is_told_so(closed, fake, problem, headers):
    body = refused(closed.post("/localize", json={"description": "a tree"}, headers=headers), problem, "key_wrong")
    assert "another" not in str(body)
    assert fake.batches == []


def test_key_in_the_path_is_none(closed, problem):
    refused(closed.get("/cells/fakeville_00001", params={"key": KEY, "access_token": KEY}), problem, "key_required")


def test_refused_before_the_body_is_read(problem):
    async def never(*_):
        raise AssertionError("it went on")

    async def ask(scope):
        sent = []

        async def send(message):
            sent.append(message)

        await KeyCheck(never, Settings(read_key=KEY).read_key, open_routes=())(scope, never, send)
        return sent

    headers = [(b"content-length", b"99")]
    start, _ = asyncio.run(ask({"type": "http", "method": "POST", "path": "/localize", "headers": headers}))
    assert start["status"] == 401
    start, _ = asyncio.run(ask({"type": "websocket", "path": "/info", "headers": []}))
    assert (start["type"], start["status"]) == ("websocket.http.response.start", 401)


EVALUATION = {"queries": [{"description": "a tree", "position": [0, 0]}]}
CHANGES = (("POST", "/evaluate", EVALUATION), ("DELETE", "/evaluate/x", None))


@pytest.fixture
def evaluates_nothing(monkeypatch):
    async def submit(_jobs, _evaluation):
        return EvaluationJob(Path("nowhere"))

    monkeypatch.setattr(runner.EvaluationJobs, "submit", submit)


def statuses_of_changes(api, headers):
    return [api.request(method, path, json=body, headers=headers).status_code for method, path, body in CHANGES]


@pytest.mark.parametrize(
    "headers",
    [
        {"Forwarded": "for=127.0.0.1"},
        {"X-Forwarded-For": "127.0.0.1"},
        {"X-Forwarded-Host": "localhost"},
        {"X-Forwarded-Proto": "https"},
        {"X-Real-IP": "127.0.0.1"},
        {"Via": "1.1 proxy"},
        {"CF-Connecting-IP": "127.0.0.1"},
        *(
            {"Host": host}
            for host in ("town.example", "town.example:8000", "192.0.2.1", "localhost.example", "[::2]", "")
        ),
        *(
            {"Host": host}
            for host in ("127.0.0.1.example", "127.0.0.1@town.example", "[127.0.0.1", "::1]", "local host")
        ),
    ],
    ids=str,
)
@pytest.mark.usefixtures("evaluates_nothing")
def test_without_a_key_a_forwarded_request_changes_nothing(api, fake, problem, headers):
    for method, path, body in CHANGES:
        refusal = problem(api.request(method, path, json=body, headers=headers), 403, "key_not_set")
        assert "HEREABOUTS_READ_KEY" in refusal["detail"]
    assert api.post("/localize", json={"description": "a tree"}, headers=headers).status_code == 200
    assert api.get("/evaluate/x", headers=headers).status_code == 404


@pytest.mark.parametrize(
    "host", ["127.0.0.1", "127.0.0.1:8000", "localhost", "LocalHost.:80", "[::1]:8000", "127.9.9.9"]
)
@pytest.mark.usefixtures("evaluates_nothing")
def test_without_a_key_a_program_on_this_machine_may_evaluate(api, host):
    assert statuses_of_changes(api, {"Host": host}) == [202, 404]


@pytest.mark.parametrize(
    ("address", "statuses"),
    [
        (("192.0.2.1", 50_000), [403, 403]),
        (("::ffff:192.0.2.1", 50_000), [403, 403]),
        (None, [403, 403]),
        (("::1", 50_000), [202, 404]),
        (("::ffff:127.0.0.1", 50_000), [202, 404]),
    ],
)
@pytest.mark.usefixtures("evaluates_nothing")
def test_without_a_key_another_machine_changes_nothing_whatever_host_it_names(api, address, statuses):
    other = TestClient(api.app, base_url="http://localhost", client=address)
    assert statuses_of_changes(other, {}) == statuses


@pytest.mark.usefixtures("evaluates_nothing")
def test_with_the_key_a_forwarded_request_may_evaluate_and_without_it_nobody(closed, problem):
    forwarded = {"X-Forwarded-For": "192.0.2.1", "Host": "town.example"}
    assert statuses_of_changes(closed, BEARER | forwarded) == [202, 404]
    assert statuses_of_changes(closed, forwarded) == [401, 401]
    assert statuses_of_changes(local_client(closed.app), {}) == [401, 401]


def test_a_new_route_counts_as_one_that_changes_something_unless_its_method_says_otherwise(problem):
    app = create_app(Settings(), FakeLocalizer)
    for method in ("POST", "PUT", "PATCH", "DELETE"):
        app.add_api_route("/new", lambda: 1, methods=[method])
    app.add_api_route("/new", lambda: 2)
    local, other = local_client(app), TestClient(app)
    for method in ("POST", "PUT", "PATCH", "DELETE"):
        assert local.request(method, "/new").json() == 1
        response = other.request(method, "/new")
        problem(response, 403, "key_not_set")
        assert "www-authenticate" not in response.headers, "no key would do"
    assert other.get("/new").json() == 2


def test_behind_a_proxy_on_this_machine_the_served_application_is_closed_too(in_a_thread, problem):
    """As nginx sends it: from 127.0.0.1, with the Host of the public site."""
    with in_a_thread(create_app(Settings(), FakeLocalizer)) as port:
        url = f"http://127.0.0.1:{port}/evaluate"
        for headers in ({"Host": "town.example"}, {"X-Forwarded-For": "127.0.0.1"}):
            problem(httpx.post(url, json=EVALUATION, headers=headers), 403, "key_not_set")
        problem(httpx.delete(f"{url}/x"), 404, "job_not_found")


def test_events_of_an_evaluation_need_it_too(closed, problem):
    refused(closed.get("/evaluate/x/events"), problem, "key_required")
    problem(closed.get("/evaluate/x/events", headers=BEARER), 404, "job_not_found")


def test_no_log_has_a_key(closed):
    with capture_logs() as lines:
        for key in (KEY, "wrong-key-123"):
            closed.post("/localize", json={"description": "a bad tree"}, headers={"X-API-Key": key})
            closed.get("/info", headers={"Authorization": f"Bearer {key}"})
    assert [line["status"] for line in lines if line["event"] == "request"] == [500, 200, 401, 200]
    assert KEY not in str(lines)
    assert "wrong-key" not in str(lines)


def test_info_says_whether_it_is_needed(closed, api):
    assert closed.get("/info").json()["key_required"] is True
    assert api.get("/info").json()["key_required"] is False


def test_openapi_has_a_button_for_the_key(closed, api):
    document = closed.get("/openapi.json").json()
    assert document["components"]["securitySchemes"] == {
        "bearer": {"type": "http", "scheme": "bearer"},
        "api_key": {"type": "apiKey", "in": "header", "name": "X-API-Key"},
    }
    assert document["security"] == [{"bearer": []}, {"api_key": []}]
    for name, path in document["paths"].items():
        for operation in path.values():
            is_open = name in OPEN_PATHS
            assert operation.get("security") == ([] if is_open else None)
            assert ("401" in operation["responses"]) != is_open
    content = document["paths"]["/localize"]["post"]["responses"]["401"]["content"]
    assert set(content["application/problem+json"]["examples"]) == {"key_required", "key_wrong"}
    assert "securitySchemes" not in api.get("/openapi.json").json()["components"]
