"""Evaluations that outlive the service."""

import errno
import json
import os
import signal
import socket
import subprocess
import sys
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import httpx
import pytest
from fake_localizer import FakeLocalizer
from local_client import local_client
from structlog.testing import capture_logs

from app import main
from app.jobs import runner, store
from app.jobs.runner import EvaluationJobs
from app.main import create_app
from app.settings import Settings
from models.files import TEMP_PREFIX
from tests.app.conftest import is_ready

WORKER = "tests.app.jobs.fake_worker"
SERVE = Path(__file__).parents[1] / "serve_fake.py"

pytestmark = pytest.mark.slow


def body(hint):
    return {"queries": [{"hints": [hint], "position": [1, 2]}]}


@pytest.fixture
def service(tmp_path, monkeypatch, until, warm):
    """A service whose jobs lie in one directory, as often as it is started."""
    monkeypatch.setattr(main, "EvaluationJobs", partial(EvaluationJobs, command=warm.command(WORKER)))

    @contextmanager
    def run():
        with local_client(create_app(Settings(jobs_dir=tmp_path / "jobs"), FakeLocalizer)) as api:
            until(lambda: api.get("/readyz").status_code == 200)
            yield api

    return run


def begin(api, hint):
    return api.post("/evaluate", json=body(hint)).json()["job"]


def status(api, job):
    return api.get(f"/evaluate/{job}").json().get("status")


def test_reports_stay_what_waits_goes_on_and_what_ran_is_interrupted(service, until, tmp_path):
    with service() as api:
        done = begin(api, "a tree")
        until(lambda: status(api, done) == "done")
        failed = begin(api, "wrong")
        until(lambda: status(api, failed) == "failed")
        before = [api.get(f"/evaluate/{job}").json() for job in (done, failed)]
        running = begin(api, "held")
        waiting = [begin(api, "a tree") for _ in range(2)]
        until(lambda: status(api, running) == "running")
    with service() as api:
        assert [api.get(f"/evaluate/{job}").json() for job in (done, failed)] == before
        assert status(api, running) == "interrupted"
        for job in waiting:
            until(lambda job=job: status(api, job) == "done")
        events = api.get(f"/evaluate/{running}/events").text
        assert "event: interrupted" in events
        assert api.delete(f"/evaluate/{done}").status_code == 200
    with service() as api:
        assert api.get(f"/evaluate/{done}").status_code == 404
        assert status(api, failed) == "failed"
    assert not (tmp_path / "jobs" / done).exists()


def test_a_cancelled_job_stays_cancelled(service, until):
    with service() as api:
        running, waiting = begin(api, "held"), begin(api, "a tree")
        until(lambda: status(api, running) == "running")
        for job in (waiting, running):
            api.delete(f"/evaluate/{job}")
    with service() as api:
        assert [status(api, job) for job in (running, waiting)] == ["cancelled", "cancelled"]


def test_what_a_kill_left_in_part_is_removed(service, until, tmp_path):
    jobs = tmp_path / "jobs"
    with service() as api:
        done = begin(api, "a tree")
        until(lambda: status(api, done) == "done")
    for name, files in {"a" * 32: ["evaluation.json"], "b" * 32: []}.items():
        (jobs / name).mkdir()
        for file in files:
            (jobs / name / file).write_text("{")
    (jobs / done / f"{TEMP_PREFIX}0").write_text("{")
    with service() as api:
        assert api.get(f"/evaluate/{'a' * 32}").status_code == 404
        assert status(api, done) == "done"
    assert [path.name for path in jobs.iterdir()] == [done]
    assert not (jobs / done / f"{TEMP_PREFIX}0").exists()


def test_a_job_whose_removal_was_cut_off_does_not_come_back(service, until, monkeypatch, tmp_path):
    with service() as api:
        done = begin(api, "a tree")
        until(lambda: status(api, done) == "done")
        with monkeypatch.context() as patch:
            patch.setattr(store.shutil, "rmtree", lambda *_, **__: None)  # as if killed before it
            api.delete(f"/evaluate/{done}")
    assert (tmp_path / "jobs" / done).is_dir()
    with service() as api:
        assert api.get(f"/evaluate/{done}").status_code == 404
    assert not (tmp_path / "jobs" / done).exists()


