"""A localizer in a process of its own, as the service sees it."""

from collections.abc import Sequence
from multiprocessing.connection import Connection
from threading import Lock
from typing import Any, Final

import structlog

from app.workers.order import OpenOrder, WorkerFault
from app.workers.pool import WorkerPool
from index.answering.answers import Answer, CellDetail, CellSummary, Described, IndexFacts
from index.answering.query import Query
from models.citymap.frame import Frame
from models.citymap.scenery.files import SceneryPart

TRIES: Final = 2  # a worker that dies may have been killed; what kills a second one is at fault itself

log = structlog.get_logger()


class RemoteLocalizer:
    """Has a worker answer; `localize` is for one thread, everything else for any.

    Args:
        pool: forks the worker, and another one if it dies.
    """

    def __init__(self, pool: WorkerPool) -> None:
        self._pool = pool
        self._changing = Lock()
        self._reading = Lock()
        self._pid, self._queries, self._reads = pool.fork()
        pool.enter()

    @property
    def facts(self) -> IndexFacts:
        """What the index says of itself."""
        return self._pool.facts

    @property
    def frame(self) -> Frame:
        """What the map's metres mean on Earth."""
        return self._pool.frame

    @property
    def pid(self) -> int:
        """The worker's process."""
        return self._pid

    def localize(self, queries: Sequence[Query]) -> list[Answer]:
        """See `app.http.protocol.LocalizerLike`."""
        answers: list[Answer] = self._tried("_queries", "localize", list(queries))
        return answers

    def describe(self, position_m: tuple[float, float]) -> Described | None:
        """See `app.http.protocol.LocalizerLike`."""
        found: Described | None = self._read("describe", position_m)
        return found

    def cell(self, cell_id: str) -> CellDetail | None:
        """See `app.http.protocol.LocalizerLike`."""
        found: CellDetail | None = self._read("cell", cell_id)
        return found

    def cells(self, first: int, count: int) -> list[CellSummary]:
        """See `app.http.protocol.LocalizerLike`."""
        found: list[CellSummary] = self._read("cells", first, count)
        return found

    def scenery(self, number: int) -> SceneryPart | None:
        """See `app.http.protocol.LocalizerLike`."""
        found: SceneryPart | None = self._read("scenery", number)
        return found

    def close(self) -> None:
        """End the worker, and with the last one of a pool its process."""
        self._queries.close()
        self._reads.close()
        self._pool.leave()

    def _read(self, name: str, *arguments: Any) -> Any:
        with self._reading:
            return self._tried("_reads", name, *arguments)

    def _tried(self, connection: str, name: str, *arguments: Any) -> Any:
        for left in range(TRIES)[::-1]:
            asked: Connection = getattr(self, connection)
            try:
                asked.send((name, arguments))
                answer = asked.recv()
            except (EOFError, OSError) as error:
                self._replace(asked, connection)
                if left == 0:
                    said = f"workers die of {name}"
                    raise WorkerFault(said, said) from error
                continue
            if isinstance(answer, Exception):
                raise answer
            return answer
        raise AssertionError

    def _replace(self, lost: Connection, connection: str) -> None:
        """Fork another worker, unless the other connection's thread did; that one closes its own lost connection."""
        with self._changing:
            if getattr(self, connection) is lost:
                log.warning("worker lost", pid=self._pid)
                self._pid, self._queries, self._reads = self._pool.fork()
        lost.close()


def open_workers(order: OpenOrder, count: int) -> list[RemoteLocalizer]:
    """Workers that answer from one index.

    Raises:
        HereaboutsError: it cannot be opened.
    """
    pool = WorkerPool(order)
    return [RemoteLocalizer(pool) for _ in range(count)]
