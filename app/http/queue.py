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

REFUSED_S = 0.2  # before a refusal is said: clients that ask again at once would else take the time of those answered
FIRST_S = 0.05  # that a query is thought to take before one was answered
UNAVAILABLE: Final = (Code.NOT_READY, Code.DRAINING, Code.LOAD_FAILED)  # why a query is not taken
LEARNING, SLOWER = 0.1, 4.0  # weight of the last query; what is so much slower than usual is an exception

log = structlog.get_logger()


@dataclass(frozen=True, slots=True)
class Served:
    """An answer, and how long its query waited for the model."""

    answer: Answer
    queue_ms: float


@dataclass(eq=False, slots=True)
class _Job:
    query: Query
    deadline_s: float
    submitted_s: float = field(default_factory=time.monotonic)
    result: Future[Served] = field(default_factory=Future)

    def begins(self) -> bool:
        """Whether to compute it; after True it can no longer be cancelled. When late, it is answered with that."""
        if not self.result.set_running_or_notify_cancel():
            return False
        if time.monotonic() < self.deadline_s:
            return True
        self.result.set_exception(Problem(Code.DEADLINE_EXCEEDED))
        return False


async def refuse(full: Problem) -> NoReturn:
    """Say so a little later.

    Raises:
        Problem: that which is given.
    """
    await asyncio.sleep(REFUSED_S)
    raise full


