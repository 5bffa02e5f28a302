"""Proxies, other origins and generic clients: root paths, forwarded headers, CORS, HEAD, gzip, trailing slashes."""

import codecs
import json

import pytest
from fake_localizer import FakeLocalizer
from fastapi import Request
from fastapi.routing import iter_route_contexts
from local_client import local_client

from app.http.keys import READING_POSTS
from app.jobs import runner
from app.jobs.job import EvaluationJob
from app.main import create_app
from app.settings import load_settings
from models.errors import HereaboutsError

KEY = "correct-horse"
EVALUATION = {"queries": [{"description": "a tree", "position": [0, 0]}]}
ORIGIN = "https://town.example"
TREE = {"description": "a tree"}


@pytest.fixture
def connect(tmp_path, until, monkeypatch):
    """Settings -> a local client of a service with a page, whose evaluations are not run."""

    async def submit(_jobs, _evaluation):
        return EvaluationJob(tmp_path, "the-job")

    monkeypatch.setattr(runner.EvaluationJobs, "submit", submit)
    (tmp_path / "index.html").write_text("<!doctype html>")
    clients = []

    def connect(**settings):
        client = local_client(create_app(load_settings(**settings), FakeLocalizer, tmp_path), follow_redirects=False)
        clients.append(client.__enter__())
        until(lambda: client.get("/readyz").status_code == 200)
        return client

    yield connect
    for client in clients:
        client.__exit__(None, None, None)


@pytest.mark.parametrize("below", ["/map", ""], ids=["kept by the proxy", "removed by the proxy"])
def test_a_root_path_is_in_every_link(connect, below):
    api = connect(root_path="/map/")
    assert api.get(f"{below}/cells?limit=1").json()["next"] == "/map/cells?offset=1&limit=1&index=default"
    assert api.get("/map/cells?offset=1&limit=1&index=default").json()["next"] is None
    accepted = api.post(f"{below}/evaluate", json=EVALUATION)
    assert accepted.headers["location"] == accepted.json()["links"]["status"] == "/map/evaluate/the-job"
    assert accepted.json()["links"]["events"] == "/map/evaluate/the-job/events"
    assert '"/map/static-offline-docs/swagger-ui.css"' in api.get(f"{below}/docs").text
    assert api.get(f"{below}/static-offline-docs/swagger-ui.css").status_code == 200
    assert api.get(f"{below}/openapi.json").json()["servers"] == [{"url": "/map"}]
    assert api.get(f"{below}/").text == "<!doctype html>"


def test_the_page_at_the_root_path_gets_the_slash_that_its_links_need(connect):
    api = connect(root_path="/map")
    response = api.get("/map", headers={"Host": "evil.example"})
    assert (response.status_code, response.headers["location"]) == (307, "/map/")
    assert api.get("/map?index=a").headers["location"] == "/map/?index=a"


@pytest.mark.parametrize(("root_path", "slash"), [("", "/"), ("/map", ""), ("/info", "/"), ("/localize", "")])
def test_a_root_path_opens_and_closes_nothing(connect, root_path, slash):
    """Even one that a route has too: what is open at the root is open below the root path, and nothing else."""
    plain, below = connect(read_key=KEY), connect(read_key=KEY, root_path=root_path)
    for route in iter_route_contexts(plain.app.routes):
        path = getattr(route, "path", "/")
        for method in ("GET", "POST", "DELETE"):
            expected = plain.request(method, path).status_code
            assert below.request(method, root_path + path + ("" if path == "/" else slash)).status_code == expected


def test_only_the_reading_posts_below_the_root_path_are_so_without_a_key(connect):
    api, forwarded = connect(root_path="/localize"), {"X-Forwarded-For": "192.0.2.1"}
    for path in READING_POSTS:
        assert api.post(f"/localize{path}", json={}, headers=forwarded).status_code == 422
    for path in ("/localize/evaluate", "/evaluate", "/localize/evaluate/"):
        assert api.post(path, json=EVALUATION, headers=forwarded).status_code == 403


def probed(api, **headers):
    def probe(request: Request):
        return [str(request.base_url), request.client.host, request.scope["root_path"]]

    api.app.add_api_route("/probe", probe)
    return api.get("/probe", headers={name.replace("_", "-"): value for name, value in headers.items()}).json()


FORWARDED = {
    "X_Forwarded_For": "203.0.113.9, 192.0.2.1",
    "X_Forwarded_Proto": "https",
    "X_Forwarded_Host": "town.example",
    "X_Forwarded_Prefix": "/map/",
}


def test_forwarded_headers_count_from_named_proxies_alone(connect):
    as_sent = ["http://127.0.0.1:8000/", "127.0.0.1", ""]
    assert probed(connect(), **FORWARDED) == as_sent
    assert probed(connect(proxies="10.0.0.0/8,::1"), **FORWARDED) == as_sent
    trusting = connect(proxies="127.0.0.0/8, 192.0.2.1")
    assert probed(trusting) == as_sent
    assert probed(trusting, **FORWARDED) == ["https://town.example/map/", "203.0.113.9", "/map"]


@pytest.mark.parametrize("prefix", ["//evil.example", "/a b", "map", "/..", "https://evil.example", "/map?x", "ä"])
def test_a_forwarded_prefix_that_is_no_path_is_ignored(connect, prefix):
    api = connect(proxies="127.0.0.1", root_path="/town")
    assert probed(api, X_Forwarded_Prefix=prefix.encode("latin-1"))[2] == "/town"


