"""The process that opens an index and the workers forked from it."""

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

from app.workers.launch import PROCESS, launch, take_prelaunched
from app.workers.messages import FORK, LocalizerSpec
from index.answering.answers import IndexFacts
from models.citymap.frame import Frame

EXIT_TIMEOUT_S: Final = 5.0  # for the process to exit after its connection closed


class WorkerPool:
    """A process that has opened an index and forks workers; HereaboutsError if it cannot be opened."""

    def __init__(self, spec: LocalizerSpec, command: Sequence[str] = PROCESS) -> None:
        self._spec, self._command = spec, command
        self._lock = Lock()
        self._closed = False
        self._users = 0
        self._start()

    def _start(self) -> None:
        if self._command == PROCESS and (prelaunched := take_prelaunched()) is not None:
            try:
                self._open(*prelaunched)
            except (EOFError, OSError):  # it was killed
                self._end_process()
            else:
                return
        self._open(*launch(self._command))

    def _open(self, process: subprocess.Popen[bytes], control: Connection) -> None:
        self._process, self._control = process, control
        self._control.send(self._spec)
        opened = self._control.recv()
        if isinstance(opened, Exception):
            self._process.wait()
            raise opened
        self.facts: IndexFacts = opened[0]
        self.frame: Frame = opened[1]

    def fork(self) -> tuple[int, Connection, Connection]:
        """Fork a worker; return its process id, its connection for queries and its connection for other calls.

        EOFError if the pool is closed. A process that had died is started again.
        """
        with self._lock:
            if self._closed:
                raise EOFError("closed")
            try:
                return self._fork()
            except (EOFError, OSError):
                self._end_process()
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
        """Count a user of the pool."""
        with self._lock:
            self._users += 1

    def leave(self) -> None:
        """Release a user of the pool; after the last one, the process ends."""
        with self._lock:
            self._users -= 1
            if not self._users:
                self._closed = True
                self._end_process()

    def _end_process(self) -> None:
        self._control.close()
        try:
            self._process.wait(EXIT_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            with suppress(ProcessLookupError):
                os.kill(self._process.pid, signal.SIGKILL)
            self._process.wait()
