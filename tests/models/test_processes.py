import os
import signal
import subprocess
import sys
import time

import pytest

from models.errors import DataError, MapError
from models.processes import forked, map_forked, one_process

SCRIPT = """
import os, time
from models.processes import map_forked

def work(task):
    print(os.getpid(), flush=True)
    time.sleep(60)

list(map_forked(work, range(100)))
"""


THREADS = """
import torch
from models.processes import forked, map_forked

def work(size):
    return float((torch.ones(size, size) @ torch.ones(size, size)).exp().sigmoid().sum())

one = work(512)
assert torch.get_num_threads() == 2
assert list(map_forked(work, [512] * 8)) == [one] * 8
with forked(lambda: work(512)) as result:
    assert result() == one
"""


def test_results_come_in_the_order_of_the_tasks() -> None:
    for count in (0, 3, 40):
        assert list(map_forked(lambda task: 2 * task, range(count))) == list(range(0, 2 * count, 2))


def test_all_is_done_here_where_that_is_asked_for() -> None:
    def in_process(_task):
        return os.getpid()

    with one_process():
        assert set(map_forked(in_process, range(40))) == {os.getpid()}
    assert os.getpid() not in set(map_forked(in_process, range(40)))


def test_work_beside_is_done_in_a_process_of_its_own_and_waited_for() -> None:
    here = os.getpid()
    with forked(lambda: (os.getpid(), set(map_forked(lambda _: os.getpid(), range(9))))) as result:
        there, shared = result()
    assert there != here
    assert shared == {there}, "and in no other: those who wait have the other CPUs"
    assert len({here, *map_forked(lambda _: os.getpid(), range(9))}) > 1
    with one_process(), forked(os.getpid) as result:
        assert result() == here


def test_what_goes_wrong_beside_is_raised_where_it_is_waited_for() -> None:
    def wrong() -> None:
        raise MapError("no map")

    with forked(wrong) as result, pytest.raises(MapError, match="no map"):
        result()
    with forked(lambda: os.kill(os.getpid(), signal.SIGKILL)) as result, pytest.raises(DataError, match="memory"):
        result()


def test_work_beside_ends_with_the_block_that_nobody_waits_in() -> None:
    start = time.monotonic()
    with forked(lambda: time.sleep(60)):
        pass
    assert time.monotonic() - start < 30


def test_no_process_outlives_the_one_that_was_killed() -> None:
    with subprocess.Popen([sys.executable, "-c", SCRIPT], stdout=subprocess.PIPE, text=True) as process:
        assert int(process.stdout.readline()) != process.pid
        process.kill()
        process.communicate(timeout=30)  # ends when nobody has the pipe any more


def test_libraries_whose_threads_have_run_already_are_used_in_forked_processes_too() -> None:
    environ = os.environ | {"OMP_NUM_THREADS": "2", "MKL_NUM_THREADS": "2"}
    subprocess.run([sys.executable, "-c", THREADS], env=environ, timeout=60, check=True)
