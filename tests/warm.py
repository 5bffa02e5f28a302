"""Starting the processes of the service without their imports, which take seconds: a warm process forks them.

`Warm.command` is for who starts them: a small python that hands its own streams to the warm process and ends as what
was forked ends, and whose end is that one's. `main` is the warm process.
"""

import importlib
import json
import os
import selectors
import signal
import socket
import subprocess
import sys
import traceback
from contextlib import suppress
from multiprocessing.connection import Connection
from pathlib import Path

ROOT = Path(__file__).parents[1]
STARTER = """
import array, json, os, socket, sys
path, module, argument = sys.argv[1:]
fds = [0, 1, 2, *([int(argument)] if argument.isdecimal() else [])]
order = json.dumps([module, argument, os.getcwd(), dict(os.environ)]).encode()
with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as warm:
    warm.connect(path)
    warm.sendmsg([order], [(socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", fds))])
    for fd in fds:
        os.close(fd)
    os._exit(int(warm.recv(16)))
"""


class Warm:
    """The warm process, from outside; ends with whoever started it.

    Args:
        scratch: a directory for its socket and its log.
    """

    def __init__(self, scratch: Path) -> None:
        self._socket = scratch / "warm"
        with (scratch / "warm.log").open("wb") as log:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "tests.warm", str(self._socket)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
                cwd=ROOT,
            )
        assert self._process.stdout is not None
        assert self._process.stdout.readline(), (scratch / "warm.log").read_text()

    def command(self, module: str) -> tuple[str, ...]:
        """Starts in place of `python -m MODULE`, with one argument."""
        return (sys.executable, "-I", "-S", "-c", STARTER, str(self._socket), module)

    def close(self) -> None:
        """End it, and what it has forked."""
        self._process.communicate()


def main(path: str) -> None:
    """Fork what is asked for until stdin closes."""
    for module in (
        "app.workers.process",
        "app.jobs.worker",
        "index.answering.localizer",
        "index.evaluation.evaluation",
    ):
        importlib.import_module(module)
    with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as listener, selectors.DefaultSelector() as events:
        listener.bind(path)
        listener.listen()
        events.register(listener, selectors.EVENT_READ)
        events.register(sys.stdin, selectors.EVENT_READ)
        print("warm", flush=True)
        running: dict[int, tuple[int, socket.socket]] = {}  # by process: its descriptor, and who asked for it
        while True:
            for key, _ in events.select():
                if key.fileobj is sys.stdin:
                    for pid in running:
                        _kill(pid)
                    return
                if key.fileobj is listener:
                    starter = listener.accept()[0]
                    order, fds, *_ = socket.recv_fds(starter, 1 << 20, 4)
                    if not order:  # the starter was killed before it could send one
                        starter.close()
                        continue
                    pid = _fork(order, fds)
                    running[pid] = ended, _ = os.pidfd_open(pid), starter
                    for one in (ended, starter):
                        events.register(one, selectors.EVENT_READ, pid)
                elif key.data in running:
                    ended, starter = running.pop(key.data)
                    for one in (ended, starter):
                        events.unregister(one)
                    os.close(ended)
                    _tell(starter, _kill(key.data))


def _kill(pid: int) -> int:
    """The status of a process that has ended, or whose starter has and it has to, with all that it has forked."""
    for kill in (os.kill, os.killpg):
        with suppress(ProcessLookupError):
            kill(pid, signal.SIGKILL)
    return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])


def _tell(starter: socket.socket, status: int) -> None:
    with starter, suppress(OSError):
        starter.send(str(status % 256).encode())


def _fork(order: bytes, fds: list[int]) -> int:
    module, argument, cwd, environ = json.loads(order)
    pid = os.fork()
    if pid:
        for fd in fds:
            os.close(fd)
        return pid
    status = 1
    try:
        os.setsid()
        for n, fd in enumerate(fds[:3]):
            os.dup2(fd, n)
            os.close(fd)
        os.chdir(cwd)
        os.environ.clear()
        os.environ.update(environ)
        run = importlib.import_module(module).main
        status = run(Connection(fds[3]) if argument.isdecimal() else Path(argument)) or 0
    except BaseException:
        traceback.print_exc()
    finally:
        os._exit(status)


if __name__ == "__main__":
    main(sys.argv[1])
