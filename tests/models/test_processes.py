import ctypes
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


HEAPS = """
import ctypes, sys, threading
from models.processes import share_one_heap
if sys.argv[1] == "one":
    share_one_heap()
libc, sizes = ctypes.CDLL(None), []
libc.fopen.restype, libc.malloc.restype = ctypes.c_void_p, ctypes.c_void_p
meet = threading.Barrier(4)
def take():
    meet.wait()
    libc.malloc(1000)
    meet.wait()
threads = [threading.Thread(target=take) for _ in range(4)]
[thread.start() for thread in threads]
[thread.join() for thread in threads]
file = ctypes.c_void_p(libc.fopen(sys.argv[2].encode(), b"w"))
libc.malloc_info(0, file)
libc.fclose(file)
"""


@pytest.mark.skipif(not hasattr(ctypes.CDLL(None), "malloc_info"), reason="only glibc has several heaps")
def test_libraries_whose_threads_have_run_already_are_used_in_forked_processes_too() -> None:
    environ = os.environ | {"OMP_NUM_THREADS": "2", "MKL_NUM_THREADS": "2"}
    subprocess.run([sys.executable, "-c", THREADS], env=environ, timeout=60, check=True)


def test_threads_share_one_heap(tmp_path) -> None:
    heaps = {}
    for how in ("one", "several"):
        subprocess.run([sys.executable, "-c", HEAPS, how, str(tmp_path / how)], check=True, timeout=60)
        heaps[how] = (tmp_path / how).read_text().count("<heap nr=")
    assert heaps["one"] == 1
    assert heaps["several"] > 1


CODE = """
import re
import torch
from models.processes import forget_code

def mapped_kib():
    regions = re.split(r"^(?=[0-9a-f]+-[0-9a-f]+ )", open("/proc/self/smaps").read(), flags=re.M)
    code = [region for region in regions if re.match(r"\\S+ r-xp .*libtorch_cpu", region)]
    return sum(int(re.search(r"^Rss: +(\\d+)", region, re.M)[1]) for region in code)

before = mapped_kib()
forget_code()
print(before, mapped_kib(), int((torch.ones(9) * 2).sum()))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux says what is mapped")
def test_code_that_was_run_is_forgotten_and_runs_again() -> None:
    said = subprocess.run([sys.executable, "-c", CODE], check=True, timeout=120, capture_output=True, text=True).stdout
    before, after, total = map(int, said.split())
    assert total == 18
    assert after < before / 2
