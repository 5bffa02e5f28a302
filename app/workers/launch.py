"""Starting the processes that hold a model, without importing anything of what they do: that would make them wait."""

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
AHEAD: Final = "index.answering.localizer"  # brings torch, which takes seconds
ROOT: Final = Path(__file__).parents[2]  # where the processes find this very code


def launch(command: Sequence[str]) -> tuple[subprocess.Popen[bytes], Connection]:
    """Start a process that opens what it is told to, and ends when its connection does."""
    own, other = socket.socketpair()
    with own, other:
        process = subprocess.Popen(
            [*command, str(other.fileno())],
            stdin=subprocess.DEVNULL,
            pass_fds=[other.fileno()],
            cwd=ROOT,
            env={**os.environ, **dict.fromkeys(THREAD_VARIABLES, "1"), "TOKENIZERS_PARALLELISM": "false"},
            start_new_session=True,  # what a terminal sends is for the service alone
        )
        return process, Connection(own.detach())


@contextmanager
def prepared() -> Iterator[None]:
    """Have the process of the next pool import what it needs while the service imports the rest."""
    _prepared.append(launch((*PROCESS, AHEAD)))
    try:
        yield
    finally:
        while (left := take_prepared()) is not None:  # no pool was opened
            process, control = left
            control.close()
            process.kill()
            process.wait()


def take_prepared() -> tuple[subprocess.Popen[bytes], Connection] | None:
    """The process that is importing ahead, whose caller ends it from now on; None if there is none."""
    return _prepared.pop() if _prepared else None


_prepared: Final[list[tuple[subprocess.Popen[bytes], Connection]]] = []
