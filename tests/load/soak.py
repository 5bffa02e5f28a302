"""Whether the service's memory grows: run by `make soak`, which says how many requests.

Starts the service and asks it as users do: descriptions, half of them never said before, and the other things that it
answers, bad requests among them. Prints the memory of all its processes as it goes (anonymous PSS: what they share is
counted once). Ends with 1 if it grew by more than allowed in the last half.
"""

import argparse
import json
import random
import statistics
import sys
import time
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path

import httpx

from tests.load.service import started, text

JSON = {"Content-Type": "application/json"}
ALLOWED_MIB = 1.0  # in 10,000 requests
STOPS, CLIENTS = 20, 4
REST_S = 3.0  # before memory is looked at: what is free between two answers is given back when there are none
SHARE_SAID, SHARE_NEW = 0.25, 0.5  # of descriptions among the requests, of new ones among these


def main() -> int:
    """Ask, print a line of JSON at each stop, judge."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--index", default="data/index")
    parser.add_argument("--requests", type=int, default=100_000)
    arguments = parser.parse_args()
    share = arguments.requests // (STOPS * CLIENTS)
    points = []
    with started(arguments.index) as (pid, url), ThreadPoolExecutor(CLIENTS) as pool:
        for stop in range(1, STOPS + 1):
            seeds = [f"{stop} {client}" for client in range(CLIENTS)]
            statuses = sum(pool.map(partial(ask, url, share), seeds), Counter())
            time.sleep(REST_S)
            points.append((stop * share * CLIENTS, memory_mib(pid)))
            shown = {"requests": points[-1][0], "mib": round(points[-1][1], 2), "statuses": statuses}
            print(json.dumps(shown), flush=True)
    slope = statistics.linear_regression(*zip(*points[STOPS // 2 :], strict=True)).slope * 10_000
    print(json.dumps({"growth_mib_per_10000_requests": round(slope, 3), "allowed": ALLOWED_MIB}))
    return int(slope > ALLOWED_MIB)


def ask(url: str, count: int, seed: str) -> Counter[int]:
    """Ask a number of descriptions, one after another; how often each status came."""
    rng = random.Random(seed)
    with httpx.Client(base_url=url, timeout=60) as client:
        return Counter(request(client, rng).status_code for _ in range(count))


def request(client: httpx.Client, rng: random.Random) -> httpx.Response:
    """One request at random."""
    if rng.random() < SHARE_SAID:
        return client.post("/localize", json={"description": text(rng, SHARE_NEW)})
    return rng.choice(OTHERS)(client, rng)


OTHERS: tuple[Callable[[httpx.Client, random.Random], httpx.Response], ...] = (
    lambda client, rng: client.post("/describe", json={"position": [rng.uniform(-400, 400), rng.uniform(-400, 400)]}),
    lambda client, rng: client.get("/cells", params={"offset": rng.randrange(5000), "limit": 5}),
    lambda client, rng: client.get(f"/cells/{rng.randrange(10**9)}"),
    lambda client, rng: client.post("/localize", json={"description": " ", rng.choice("abcdefgh") * 3: 1}),
    lambda client, rng: client.post(
        "/localize", content=rng.randbytes(200), headers={"Content-Type": "application/json"}
    ),
    lambda client, _: client.get("/info"),
    lambda client, _: client.get("/metrics"),
    lambda client, _: client.get("/"),
)


def memory_mib(pid: int) -> float:
    """Memory of a process and of all that it started, what they share counted once.

    That of files is left out: how much of it is theirs changes when a stranger who reads the same files comes or goes.
    """
    lines = Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
    kib = next(int(line.split()[1]) for line in lines if line.startswith("Pss_Anon:"))
    children = Path(f"/proc/{pid}/task").glob("*/children")
    return kib / 1024 + sum(memory_mib(int(child)) for file in children for child in file.read_text().split())


if __name__ == "__main__":
    sys.exit(main())
