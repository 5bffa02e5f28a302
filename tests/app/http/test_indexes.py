import asyncio
import errno
import time
from contextlib import asynccontextmanager
from dataclasses import replace

import pytest
from fake_localizer import FakeLocalizer
from structlog.testing import capture_logs

from app.http import indexes as indexes_module
from app.http.errors import Code, Problem
from app.http.indexes import Indexes
from index.answering.query import Query
from models.errors import HereaboutsError, IndexBroken


class City:
    """Index versions and the aliases that name them; what opened them, and what can no longer be opened."""

    def __init__(self, **aliases):
        self.aliases = aliases
        self.opened = {}
        self.broken = set()

    def open(self, alias, version):
        if version in self.broken:
            raise IndexBroken(f"{version} is broken")
        fake = FakeLocalizer()
        fake.facts = replace(fake.facts, version=version or "none")
        self.opened[version] = fake
        return [fake]


@asynccontextmanager
async def serving(city, check_files=None):
    indexes = Indexes(city.open, lambda: city.aliases, 60.0, check_files)
    await indexes.start()
    try:
        for alias in indexes.names():
            await indexes.queue(alias).wait_until_open()
        yield indexes
    finally:
        for fake in city.opened.values():
            fake.gate.set()
        await indexes.close()


async def answering_version(indexes, alias="default"):
    """The version that answers."""
    async with indexes.lease(alias) as queue:
        await queue.submit(Query("a tree"), time.monotonic() + 5)
        return queue.localizer.facts.version


async def soon(condition):
    async with asyncio.timeout(60):
        while not condition():
            await asyncio.sleep(0.01)


@pytest.fixture(autouse=True)
def _looks_often(monkeypatch):
    monkeypatch.setattr(indexes_module, "ALIAS_POLL_S", 0.01)


def test_each_alias_is_served_by_its_own_version():
    async def run():
        async with serving(City(default="v1", berlin="b1")) as indexes:
            assert indexes.names() == ["berlin", "default"]
            with pytest.raises(Problem) as refused:
                indexes.queue("paris")
            assert refused.value.code is Code.INDEX_NOT_FOUND
            return await answering_version(indexes), await answering_version(indexes, "berlin")

    assert asyncio.run(run()) == ("v1", "b1")


def test_an_alias_that_changes_on_disk_is_followed_and_the_old_version_let_go():
    city = City(default="v1")

    async def run():
        async with serving(city) as indexes:
            first = city.opened["v1"]
            city.aliases = {"default": "v2", "new": "v1"}
            await soon(lambda: indexes.queue().localizer.facts.version == "v2" and "new" in indexes.names())
            assert await answering_version(indexes) == "v2"
            await soon(lambda: first.is_closed)
            assert not city.opened["v1"].is_closed

    asyncio.run(run())


def test_a_request_keeps_its_version_while_the_alias_moves_on():
    city = City(default="v1")

    async def run():
        async with serving(city) as indexes:
            city.opened["v1"].gate.clear()
            waiting = asyncio.create_task(answering_version(indexes))
            async with indexes.lease() as leased:
                await asyncio.sleep(0.02)
                city.aliases = {"default": "v2"}
                await soon(lambda: indexes.queue() is not leased)
                assert await answering_version(indexes) == "v2"
                city.opened["v1"].gate.set()
                assert await waiting == "v1"
                assert leased.localizer.facts.version == "v1"
                await leased.submit(Query("another"), time.monotonic() + 5)
                assert not city.opened["v1"].is_closed
            await soon(lambda: city.opened["v1"].is_closed)

    asyncio.run(run())


def test_an_alias_that_is_removed_answers_its_requests_and_no_more():
    city = City(default="v1", canary="c1")

    async def run():
        async with serving(city) as indexes:
            canary = city.opened["c1"]
            canary.gate.clear()
            waiting = asyncio.create_task(answering_version(indexes, "canary"))
            await asyncio.to_thread(canary.entered.acquire, timeout=60)
            city.aliases = {}
            await soon(lambda: indexes.names() == ["default"])
            with pytest.raises(Problem) as refused:
                await answering_version(indexes, "canary")
            assert refused.value.code is Code.INDEX_NOT_FOUND
            assert await answering_version(indexes) == "v1"  # requests that name no index need it
            canary.gate.set()
            assert await waiting == "c1"
            await soon(lambda: canary.is_closed)

    asyncio.run(run())


def test_a_version_that_cannot_be_opened_leaves_the_old_one_serving():
    city = City(default="v1")
    city.broken = {"v2"}

    async def run():
        async with serving(city) as indexes:
            city.aliases = {"default": "v2"}
            with capture_logs() as lines:
                await soon(lambda: "index not switched" in [line["event"] for line in lines])
                await asyncio.sleep(0.1)
            [entry] = [line for line in lines if line["event"] == "index not switched"]
            assert (entry["alias"], entry["index_version"], entry["reason"]) == ("default", "v2", "v2 is broken")
            assert await answering_version(indexes) == "v1"
            city.aliases = {"default": "v3"}
            await soon(lambda: indexes.queue().localizer.facts.version == "v3")

    asyncio.run(run())


@pytest.mark.parametrize("there", [{}, {"default": "of another model"}])
def test_an_index_that_is_built_after_the_service_started_is_found(there):
    city = City(**there)
    city.broken = {None, *there.values()}

    async def run():
        async with serving(city) as indexes:
            with pytest.raises(Problem) as refused:
                indexes.check_accepting()
            assert refused.value.code is Code.LOAD_FAILED
            city.aliases = {"default": "v1"}
            await soon(lambda: "v1" in city.opened)
            await soon(lambda: indexes.queue()._localizers)
            return await answering_version(indexes)

    assert asyncio.run(run()) == "v1"


