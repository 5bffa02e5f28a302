import threading

import pytest
from fastapi.testclient import TestClient

from app.main import create_app
from models.errors import IndexMismatch


def test_alive_at_once_and_ready_when_loaded(settings, fake, until, problem):
    loaded = threading.Event()

    def open_slowly():
        assert threading.current_thread().name == "inference"
        loaded.wait(5)
        return fake

    with TestClient(create_app(settings, open_slowly)) as api:
        assert api.get("/healthz").json() == {"status": "ok"}
        response = api.get("/readyz")
        problem(response, 503, "not_ready")
        assert response.headers["retry-after"] == "2"
        problem(api.post("/localize", json={"description": "a tree"}), 503, "not_ready")
        problem(api.get("/cells/x"), 503, "not_ready")
        assert api.get("/info").json()["index"] is None
        loaded.set()
        until(lambda: api.get("/readyz").status_code == 200)
        assert api.get("/readyz").json() == {"status": "ready"}


@pytest.mark.parametrize(
    ("error", "message"),
    [
        (IndexMismatch("/secret/index built by a, model is b; rebuild it"), "the reason is in the service's log"),
        (KeyError("secret"), "it is in the service's log"),
    ],
)
def test_load_that_failed_is_said_by_readyz(settings, until, problem, error, message):
    def fail():
        raise error

    with TestClient(create_app(settings, fail)) as api:
        until(lambda: api.get("/readyz").json()["code"] != "not_ready")
        body = problem(api.get("/readyz"), 503, "load_failed")
        assert message in body["detail"]
        assert "secret" not in api.get("/readyz").text + api.post("/localize", json={"description": "a tree"}).text
        problem(api.post("/localize", json={"description": "a tree"}), 503, "load_failed")
        assert api.get("/healthz").status_code == 200


def test_draining_refuses_and_says_so(settings, fake, start, problem):
    with start(settings, fake) as api:
        api.app.state.indexes.drain()
        response = api.get("/readyz")
        problem(response, 503, "draining")
        assert response.headers["retry-after"] == "5"
        problem(api.post("/localize", json={"description": "a tree"}), 503, "draining")
        assert api.get("/healthz").status_code == 200


def test_service_can_be_started_again(settings, fake, until):
    app = create_app(settings, lambda: fake)
    before = threading.enumerate()
    for _ in range(2):
        with TestClient(app) as api:
            until(lambda api=api: api.get("/readyz").status_code == 200)
            assert api.post("/localize", json={"description": "a tree"}).status_code == 200
        assert "inference" not in [thread.name for thread in threading.enumerate() if thread not in before]


def test_info_shows_limits_and_index(api):
    body = api.get("/info").json()
    assert body["service"] == "hereabouts"
    assert body["version"]
    assert body["limits"] == {
        "max_bytes": 262_144,
        "max_characters": 4000,
        "max_hints": 32,
        "max_items": 64,
        "max_rows": 1000,
        "max_top_k": 40,
        "max_vertices": 2000,
        "max_queue": 256,
        "max_wait_ms": 1500,
        "max_evaluate_bytes": 16_777_216,
        "max_queries": 10_000,
        "max_jobs": 8,
        "deadline_ms": 10_000,
        "max_deadline_ms": 60_000,
    }
    assert body["data_sets"] == []
    assert body["corrections"] is False
    assert body["indexes"] == ["default"]
    assert body["index"]["num_cells"] == 2
    assert body["index"]["dim"] == 8
    assert body["index"]["crs"]["origin"] == {"lat": 60.17, "lon": 24.94}
    assert body["index"]["provenance"]["model_sha256"] == "ab" * 32
