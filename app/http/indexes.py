"""The served indexes: one queue per alias, replaced without downtime when the alias names another version."""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from functools import partial
from typing import Final

import structlog

from app import limits
from app.http.errors import Code, Problem
from app.http.protocol import LocalizerLike
from app.http.queue import InferenceQueue, refuse
from index.build.artifact import DEFAULT_ALIAS
from models.errors import HereaboutsError, IndexBroken, IndexUnusable

ALIAS_POLL_S: Final = 1.0  # interval between two reads of aliases.json

log = structlog.get_logger()


@dataclass(eq=False, slots=True)
class _ServedIndex:
    queue: InferenceQueue
    version: str | None  # the one its alias named when it was opened; None if unknown
    checking: asyncio.Task[None] | None = None  # verifies its files
    leases: int = 0
    unused: asyncio.Event = field(default_factory=asyncio.Event)


class Indexes:
    """Queues by alias. A request leases a queue, so that one version answers it even if the alias changes meanwhile.

    `open_index` opens the localizers of an alias and its version, and `read_aliases` returns the version of each alias;
    both block. `check_files` verifies a served version and raises IndexBroken.
    """

    def __init__(
        self,
        open_index: Callable[[str, str | None], Sequence[LocalizerLike]],
        read_aliases: Callable[[], Mapping[str, str]],
        max_wait_s: float,
        check_files: Callable[[str], Awaitable[None]] | None = None,
    ) -> None:
        self._open_index, self._read_aliases, self._max_wait_s = open_index, read_aliases, max_wait_s
        self._check_files = check_files
        self._served: dict[str, _ServedIndex] = {}
        self._retiring: set[asyncio.Task[None]] = set()
        self._checks: set[asyncio.Task[None]] = set()  # of served and of retired versions
        self._watching: asyncio.Task[None] | None = None
        self._checking = asyncio.Lock()
        self.is_draining = False  # shutting down, new queries are refused
        self._unreadable = ""  # the last logged reason why aliases cannot be read

    async def start(self) -> None:
        """Start opening the versions that the aliases name, and start watching the aliases."""
        self.is_draining, self._checking = False, asyncio.Lock()
        versions_by_alias = await self._read_versions() or {}
        self._served = {
            alias: self._begin(alias, versions_by_alias.get(alias)) for alias in {DEFAULT_ALIAS, *versions_by_alias}
        }
        for alias, served in self._served.items():
            self._begin_check(alias, served)
        self._watching = asyncio.create_task(self._watch())

    def queue(self, alias: str = DEFAULT_ALIAS) -> InferenceQueue:
        """Return the queue of an alias; 404 if it is not served."""
        try:
            return self._served[alias].queue
        except KeyError:
            raise Problem(Code.INDEX_NOT_FOUND) from None

    def names(self) -> list[str]:
        """Return the served aliases, sorted."""
        return sorted(self._served)

    def versions(self) -> dict[str, str]:
        """Return the version that each alias serves, without aliases that are not ready."""
        ready = {alias: served.queue for alias, served in self._served.items() if served.queue.num_workers}
        return {alias: queue.localizer.facts.version for alias, queue in sorted(ready.items())}

    @asynccontextmanager
    async def lease(self, alias: str = DEFAULT_ALIAS) -> AsyncIterator[InferenceQueue]:
        """Yield the queue of an alias and keep it open until the block ends; 404 if the alias is not served."""
        self.queue(alias)
        served = self._served[alias]
        served.leases += 1
        try:
            yield served.queue
        finally:
            served.leases -= 1
            if not served.leases:
                served.unused.set()

    @property
    def is_idle(self) -> bool:
        """Whether no query waits or is being computed."""
        return all(served.queue.is_idle for served in self._served.values())

    def check_accepting(self) -> None:
        """Raise 503 if a query to the default index would not be accepted now."""
        if self.is_draining:
            raise Problem(Code.DRAINING)
        self.queue().check_accepting()

    async def check_room(self) -> None:
        """Raise 429 if the queues of all indexes are full."""
        refusals = [served.queue.refusal() for served in self._served.values()]
        if refusals and refusals[0] is not None and None not in refusals:
            await refuse(refusals[0])

    def drain(self) -> None:
        """Refuse new queries; waiting ones are still answered. Takes no lock: a signal handler may call it."""
        self.is_draining = True
        for served in list(self._served.values()):
            served.queue.drain()

    async def close(self) -> None:
        """Drain, answer the waiting queries, then close all queues."""
        self.drain()
        if self._watching is not None:
            self._watching.cancel()
            await asyncio.gather(self._watching, return_exceptions=True)
        for task in [*self._retiring, *self._checks]:
            _cancel(task)
        await asyncio.gather(*self._retiring, *self._checks, return_exceptions=True)
        await asyncio.gather(*(served.queue.close() for served in self._served.values()))

    async def _switch(self, alias: str, version: str) -> bool:
        """Open a version and let an alias serve it; requests that hold a lease finish with the previous version.

        Return False if the version cannot be opened; the alias then keeps its previous version.
        """
        new = self._begin(alias, version)
        try:
            await new.queue.wait_until_open()
            new.queue.check_accepting()
        except BaseException as error:
            await new.queue.close()
            if not isinstance(error, Problem):
                raise
            reason = str(new.queue.error or error.detail)
            log.error("index not switched", alias=alias, index_version=version, reason=reason)
            return False
        old, self._served[alias] = self._served.get(alias), new
        self._begin_check(alias, new)
        log.info("index switched", alias=alias, index_version=new.queue.localizer.facts.version)
        if old is not None:
            self._begin_retiring(old)
        return True

    def _begin(self, alias: str, version: str | None) -> _ServedIndex:
        opener = partial(self._open_index, alias, version)
        queue = InferenceQueue(opener, limits.MAX_WAITING_QUERIES, self._max_wait_s)
        queue.start()
        if self.is_draining:
            queue.drain()
        return _ServedIndex(queue, version)

    def _begin_retiring(self, served: _ServedIndex) -> None:
        task = asyncio.create_task(self._retire(served))
        self._retiring.add(task)
        task.add_done_callback(self._retiring.discard)

    async def _retire(self, served: _ServedIndex) -> None:
        if served.checking is not None:
            _cancel(served.checking)
            await asyncio.wait([served.checking])  # not gather, which would cancel the check a second time
        while served.leases:
            served.unused.clear()
            await served.unused.wait()
        await served.queue.close()

    def _begin_check(self, alias: str, served: _ServedIndex) -> None:
        served.checking = task = asyncio.create_task(self._check(alias, served))
        self._checks.add(task)
        task.add_done_callback(self._checks.discard)

    async def _check(self, alias: str, served: _ServedIndex) -> None:
        """Verify the files of a ready version, one version at a time; a corrupt version stops answering."""
        await served.queue.wait_until_open()
        if self._check_files is None or not served.queue.num_workers:
            return
        version = served.queue.localizer.facts.version
        try:
            async with self._checking:
                await self._check_files(version)
        except IndexBroken as error:
            served.queue.fail(str(error))
            log.error("index broken", alias=alias, index_version=version, reason=str(error))
        except (HereaboutsError, OSError) as error:
            log.error("index not verified", alias=alias, index_version=version, reason=str(error))
        else:
            log.info("index verified", alias=alias, index_version=version)

    async def _read_versions(self) -> dict[str, str] | None:
        try:
            return dict(await asyncio.to_thread(self._read_aliases))
        except (IndexUnusable, OSError) as error:
            if str(error) != self._unreadable:
                log.error("aliases cannot be read", reason=str(error))
            self._unreadable = str(error)
            return None

    async def _watch(self) -> None:
        """Follow the alias file; a version that cannot be opened is retried only after its alias changes."""
        failed: dict[str, str] = {}
        while True:
            await asyncio.sleep(ALIAS_POLL_S)
            versions_by_alias = await self._read_versions()
            if versions_by_alias is None:
                continue
            for alias in self._served.keys() - versions_by_alias.keys() - {DEFAULT_ALIAS}:
                log.info("index removed", alias=alias)
                self._begin_retiring(self._served.pop(alias))
            for alias, version in versions_by_alias.items():
                served = self._served.get(alias)
                if failed.get(alias) == version or (served is not None and served.version == version):
                    continue
                if await self._switch(alias, version):
                    failed.pop(alias, None)
                else:
                    failed[alias] = version


def _cancel(task: asyncio.Task[None]) -> None:
    """Cancel a task unless it is being cancelled: a second cancel would interrupt its wait for a killed process."""
    if not task.cancelling():
        task.cancel()
