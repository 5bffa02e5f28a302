"""The process that opens an index, and the workers that are forked from it."""

import os
import signal
import socket
import subprocess
from collections.abc import Sequence
from contextlib import suppress
from multiprocessing.connection import Connection
from multiprocessing.reduction import send_handle
from threading import Lock
from typing import Final

from app.workers.launch import PROCESS, launch, take_prepared
from app.workers.order import FORK, OpenOrder
from index.answering.answers import IndexFacts
from models.citymap.frame import Frame

EXIT_S: Final = 5.0


class WorkerPool:
    """An index, opened in a process of its own, from which workers are forked.

    Args:
        order: what to open.
        command: of the process.

    Raises:
        HereaboutsError: it cannot be opened.
    """

    def __init__(self, order: OpenOrder, command: Sequence[str] = PROCESS) -> None:
        self._order, self._command = order, command
        self._lock = Lock()
        self._closed = False
        self._users = 0
        self._start()

    def _start(self) -> None:
        if self._command == PROCESS and (ahead := take_prepared()) is not None:
            try:
                self._open(*ahead)
            except (EOFError, OSError):  # somebody killed it
                self._bury()
            else:
                return
        self._open(*launch(self._command))

    def _open(self, process: subprocess.Popen[bytes], control: Connection) -> None:
        self._process, self._control = process, control
        self._control.send(self._order)
        opened = self._control.recv()
        if isinstance(opened, Exception):
            self._process.wait()
            raise opened
        self.facts: IndexFacts = opened[0]
        self.frame: Frame = opened[1]

    def fork(self) -> tuple[int, Connection, Connection]:
        """A new worker: its process id, its connection for queries, and that for everything else.

        Raises:
            EOFError: the pool is closed.
            HereaboutsError: the index had to be opened anew, as its process was gone, and cannot be any more.
        """
        with self._lock:
            if self._closed:
                raise EOFError("closed")
            try:
                return self._fork()
            except (EOFError, OSError):
                self._bury()
                self._start()
                return self._fork()

    def _fork(self) -> tuple[int, Connection, Connection]:
        pairs = [socket.socketpair() for _ in range(2)]
        try:
            self._control.send(FORK)
            for _, other in pairs:
                send_handle(self._control, other.fileno(), self._process.pid)
                other.close()
            queries, reads = (Connection(own.detach()) for own, _ in pairs)
        finally:
            for own, other in pairs:
                own.close()
                other.close()
        return queries.recv(), queries, reads

    def enter(self) -> None:
        """Note that somebody uses a worker."""
        with self._lock:
            self._users += 1

    def leave(self) -> None:
        """Note that somebody does no longer; after the last one, the process ends."""
        with self._lock:
            self._users -= 1
            if not self._users:
                self._closed = True
                self._bury()

    def _bury(self) -> None:
        self._control.close()
        try:
            self._process.wait(EXIT_S)
        except subprocess.TimeoutExpired:
            with suppress(ProcessLookupError):
                os.kill(self._process.pid, signal.SIGKILL)
            self._process.wait()
