"""A service of an index that is elsewhere: fetched, followed, answered from while the store is down."""

import time
from dataclasses import replace

import fsspec
import pytest
from fake_localizer import FakeLocalizer
from fastapi.testclient import TestClient
from typer.testing import CliRunner

from app.cli.main import app as commands
from app.copying import Copying
from app.main import create_app
from app.settings import Settings
from index.build.artifact import open_version, set_alias
from index.remote.place import Place
from index.remote.push import push
from models.errors import RemoteUnavailable
from models.files import hold
from tests.versions import write_index

URL = "memory://bucket/town"


class Versioned(FakeLocalizer):
    """Says which version answers, and holds it until it is closed, as a process does."""

    def __init__(self, directory):
        super().__init__()
        self.facts = replace(self.facts, version=open_version(directory)[1].version)
        self._holder = [set()]
        hold(directory, self._holder[0])

    def close(self):
        super().close()
        self._holder.clear()


def silent(*_):
    pass


@pytest.fixture
def index(tmp_path):
    return write_index(tmp_path / "index")


@pytest.fixture
def files():
    """What is in memory, as in a bucket."""
    files = fsspec.filesystem("memory")
    files.store.clear()
    yield files
    files.store.clear()


@pytest.fixture
def is_down(files, monkeypatch):
    """Cleared or filled: whether the bucket answers."""
    down, read = [], type(files).cat_file

    def cat_file(self, path, **more):
        if down:
            raise ConnectionError("no route to the bucket")
        return read(self, path, **more)

    monkeypatch.setattr(type(files), "cat_file", cat_file)
    return down


@pytest.fixture
def serve(tmp_path, monkeypatch):
    """Services of the bucket."""
    monkeypatch.setattr("app.main.open_workers", lambda order, _count: [Versioned(order.index_dir)])
    monkeypatch.setattr("app.http.indexes.LOOKED_AT_S", 0.02)
    monkeypatch.setattr("app.copying.LOOKED_AT_S", 0.02)
    monkeypatch.setattr("app.copying.LONGEST_S", 0.05)
    monkeypatch.setenv("HEREABOUTS_CACHE_DIR", str(tmp_path / "cache"))
    return lambda **settings: TestClient(create_app(Settings(index=URL, **settings)))


def served(api):
    """The version that answers; None if none does."""
    response = api.post("/localize", json={"description": "a tree"})
    return response.json()["provenance"]["index_version"] if response.is_success else None


def test_it_is_fetched_served_and_followed_and_the_old_version_removed(index, files, serve, until, tmp_path):
    push(index, Place(URL), silent)
    with serve() as api:
        until(lambda: served(api) == "v1")
        [root] = (tmp_path / "cache" / "indexes").iterdir()
        set_alias(index, "default", "v2")
        push(index, Place(URL), silent)
        until(lambda: served(api) == "v2")
        until(lambda: not (root / "v1").exists())
        assert served(api) == "v2"
        assert api.get("/indexes").json()["aliases"] == {"default": "v2"}


def test_it_is_not_ready_until_something_was_fetched_and_says_why(index, files, serve, until, problem, logged):
    said = logged("info")
    with serve() as api:
        until(lambda: "still being fetched" in api.get("/readyz").json()["detail"])
        time.sleep(0.2)
        for response in (api.get("/readyz"), api.post("/localize", json={"description": "a tree"})):
            problem(response, 503, "not_ready")
            assert response.headers["Retry-After"]
            assert URL not in response.text
        assert api.get("/healthz").status_code == 200
        push(index, Place(URL), silent)
        until(lambda: served(api) == "v1")
    lines = said()
    assert lines.count("index not fetched") == 1, "however often it was tried"
    assert f"there is no index in {URL}" in lines
    assert "load failed" not in lines
    assert lines.count("index fetched again") == 1


def test_a_store_that_is_down_is_logged_once_and_what_is_here_answers_also_after_a_restart(
    index, files, is_down, serve, until, logged
):
    said = logged("info")
    push(index, Place(URL), silent)
    with serve() as api:
        until(lambda: served(api) == "v1")
        is_down.append(True)
        time.sleep(0.3)
        assert served(api) == "v1"
    lines = said()
    assert lines.count("index not fetched") == 1
    assert "no route to the bucket" in lines
    with serve() as api:
        until(lambda: served(api) == "v1")
        is_down.clear()
        set_alias(index, "default", "v2")
        push(index, Place(URL), silent)
        until(lambda: served(api) == "v2")


