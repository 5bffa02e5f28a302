"""Jobs from the queue to the end, with a worker that does no work (fake_worker.py)."""

import asyncio
import json
import os
import sys
import time
from functools import partial
from pathlib import Path

import pytest
import structlog

from app import main
from app.http.routes import evaluate
from app.jobs import runner
from app.jobs.job import EvaluationJob
from app.jobs.runner import EvaluationJobs

COMMAND = (sys.executable, str(Path(__file__).parent / "fake_worker.py"))
TIMEOUT_S = 60


@pytest.fixture
def command(warm):
    return warm.command("tests.app.jobs.fake_worker")


@pytest.fixture
def api(settings, fake, start, command, monkeypatch):
    monkeypatch.setattr(main, "EvaluationJobs", partial(EvaluationJobs, command=command, max_waiting=2))
    with start(settings, fake) as api:
        yield api


def post(api, hint="a tree", **more):
    return api.post("/evaluate", json={"queries": [{"hints": [hint], "position": [1, 2]}], **more})


def begin(api, hint="a tree", **more):
    response = post(api, hint, **more)
    assert response.status_code == 202, response.text
    return response.json()["job"]


def state(api, job):
    return api.get(f"/evaluate/{job}").json()


def wait_for(api, job, *statuses):
    end = time.monotonic() + TIMEOUT_S
    while (now := state(api, job))["status"] not in statuses:
        assert time.monotonic() < end, now
        time.sleep(0.02)
    return now


def events(response):
    assert response.headers["content-type"].startswith("text/event-stream")
    blocks = [block for block in response.text.split("\r\n\r\n") if block.startswith("event: ")]
    lines = [block.split("\r\n") for block in blocks]
    return [(name.removeprefix("event: "), json.loads(data.removeprefix("data: "))) for name, data in lines]


def is_alive(pid):
    try:
        return "Z" not in Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return False


def directory(api, job):
    return api.app.state.jobs.get(job).directory


def test_done_with_its_report(api):
    job = begin(api, grow=[200])
    finished = wait_for(api, job, "done")
    assert set(finished) == {"job", "status", "progress", "created", "seconds", "report", "error"}
    assert finished["report"] == {"queries": 1, "grow": [200]}
    assert finished["progress"] == {"stage": "ask", "done": 2, "total": 2}
    assert finished["seconds"] > 0
    assert finished["error"] is None


def test_events_tell_the_progress_and_one_end(api):
    job = begin(api, "slow")
    reported = events(api.get(f"/evaluate/{job}/events"))
    assert [name for name, _ in reported[:-1]] == ["progress"] * (len(reported) - 1)
    assert reported[-1][0] == "done"
    assert {"stage": "ask", "done": 0, "total": 2} in [data["progress"] for _, data in reported]
    assert reported[-1][1] == state(api, job)
    assert events(api.get(f"/evaluate/{job}/events")) == reported[-1:], "who comes late is told the end"


def test_events_of_a_cancelled_job_end(api):
    running, queued = begin(api, "held"), begin(api)
    wait_for(api, running, "running")
    api.delete(f"/evaluate/{queued}")
    assert [name for name, _ in events(api.get(f"/evaluate/{queued}/events"))] == ["cancelled"]
    api.delete(f"/evaluate/{running}")


@pytest.mark.slow
def test_silent_stream_has_signs_of_life(api, monkeypatch):
    monkeypatch.setattr(evaluate, "PING_S", 0.1)
    job = begin(api, "slow")
    assert ": ping" in api.get(f"/evaluate/{job}/events").text


def test_follower_that_is_slow_misses_no_end():
    async def follow():
        job = EvaluationJob(Path("/nowhere"))
        stages = []
        async for now in job.follow():
            stages.append(now.status)
            if now.status == "queued":
                job.begin()
                job.finish("done", report={})
        return stages

    assert asyncio.run(asyncio.wait_for(follow(), TIMEOUT_S)) == ["queued", "done"]


def test_follower_that_leaves_cancels_nothing():
    async def leave():
        job = EvaluationJob(Path("/nowhere"))
        stream = evaluate.events(job)
        await anext(stream)
        await stream.aclose()
        return job.requested_end

    assert not asyncio.run(leave())


def test_input_that_is_wrong_is_said_without_directories(api):
    finished = wait_for(api, begin(api, "wrong"), "failed")
    assert finished["error"] == {"code": "evaluation_failed", "detail": "index/cells: are wrong, make them right"}
    assert finished["report"] is None


