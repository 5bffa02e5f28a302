"""What operators do: keys, versions and the names that serve them, counts."""

import errno
import hashlib
import os
import shutil
import tarfile
import threading

import pytest
from fake_localizer import FakeLocalizer
from local_client import local_client

from app.main import create_app
from app.settings import Settings
from index.build.artifact import open_version, read_aliases
from models.paper.checkpoint import save_retriever

pytestmark = pytest.mark.usefixtures("warm_workers")
READ, ADMIN = "read-key-1", "admin-key-1"
TEXT = "I am north of a gray building. A black pole is to my west."
PAUSE_S = 0.02  # between the requests of a client, so that the other version gets a CPU to be opened on


@pytest.fixture
def root(index_dir, tmp_path):
    """An index directory of one's own, with a second version that is registered and a third that is not."""
    root = tmp_path / "index"
    shutil.copytree(index_dir, root)
    return root


def served(root, tmp_path, model, until, **settings):
    if not (tmp_path / "weights").exists():
        save_retriever(model, tmp_path / "weights", {})
    return local_client(create_app(Settings(index_dir=root, weights_dir=tmp_path / "weights", workers=2, **settings)))


@pytest.mark.slow
def test_versions_are_listed_verified_kept_and_switched(root, tmp_path, model, until, problem, fake):
    default = read_aliases(root).aliases["default"]
    with served(root, tmp_path, model, until) as api:
        until(lambda: api.get("/readyz").status_code == 200, 60)
        listed = api.get("/indexes").json()
        assert listed == {
            "aliases": {"default": default},
            "versions": [{"version": default, "registered": True, "aliases": ["default"]}],
        }
        verified = api.post(f"/indexes/{default}/verify", json={}).json()
        assert verified["files"] == len(open_version(root)[1].files)

        kept = api.post(f"/indexes/{default}/snapshot", json={})
        assert kept.status_code == 201
        path = root / kept.json()["file"]
        assert hashlib.sha256(path.read_bytes()).hexdigest() == kept.json()["sha256"]
        again = api.post(f"/indexes/{default}/snapshot", json={}).json()
        assert again == kept.json()
        with tarfile.open(path) as archive:
            archive.extractall(
                tmp_path / "elsewhere", **({"filter": "data"} if hasattr(tarfile, "data_filter") else {})
            )
        (root / "aliases.json").rename(root / "aliases.kept")
        assert open_version(tmp_path / "elsewhere" / default)[1].version == default
        (root / "aliases.kept").rename(root / "aliases.json")

        switched = api.post("/indexes/aliases", json={"alias": "canary", "version": default}).json()
        assert switched["aliases"] == {"canary": default, "default": default}
        assert read_aliases(root).aliases == {"canary": default, "default": default}
        body = {"description": TEXT, "index": "canary"}
        assert api.post("/localize", json=body).json()["provenance"]["index"] == "canary"

        for path in ("verify", "snapshot"):
            problem(api.post(f"/indexes/none/{path}", json={}), 404, "version_not_found")
        problem(api.post("/indexes", json={"version": "none"}), 404, "version_not_found")
        problem(api.post("/indexes", json={"version": "../x"}), 422, "invalid_request", "version")
        problem(api.post("/indexes/aliases", json={"alias": "default", "version": "none"}), 404, "version_not_found")


@pytest.mark.slow
def test_a_version_that_cannot_be_served_is_refused_and_the_old_one_answers(root, tmp_path, model, until, problem):
    default = read_aliases(root).aliases["default"]
    with served(root, tmp_path, model, until) as api:
        until(lambda: api.get("/readyz").status_code == 200, 60)
        until(api.app.state.indexes._served["default"].checking.done, 60)  # it was whole when it was read
        (root / default / "cells.json").write_text("{}")
        change = {"alias": "default", "version": default}
        for response in (
            api.post("/indexes/aliases", json=change),
            api.post(f"/indexes/{default}/verify", json={}),
            api.post(f"/indexes/{default}/snapshot", json={}),
        ):
            body = problem(response, 409, "index_broken")
            assert str(root) not in response.text
            assert "build it again" in body["detail"]
        assert not (root / "snapshots").exists()
        assert api.post("/localize", json={"description": TEXT}).status_code == 200
        assert read_aliases(root).aliases == {"default": default}


@pytest.mark.slow
def test_an_index_of_another_model_is_409_with_a_way_out(root, tmp_path, model, until, problem):
    default = read_aliases(root).aliases["default"]
    settings = Settings(index_dir=root, workers=1)  # the weights that ship
    with local_client(create_app(settings)) as api:
        until(lambda: api.get("/readyz").json()["code"] == "load_failed", 60)
        response = api.post("/indexes/aliases", json={"alias": "default", "version": default})
        assert "hereabouts index" in problem(response, 409, "index_mismatch")["detail"]


