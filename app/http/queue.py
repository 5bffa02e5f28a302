"""A bounded queue before the workers that hold the model."""

import asyncio
import math
import time
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from heapq import heappop, heappush
from threading import Condition, Lock, Thread
from typing import Final, NoReturn

import structlog

from app.http.errors import Code, Problem
from app.http.protocol import LocalizerLike
from index.answering.answers import Answer
from index.answering.query import Query
from models.errors import HereaboutsError

REFUSAL_DELAY_S = 0.2  # before a 429: clients that retry at once would take CPU time from accepted queries
INITIAL_QUERY_S = 0.05  # assumed time of a query before the first one is answered
UNAVAILABLE: Final = (Code.NOT_READY, Code.DRAINING, Code.LOAD_FAILED)  # problems of a queue that accepts no query
QUERY_ERRORS: Final = (Code.INVALID_REQUEST, Code.INDEX_NOT_FOUND, Code.INTERNAL_ERROR, *UNAVAILABLE)
QUERY_TIME_WEIGHT = 0.1  # of the latest query in the moving average
MAX_SLOWDOWN = 4.0  # times the average; a slower query is an outlier and counts as this slow

log = structlog.get_logger()


@dataclass(frozen=True, slots=True)
class ServedAnswer:
    """An answer and how long its query waited for a worker."""

    answer: Answer
    queue_ms: float


@dataclass(eq=False, slots=True)
class _PendingQuery:
    query: Query
    deadline_s: float
    submitted_s: float = field(default_factory=time.monotonic)
    result: Future[ServedAnswer] = field(default_factory=Future)

    def claim(self) -> bool:
        """Return whether to compute the query, which can then no longer be cancelled; a late query gets its error."""
        if not self.result.set_running_or_notify_cancel():
            return False
        if time.monotonic() < self.deadline_s:
            return True
        self.result.set_exception(Problem(Code.DEADLINE_EXCEEDED))
        return False


async def refuse(problem: Problem) -> NoReturn:
    """Raise a problem after a short delay."""
    await asyncio.sleep(REFUSAL_DELAY_S)
    raise problem