@pytest.mark.slow
def test_crash_is_told_in_the_log_alone(api):
    with structlog.testing.capture_logs() as logged:
        finished = wait_for(api, begin(api, "crash"), "failed")
    assert finished["error"]["code"] == "internal_error"
    assert "secret" not in str(finished)
    assert any("secret of the crash" in entry.get("stderr", "") for entry in logged)
    assert wait_for(api, begin(api), "done"), "the next one runs"


@pytest.mark.slow
@pytest.mark.parametrize("with_messages", [True, False])
def test_a_fault_is_told_in_the_log_and_what_was_said_where_it_is_wanted(api, monkeypatch, with_messages):
    monkeypatch.setenv("HEREABOUTS_LOG_DESCRIPTIONS", str(with_messages))
    with structlog.testing.capture_logs() as logged:
        wait_for(api, begin(api, "a quixotic fault"), "failed")
    [reported] = [entry["stderr"] for entry in logged if entry["event"] == "evaluation crashed"]
    assert "fake_worker.py" in reported
    assert "KeyError" in reported
    assert ("quixotic" in reported) == with_messages


@pytest.mark.parametrize("command", [("/nowhere/python",)])
def test_worker_that_does_not_start_is_a_failure(api):
    assert wait_for(api, begin(api), "failed")["error"]["code"] == "internal_error"


@pytest.mark.slow
@pytest.mark.parametrize("command", [COMMAND])  # the process that is ended is the one that works
def test_crash_leaves_no_process_behind(api, until):
    job = begin(api, "orphan")
    wait_for(api, job, "failed")
    child = int((directory(api, job) / "child").read_text())
    until(lambda: not is_alive(child))


@pytest.mark.slow
@pytest.mark.parametrize("command", [COMMAND])
def test_cancel_stops_the_work(api, problem):
    job = begin(api, "held")
    wait_for(api, job, "running")
    end = time.monotonic() + TIMEOUT_S
    while state(api, job)["progress"]["stage"] != "ask":
        assert time.monotonic() < end
    pid = api.app.state.jobs.get(job).process.pid
    assert os.getpriority(os.PRIO_PROCESS, pid) >= 10
    response = api.delete(f"/evaluate/{job}")
    assert (response.status_code, response.json()["status"]) == (200, "cancelled")
    assert not is_alive(pid)
    assert state(api, job)["status"] == "cancelled"
    scratch = directory(api, job)
    assert api.delete(f"/evaluate/{job}").json()["status"] == "cancelled"
    assert not scratch.exists()
    problem(api.get(f"/evaluate/{job}"), 404, "job_not_found")
    problem(api.delete(f"/evaluate/{job}"), 404, "job_not_found")
    problem(api.get(f"/evaluate/{job}/events"), 404, "job_not_found")


@pytest.mark.slow
def test_one_runs_some_wait_and_one_more_is_refused(api, problem):
    running = begin(api, "held")
    wait_for(api, running, "running")
    waiting = [begin(api), begin(api)]
    response = post(api)
    problem(response, 429, "jobs_full")
    assert response.headers["retry-after"] == "30"
    assert [state(api, job)["status"] for job in waiting] == ["queued", "queued"]
    assert api.delete(f"/evaluate/{waiting[0]}").json()["status"] == "cancelled"
    waiting.append(begin(api))
    api.delete(f"/evaluate/{running}")
    for job in waiting[1:]:
        wait_for(api, job, "done")
    assert state(api, waiting[0])["status"] == "cancelled"


def test_finished_jobs_are_kept_for_a_while(api, monkeypatch, problem):
    monkeypatch.setattr(runner, "MAX_FINISHED_JOBS", 2)
    running = begin(api, "held")
    wait_for(api, running, "running")
    old = []
    for _ in range(4):
        old.append(begin(api))
        api.delete(f"/evaluate/{old[-1]}")
    problem(api.get(f"/evaluate/{old[0]}"), 404, "job_not_found")
    assert [state(api, job)["status"] for job in old[2:]] == ["cancelled", "cancelled"]
    assert len(list(directory(api, old[3]).parent.iterdir())) == 3
    assert state(api, running)["status"] == "running"


def test_end_of_the_service_leaves_nothing(settings, fake, start, monkeypatch):
    monkeypatch.setattr(main, "EvaluationJobs", partial(EvaluationJobs, command=COMMAND))
    with start(settings, fake) as api:
        jobs = [begin(api, "held"), begin(api, "held")]
        wait_for(api, jobs[0], "running")
        pid = api.app.state.jobs.get(jobs[0]).process.pid
        scratch = directory(api, jobs[0]).parent
        assert scratch.is_dir()
    assert not is_alive(pid)
    assert not scratch.exists()
