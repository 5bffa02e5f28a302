"""The parts that the load scripts share: a service on one index, and descriptions to send to it."""

import os
import random
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from http import HTTPStatus

import httpx

STREETS = (
    "Bulevardi",
    "Fredrikinkatu",
    "Annankatu",
    "Mannerheimintie",
    "Aleksanterinkatu",
    "Unioninkatu",
    "Kaisaniemi",
)
THINGS = ("bank", "church", "hotel", "pharmacy", "cafe", "park", "statue", "tram stop", "school", "cinema", "fountain")
SYLLABLES = ("ka", "lo", "ri", "ne", "ta", "vi", "su", "mo", "pe", "hal", "kin", "ster")
START_S = 120


@contextmanager
def started(index: str) -> Iterator[tuple[int, str]]:
    """A service on an index: its process, and where it answers, once it does."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = (sys.executable, "-m", "app.cli.main", "serve", "--index", index, "--port", str(port))
    service = subprocess.Popen(command, env=os.environ | {"HEREABOUTS_LOG_LEVEL": "error"})
    url = f"http://127.0.0.1:{port}"
    try:
        end = time.monotonic() + START_S
        while not is_ready(url):
            if service.poll() is not None or time.monotonic() > end:
                raise SystemExit(f"the service is not ready after {START_S} s, or has ended")
            time.sleep(0.1)
        yield service.pid, url
    finally:
        service.terminate()
        service.wait()


def is_ready(url: str) -> bool:
    """Whether the service answers."""
    try:
        return httpx.get(f"{url}/readyz").status_code == HTTPStatus.OK
    except httpx.TransportError:
        return False


def text(rng: random.Random, share_new: float = 1.0) -> str:
    """A description of Helsinki, the share of those that nobody has said before; the others are among a few hundred."""
    if rng.random() < share_new:
        name = "".join(rng.choices(SYLLABLES, k=5)).title()
    else:
        rng, name = random.Random(rng.randrange(500)), "Ekberg"
    street, left, behind = rng.choice(STREETS), rng.choice(THINGS), rng.choice(THINGS)
    return f"I'm on {street} by Cafe {name}, the {left} on my left and a {name.lower()} {behind} behind me."