@pytest.mark.parametrize("error", [errno.EROFS, errno.ENOSPC])
def test_a_directory_that_cannot_be_written_is_said_and_nothing_changes(root, fake, start, problem, monkeypatch, error):
    default = read_aliases(root).aliases["default"]
    before = (root / "aliases.json").read_bytes()

    def fails(*_arguments, **_more):
        raise OSError(error, os.strerror(error), str(root))

    monkeypatch.setattr("index.build.artifact.replace_file", fails)
    monkeypatch.setattr("index.build.snapshot.open_atomic", fails)
    with start(Settings(index_dir=root), fake) as api:
        (root / "copied").mkdir()
        for item in (root / default).iterdir():
            content = item.read_bytes()
            copied = content.replace(default.encode(), b"copied") if item.name == "manifest.json" else content
            (root / "copied" / item.name).write_bytes(copied)
        for response in (
            api.post("/indexes/aliases", json={"alias": "another", "version": default}),
            api.post(f"/indexes/{default}/snapshot", json={}),
            api.post("/indexes", json={"version": "copied"}),
        ):
            assert str(root) not in response.text
            problem(response, 409, "not_writable")
        assert (root / "aliases.json").read_bytes() == before
        assert api.get("/info").json()["indexes"] == ["default"]
        monkeypatch.undo()
        assert api.post("/indexes", json={"version": "copied"}).json()["version"] == "copied"


MATRIX = [
    # read key, admin key, host; sent; status of asking, of changing
    (None, None, "127.0.0.1", None, 200, 404),
    (None, None, "0.0.0.0", None, 200, 403),
    (READ, None, "127.0.0.1", None, 401, 401),
    (READ, None, "127.0.0.1", READ, 200, 403),
    (READ, ADMIN, "0.0.0.0", None, 401, 401),
    (READ, ADMIN, "0.0.0.0", READ, 200, 403),
    (READ, ADMIN, "0.0.0.0", ADMIN, 200, 404),
    (READ, ADMIN, "0.0.0.0", "another-key", 401, 401),
    (None, ADMIN, "0.0.0.0", None, 200, 401),
    (None, ADMIN, "0.0.0.0", "another-key", 200, 401),
    (None, ADMIN, "0.0.0.0", ADMIN, 200, 404),
]


@pytest.mark.parametrize(("read", "admin", "host", "sent", "asking", "changing"), MATRIX)
def test_who_may_ask_and_who_may_change(tmp_path, until, read, admin, host, sent, asking, changing):
    settings = Settings(read_key=read, admin_key=admin, host=host, index_dir=tmp_path)
    with local_client(create_app(settings, FakeLocalizer)) as api:
        until(lambda: api.get("/readyz").status_code == 200)
        headers = {"X-API-Key": sent} if sent else {}
        assert api.post("/localize", json={"description": TEXT}, headers=headers).status_code == asking
        assert api.get("/indexes", headers=headers).status_code == asking
        for path, body in (
            ("/indexes", {"version": "none"}),
            ("/indexes/aliases", {"alias": "default", "version": "none"}),
            ("/indexes/none/verify", {}),
            ("/indexes/none/snapshot", {}),
        ):
            assert api.post(path, json=body, headers=headers).status_code == changing, path


def test_a_page_of_another_site_changes_nothing_unasked(tmp_path, problem):
    with local_client(create_app(Settings(index_dir=tmp_path), FakeLocalizer)) as api:
        for path in ("/indexes", "/indexes/aliases", "/indexes/v1/verify", "/indexes/v1/snapshot"):
            for content_type in ("text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x"):
                response = api.post(path, content="{}", headers={"Content-Type": content_type})
                problem(response, 415, "unsupported_media_type")
            assert api.post(path).status_code in (415, 422)


def test_both_keys_at_once_are_not_more_than_the_lesser(tmp_path):
    settings = Settings(read_key=READ, admin_key=ADMIN, index_dir=tmp_path)
    with local_client(create_app(settings, FakeLocalizer)) as api:
        headers = {"X-API-Key": READ, "Authorization": f"Bearer {ADMIN}"}
        assert api.post("/indexes", json={"version": "none"}, headers=headers).status_code == 403


def test_counts_have_routes_and_never_what_was_sent(settings, fake, start):
    with start(settings, fake) as api:
        api.post("/localize", json={"description": "a secret tree"})
        api.get("/cells/secret")
        api.get("/secret/path?secret=1")
        api.request("SECRET", "/localize")
        text = api.get("/metrics").text
    assert 'hereabouts_requests_total{method="POST",route="/localize",status="200"} 1.0' in text
    assert 'route="/cells/{cell_id}",status="404"} 1.0' in text
    assert 'hereabouts_index{index="default",version="v1"} 1.0' in text
    assert 'hereabouts_workers{index="default"} 1.0' in text
    assert "hereabouts_request_seconds_bucket" in text
    assert "secret" not in text.lower()


def test_answers_say_that_they_are_what_they_say(api):
    for path in ("/healthz", "/info", "/nothing", "/search?q=a+tree"):
        headers = api.get(path).headers
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "no-referrer"
        assert headers["content-security-policy"].startswith("default-src 'none'")
    assert "content-security-policy" not in api.get("/docs").headers


@pytest.mark.slow
def test_no_request_is_lost_while_real_indexes_are_switched(root, tmp_path, model, until):
    default = read_aliases(root).aliases["default"]
    with served(root, tmp_path, model, until) as api:
        until(lambda: api.get("/readyz").status_code == 200, 60)
        ends, codes = threading.Event(), []

        def ask():
            while not ends.is_set():
                codes.append(api.post("/localize", json={"description": TEXT}).status_code)
                ends.wait(PAUSE_S)

        clients = [threading.Thread(target=ask) for _ in range(4)]
        for client in clients:
            client.start()
        change = {"alias": "default", "version": default}
        assert api.post("/indexes/aliases", json=change).status_code == 200
        switched = len(codes)
        until(lambda: len(codes) > switched + 4)
        ends.set()
        for client in clients:
            client.join(30)
        assert switched > 4
        assert set(codes) == {200}
