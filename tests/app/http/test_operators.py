"""Work of operators: list the versions of an index, move its aliases, and read counts."""

import shutil
import threading

import pytest
from local_client import local_client
from structlog.testing import capture_logs

from app.main import create_app
from app.settings import Settings
from index.build.artifact import read_aliases, register, remove_alias, set_alias
from models.paper.checkpoint import save_retriever

pytestmark = pytest.mark.usefixtures("warm_workers")
TEXT = "I am north of a gray building. A black pole is to my west."
PAUSE_S = 0.02  # between the requests of a client, so that the other version gets a CPU to be opened on


@pytest.fixture
def root(index_dir, tmp_path):
    """A copy of the index directory."""
    shutil.copytree(index_dir, tmp_path / "index")
    return tmp_path / "index"


def served(root, tmp_path, model):
    if not (tmp_path / "weights").exists():
        save_retriever(model, tmp_path / "weights", {})
    return local_client(create_app(Settings(index_dir=root, weights_dir=tmp_path / "weights", workers=2)))


def copy_version(root, version, name):
    """Copy a version to another name, as an operator copies one from elsewhere."""
    shutil.copytree(root / version, root / name)
    manifest = root / name / "manifest.json"
    manifest.write_text(manifest.read_text().replace(version, name))


@pytest.mark.slow
def test_versions_are_listed_and_served_by_the_names_that_they_get(root, tmp_path, model, until, problem):
    default = read_aliases(root).aliases["default"]
    copy_version(root, default, "copied")
    with served(root, tmp_path, model) as api:
        until(lambda: api.get("/readyz").status_code == 200)
        known = {"version": default, "registered": True, "aliases": ["default"]}
        copied = {"version": "copied", "registered": False, "aliases": []}
        assert api.get("/indexes").json() == {"aliases": {"default": default}, "versions": [known, copied]}

        register(root, "copied")
        set_alias(root, "canary", "copied")
        until(lambda: api.get("/indexes").json()["aliases"] == {"canary": "copied", "default": default})
        assert api.get("/indexes").json()["versions"] == [known, copied | {"registered": True, "aliases": ["canary"]}]
        body = {"description": TEXT, "index": "canary"}
        provenance = api.post("/localize", json=body).json()["provenance"]
        assert (provenance["index"], provenance["index_version"]) == ("canary", "copied")

        remove_alias(root, "canary")
        until(lambda: api.get("/indexes").json()["aliases"] == {"default": default})
        problem(api.post("/localize", json=body), 404, "index_not_found")


@pytest.mark.slow
def test_a_version_that_cannot_be_served_is_logged_and_the_old_one_answers(root, tmp_path, model, until):
    default = read_aliases(root).aliases["default"]
    copy_version(root, default, "copied")
    register(root, "copied")
    (root / "copied" / "cells.json").write_text("{}")
    with served(root, tmp_path, model) as api:
        until(lambda: api.get("/readyz").status_code == 200)
        with capture_logs() as lines:
            set_alias(root, "default", "copied")
            until(lambda: "index not switched" in [line["event"] for line in lines])
        [entry] = [line for line in lines if line["event"] == "index not switched"]
        assert entry["index_version"] == "copied"
        assert "cells.json" in entry["reason"]
        assert api.post("/localize", json={"description": TEXT}).json()["provenance"]["index_version"] == default


@pytest.mark.slow
def test_an_index_of_another_model_is_logged_with_a_way_out(root, until, problem):
    settings = Settings(index_dir=root, workers=1)  # the weights that ship
    with capture_logs() as lines, local_client(create_app(settings)) as api:
        until(lambda: api.get("/readyz").json()["code"] == "load_failed")
    [entry] = [line["reason"] for line in lines if line["event"] == "load failed"]
    assert "rebuild the index with this model" in entry


@pytest.mark.parametrize(
    ("method", "path"),
    [
        ("POST", "/indexes"),
        ("POST", "/indexes/aliases"),
        ("POST", "/indexes/v1/verify"),
        ("POST", "/indexes/v1/snapshot"),
        ("DELETE", "/indexes/v1"),
    ],
)
def test_indexes_cannot_be_changed_over_http(api, method, path):
    assert api.request(method, path, json={}).status_code in (404, 405)


def test_a_page_of_another_site_starts_no_evaluation(api, problem):
    for content_type in ("text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x"):
        response = api.post("/evaluate", content="{}", headers={"Content-Type": content_type})
        problem(response, 415, "unsupported_media_type")
    problem(api.post("/evaluate"), 415, "unsupported_media_type")


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
    copy_version(root, read_aliases(root).aliases["default"], "copied")
    register(root, "copied")
    with served(root, tmp_path, model) as api:
        until(lambda: api.get("/readyz").status_code == 200)
        ends, codes = threading.Event(), []

        def ask():
            while not ends.is_set():
                codes.append(api.post("/localize", json={"description": TEXT}).status_code)
                ends.wait(PAUSE_S)

        clients = [threading.Thread(target=ask) for _ in range(4)]
        for client in clients:
            client.start()
        set_alias(root, "default", "copied")
        until(lambda: api.get("/indexes").json()["aliases"] == {"default": "copied"})
        switched = len(codes)
        until(lambda: len(codes) > switched + 4)
        ends.set()
        for client in clients:
            client.join(60)
        assert switched > 4
        assert set(codes) == {200}