class InferenceQueue:
    """A bounded first-in, first-out queue with one thread per worker.

    One thread calls `open_localizers`. Then each localizer has a thread that takes the query that has waited longest.
    Each worker computes one query at a time: on a CPU, a batch is no faster per query, and every query would wait for
    the slowest. The first idle worker gets the query, because its memory and its cache of texts are most likely warm. A
    query whose client has left or whose deadline has passed is not computed. A query that would wait longer than
    `max_wait_s` is refused at once.
    """

    def __init__(
        self, open_localizers: Callable[[], Sequence[LocalizerLike]], max_queue: int, max_wait_s: float = math.inf
    ) -> None:
        self._open_localizers = open_localizers
        self._max_queue = max_queue
        self._max_wait_s = max_wait_s
        self._lock = Lock()
        self._idle: list[tuple[int, Condition]] = []  # heap of waiting threads, by the number of their localizer
        self._pending: deque[_PendingQuery] = deque()
        self._computing = 0
        self._query_s = INITIAL_QUERY_S  # moving average of the time of a query
        self._localizers: Sequence[LocalizerLike] = ()
        self._failure: str | None = None  # why no query is answered, as clients see it
        self.error: Exception | None = None  # raised by `open_localizers`
        self._is_draining = False
        self._is_closed = False
        self._threads: list[Thread] = []
        self._opened: Future[None] = Future()

    @property
    def localizer(self) -> LocalizerLike:
        """The first localizer, for its facts and cells but not for `localize`; 503 if it is not ready."""
        if self._failure is not None:
            raise Problem(Code.LOAD_FAILED, self._failure)
        if not self._localizers:
            raise Problem(Code.NOT_READY)
        return self._localizers[0]

    async def wait_until_open(self) -> None:
        """Wait until the localizers are open or have failed to open."""
        await asyncio.shield(asyncio.wrap_future(self._opened))  # cancelling one waiter must not cancel the others

    @property
    def num_waiting(self) -> int:
        """The number of waiting queries."""
        return len(self._pending)

    @property
    def num_workers(self) -> int:
        """The number of localizers that answer; 0 before they are open and after `fail`."""
        return 0 if self._failure is not None else len(self._localizers)

    @property
    def is_idle(self) -> bool:
        """Whether no query waits or is being computed."""
        with self._lock:
            return not self._pending and not self._computing

    def check_accepting(self) -> None:
        """Raise 503 if a query would not be accepted now."""
        if self._is_draining:
            raise Problem(Code.DRAINING)
        _ = self.localizer

    def start(self) -> None:
        """Start loading the localizers in a thread."""
        self._is_draining = self._is_closed = False
        self._opened = Future()
        self._threads = [Thread(target=self._open, name="inference", daemon=True)]
        self._threads[0].start()

    def drain(self) -> None:
        """Refuse new queries; waiting ones are still answered. Takes no lock: a signal handler may call it."""
        self._is_draining = True

    def fail(self, reason: str) -> None:
        """Refuse all queries from now on, including the waiting ones; `reason` tells clients what to do."""
        with self._lock:
            self._failure = reason
            waiting = [self._pending.popleft() for _ in range(len(self._pending))]
        for pending in waiting:
            if pending.claim():
                pending.result.set_exception(Problem(Code.LOAD_FAILED, reason))

    async def close(self) -> None:
        """Drain, answer the waiting queries, then end the threads."""
        self.drain()
        with self._lock:
            self._is_closed = True
            while self._idle:
                self._wake()
        for thread in self._threads:  # the first thread adds the others before it ends
            await asyncio.to_thread(thread.join)

    async def submit(self, query: Query, deadline_s: float) -> ServedAnswer:
        """Answer a query before the time.monotonic() `deadline_s`; 429 if the queue is full, 503 or 504.

        If the caller is cancelled before the computation begins, the query is not computed.
        """
        pending = _PendingQuery(query, deadline_s)
        with self._lock:
            self.check_accepting()
            refusal = self._refusal(deadline_s - time.monotonic())
            if refusal is None:
                self._pending.append(pending)
                self._wake()
        if refusal is not None:
            await refuse(refusal)
        try:
            async with asyncio.timeout(deadline_s - time.monotonic()):
                return await asyncio.wrap_future(pending.result)
        except TimeoutError:
            raise Problem(Code.DEADLINE_EXCEEDED) from None
        finally:
            self._discard(pending)

    def refusal(self) -> Problem | None:
        """Return the problem with which any query would be refused because the queue is full; None if it is not."""
        with self._lock:
            return self._refusal(math.inf) if self._localizers and not self._is_draining else None

    def _refusal(self, seconds: float) -> Problem | None:
        """Return why a query that can wait for this long is refused; None if it is accepted."""
        wait_s = self._query_s * (len(self._pending) + self._computing / 2) / len(self._localizers)
        if len(self._pending) < self._max_queue and wait_s <= min(self._max_wait_s, seconds):
            return None
        return Problem(Code.QUEUE_FULL, retry_after_s=max(1, math.ceil(wait_s)))

    def _discard(self, pending: _PendingQuery) -> None:
        with self._lock:
            if pending in self._pending:
                self._pending.remove(pending)

    def _open(self) -> None:
        localizers = self._try_to_open()
        self._localizers = localizers
        self._threads += [
            Thread(target=self._run, args=(n, localizer), name="inference", daemon=True)
            for n, localizer in enumerate(localizers[1:], 1)
        ]
        for thread in self._threads[1:]:
            thread.start()
        self._opened.set_result(None)
        if localizers:
            self._run(0, localizers[0])

    def _try_to_open(self) -> Sequence[LocalizerLike]:
        try:
            localizers = self._open_localizers()
        except HereaboutsError as error:
            log.error("load failed", reason=str(error))
            self.error = error
            self._failure = "the index or the model cannot be used; the reason is in the service's log"
            return ()
        except Exception as error:
            log.exception("load failed", reason=str(error))  # safe to log: no text was received yet
            self._failure = "an internal error occurred while loading; it is in the service's log"
            return ()
        facts = localizers[0].facts
        log.info("ready", index_version=facts.version, cells=facts.num_cells, workers=len(localizers))
        return localizers

    def _run(self, number: int, localizer: LocalizerLike) -> None:
        while pending := self._next_query(number):
            if pending.claim():
                self._compute(localizer, pending)
            with self._lock:
                self._computing -= 1
        localizer.close()

    def _next_query(self, number: int) -> _PendingQuery | None:
        """Wait for a query and return the oldest one; None when the queue is closed and empty."""
        with self._lock:
            while not self._pending and not self._is_closed:
                idle = Condition(self._lock)
                heappush(self._idle, (number, idle))
                idle.wait()
            if not self._pending:
                return None
            self._computing += 1
            return self._pending.popleft()

    def _wake(self) -> None:
        if self._idle:
            heappop(self._idle)[1].notify()

    def _compute(self, localizer: LocalizerLike, pending: _PendingQuery) -> None:
        started_s = time.monotonic()
        try:
            [answer] = localizer.localize([pending.query])
        except Exception as error:
            pending.result.set_exception(error)
        else:
            self._update_query_time(time.monotonic() - started_s)
            pending.result.set_result(ServedAnswer(answer, (started_s - pending.submitted_s) * 1000))

    def _update_query_time(self, query_s: float) -> None:
        with self._lock:
            self._query_s += QUERY_TIME_WEIGHT * (min(query_s, MAX_SLOWDOWN * self._query_s) - self._query_s)