def test_what_changes_it_is_409_and_changes_nothing(index, files, serve, until, problem):
    push(index, Place(URL), silent)
    with serve() as api:
        until(lambda: served(api) == "v1")
        for path, body in (
            ("/indexes", {"version": "v1"}),
            ("/indexes/aliases", {"alias": "canary", "version": "v1"}),
            ("/indexes/v1/snapshot", {}),
        ):
            assert "hereabouts push" in problem(api.post(path, json=body), 409, "not_writable")["detail"]
        assert api.post("/indexes/v1/verify", json={}).json()["version"] == "v1"
        assert api.get("/indexes").json()["aliases"] == {"default": "v1"}
        assert Place(URL).aliases().aliases == {"default": "v1"}


def test_a_copy_that_cannot_be_written_says_where_to(index, files, serve, until, tmp_path, logged):
    (tmp_path / "cache").write_text("a file, where a directory ought to be")
    said = logged("info")
    with serve() as api:
        until(lambda: "HEREABOUTS_CACHE_DIR" in said())
        assert api.get("/readyz").json()["code"] == "not_ready"


def test_a_url_that_cannot_be_read_here_is_said_before_anything_starts():
    with pytest.raises(RemoteUnavailable, match="s4://bucket is no URL of an index"):
        create_app(Settings(index="s4://bucket"))


@pytest.mark.parametrize(
    ("arguments", "environ", "wanted"),
    [
        (["--index", URL], {}, {"index": URL}),
        ([], {"HEREABOUTS_INDEX": URL, "HEREABOUTS_INDEX_DIR": "/a"}, {"index": URL}),
        ([], {"HEREABOUTS_INDEX": "/b"}, {"index": None, "index_dir": "/b"}),
        ([], {"HEREABOUTS_INDEX_DIR": "/a"}, {"index": None, "index_dir": "/a"}),
        (["--index", "c/d"], {"HEREABOUTS_INDEX": URL}, {"index": None, "index_dir": "c/d"}),
    ],
)
def test_serve_takes_a_directory_or_a_url(monkeypatch, arguments, environ, wanted):
    seen = []
    monkeypatch.setattr("app.main.create_app", seen.append)
    monkeypatch.setattr("app.server.serve", lambda *_: None)
    monkeypatch.setattr("app.workers.pool.launch", lambda *_: pytest.skip("starts a process"))
    monkeypatch.setattr("app.workers.launch.prepared", lambda: memoryview(b""))  # does nothing around a block
    monkeypatch.setattr("app.logs.configure_logging", lambda *_: None)
    result = CliRunner().invoke(commands, ["serve", *arguments], env=environ)
    assert result.exit_code == 0, result.output
    [settings] = seen
    assert {name: value and str(value) for name, value in settings.model_dump(include={*wanted}).items()} == wanted


@pytest.mark.parametrize(
    "arguments", [["localize", "a tree", "--index", URL], ["index", "--map", "x.osm", "--out", URL]]
)
def test_commands_that_take_a_directory_alone_say_so(arguments):
    result = CliRunner().invoke(commands, arguments)
    assert result.exit_code == 2
    assert "which serve and push alone take" in " ".join(result.output.replace("│", " ").split())


def test_push_says_what_is_there(index, files):
    result = CliRunner().invoke(commands, ["push", URL, "--index", str(index)])
    assert result.exit_code == 0, result.output
    assert f"{URL} has default (v1); serve it with: hereabouts serve --index {URL}" in " ".join(result.output.split())
    assert Place(URL).aliases().aliases == {"default": "v1"}


def test_what_is_being_fetched_does_not_keep_the_service_from_ending(monkeypatch, tmp_path):
    class Slow:
        place = Place(URL)

        def refresh(self):
            time.sleep(0.5)

    monkeypatch.setattr("app.copying.ENDS_S", 0.05)
    copying = Copying(Slow(), tmp_path)
    copying.start()
    before = time.monotonic()
    copying.close()
    assert time.monotonic() - before < 0.4