@pytest.mark.parametrize("error", [IndexBroken("half a file"), OSError(errno.EIO, "a bad disk")])
def test_aliases_that_cannot_be_read_change_nothing_until_they_can(error):
    city = City(default="v1")
    failed = []

    def unreadable():
        failed.append(error)
        raise error

    async def run():
        async with serving(city) as indexes:
            indexes._read_aliases = unreadable
            await soon(lambda: len(failed) > 2)
            assert await answering_version(indexes) == "v1"
            city.aliases = {"default": "v2"}
            indexes._read_aliases = lambda: city.aliases
            await soon(lambda: indexes.queue().localizer.facts.version == "v2")

    asyncio.run(run())


def refusal(indexes, alias="default"):
    """Return why an index does not answer; None if it does."""
    try:
        indexes.queue(alias).check_accepting()
    except Problem as problem:
        return problem.detail
    return None


def test_every_version_that_is_opened_is_read_and_a_broken_one_answers_no_more():
    city, read = City(default="v1", berlin="b1", paris="p1"), []

    async def check(version):
        read.append(version)
        assert len(city.opened) >= 3, "before it is ready"
        await asyncio.sleep(0.02)
        if version in ("b1", "v2"):
            raise IndexBroken(f"{version} is broken")
        if version == "p1":
            raise HereaboutsError("nobody knows")

    async def run():
        async with serving(city, check) as indexes:
            await soon(lambda: refusal(indexes, "berlin"))
            await soon(lambda: len(read) == 3)
            assert sorted(read) == ["b1", "p1", "v1"]
            assert indexes.versions() == {"default": "v1", "paris": "p1"}
            assert await answering_version(indexes) == "v1"
            city.aliases["default"] = "v2"
            await soon(lambda: refusal(indexes))
            assert refusal(indexes) == "v2 is broken"
            await asyncio.sleep(0.05)
            assert read.count("v2") == 1, "and not again and again"
            city.aliases["default"] = "v3"
            await soon(lambda: not refusal(indexes))
            assert await answering_version(indexes) == "v3"
            await soon(lambda: city.opened["v2"].is_closed)

    asyncio.run(run())


def test_what_waits_for_a_version_that_is_found_broken_is_refused():
    city, is_found = City(default="v1"), asyncio.Event()

    async def check(_version):
        await is_found.wait()
        raise IndexBroken("a file was changed")

    async def run():
        async with serving(city, check) as indexes:
            fake = city.opened["v1"]
            fake.gate.clear()
            computed, waiting = (asyncio.create_task(answering_version(indexes)) for _ in range(2))
            await asyncio.to_thread(fake.entered.acquire, timeout=60)
            is_found.set()
            with pytest.raises(Problem) as refused:
                await waiting
            assert (refused.value.code, refused.value.detail) == (Code.LOAD_FAILED, "a file was changed")
            fake.gate.set()
            with pytest.raises(Problem):
                await computed  # it was, but nothing is said of what it came from any more
            await soon(lambda: indexes.is_idle)

    asyncio.run(run())


def checking(begun, ended, lasts_s):
    """A check that ends so long after it was cancelled, as it waits for what it has killed."""

    async def check(version):
        begun.append(version)
        try:
            await asyncio.sleep(60)
        finally:
            await asyncio.sleep(lasts_s)
            ended.append(version)

    return check


def test_a_check_ends_with_the_version_or_the_service_that_it_is_of():
    city, begun, ended = City(default="v1"), [], []

    async def run():
        async with serving(city, checking(begun, ended, 0)) as indexes:
            await soon(lambda: begun == ["v1"])
            city.aliases = {"default": "v2"}
            await soon(lambda: begun == ["v1", "v2"])
            assert ended == ["v1"]
            assert await answering_version(indexes) == "v2"
        assert ended == ["v1", "v2"]

    asyncio.run(run())


def test_a_check_that_is_ended_can_wait_for_its_process_though_the_service_ends_meanwhile():
    city, begun, ended = City(default="v1"), [], []

    async def run():
        async with serving(city, checking(begun, ended, 0.05)) as indexes:
            await soon(lambda: begun)
            city.aliases = {"default": "v2"}
            await soon(lambda: indexes.queue().localizer.facts.version == "v2")
            await asyncio.sleep(0)  # the check of v1 has been cancelled
        assert "v1" in ended

    asyncio.run(run())


def test_draining_refuses_on_every_index():
    async def run():
        async with serving(City(default="v1", berlin="b1")) as indexes:
            indexes.drain()
            for alias in indexes.names():
                with pytest.raises(Problem) as refused:
                    await answering_version(indexes, alias)
                assert refused.value.code is Code.DRAINING
            return indexes.is_idle

    assert asyncio.run(run())


def test_there_is_room_while_one_index_has_some(monkeypatch):
    full = Problem(Code.QUEUE_FULL)

    async def run():
        async with serving(City(default="one", canary="two")) as indexes:
            for alias in ("default", "canary"):
                with monkeypatch.context() as patch:
                    patch.setattr(indexes.queue(alias), "refusal", lambda: full)
                    await indexes.check_room()
            for alias in ("default", "canary"):
                monkeypatch.setattr(indexes.queue(alias), "refusal", lambda: full)
            with pytest.raises(Problem) as refused:
                await indexes.check_room()
            assert refused.value is full

    asyncio.run(run())
