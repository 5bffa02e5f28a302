"""Time and memory of the processes that are measured."""

import os
import subprocess
import sys
from threading import Lock, Thread

from app.benchmark import processes


def test_memory_counts_what_another_thread_has_started() -> None:
    """Workers of the service come of another thread than its first."""
    code = "import sys; held = bytearray(b'x') * (200 << 20); print('ready', flush=True); sys.stdin.read()"
    started = []

    def start() -> None:
        pipe = subprocess.PIPE
        started.append(subprocess.Popen([sys.executable, "-c", code], stdin=pipe, stdout=pipe))
        started[0].stdout.readline()
        done.acquire()

    done = Lock()
    done.acquire()
    before, thread = processes._memory_mib(os.getpid()), Thread(target=start)
    thread.start()
    try:
        while not started or processes._memory_mib(started[0].pid) < 200:
            assert thread.is_alive()
        assert processes._memory_mib(os.getpid()) > before + 150
    finally:
        done.release()
        thread.join()
        with started[0]:
            started[0].stdin.close()


def test_memory_counts_pages_of_a_file_whole_whoever_has_it_open(tmp_path) -> None:
    size, file = 64 << 20, tmp_path / "library"
    file.write_bytes(bytes(size))
    code = f"""
import mmap, sys
with open({str(file)!r}, "rb") as file:
    held = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
assert not any(held[n] for n in range(0, {size}, 4096))
print("ready", flush=True)
sys.stdin.read()
"""
    pipe = subprocess.PIPE
    twins = [subprocess.Popen([sys.executable, "-c", code], stdin=pipe, stdout=pipe) for _ in range(3)]
    try:
        for twin in twins:
            twin.stdout.readline()
        alone = [processes._memory_mib(twin.pid) for twin in twins]
        assert all(64 <= mib < 128 for mib in alone), "as PSS it would be a third of the file"
    finally:
        for twin in twins:
            with twin:
                twin.stdin.close()
