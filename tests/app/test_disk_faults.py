"""Disks that are full or read-only, and two who write at once: processes that build and serve for real."""

import os
import shutil
from contextlib import contextmanager

import httpx
import pytest

from index.build.artifact import open_version, read_aliases
from models.files import TEMP_PREFIX
from tests.mould import Mould

pytestmark = pytest.mark.slow

READ_ONLY = {"is_bound": True}  # as `Mould.serve` takes it


@pytest.fixture(scope="module")
def mould(tmp_path_factory):
    with Mould(tmp_path_factory.mktemp("mould")) as mould:
        yield mould


@pytest.fixture
def root(mould, tmp_path):
    """An index directory with a version that is served."""
    shutil.copytree(mould.scratch / "index", tmp_path / "index")
    return tmp_path / "index"


@pytest.fixture
def serve(mould):
    """A context manager: index directory -> client of a service of its own on it, which is killed in the end."""

    @contextmanager
    def started(root, jobs="jobs", **limits):
        pid, url = mould.serve(root, jobs=jobs, **limits)
        with httpx.Client(base_url=url, timeout=60) as client:
            try:
                yield client
            finally:
                os.kill(pid, 9)
                mould.wait(pid)

    return started


@contextmanager
def disk(directory, limits):
    """Where the limits of a process are permissions, has a directory deny them."""
    places = [directory, *(path for path in directory.rglob("*") if path.is_dir())]
    for place in places:
        place.chmod(0o555 if limits == READ_ONLY else 0o755)
    try:
        yield
    finally:
        for place in places:
            place.chmod(0o755)


def add(root, version):
    """Copy the version that is served to another name, as an operator would from elsewhere."""
    directory, _ = open_version(root)
    shutil.copytree(directory, root / version, copy_function=os.link)
    manifest = root / version / "manifest.json"
    text = manifest.read_text()
    manifest.unlink()
    manifest.write_text(text.replace(directory.name, version))


def listing(root):
    """The files there are, and when each was written, but for what the worker of a killed service says as it ends."""
    files = [path for path in root.rglob("*") if path.is_file() and path.name != "stderr.txt"]
    return {str(path): path.stat().st_mtime_ns for path in files}


@pytest.mark.parametrize("limits", [{"file_bytes": 50_000}, READ_ONLY])
def test_an_index_that_cannot_be_written_is_said_and_what_is_there_stays(mould, root, limits):
    before = listing(root), open_version(root)
    with disk(root, limits):
        status, output = mould.wait(mould.build(root, **limits))
    assert status == 1
    assert f"{root} cannot be written" in " ".join(output.split())
    assert "Traceback" not in output
    assert (listing(root), open_version(root)) == before
    assert not list(root.glob(f"{TEMP_PREFIX}*"))


@pytest.mark.parametrize("limits", [{"file_bytes": 0}, READ_ONLY])
def test_a_service_that_cannot_write_says_so_and_answers_as_before(serve, root, limits, problem, until):
    default = read_aliases(root).aliases["default"]
    evaluation = {"queries": [{"hints": ["held"], "position": [1, 2]}]}
    with serve(root) as api:
        running = api.post("/evaluate", json=evaluation).json()["job"]
        until(lambda: api.get(f"/evaluate/{running}").json()["status"] == "running")
    before = listing(root.parent)
    with disk(root.parent, limits), serve(root, **limits) as api:
        assert api.get("/indexes").json()["aliases"] == {"default": default}
        if limits != READ_ONLY:  # where jobs cannot be kept at all, they are done all the same
            problem(api.post("/evaluate", json=evaluation), 409, "not_writable")
        answer = api.post("/localize", json={"description": "a tree"})
        assert (answer.status_code, answer.json()["provenance"]["index_version"]) == (200, default)
    assert listing(root.parent) == before
    with serve(root) as api:
        assert api.get(f"/evaluate/{running}").json()["status"] == "interrupted"
        assert api.post("/evaluate", json=evaluation).is_success


@pytest.mark.parametrize("limits", [{"file_bytes": 0}, READ_ONLY])
def test_an_alias_that_cannot_be_written_is_said_and_the_old_one_stays(mould, root, limits):
    add(root, "copied")
    before = listing(root), read_aliases(root)
    with disk(root, limits):
        status, output = mould.wait(mould.set_alias(root, "default", "copied", **limits))
    assert status == 1
    assert f"{root} cannot be written" in " ".join(output.split())
    assert "Traceback" not in output
    assert (listing(root), read_aliases(root)) == before
    assert mould.wait(mould.set_alias(root, "default", "copied"))[0] == 0
    assert read_aliases(root).aliases == {"default": "copied"}


def test_two_builds_at_once_lose_nothing(mould, root):
    before = set(read_aliases(root).versions)
    for pid in [mould.build(root) for _ in range(2)]:
        assert mould.wait(pid)[0] == 0
    known = read_aliases(root)
    built = set(known.versions) - before
    assert len(built) == 2
    assert known.aliases["default"] in built
    for version in known.versions:
        open_version(root / version)
    assert {path.name for path in root.iterdir()} == {*known.versions, "aliases.json", ".lock"}


def test_two_that_set_aliases_at_once_lose_nothing_and_a_service_follows(mould, serve, root, until):
    default = read_aliases(root).aliases["default"]
    names = [[f"{operator}{n}" for n in range(6)] for operator in "ab"]
    wanted = {"default": default} | {version: version for versions in names for version in versions}
    for version in {*wanted} - {"default"}:
        add(root, version)
    with serve(root) as api:
        for both in zip(*names, strict=True):
            for pid in [mould.set_alias(root, version, version) for version in both]:
                assert mould.wait(pid)[0] == 0
        until(lambda: api.get("/indexes").json()["aliases"] == wanted)
    known = read_aliases(root)
    assert known.aliases == wanted
    assert set(known.versions) == set(wanted.values())
