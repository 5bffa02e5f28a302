"""Starting worker processes, without importing their heavy modules here, which would delay the start."""

import os
import socket
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Final

from app.threads import THREAD_VARIABLES

PROCESS: Final = (sys.executable, "-m", "app.workers.process")
PRELOADED_MODULE: Final = "index.answering.localizer"  # imports torch, which takes seconds
ROOT: Final = Path(__file__).parents[2]  # the processes import the same code


def launch(command: Sequence[str]) -> tuple[subprocess.Popen[bytes], Connection]:
    """Start a process that exits when the returned connection closes."""
    own, other = socket.socketpair()
    with own, other:
        process = subprocess.Popen(
            [*command, str(other.fileno())],
            stdin=subprocess.DEVNULL,
            pass_fds=[other.fileno()],
            cwd=ROOT,
            env={**os.environ, **dict.fromkeys(THREAD_VARIABLES, "1"), "TOKENIZERS_PARALLELISM": "false"},
            start_new_session=True,  # signals of a terminal are for the service only
        )
        return process, Connection(own.detach())


@contextmanager
def prelaunched() -> Iterator[None]:
    """Start the process of the next pool early, so that it imports torch while the service imports the rest."""
    _prelaunched.append(launch((*PROCESS, PRELOADED_MODULE)))
    try:
        yield
    finally:
        while (unused := take_prelaunched()) is not None:  # no pool was opened
            process, control = unused
            control.close()
            process.kill()
            process.wait()


def take_prelaunched() -> tuple[subprocess.Popen[bytes], Connection] | None:
    """Return the early process, which the caller has to end; None if there is none."""
    return _prelaunched.pop() if _prelaunched else None


_prelaunched: Final[list[tuple[subprocess.Popen[bytes], Connection]]] = []
