"""Shards as tasks of a Ray cluster: a real one of two workers where Ray is installed."""

import secrets
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from types import SimpleNamespace

import pytest

from index.build.build import IndexJob
from index.build.ray_shards import build_on_ray
from models.errors import ClusterUnavailable, DataError, MapError
from tests.index_facts import index_facts

CLUSTER = """
import ray
print(ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False).address_info["address"], flush=True)
input()
"""


@pytest.fixture
def cluster(monkeypatch):
    """The address of a Ray with two CPUs, which lets nobody else in and ends with the test."""
    if find_spec("ray") is None:
        pytest.skip("takes Ray: pip install 'hereabouts[ray]'")
    monkeypatch.setenv("RAY_AUTH_MODE", "token")
    monkeypatch.setenv("RAY_AUTH_TOKEN", secrets.token_hex(32))  # else it would be kept in the home directory
    with subprocess.Popen([sys.executable, "-c", CLUSTER], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        yield process.stdout.readline().decode().strip()
        process.communicate(b"\n")


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # Ray's own
def test_two_workers_make_the_bytes_of_the_whole(cluster, deep_file, rich_dir, deep_index, tmp_path) -> None:
    calls = []
    job = IndexJob(deep_file, tmp_path / "out", rich_dir, levels=True)
    build_on_ray(job, None, cluster, lambda *call: calls.append(call))
    assert ("make shards", 1, 2) in calls
    assert index_facts(tmp_path / "out") == index_facts(deep_index)


def fake_ray(monkeypatch, **attributes):
    """A Ray that does what it is told to."""
    exceptions = SimpleNamespace(RayError=type("RayError", (Exception,), {}), RayTaskError=KeyError)
    ray = SimpleNamespace(exceptions=exceptions, shutdown=lambda: None, init=lambda **_: None, **attributes)
    monkeypatch.setitem(sys.modules, "ray", ray)
    return ray


def make_here(made):
    """Tasks of a fake Ray, which are done at once by a function."""
    remote = SimpleNamespace(options=lambda **_: SimpleNamespace(remote=made))
    return {"remote": lambda _: remote, "wait": lambda waiting: (waiting[:1], waiting[1:])}


@pytest.mark.parametrize("address", ["127.0.0.1:1", "ray://127.0.0.1:1"])
def test_a_cluster_that_is_not_there_is_said_at_once(osm_file, tmp_path, monkeypatch, address) -> None:
    fake_ray(monkeypatch)
    with pytest.raises(ClusterUnavailable, match=rf"no Ray cluster at {address} \(.*refused.*ray start --head"):
        build_on_ray(IndexJob(osm_file, tmp_path), 2, address)


def test_workers_that_write_elsewhere_and_shards_that_are_lost_are_said(osm_file, tmp_path, monkeypatch) -> None:
    job = IndexJob(osm_file, tmp_path)
    fake_ray(monkeypatch, get=lambda done: done, **make_here(lambda _, shard: Path(f"/of/the/worker/{shard.name}")))
    with pytest.raises(DataError, match=rf"/of/the/worker/1-of-2 was made but is not visible here: .* {tmp_path}"):
        build_on_ray(job, 2, None)

    def lost(_done):
        raise ray.exceptions.RayError("node died")

    ray = fake_ray(monkeypatch, get=lost, **make_here(lambda *_: None))
    with pytest.raises(ClusterUnavailable, match=r"lost a shard \(node died\); repeat the command"):
        build_on_ray(job, 2, None)


def test_what_is_wrong_with_a_map_is_said_as_it_is_without_ray(osm_file, tmp_path, monkeypatch) -> None:
    def failed(_done):
        error = KeyError("a trace of a worker")
        error.cause = MapError("no map")
        raise error

    fake_ray(monkeypatch, get=failed, **make_here(lambda *_: None))
    with pytest.raises(MapError, match=r"^no map$"):
        build_on_ray(IndexJob(osm_file, tmp_path), 2, None)


def test_ray_that_is_not_installed_is_said(osm_file, tmp_path, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(ClusterUnavailable, match=r"pip install 'hereabouts\[ray\]'"):
        build_on_ray(IndexJob(osm_file, tmp_path), 2, None)
