"""Measure the load that the service bears (`make load`, on idle CPUs). Prints a line of JSON for each of

1, 2, 32 clients, each asking as soon as it is answered (the last is the knee);
3 times the knee, with GET /healthz beside it, and how soon a request is answered at once after that;
SECONDS of requests that come by chance, 0.7 of the knee;
one client beside a process that computes.

The knee and 3 times the knee are measured in turns, a minute each in all, as a machine is not always as fast.

Every description is new. Ends with 1 if a bound is not kept.
"""

import argparse
import asyncio
import json
import random
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Coroutine
from contextlib import closing
from dataclasses import dataclass, field
from http import HTTPStatus
from http.client import HTTPConnection
from statistics import quantiles
from typing import Any

import aiohttp

from tests.load.service import started, text

BUSY = "import os; asked = os.getppid()\nwhile os.getppid() == asked: pass"  # ends with who began it, however that ends
MANY = 32
TURNS, TURN_S = 3, 20.0


@dataclass
class Figures:
    """Answers from the first request to the last."""

    seconds: float = 0.0
    statuses: Counter[int] = field(default_factory=Counter)
    good_ms: list[float] = field(default_factory=list)

    def add(self, other: "Figures") -> None:
        """Take what came back at another time to it."""
        self.seconds += other.seconds
        self.statuses += other.statuses
        self.good_ms += other.good_ms

    @property
    def goodput(self) -> float:
        """Descriptions answered a second."""
        return len(self.good_ms) / self.seconds

    def percentile_ms(self, percent: int) -> float:
        """Return a percentile of the latency of good answers."""
        return quantiles(self.good_ms, n=100)[percent - 1]

    def shown(self) -> dict[str, Any]:
        """As it is printed."""
        return {
            "answered_a_second": round(self.goodput, 1),
            "p50_ms": round(self.percentile_ms(50), 1),
            "p99_ms": round(self.percentile_ms(99), 1),
            "statuses": self.statuses,
        }


class Load:
    """Asks a service.

    Args:
        url: where it is.
    """

    def __init__(self, url: str) -> None:
        self._rng = random.Random("load 1")
        self._url = f"{url}/localize"

    async def __aenter__(self) -> "Load":
        # aiohttp, as it takes a third of the time of httpx, and the service is on the same CPUs.
        self._client = aiohttp.ClientSession(connector=aiohttp.TCPConnector(limit=0))
        return self

    async def __aexit__(self, *_: object) -> None:
        await self._client.close()

    async def clients(self, count: int, seconds: float) -> Figures:
        """So many clients, each asking again as soon as it is answered."""
        end = time.monotonic() + seconds

        async def client(into: Figures) -> None:
            while time.monotonic() < end:
                await self._ask(into)

        return await self._timed(lambda into: [client(into) for _ in range(count)])

    async def arrivals(self, rate: float, seconds: float) -> Figures:
        """Requests that come by chance, so many a second, whether the earlier ones are answered or not."""

        async def arrive(into: Figures) -> None:
            begun = time.monotonic()
            async with asyncio.TaskGroup() as group:
                due_s = 0.0
                while (due_s := due_s + self._rng.expovariate(rate)) < seconds:
                    await asyncio.sleep(begun + due_s - time.monotonic())
                    group.create_task(self._ask(into))

        return await self._timed(lambda into: [arrive(into)])

    async def recovery_s(self, usual_ms: float) -> float:
        """Seconds until a request is answered in twice the usual time."""
        begun = time.monotonic()
        while True:
            figures = Figures()
            await self._ask(figures)
            if figures.good_ms and figures.good_ms[0] < 2 * usual_ms:
                return time.monotonic() - begun - figures.good_ms[0] / 1000

    @staticmethod
    async def _timed(work: Any) -> Figures:
        figures, begun = Figures(), time.monotonic()
        works: list[Coroutine[Any, Any, None]] = work(figures)
        await asyncio.gather(*works)
        figures.seconds = time.monotonic() - begun
        return figures

    async def _ask(self, into: Figures) -> None:
        begun = time.monotonic()
        async with self._client.post(self._url, json={"description": text(self._rng)}) as response:
            await response.read()
        into.statuses[response.status] += 1
        if response.status == HTTPStatus.OK:
            into.good_ms.append((time.monotonic() - begun) * 1000)


