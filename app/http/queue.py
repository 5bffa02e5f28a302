"""One thread that owns the model, a bounded queue before it, and micro-batches of whatever waits."""

import asyncio
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, field
from threading import Condition, Thread

import structlog

from app.http.errors import Code, Problem
from app.http.protocol import LocalizerLike
from app.startup import no_collection
from index.answers import Answer
from index.query import Query
from models.errors import HereaboutsError

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
        """Whether to compute it; after True it can no longer be cancelled."""
        return self.result.set_running_or_notify_cancel() and self.is_in_time()

    def is_in_time(self) -> bool:
        """Whether the deadline is ahead; else the job is answered with that."""
        if time.monotonic() < self.deadline_s:
            return True
        self.result.set_exception(Problem(Code.DEADLINE_EXCEEDED))
        return False


class InferenceQueue:
    """Answers queries on one thread, several in a forward pass when several wait.

    The thread opens the localizer, then takes what waits, up to `max_batch`, without any artificial delay.
    A query whose client left or whose deadline has passed is not computed. When a batch fails, its items
    are computed one by one, so that a bad one fails alone.
    """

    def __init__(self, open_localizer: Callable[[], LocalizerLike], max_queue: int, max_batch: int) -> None:
        self._open_localizer = open_localizer
        self._max_queue = max_queue
        self._max_batch = max_batch
        self._changed = Condition()
        self._jobs: deque[_Job] = deque()
        self._computing = 0
        self._localizer: LocalizerLike | None = None
        self._failure: str | None = None
        self._is_draining = False
        self._is_closed = False
        self._thread: Thread | None = None

    @property
    def localizer(self) -> LocalizerLike:
        """The localizer, for its facts and cells; `localize` belongs to the inference thread.

        Raises:
            Problem: not ready, or it could not be loaded.
        """
        if self._failure is not None:
            raise Problem(Code.LOAD_FAILED, self._failure)
        if self._localizer is None:
            raise Problem(Code.NOT_READY)
        return self._localizer

    @property
    def is_draining(self) -> bool:
        """Whether new queries are refused for good."""
        return self._is_draining

    @property
    def is_idle(self) -> bool:
        """Whether nothing waits and nothing is computed."""
        with self._changed:
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
        """Start the thread, which begins by loading the localizer."""
        self._is_draining = self._is_closed = False
        self._thread = Thread(target=self._run, name="inference", daemon=True)
        self._thread.start()

    def drain(self) -> None:
        """Refuse new queries; the waiting ones are answered. Takes no lock: a signal handler may call it."""
        self._is_draining = True

    async def close(self) -> None:
        """Drain, wait for the waiting queries, end the thread."""
        self.drain()
        with self._changed:
            self._is_closed = True
            self._changed.notify()
        if self._thread is not None:
            await asyncio.to_thread(self._thread.join)

    async def submit(self, query: Query, deadline_s: float) -> Served:
        """Answer a query. When the caller is cancelled before the computation begins, it never begins.

        Args:
            query: what to localize.
            deadline_s: time.monotonic() by which an answer is worth something.

        Raises:
            Problem: queue full, not accepting, or no answer before the deadline.
        """
        job = _Job(query, deadline_s)
        self._enqueue(job)
        try:
            async with asyncio.timeout(deadline_s - time.monotonic()):
                return await asyncio.wrap_future(job.result)
        except TimeoutError:
            raise Problem(Code.DEADLINE_EXCEEDED) from None
        finally:
            self._forget(job)

    def _enqueue(self, job: _Job) -> None:
        with self._changed:
            self.check_accepting()
            if len(self._jobs) >= self._max_queue:
                raise Problem(Code.QUEUE_FULL)
            self._jobs.append(job)
            self._changed.notify()

    def _forget(self, job: _Job) -> None:
        with self._changed:
            if job in self._jobs:
                self._jobs.remove(job)

    def _run(self) -> None:
        try:
            with no_collection():
                self._localizer = localizer = self._open_localizer()
        except HereaboutsError as error:
            log.error("load failed", reason=str(error))
            self._failure = str(error)
            return
        except Exception:
            log.exception("load failed")
            self._failure = "a fault in the service while loading; the operator finds it in the log"
            return
        log.info("ready", index_version=localizer.facts.version, cells=localizer.facts.num_cells)
        while batch := self._take():
            self._compute(localizer, [job for job in batch if job.begins()])
            with self._changed:
                self._computing = 0

    def _take(self) -> list[_Job]:
        """What waits, at most `max_batch`; waits for a first one; empty when closed and nothing is left."""
        with self._changed:
            self._changed.wait_for(lambda: self._jobs or self._is_closed)
            batch = [self._jobs.popleft() for _ in range(min(self._max_batch, len(self._jobs)))]
            self._computing = len(batch)
            return batch

    def _compute(self, localizer: LocalizerLike, jobs: list[_Job]) -> None:
        if not jobs:
            return
        started_s = time.monotonic()
        try:
            answers = localizer.localize([job.query for job in jobs])
            served = list(zip(jobs, answers, strict=True))
        except Exception as error:
            if len(jobs) == 1:
                jobs[0].result.set_exception(error)
                return
            log.warning("batch failed, computing one by one", size=len(jobs), error=type(error).__name__)
            for job in jobs:
                self._compute(localizer, [job] if job.is_in_time() else [])
        else:
            for job, answer in served:
                job.result.set_result(Served(answer, (started_s - job.submitted_s) * 1000))
