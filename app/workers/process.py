"""The processes that hold the model: `python -m app.workers.process [MODULE ...] FD`.

The first process opens an index and forks workers on request. Workers share its memory, and each answers on two
connections: one for queries and one for calls that need no model. The first process exits when FD closes, and a worker
when its connections close, so that none outlives the service.
"""

import os
import signal
import sys
import traceback
from collections.abc import Sequence
from importlib import import_module
from multiprocessing.connection import Connection
from multiprocessing.reduction import recv_handle
from threading import Thread
from typing import TYPE_CHECKING, Final

from app.redaction import redacted_traceback
from app.workers.messages import FORK, WorkerFault
from models.errors import HereaboutsError
from models.memory import drop_code_pages, drop_pages

if TYPE_CHECKING:
    from index.answering.localizer import Localizer

SIGNALS: Final = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)  # left to the service, which drains


def main(control: Connection, preloaded: Sequence[str] = ()) -> None:
    """Open the index of the first message, answer with (facts, frame) or an error, then fork workers on request."""
    for number in SIGNALS:
        signal.signal(number, signal.SIG_IGN)
    try:
        for name in preloaded:
            import_module(name)
        try:
            spec = control.recv()
        except EOFError:
            return  # the service is gone
        localizer = spec.open()
    except Exception as error:
        control.send(_to_picklable(error))
        return
    drop_pages()
    drop_code_pages()
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # exited workers are reaped automatically
    control.send((localizer.facts, localizer.frame))
    while True:
        try:
            assert control.recv() == FORK
            handles = recv_handle(control), recv_handle(control)
        except (EOFError, OSError):
            return
        if os.fork() == 0:
            control.close()
            _work(localizer, *(Connection(handle) for handle in handles))
            os._exit(0)
        for handle in handles:
            os.close(handle)


def _work(localizer: "Localizer", queries: Connection, reads: Connection) -> None:
    Thread(target=_answer, args=(localizer, reads), daemon=True).start()
    queries.send(os.getpid())
    _answer(localizer, queries)


def _answer(localizer: "Localizer", connection: Connection) -> None:
    """Answer calls (name of a method, arguments), one after another."""
    while True:
        try:
            name, arguments = connection.recv()
        except (EOFError, OSError):
            return
        try:
            answer = getattr(localizer, name)(*arguments)
        except Exception as error:
            answer = _to_picklable(error)
        try:
            connection.send(answer)
        except OSError:
            return


def _to_picklable(error: Exception) -> Exception:
    """Return an error that can be pickled: user errors as they are, others as text."""
    if isinstance(error, HereaboutsError):
        return error
    return WorkerFault("".join(traceback.format_exception(error)), redacted_traceback(error))


if __name__ == "__main__":
    main(Connection(int(sys.argv[-1])), sys.argv[1:-1])