def health_ms(url: str, stop: Any) -> list[float]:
    """Milliseconds of GET /healthz, ten times a second until told to stop; for a thread of its own."""
    measured = []
    with closing(HTTPConnection(url.removeprefix("http://"))) as client:
        while not stop.is_set():
            begun = time.monotonic()
            client.request("GET", "/healthz")
            answer = client.getresponse()
            answer.read()
            assert answer.status == HTTPStatus.OK
            measured.append((time.monotonic() - begun) * 1000)
            time.sleep(0.1)
    return measured


@dataclass
class Overload:
    """Many clients and far too many requests, in turns."""

    knee: Figures = field(default_factory=Figures)
    over: Figures = field(default_factory=Figures)
    health_ms: list[float] = field(default_factory=list)
    recovery_s: float = 0.0

    async def take_turn(self, load: Load, url: str, usual_ms: float) -> None:
        """One of each; after the first the rate is three times the knee so far."""
        self.knee.add(await load.clients(MANY, TURN_S))
        stop = asyncio.Event()
        health = asyncio.create_task(asyncio.to_thread(health_ms, url, stop))
        self.over.add(await load.arrivals(3 * self.knee.goodput, TURN_S))
        self.recovery_s = max(self.recovery_s, await load.recovery_s(usual_ms))
        stop.set()
        self.health_ms += await health

    def bounds(self) -> dict[str, bool]:
        """Return which bounds are kept."""
        return {
            "only 200, 429, 503": set(self.over.statuses) <= {200, 429, 503},
            "at least .9 of the knee answered": self.over.goodput >= 0.9 * self.knee.goodput,
            "healthz p99 under 50 ms": self.health_p99_ms < 50,
            "recovery under 2 s": self.recovery_s < 2,
        }

    @property
    def health_p99_ms(self) -> float:
        """Return the 99th percentile of GET /healthz."""
        return quantiles(self.health_ms, n=100)[98]


async def measure(load: Load, url: str, seconds: float) -> bool:
    """Measure everything; return whether every bound is kept."""
    is_kept = True

    def note(name: str, figures: Figures, bounds: dict[str, bool], **more: float) -> None:
        nonlocal is_kept
        is_kept = is_kept and all(bounds.values())
        rounded = {what: round(value, 2) for what, value in more.items()}
        print(json.dumps({"load": name, **figures.shown(), **rounded, "kept": bounds}), flush=True)

    await load.clients(2, 10)
    alone = await load.clients(1, 20)
    note("1 client", alone, {})
    note("2 clients", await load.clients(2, 20), {})
    both = Overload()
    for _ in range(TURNS):
        await both.take_turn(load, url, alone.percentile_ms(50))
    times = both.knee.goodput / alone.goodput
    note(f"{MANY} clients", both.knee, {"at least 1.7 times one": times >= 1.7}, times_one=times)
    more = {"healthz_p99_ms": both.health_p99_ms, "recovery_s": both.recovery_s}
    share = both.over.goodput / both.knee.goodput
    note("3 times the knee", both.over, both.bounds(), share_of_the_knee=share, **more)
    usual = await load.arrivals(0.7 * both.knee.goodput, seconds)
    p50, p99 = usual.percentile_ms(50), usual.percentile_ms(99)
    note("0.7 of the knee", usual, {"no error": set(usual.statuses) == {200}, "p99 under 5 p50": p99 < 5 * p50})
    with subprocess.Popen((sys.executable, "-c", BUSY)) as busy:
        unloaded = await load.clients(1, 20)
        busy.kill()
    slower = unloaded.percentile_ms(50) / alone.percentile_ms(50)
    note("beside a busy process", unloaded, {"p50 at most twice": slower <= 2}, times_alone=slower)
    return is_kept


def main() -> int:
    """Start a service, measure, judge."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--index", default="data/index")
    parser.add_argument("--seconds", type=float, default=600, help="at 0.7 of the knee")
    arguments = parser.parse_args()
    with started(arguments.index) as (_, url):
        return int(not asyncio.run(measured(url, arguments.seconds)))


async def measured(url: str, seconds: float) -> bool:
    """As `measure`, of a service."""
    async with Load(url) as load:
        return await measure(load, url, seconds)


if __name__ == "__main__":
    sys.exit(main())