def test_a_job_is_promised_once_its_directory_is_on_disk(service, monkeypatch, tmp_path):
    synced = []
    monkeypatch.setattr(store, "sync", synced.append)
    with service() as api:
        begin(api, "a tree")
        assert synced == [tmp_path / "jobs"]


def test_what_cannot_be_read_or_is_no_job_is_left_alone(service, tmp_path):
    torn, unreadable, other = (tmp_path / "jobs" / name for name in ("a" * 32, "b" * 32, "photographs"))
    for path in (torn, unreadable / "state.json", other):
        path.mkdir(parents=True)
    (torn / "state.json").write_text("{")
    with capture_logs() as logs, service() as api:
        assert api.get(f"/evaluate/{torn.name}").status_code == 404
    assert sorted(line["job"] for line in logs if line["event"] == "job not read") == [torn.name, unreadable.name]
    assert all(path.is_dir() for path in (torn, unreadable, other))


def test_a_full_disk_stops_no_job_and_takes_no_other(service, until, monkeypatch, problem):
    def fails(*_):
        raise OSError(errno.ENOSPC, "full")

    with service() as api, monkeypatch.context() as patch:
        slow, old, waiting = (begin(api, "slow") for _ in range(3))
        until(lambda: status(api, slow) == "running")
        api.delete(f"/evaluate/{old}")
        patch.setattr(runner, "MAX_FINISHED_JOBS", 1)
        patch.setattr(store, "replace_file", fails)
        patch.setattr(store.JobStore, "remove", fails)
        problem(api.post("/evaluate", json=body("a tree")), 409, "not_writable")
        until(lambda: status(api, waiting) == "done")
        assert api.get(f"/evaluate/{old}").status_code == 404
        patch.undo()
        after = begin(api, "a tree")
        until(lambda: status(api, after) == "done")


def test_a_directory_of_another_service_is_not_shared(service, tmp_path):
    with service() as first, capture_logs() as logs, service() as second:
        assert [line["event"] for line in logs if line["log_level"] == "warning"] == ["jobs are not kept"]
        job = begin(first, "a tree")
        assert second.get(f"/evaluate/{job}").status_code == 404
        assert len(list((tmp_path / "jobs").iterdir())) == 1


class Killed:
    """A service in a process that is killed, and started again."""

    def __init__(self, scratch, worker):
        self.scratch, self.worker = scratch, worker
        self.process = None

    def start(self, until):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        environ = os.environ | {"HEREABOUTS_JOBS_DIR": str(self.scratch / "jobs")}
        command = [sys.executable, SERVE, str(port), *self.worker]
        self.process = subprocess.Popen(command, env=environ, stderr=subprocess.DEVNULL)
        self.url = f"http://127.0.0.1:{port}"
        until(lambda: is_ready(self.url))

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()


def test_what_was_acknowledged_is_there_after_every_kill(tmp_path, until, warm):
    service = Killed(tmp_path, warm.command(WORKER))
    acknowledged = set()
    try:
        for n in range(4):
            service.start(until)
            with httpx.Client(base_url=service.url) as client:
                for job in acknowledged:
                    assert client.get(f"/evaluate/{job}").status_code == 200
                for _ in range(n):
                    acknowledged.add(client.post("/evaluate", json=body("a tree")).json()["job"])
                acknowledged.add(client.post("/evaluate", json=body("slow")).json()["job"])
            service.kill()
        service.start(until)

        with httpx.Client(base_url=service.url) as client:

            def states():
                return [client.get(f"/evaluate/{job}").json()["status"] for job in acknowledged]

            until(lambda: set(states()) <= {"done", "interrupted"})
            assert states().count("interrupted") <= 4
    finally:
        service.kill()
    stored = [json.loads(path.read_text())["job"] for path in (tmp_path / "jobs").glob("*/state.json")]
    assert set(stored) == acknowledged
