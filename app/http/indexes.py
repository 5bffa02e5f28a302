"""The indexes that are served: a queue an alias, exchanged under load when the alias names another version."""

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

LOOKED_AT_S: Final = 1.0  # how often aliases are read again

log = structlog.get_logger()


@dataclass(eq=False, slots=True)
class _Served:
    """A queue, and how many requests use it."""

    queue: InferenceQueue
    version: str | None  # that its alias named when it was opened; None: nobody knew
    checking: asyncio.Task[None] | None = None  # reads its files again
    leases: int = 0
    unused: asyncio.Event = field(default_factory=asyncio.Event)


class Indexes:
    """Queues by alias. A request leases one, so that one version answers it, whatever the alias names next.

    Args:
        open_index: what answers for an alias and the version that it names; blocks, runs on a thread.
        read_aliases: the version that each alias names; blocks.
        max_wait_s: longest expected wait of a query.
        check_files: reads all files of a version that is served, or raises IndexBroken; None: they need not be.
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
        self._served: dict[str, _Served] = {}
        self._retiring: set[asyncio.Task[None]] = set()
        self._checks: set[asyncio.Task[None]] = set()  # of what is served, and of what was
        self._watching: asyncio.Task[None] | None = None
        self._checking = asyncio.Lock()
        self._is_draining = False
        self._unreadable = ""  # why, when it was last logged

    async def start(self) -> None:
        """Begin to open what the aliases name, and to watch them."""
        self._is_draining, self._checking = False, asyncio.Lock()
        named = await self._named() or {}
        self._served = {alias: self._begin(alias, named.get(alias)) for alias in {DEFAULT_ALIAS, *named}}
        for alias, served in self._served.items():
            self._begin_check(alias, served)
        self._watching = asyncio.create_task(self._watch())

    def queue(self, alias: str = DEFAULT_ALIAS) -> InferenceQueue:
        """What answers for an alias now.

        Raises:
            Problem: there is no such alias.
        """
        try:
            return self._served[alias].queue
        except KeyError:
            raise Problem(Code.INDEX_NOT_FOUND) from None

    def names(self) -> list[str]:
        """The aliases, in order."""
        return sorted(self._served)

    def versions(self) -> dict[str, str]:
        """The version that answers for each alias; those that are not ready are left out."""
        ready = {alias: served.queue for alias, served in self._served.items() if served.queue.num_workers}
        return {alias: queue.localizer.facts.version for alias, queue in sorted(ready.items())}

    @asynccontextmanager
    async def lease(self, alias: str = DEFAULT_ALIAS) -> AsyncIterator[InferenceQueue]:
        """What answers for an alias, and goes on to until the block ends.

        Raises:
            Problem: there is no such alias.
        """
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
    def is_draining(self) -> bool:
        """Whether new queries are refused for good."""
        return self._is_draining

    @property
    def is_idle(self) -> bool:
        """Whether nothing waits and nothing is computed."""
        return all(served.queue.is_idle for served in self._served.values())

    def check_accepting(self) -> None:
        """Pass if a query to the default index would be taken now.

        Raises:
            Problem: draining, not ready, or not loaded.
        """
        if self._is_draining:
            raise Problem(Code.DRAINING)
        self.queue().check_accepting()

    async def check_room(self) -> None:
        """Pass unless any query would be refused, whatever it asks.

        Raises:
            Problem: all queues are full.
        """
        full = [served.queue.full() for served in self._served.values()]
        if full and full[0] is not None and None not in full:
            await refuse(full[0])

    def drain(self) -> None:
        """Refuse new queries; the waiting ones are answered. Takes no lock: a signal handler may call it."""
        self._is_draining = True
        for served in list(self._served.values()):
            served.queue.drain()

    async def close(self) -> None:
        """Drain, wait for the waiting queries, end all queues."""
        self.drain()
        if self._watching is not None:
            self._watching.cancel()
            await asyncio.gather(self._watching, return_exceptions=True)
        for task in [*self._retiring, *self._checks]:
            _cancel(task)
        await asyncio.gather(*self._retiring, *self._checks, return_exceptions=True)
        await asyncio.gather(*(served.queue.close() for served in self._served.values()))

    async def _switch(self, alias: str, version: str) -> bool:
        """Open a version, then let an alias serve it; earlier requests are answered by the version before.

        Returns:
            Whether it was opened; otherwise the alias serves what it served before.
        """
        new = self._begin(alias, version)
        try:
            await new.queue.opened()
            new.queue.check_accepting()
        except BaseException as error:
            await new.queue.close()
            if not isinstance(error, Problem):
                raise
            reason = str(new.queue.failure or error.detail)
            log.error("index not switched", alias=alias, index_version=version, reason=reason)
            return False
        old, self._served[alias] = self._served.get(alias), new
        self._begin_check(alias, new)
        log.info("index switched", alias=alias, index_version=new.queue.localizer.facts.version)
        if old is not None:
            self._begin_retiring(old)
        return True

    def _begin(self, alias: str, version: str | None) -> _Served:
        opener = partial(self._open_index, alias, version)
        queue = InferenceQueue(opener, limits.MAX_WAITING_QUERIES, self._max_wait_s)
        queue.start()
        if self._is_draining:
            queue.drain()
        return _Served(queue, version)

    def _begin_retiring(self, served: _Served) -> None:
        task = asyncio.create_task(self._retire(served))
        self._retiring.add(task)
        task.add_done_callback(self._retiring.discard)

    async def _retire(self, served: _Served) -> None:
        """End a queue once no request uses it."""
        if served.checking is not None:
            _cancel(served.checking)
            await asyncio.wait([served.checking])  # not gather: if this is cancelled, so would that be once more
        while served.leases:
            served.unused.clear()
            await served.unused.wait()
        await served.queue.close()

    def _begin_check(self, alias: str, served: _Served) -> None:
        served.checking = task = asyncio.create_task(self._check(alias, served))
        self._checks.add(task)
        task.add_done_callback(self._checks.discard)

    async def _check(self, alias: str, served: _Served) -> None:
        """Read the files of a version once it is ready, one version at a time; what is broken answers no more."""
        await served.queue.opened()
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

    async def _named(self) -> dict[str, str] | None:
        """Return the version that each alias names; None if the aliases cannot be read."""
        try:
            return dict(await asyncio.to_thread(self._read_aliases))
        except (IndexUnusable, OSError) as error:
            if str(error) != self._unreadable:
                log.error("aliases cannot be read", reason=str(error))
            self._unreadable = str(error)
            return None

    async def _watch(self) -> None:
        """Follow the aliases; a version that cannot be opened is tried again when its alias changes again."""
        failed: dict[str, str] = {}
        while True:
            await asyncio.sleep(LOOKED_AT_S)
            named = await self._named()
            if named is None:
                continue
            for alias in self._served.keys() - named.keys() - {DEFAULT_ALIAS}:
                log.info("index removed", alias=alias)
                self._begin_retiring(self._served.pop(alias))
            for alias, version in named.items():
                served = self._served.get(alias)
                if failed.get(alias) == version or (served is not None and served.version == version):
                    continue
                if await self._switch(alias, version):
                    failed.pop(alias, None)
                else:
                    failed[alias] = version


def _cancel(task: asyncio.Task[None]) -> None:
    """Cancel a task once: a second time would end it while it waits for the process that it has killed."""
    if not task.cancelling():
        task.cancel()
