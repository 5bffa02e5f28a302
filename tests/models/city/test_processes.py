import os
import subprocess
import sys

from models.city.processes import map_forked, one_process

SCRIPT = """
import os, time
from models.city.processes import map_forked

def work(task):
    print(os.getpid(), flush=True)
    time.sleep(60)

list(map_forked(work, range(100)))
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


def test_no_process_outlives_the_one_that_was_killed() -> None:
    with subprocess.Popen([sys.executable, "-c", SCRIPT], stdout=subprocess.PIPE, text=True) as process:
        assert int(process.stdout.readline()) != process.pid
        process.kill()
        process.communicate(timeout=30)  # ends when nobody has the pipe any more
