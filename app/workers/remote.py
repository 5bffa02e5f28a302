"""A localizer in a worker process, as the service sees it."""

from collections.abc import Sequence
from multiprocessing.connection import Connection
from threading import Lock
from typing import Any, Final

import structlog

from app.workers.messages import LocalizerSpec, WorkerFault
from app.workers.pool import WorkerPool
from index.answering.answers import Answer, CellDetail, CellSummary, Described, IndexFacts
from index.answering.query import Query
from models.citymap.frame import Frame
from models.citymap.scenery.files import SceneryPart

MAX_TRIES: Final = 2  # one lost worker may have been killed; a call that loses two is itself the cause

log = structlog.get_logger()


class RemoteLocalizer:
    """A `LocalizerLike` that calls a worker process of a pool, which replaces it if it dies."""

    def __init__(self, pool: WorkerPool) -> None:
        self._pool = pool
        self._changing = Lock()
        self._reading = Lock()
        self.pid, self._queries, self._reads = pool.fork()
        pool.enter()

    @property
    def facts(self) -> IndexFacts:
        """The facts in the manifest of the index."""
        return self._pool.facts

    @property
    def frame(self) -> Frame:
        """The coordinate frame of the map."""
        return self._pool.frame

    def localize(self, queries: Sequence[Query]) -> list[Answer]:
        """Return one answer per query."""
        return self._call("_queries", "localize", list(queries))

    def describe(self, position_m: tuple[float, float], language: str | None = None) -> Described | None:
        """Describe a position."""
        return self._read("describe", position_m, language)

    def position_of(self, source_id: str) -> tuple[float, float] | None:
        """Return the position of an object."""
        return self._read("position_of", source_id)

    def cell(self, cell_id: str) -> CellDetail | None:
        """Return a cell."""
        return self._read("cell", cell_id)

    def cells(self, first: int, count: int) -> list[CellSummary]:
        """Return a page of cells."""
        return self._read("cells", first, count)

    def scenery(self, number: int) -> SceneryPart | None:
        """Return a part of the scenery."""
        return self._read("scenery", number)

    def close(self) -> None:
        """End the worker; the last worker of a pool also ends the pool's process."""
        self._queries.close()
        self._reads.close()
        self._pool.leave()

    def _read(self, name: str, *arguments: Any) -> Any:
        with self._reading:
            return self._call("_reads", name, *arguments)

    def _call(self, attribute: str, name: str, *arguments: Any) -> Any:
        for tries_left in range(MAX_TRIES)[::-1]:
            connection: Connection = getattr(self, attribute)
            try:
                connection.send((name, arguments))
                answer = connection.recv()
            except (EOFError, OSError) as error:
                self._replace(connection, attribute)
                if tries_left == 0:
                    message = f"{name} makes workers crash"
                    raise WorkerFault(message, message) from error
                continue
            if isinstance(answer, Exception):
                raise answer
            return answer
        raise AssertionError

    def _replace(self, lost: Connection, attribute: str) -> None:
        """Fork another worker unless the thread of the other connection has done so; close only the lost connection."""
        with self._changing:
            if getattr(self, attribute) is lost:
                log.warning("worker lost", pid=self.pid)
                self.pid, self._queries, self._reads = self._pool.fork()
        lost.close()


def open_workers(spec: LocalizerSpec, count: int) -> list[RemoteLocalizer]:
    """Open an index in `count` workers; HereaboutsError if it cannot be opened."""
    pool = WorkerPool(spec)
    return [RemoteLocalizer(pool) for _ in range(count)]