def test_a_trusted_proxy_makes_no_request_direct(connect, problem):
    api = connect(proxies="127.0.0.1")
    for headers in ({"X-Forwarded-For": "127.0.0.1"}, {"X-Forwarded-Host": "localhost"}, {"X-Forwarded-Prefix": "/m"}):
        problem(api.post("/evaluate", json=EVALUATION, headers=headers), 403, "key_not_set")
    assert api.post("/evaluate", json=EVALUATION).status_code == 202


@pytest.mark.parametrize(
    ("given", "advice"),
    [
        ({"root_path": "//evil.example"}, "/hereabouts"),
        ({"root_path": "map"}, "/hereabouts"),
        ({"proxies": "nginx"}, "10.0.0.0/8"),
        ({"proxies": "10.0.0.1/8"}, "10.0.0.0/8"),
        ({"cors_origins": "town.example"}, "https://town.example"),
        ({"cors_origins": "https://town.example/"}, "without a path"),
    ],
)
def test_a_setting_that_cannot_be_used_says_what_to_send(given, advice):
    with pytest.raises(HereaboutsError, match=advice):
        load_settings(**given)


def preflight(api, origin=ORIGIN, method="POST"):
    requested = {
        "Access-Control-Request-Method": method,
        "Access-Control-Request-Headers": "authorization,content-type",
    }
    return api.options("/localize", headers={"Origin": origin, **requested})


def test_pages_of_named_origins_may_ask_and_read(connect, monkeypatch):
    monkeypatch.setenv("HEREABOUTS_CORS_ORIGINS", f"http://localhost:3000, {ORIGIN}")
    api = connect(read_key=KEY)
    assert preflight(api).status_code == 200, "a browser sends a preflight without the key"
    assert preflight(api).headers["access-control-allow-origin"] == ORIGIN
    assert preflight(api, "https://other.example").status_code == 400
    for headers in ({"X-API-Key": KEY}, {}):  # an error can be read too
        response = api.post("/localize", json=TREE, headers={"Origin": ORIGIN, **headers})
        assert response.headers["access-control-allow-origin"] == ORIGIN
        exposed = set(response.headers["access-control-expose-headers"].split(", "))
        assert exposed >= {"X-Request-ID", "Retry-After", "Content-Language", "ETag"}
    other = api.get("/info", headers={"Origin": "https://other.example"})
    assert "access-control-allow-origin" not in other.headers


def test_without_the_setting_no_origin_may(api):
    assert preflight(api).status_code == 405
    assert "access-control-allow-origin" not in api.get("/info", headers={"Origin": ORIGIN}).headers


@pytest.mark.parametrize("origin", [ORIGIN, "null", "https://localhost.example", ""])
def test_a_page_of_another_origin_changes_nothing_without_a_key(connect, problem, origin):
    api = connect(cors_origins="*")
    problem(api.post("/evaluate", json=EVALUATION, headers={"Origin": origin}), 403, "key_not_set")
    assert api.post("/evaluate", json=EVALUATION, headers={"Origin": "http://localhost:8000"}).status_code == 202
    assert api.post("/localize", json=TREE, headers={"Origin": origin}).status_code == 200


@pytest.mark.parametrize(
    "path", ["/", "/cells", "/info", "/docs", "/openapi.json", "/search?q=a+tree", "/nothing", "/localize", "/cells/"]
)
def test_head_has_the_headers_of_get_and_no_body(connect, path):
    api = connect()
    head, get = api.head(path), api.get(path)
    assert (head.status_code, head.content) == (get.status_code, b"")
    for response in (head, get):
        response.headers.pop("x-request-id")
    if path != "/search?q=a+tree":  # with the time it took
        assert head.headers == get.headers


def test_head_of_an_event_stream_ends(connect, tmp_path, monkeypatch):
    job = EvaluationJob(tmp_path, "the-job")
    monkeypatch.setattr(runner.EvaluationJobs, "get", lambda _jobs, _name: job)
    response = connect().head("/evaluate/the-job/events")
    assert (response.status_code, response.content) == (200, b"")
    assert response.headers["content-type"].startswith("text/event-stream")


def test_answers_are_compressed_once_for_who_takes_it(connect):
    api = connect()
    for path in ("/openapi.json", "/cells"):
        zipped, plain = (api.get(path, headers={"Accept-Encoding": coding}) for coding in ("gzip", "gzip;q=0"))
        assert (zipped.headers["content-encoding"], zipped.json()) == ("gzip", plain.json())
        assert int(zipped.headers["content-length"]) < int(plain.headers["content-length"])
        assert "Accept-Encoding" in zipped.headers["vary"]
        assert "content-encoding" not in plain.headers
    assert api.get("/cells").headers["etag"].startswith("W/"), "other bytes have the same tag"


def test_a_trailing_slash_is_the_same_route(connect, problem):
    api = connect(read_key=KEY)
    assert api.get("/info/").json()["service"] == "hereabouts"
    problem(api.post("/localize/", json=TREE), 401, "key_required")
    headers = {"X-API-Key": KEY}
    assert api.post("/localize/", json=TREE, headers=headers).json()["status"] == "ok"
    assert api.get("/cells/", headers=headers).json()["total"] == 2
    problem(api.get("/cells//", headers=headers), 404, "not_found")


def test_a_byte_order_mark_before_json_is_read(api):
    content = codecs.BOM_UTF8 + json.dumps(TREE).encode()
    response = api.post("/localize", content=content, headers={"Content-Type": "application/json"})
    assert response.status_code == 200
