"""An index in a real Milvus: built, verified, served, and served through a Milvus that is killed and started again."""

import shutil
import threading
import time

import pytest
from fastapi.testclient import TestClient
from typer.testing import CliRunner

from app.cli import main as cli
from app.main import create_app
from app.settings import Settings
from index.build.artifact import open_version, read_aliases, set_alias
from index.build.build import IndexJob
from index.build.manifest import write_manifest
from index.stores.milvus_connection import URI
from index.stores.milvus_store import MilvusStore
from models.errors import StoreUnavailable

pytest.importorskip("pymilvus", reason="pymilvus not installed: pip install 'hereabouts[dev]'")
pytestmark = [pytest.mark.slow, pytest.mark.server("milvus"), pytest.mark.usefixtures("warm_workers")]
THREADS, PAUSE_S = 4, 0.1
QUERIES = [
    {"description": text, "refine": refine}
    for text in ("A tree is near.", "I am north of a building.")
    for refine in ("none", "posterior")
]


@pytest.fixture(scope="module")
def uri(milvus_server):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(URI, milvus_server.uri)
        yield milvus_server.uri


@pytest.fixture(scope="module")
def root(uri, osm_file, weights_dir, tmp_path_factory):
    root = tmp_path_factory.mktemp("in-milvus") / "index"
    IndexJob(osm_file, root, weights_dir, store="milvus").build()
    yield root
    manifest = open_version(root)[1]
    MilvusStore(manifest.collection, manifest.dim, manifest.cells).drop()


@pytest.fixture(scope="module")
def served(root, weights_dir, until):
    with TestClient(create_app(Settings(index_dir=root, weights_dir=weights_dir, workers=2))) as api:
        until(lambda: api.get("/readyz").status_code == 200)
        yield api


def test_no_vectors_are_in_the_directory(root):
    directory, manifest = open_version(root)
    assert manifest.store == "milvus"
    assert manifest.collection == "hereabouts_" + manifest.version.replace("-", "_")
    assert "vectors.faiss" not in manifest.files
    assert not (directory / "vectors.faiss").exists()
    by_alias = MilvusStore("hereabouts_default", manifest.dim, manifest.cells)
    by_alias.check()  # Milvus's alias
    by_alias.close()


def test_it_answers_as_an_index_in_a_file(served, index_dir, weights_dir, until):
    with TestClient(create_app(Settings(index_dir=index_dir, weights_dir=weights_dir, workers=1))) as other:
        until(lambda: other.get("/readyz").status_code == 200)
        for query in QUERIES:
            here, there = (api.post("/localize", json=query).json() for api in (served, other))
            assert here["status"] == there["status"]
            assert here["estimate"]["position"] == pytest.approx(there["estimate"]["position"], abs=0.01)
            for one, two in zip(here["candidates"], there["candidates"], strict=True):
                assert one["cell_id"] == two["cell_id"]
                assert one["probability"] == pytest.approx(two["probability"], abs=1e-4)


def test_its_rows_are_counted_when_it_is_verified(root, tmp_path, weights_dir, osm_file):
    verified = CliRunner().invoke(cli.app, ["verify", "--index", str(root)])
    assert verified.exit_code == 0, verified.output
    other = tmp_path / "index"
    directory = IndexJob(osm_file, other, weights_dir, store="milvus").build()
    manifest = open_version(other)[1]
    assert IndexJob(osm_file, other, weights_dir, keep_current=True, store="milvus").build() == directory
    MilvusStore(manifest.collection, manifest.dim, manifest.cells).drop()
    shutil.copytree(directory, root / directory.name)
    refused = CliRunner().invoke(cli.app, ["alias", "set", "canary", directory.name, "--index", str(root)])
    assert refused.exit_code == 1
    assert read_aliases(root).aliases.keys() == {"default"}
    shutil.rmtree(root / directory.name)


def test_without_an_address_the_command_says_what_to_set(monkeypatch, osm_file, tmp_path):
    monkeypatch.delenv(URI, raising=False)
    result = CliRunner().invoke(
        cli.app, ["index", "--map", str(osm_file), "--out", str(tmp_path / "i"), "--store", "milvus"]
    )
    assert result.exit_code == 1
    assert URI in " ".join(result.output.split())


def test_where_milvus_is_down_the_service_starts_and_what_needs_no_vectors_is_answered(
    monkeypatch, index_dir, tmp_path, weights_dir, until, problem
):
    """The manifest names a Milvus server, and there is none at that address."""
    monkeypatch.setenv(URI, "http://127.0.0.1:1")
    root = tmp_path / "index"
    shutil.copytree(index_dir, root)
    directory, manifest = open_version(root)
    (root / "aliases.json").unlink()
    moved = manifest.model_copy(update={"store": "milvus", "collection": "hereabouts_none"})
    write_manifest(directory, moved)
    set_alias(root, "default", manifest.version)
    with TestClient(create_app(Settings(index_dir=root, weights_dir=weights_dir, workers=1))) as api:
        until(lambda: api.get("/readyz").status_code == 200)
        response = api.post("/localize", json=QUERIES[0])
        problem(response, 503, "store_unavailable")
        assert response.headers["Retry-After"] == "2"
        verified = CliRunner().invoke(cli.app, ["verify", "--index", str(root)])
        assert verified.exit_code == 1
        assert "Milvus" in verified.stderr
        batch = api.post("/localize/batch", json={"items": QUERIES[:1]}).json()
        assert batch["items"][0]["error"]["code"] == "store_unavailable"
        assert api.get("/cells").status_code == 200


def test_a_build_without_milvus_leaves_nothing(monkeypatch, osm_file, weights_dir, tmp_path):
    monkeypatch.setenv(URI, "http://127.0.0.1:1")
    with pytest.raises(StoreUnavailable, match="cannot create_collection"):
        IndexJob(osm_file, tmp_path / "index", weights_dir, store="milvus").build()
    assert not list((tmp_path / "index").glob("*"))


def test_killed_under_load_and_started_again_it_answers_without_a_restart(milvus_server, served, until):
    answered, ends = [], threading.Event()

    def down():
        return [status for answered_s, status, _ in answered if killed_s + 1 < answered_s]

    def ask(number):
        while not ends.wait(PAUSE_S):
            response = served.post("/localize", json=QUERIES[number])
            answered.append((time.monotonic(), response.status_code, response.headers.get("Retry-After")))
            assert served.get("/healthz").status_code == 200

    threads = [threading.Thread(target=ask, args=(n,)) for n in range(THREADS)]
    for thread in threads:
        thread.start()
    try:
        until(lambda: len(answered) >= 4 * THREADS)
        milvus_server.kill()
        killed_s = time.monotonic()
        until(lambda: len(down()) >= 2 * THREADS)
        assert served.get("/readyz").status_code == 200
        refused = set(down())
        milvus_server.start()
        until(lambda: [status for _, status, _ in answered[-2 * THREADS :]] == [200] * 2 * THREADS)
    finally:
        ends.set()
        for thread in threads:
            thread.join()
    assert refused == {503}
    assert {(status, retry) for _, status, retry in answered} == {(200, None), (503, "2")}
