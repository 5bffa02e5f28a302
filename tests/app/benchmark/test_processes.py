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
