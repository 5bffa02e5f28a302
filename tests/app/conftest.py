import sys
import time
from contextlib import contextmanager
from pathlib import Path

import pytest
import structlog
from fastapi.testclient import TestClient

sys.path.append(str(Path(__file__).parent))  # importlib mode does not; see also serve_fake.py

from fake_localizer import FakeLocalizer

from app.main import create_app
from app.settings import Settings

TEXT = "I am north of a gray building. A black pole is to my west."


def wait_until(condition, timeout_s=5):
    end = time.monotonic() + timeout_s
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.005)


@contextmanager
def started(settings, localizer):
    with TestClient(create_app(settings, lambda: localizer)) as api:
        wait_until(lambda: api.get("/readyz").status_code == 200)
        yield api
        localizer.gate.set()


@pytest.fixture(scope="session", autouse=True)
def _plain_logs():
    structlog.configure(processors=[structlog.processors.JSONRenderer()])  # the default draws every local variable
    yield
    structlog.reset_defaults()


@pytest.fixture
def settings():
    return Settings()


@pytest.fixture
def fake():
    return FakeLocalizer()


@pytest.fixture
def api(settings, fake):
    """A client of a service that is ready and answers with `fake`."""
    with started(settings, fake) as api:
        yield api


@pytest.fixture
def start():
    """A context manager: (settings, localizer) -> client of a service that is ready."""
    return started


@pytest.fixture(scope="session")
def until():
    """Waits until a condition holds."""
    return wait_until


@pytest.fixture
def text():
    return TEXT


@pytest.fixture
def problem():
    """Asserts that a response is this problem, as every problem has to look, and gives its body."""

    def check(response, status, code, field=None):
        assert response.status_code == status, response.text
        assert response.headers["content-type"] == "application/problem+json"
        body = response.json()
        assert body["code"] == code
        assert body["type"] == f"urn:hereabouts:problem:{code}"
        assert body["status"] == status
        assert body["title"]
        assert body["detail"]
        assert body["request_id"] == response.headers["x-request-id"]
        assert set(body) <= {"type", "title", "status", "detail", "code", "request_id", "errors"}
        assert len(response.content) < 5000
        if field is not None:
            assert field in [error["field"] for error in body["errors"]]
        return body

    return check
