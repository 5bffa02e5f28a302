import os
import signal
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

sys.path.append(str(Path(__file__).parent))

from ordered import Broken, Order

from app.main import create_app
from app.settings import Settings
from app.workers import launch
from app.workers.messages import WorkerFault
from app.workers.pool import WorkerPool
from app.workers.remote import open_workers
from index.answering.query import Query
from models.errors import IndexBroken, ReplyError


@pytest.fixture(autouse=True)
def _importable(monkeypatch):
    places = Path(__file__).parent, Path(__file__).parents[1]
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([*map(str, places), os.environ.get("PYTHONPATH", "")]))


@pytest.fixture
def workers():
    opened = open_workers(Order(), 2)
    yield opened
    for worker in opened:
        worker.close()


def ask(worker, text="a tree"):
    """The process that answered, and the one that it was forked from."""
    return tuple(map(int, worker.localize([Query(text)])[0].warnings))


def is_running(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def test_workers_are_processes_of_one_mould(workers):
    (one, mould), (other, same) = (ask(worker) for worker in workers)
    assert len({one, other, mould, os.getpid()}) == 4
    assert mould == same
    assert [worker.pid for worker in workers] == [one, other]
    assert workers[0].facts.map_name == "fakeville"
    assert workers[0].frame.is_georeferenced


@pytest.fixture
def ahead(monkeypatch):
    """A process is prepared that imports what takes a moment."""
    monkeypatch.setattr(launch, "PRELOADED_MODULE", "colorsys")
    with launch.prelaunched():
        [(process, _)] = launch._prelaunched
        yield process


def test_a_prepared_process_is_that_of_the_next_pool_alone(ahead):
    first, second = (open_workers(Order(), 1)[0] for _ in range(2))
    assert ask(first)[1] == ahead.pid != ask(second)[1]
    assert str(first.cell("colorsys")) == "imported"
    assert second.cell("colorsys") is None
    for worker in (first, second):
        worker.close()
    assert not is_running(ahead.pid)


def test_a_prepared_process_that_was_killed_is_replaced(ahead):
    ahead.kill()
    ahead.wait()
    [worker] = open_workers(Order(), 1)
    assert ask(worker)[1] != ahead.pid
    worker.close()


def test_a_prepared_process_that_nobody_needs_ends():
    with launch.prelaunched():
        [(process, _)] = launch._prelaunched
    assert process.poll() is not None
    assert not launch._prelaunched
    process, control = launch.launch((*launch.PROCESS, "colorsys"))
    control.close()
    assert process.wait(60) == 0, "and by itself, when the service is gone"


def test_libraries_have_one_thread_each_whatever_the_operator_sets(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "4")  # a forked process would wait for threads that it has not
    [worker] = open_workers(Order(), 1)
    for name in ("OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        assert str(worker.cell(name)) == "1"
    worker.close()


def test_reads_need_not_wait_for_the_model(workers):
    with ThreadPoolExecutor(1) as pool:
        slow = pool.submit(ask, workers[0], "slow")
        assert workers[0].describe((1.0, 2.0)) == (workers[0].pid, (1.0, 2.0))
        assert not slow.done()


def test_errors_come_as_they_are_and_faults_with_their_traceback(workers):
    with pytest.raises(ReplyError) as refused:
        ask(workers[0], "reply")
    assert (refused.value.number, refused.value.field, refused.value.advice) == (2, "choice", "another one")
    with pytest.raises(WorkerFault, match=r"(?s)Traceback.*KeyError: 'what it was'"):
        ask(workers[0], "fault")
    assert ask(workers[0])


def test_an_index_that_cannot_be_opened_says_why():
    with pytest.raises(IndexBroken, match="cut short"):
        open_workers(Broken(), 2)


def test_a_worker_that_is_killed_is_forked_again_and_nothing_is_lost(workers, tmp_path):
    before = workers[0].pid
    now, _ = ask(workers[0], f"die once {tmp_path / 'died'}")
    assert now == workers[0].pid != before
    os.kill(now, signal.SIGKILL)
    assert workers[0].describe((0.0, 0.0))[0] not in (before, now)


def test_what_kills_every_worker_is_refused_and_the_next_is_answered(workers):
    with pytest.raises(WorkerFault, match="localize makes workers crash"):
        ask(workers[0], "die")
    with pytest.raises(WorkerFault, match="scenery makes workers crash"):
        workers[0].scenery(0)
    assert ask(workers[0])


@pytest.mark.parametrize(
    ("text", "faults"),
    [
        ("a quoted quixotic tree", ["ordered.py", "ValueError", "WorkerFault"]),
        ("a deadly quixotic tree", ["worker lost", "localize makes workers crash"]),
    ],
)
def test_no_line_has_what_was_said_when_a_worker_fails_of_it(logged, until, text, faults):
    read_log, body = logged(), {"description": text}
    with TestClient(create_app(Settings(), lambda: open_workers(Order(), 1)[0])) as api:
        until(lambda: api.get("/readyz").status_code == 200)
        assert api.post("/localize", json=body).status_code == 500
        assert api.post("/localize/batch", json={"items": [body, body]}).status_code == 500
    lines = read_log()
    assert all(fault in lines for fault in faults), "where it happened is told"
    assert "quixotic" not in lines


def test_a_mould_that_is_killed_is_made_again_when_it_is_needed(workers):
    worker, mould = ask(workers[0])
    os.kill(mould, signal.SIGKILL)
    assert ask(workers[0]) == (worker, 1) or ask(workers[0])[0] == worker, "workers do not need it"
    os.kill(worker, signal.SIGKILL)
    again, another = ask(workers[0])
    assert again != worker
    assert another != mould


def test_none_is_left_when_the_workers_are_closed(until):
    opened = open_workers(Order(), 2)
    pids = {pid for worker in opened for pid in ask(worker)}
    opened[0].close()
    assert ask(opened[1])
    opened[1].close()
    until(lambda: not any(map(is_running, pids)))


def test_signals_of_a_terminal_or_a_stopping_system_are_for_the_service(workers):
    pids = ask(workers[0])
    for pid in pids:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            os.kill(pid, number)
    assert ask(workers[0]) == pids


def test_a_closed_pool_starts_no_process_again():
    pool = WorkerPool(Order())
    pool.enter()
    pool.leave()
    with pytest.raises(EOFError, match="closed"):
        pool.fork()