class InferenceQueue:
    """Answers queries on as many threads as there are workers, one after another as they come.

    A thread opens the localizers, then each of them has a thread that takes what has waited longest. Several at once
    would be no faster a query on a CPU, and all of them would wait for the last. Of those that are idle the first is
    asked, whose memory is at hand and which remembers most texts. A query whose client left or whose deadline is past
    is not computed; one that would wait too long is refused at once.

    Args:
        open_localizers: run once; each of what it gives answers on a thread of its own.
        max_queue: queries that wait.
        max_wait_s: that a query may be expected to wait.
    """

    def __init__(
        self,
        open_localizers: Callable[[], Sequence[LocalizerLike]],
        max_queue: int,
        max_wait_s: float = math.inf,
    ) -> None:
        self._open_localizers = open_localizers
        self._max_queue = max_queue
        self._max_wait_s = max_wait_s
        self._lock = Lock()
        self._idle: list[tuple[int, Condition]] = []  # heap, by number of the localizer, of threads that wait for a job
        self._jobs: deque[_Job] = deque()
        self._computing = 0
        self._query_s = FIRST_S  # that a worker takes for a query, a moving average
        self._localizers: Sequence[LocalizerLike] = ()
        self._failure: str | None = None  # why nothing is answered, in words for clients
        self._error: Exception | None = None
        self._is_draining = False
        self._is_closed = False
        self._threads: list[Thread] = []
        self._opened: Future[None] = Future()

    @property
    def localizer(self) -> LocalizerLike:
        """The localizer, for its facts and cells; `localize` belongs to the threads of the queue.

        Raises:
            Problem: not ready, or it could not be loaded.
        """
        if self._failure is not None:
            raise Problem(Code.LOAD_FAILED, self._failure)
        if not self._localizers:
            raise Problem(Code.NOT_READY)
        return self._localizers[0]

    async def opened(self) -> None:
        """Wait until the localizers are there, or cannot be opened."""
        await asyncio.shield(asyncio.wrap_future(self._opened))  # who waits no more must not cancel it for others

    @property
    def failure(self) -> Exception | None:
        """Why the localizers could not be opened, if they could not."""
        return self._error

    @property
    def num_waiting(self) -> int:
        """Queries that wait."""
        return len(self._jobs)

    @property
    def num_workers(self) -> int:
        """Localizers that answer; 0 until they are there, and once they must not."""
        return 0 if self._failure is not None else len(self._localizers)

    @property
    def is_draining(self) -> bool:
        """Whether new queries are refused for good."""
        return self._is_draining

    @property
    def is_idle(self) -> bool:
        """Whether nothing waits and nothing is computed."""
        with self._lock:
            return not self._jobs and not self._computing

    def check_accepting(self) -> None:
        """Pass if a query would be taken now.

        Raises:
            Problem: draining, not ready, or not loaded.
        """
        if self._is_draining:
            raise Problem(Code.DRAINING)
        _ = self.localizer

    def start(self) -> None:
        """Start to load the localizers."""
        self._is_draining = self._is_closed = False
        self._opened = Future()
        self._threads = [Thread(target=self._open, name="inference", daemon=True)]
        self._threads[0].start()

    def drain(self) -> None:
        """Refuse new queries; the waiting ones are answered. Takes no lock: a signal handler may call it."""
        self._is_draining = True

    def fail(self, reason: str) -> None:
        """Refuse all queries from now on, those that wait too: what was opened is not what it should be.

        Args:
            reason: what is wrong and what to do, for clients.
        """
        with self._lock:
            self._failure = reason
            waiting = [self._jobs.popleft() for _ in range(len(self._jobs))]
        for job in waiting:
            if job.begins():
                job.result.set_exception(Problem(Code.LOAD_FAILED, reason))

    async def close(self) -> None:
        """Drain, wait for the waiting queries, end the threads."""
        self.drain()
        with self._lock:
            self._is_closed = True
            while self._idle:
                self._wake()
        for thread in self._threads:  # the first adds the others before it ends
            await asyncio.to_thread(thread.join)

    async def submit(self, query: Query, deadline_s: float) -> Served:
        """Answer a query. When the caller is cancelled before the computation begins, it never begins.

        Args:
            query: what to localize.
            deadline_s: time.monotonic() by which an answer is worth something.

        Raises:
            Problem: queue full, not accepting, or no answer before the deadline.
        """
        job = _Job(query, deadline_s)
        with self._lock:
            self.check_accepting()
            full = self._full(deadline_s - time.monotonic())
            if full is None:
                self._jobs.append(job)
                self._wake()
        if full is not None:
            await refuse(full)
        try:
            async with asyncio.timeout(deadline_s - time.monotonic()):
                return await asyncio.wrap_future(job.result)
        except TimeoutError:
            raise Problem(Code.DEADLINE_EXCEEDED) from None
        finally:
            self._forget(job)

    def full(self) -> Problem | None:
        """Why a query would be refused as too many wait, however long it may take; None if that is not why."""
        with self._lock:
            return self._full(math.inf) if self._localizers and not self._is_draining else None

    def _full(self, seconds: float) -> Problem | None:
        """Why a query that may take so long is refused, if it is."""
        wait_s = self._query_s * (len(self._jobs) + self._computing / 2) / len(self._localizers)
        if len(self._jobs) < self._max_queue and wait_s <= min(self._max_wait_s, seconds):
            return None
        return Problem(Code.QUEUE_FULL, retry_after_s=max(1, math.ceil(wait_s)))

    def _forget(self, job: _Job) -> None:
        with self._lock:
            if job in self._jobs:
                self._jobs.remove(job)

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
        """The localizers; none if they cannot be opened."""
        try:
            localizers = self._open_localizers()
        except HereaboutsError as error:
            log.error("load failed", reason=str(error))
            self._error = error
            self._failure = "the index or the model cannot be used; the operator finds in the log why"
            return ()
        except Exception as error:
            log.exception("load failed", reason=str(error))  # nobody has said anything yet
            self._failure = "a fault in the service while loading; the operator finds it in the log"
            return ()
        facts = localizers[0].facts
        log.info("ready", index_version=facts.version, cells=facts.num_cells, workers=len(localizers))
        return localizers

    def _run(self, number: int, localizer: LocalizerLike) -> None:
        while job := self._take(number):
            if job.begins():
                self._compute(localizer, job)
            with self._lock:
                self._computing -= 1
        localizer.close()

    def _take(self, number: int) -> _Job | None:
        """What has waited longest; waits for it; None when closed and nothing is left."""
        with self._lock:
            while not self._jobs and not self._is_closed:
                idle = Condition(self._lock)
                heappush(self._idle, (number, idle))
                idle.wait()
            if not self._jobs:
                return None
            self._computing += 1
            return self._jobs.popleft()

    def _wake(self) -> None:
        if self._idle:
            heappop(self._idle)[1].notify()

    def _compute(self, localizer: LocalizerLike, job: _Job) -> None:
        started_s = time.monotonic()
        try:
            [answer] = localizer.localize([job.query])
        except Exception as error:
            job.result.set_exception(error)
        else:
            self._learn(time.monotonic() - started_s)
            job.result.set_result(Served(answer, (started_s - job.submitted_s) * 1000))

    def _learn(self, query_s: float) -> None:
        with self._lock:
            self._query_s += LEARNING * (min(query_s, SLOWER * self._query_s) - self._query_s)
