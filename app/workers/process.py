"""The processes that hold a model: `python -m app.workers.process [MODULE ...] FD`.

The first opens an index and is the mould: on request it forks workers, which share its memory and each answer on two
connections of their own, one for queries and one for what needs no model. It ends when FD closes, a worker when its
connections do, so that none outlives the service.
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

from app.fault_logging import where
from app.startup import no_collection
from app.workers.order import FORK, WorkerFault
from models.errors import HereaboutsError
from models.processes import forget_code, give_back, share_one_heap

if TYPE_CHECKING:
    from index.answering.localizer import Localizer

IDLE_S: Final = 1.0  # without calls, and memory is given back
MANY: Final = 100  # calls since it was the last time; the next one has to take it again
SIGNALS: Final = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)  # are for the service, which drains


def main(control: Connection, ahead: Sequence[str] = ()) -> None:
    """Open what the first message says, answer (facts, frame) or an error, then fork workers as they are asked for.

    Args:
        control: to the service.
        ahead: modules to import before there is a message.
    """
    for number in SIGNALS:
        signal.signal(number, signal.SIG_IGN)
    share_one_heap()
    try:
        with no_collection():
            for name in ahead:
                import_module(name)
            try:
                order = control.recv()
            except EOFError:
                return  # the service has ended
            localizer = order.open()
    except Exception as error:
        control.send(_as_sent(error))
        return
    give_back()  # what opening needed for a moment, or every worker would have it too
    forget_code()
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # the dead are buried at once
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
    """Answer until the service closes the connection for queries."""
    Thread(target=_answer, args=(localizer, reads), daemon=True).start()
    queries.send(os.getpid())
    _answer(localizer, queries)


def _answer(localizer: "Localizer", asked: Connection) -> None:
    """Answer calls (name of a method, arguments), one after another."""
    answered = 0
    while True:
        try:
            if answered >= MANY and not asked.poll(IDLE_S):
                give_back()
                answered = 0
            name, arguments = asked.recv()
        except (EOFError, OSError):
            return
        answered += 1
        try:
            answer = getattr(localizer, name)(*arguments)
        except Exception as error:
            answer = _as_sent(error)
        try:
            asked.send(answer)
        except OSError:
            return


def _as_sent(error: Exception) -> Exception:
    """An error that another process can read: those that users meet are themselves, others become text."""
    if isinstance(error, HereaboutsError):
        return error
    return WorkerFault("".join(traceback.format_exception(error)), where(error))


if __name__ == "__main__":
    main(Connection(int(sys.argv[-1])), sys.argv[1:-1])
