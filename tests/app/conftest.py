import logging
import re
import sys
import threading
import time
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from urllib.request import urlopen

import pytest
import structlog
import uvicorn
from pydantic import ValidationError

sys.path.append(str(Path(__file__).parent))  # importlib mode does not; see also serve_fake.py

from fake_localizer import FakeLocalizer
from local_client import local_client

from app.http.errors import Code, Problem, field_name
from app.jobs.runner import EvaluationJobs
from app.logs import configure_logging
from app.main import create_app
from app.server import CONNECTION_OPTIONS
from app.settings import Settings
from app.workers.pool import WorkerPool
from tests.warm import Warm

TEXT = "I am north of a gray building. A black pole is to my west."


def wait_until(condition, timeout_s=60):
    """Wait for what an idle machine does in a second or less."""
    end = time.monotonic() + timeout_s
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.01)


def is_ready(url):
    """Whether a service is ready; `httpx.get` would load certificates each time, which takes longer than the answer."""
    try:
        with urlopen(f"{url}/readyz") as response:
            return response.status == 200
    except OSError:  # also a refusal
        return False


@contextmanager
def started(settings, localizer):
    with local_client(create_app(settings, lambda: localizer)) as api:
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


class TheTests:
    """The localizer of the service that tests share: whichever the running test has."""

    def __init__(self):
        self.own = FakeLocalizer()

    def __getattr__(self, name):
        return getattr(self.own, name)


@pytest.fixture(scope="session")
def _shared():
    localizer = TheTests()
    with started(Settings(), localizer) as api:
        yield api, localizer


@pytest.fixture
def api(_shared, fake):
    """A client of a service that is ready and answers with `fake`; who changes more of it has to `start` another."""
    api, localizer = _shared
    localizer.own = fake
    yield api
    fake.gate.set()
    wait_until(lambda: api.app.state.indexes.is_idle)


@pytest.fixture
def start():
    """A context manager: (settings, localizer) -> client of a service of its own that is ready."""
    return started


@pytest.fixture(scope="session")
def in_a_thread():
    """A context manager: application -> port on which it is served, as users reach it, once it is ready."""

    @contextmanager
    def serve(app):
        server = uvicorn.Server(
            uvicorn.Config(app, port=0, access_log=False, log_config=None, lifespan="on", **CONNECTION_OPTIONS)
        )
        thread = threading.Thread(target=server.run)
        thread.start()
        wait_until(lambda: server.started)
        port = server.servers[0].sockets[0].getsockname()[1]
        wait_until(lambda: is_ready(f"http://127.0.0.1:{port}"))
        try:
            yield port
        finally:
            server.should_exit = True
            thread.join(60)
        assert not thread.is_alive()

    return serve


@pytest.fixture(scope="session")
def warm(tmp_path_factory):
    """A process that has imported what the service's processes import."""
    warm = Warm(tmp_path_factory.mktemp("warm"))
    yield warm
    warm.close()


@contextmanager
def forked_from(warm):
    """Services that are started within have their processes forked from `warm`."""
    with pytest.MonkeyPatch.context() as patch:
        for name, kind, module in (
            ("app.workers.remote.WorkerPool", WorkerPool, "app.workers.process"),
            ("app.main.EvaluationJobs", EvaluationJobs, "app.jobs.worker"),
        ):
            patch.setattr(name, partial(kind, command=warm.command(module)))
        yield


@pytest.fixture(scope="module")
def warm_workers(warm):
    """The services of a module have their processes forked from `warm`."""
    with forked_from(warm):
        yield


@pytest.fixture(scope="session")
def until():
    """Waits until a condition holds."""
    return wait_until


@pytest.fixture
def logged(capfd):
    """(level, with words) -> begins to log as the service does, and gives what reads all that was logged since."""
    root, configured = logging.getLogger(), structlog.get_config()
    loggers = {name: logging.getLogger(name) for name in ("faiss.loader", "httpx", "httpcore", "httpx2", "httpcore2")}
    level, handlers = root.level, root.handlers[:]
    levels = {name: logger.level for name, logger in loggers.items()}

    def begin(level="debug", with_messages=False):
        configure_logging(level, with_messages)
        for name in levels.keys() - {"faiss.loader"}:  # of the tests' own clients
            loggers[name].setLevel(logging.WARNING)
        return lambda: capfd.readouterr().err

    yield begin
    root.setLevel(level)
    root.handlers[:] = handlers
    for name, logger in loggers.items():
        logger.setLevel(levels[name])
    structlog.configure(**configured)


@pytest.fixture
def text():
    return TEXT


@pytest.fixture(scope="session")
def refused():
    """Runs what takes a body apart, and gives (the names of the fields that it refuses, all that it says)."""

    def check(take, body):
        with pytest.raises((ValidationError, Problem)) as raised:
            take(body)
        error = raised.value
        if isinstance(error, Problem):
            assert error.code is Code.INVALID_REQUEST
            return [wrong.field for wrong in error.errors], error.detail
        details = error.errors()
        fields = [field_name(("body", *wrong["loc"]), wrong.get("ctx", {})) for wrong in details]
        return fields, " ".join(wrong["msg"] for wrong in details)

    return check


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
        assert not re.search(r"Input should|should (be|have|match)|validation", response.text), "pydantic's words"
        if field is not None:
            assert field in [error["field"] for error in body["errors"]]
        return body

    return check
