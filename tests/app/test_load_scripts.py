"""The scripts behind `make load` and `make soak`, for a moment, so that they run when they are needed."""

import asyncio
import os
import threading
from dataclasses import replace

import pytest
from fake_localizer import FakeLocalizer

from app.main import create_app
from app.settings import Settings
from tests.load.load import Load, health_ms
from tests.load.soak import ask, memory_mib

pytestmark = pytest.mark.slow


class Plain(FakeLocalizer):
    """Whom no word steers: streets have them by chance."""

    def localize(self, queries):
        return super().localize([replace(query, description="a tree") for query in queries])


@pytest.fixture(scope="module")
def url(in_a_thread):
    with in_a_thread(create_app(Settings(), Plain)) as port:
        yield f"http://127.0.0.1:{port}"


def test_load_asks_as_clients_and_as_arrivals(url):
    async def both():
        async with Load(url) as load:
            return await load.clients(3, 0.5), await load.arrivals(50, 0.5), await load.recovery_s(60_000)

    clients, arrivals, recovery_s = asyncio.run(both())
    for figures in (clients, arrivals):
        assert set(figures.statuses) == {200}
        assert len(figures.good_ms) == figures.statuses[200] > 5
        assert 0 < figures.percentile_ms(50) <= figures.percentile_ms(99)
        assert figures.shown()["answered_a_second"] == round(figures.goodput, 1)
    assert 0 <= recovery_s < 60


def test_health_is_asked_until_it_is_told_to_stop(url):
    stop = threading.Event()
    threading.Timer(0.3, stop.set).start()
    assert all(ms > 0 for ms in health_ms(url, stop))


def test_soak_asks_what_users_ask_and_sees_the_memory_of_all_processes(url):
    statuses = ask(url, 60, "1 0")
    assert set(statuses) == {200, 400, 404, 422}
    assert sum(statuses.values()) == 60
    assert memory_mib(os.getpid()) > 50
