"""The processes that are measured: `hereabouts index`, `hereabouts serve`, a neighbour; their time and memory."""

import socket
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx

from app.settings import load_settings
from models.errors import HereaboutsError

POLL_S = 0.1
LOOKING = 20  # of so many parts of the time one at most goes to counting pages, which slows who has many
START_S = 600.0  # a large index is read and its sums are checked


@dataclass(frozen=True, slots=True)
class Service:
    """A service that runs.

    Attributes:
        client: asks it.
        pid: of its first process.
    """

    client: httpx.Client
    pid: int

    def memory_mib(self) -> int:
        """Memory of all its processes together in MiB."""
        return _memory_mib(self.pid)


def measure_index(map_path: Path, out: Path) -> dict[str, float]:
    """Seconds, peak memory of all its processes together, and size of one `hereabouts index`.

    Args:
        map_path: map to index.
        out: directory of the index, which is kept.

    Raises:
        HereaboutsError: it did not end well.
    """
    start = time.perf_counter()
    job = subprocess.Popen(
        [*_hereabouts(), "index", "--map", str(map_path), "--out", str(out)], stdout=subprocess.DEVNULL
    )
    peak = 0
    try:
        while job.poll() is None:
            looked = time.perf_counter()
            peak = max(peak, _memory_mib(job.pid))
            time.sleep(max(POLL_S, LOOKING * (time.perf_counter() - looked)))
    finally:
        job.kill()
    if job.returncode:
        raise HereaboutsError(
            f"'hereabouts index' of {map_path.name} ended with {job.returncode}; if it was killed (-9), it needs more "
            "memory than there is: ask for a smaller city"
        )
    seconds = time.perf_counter() - start
    size = sum(path.stat().st_size for path in out.rglob("*") if path.is_file())
    return {"seconds": round(seconds, 1), "peak_memory_mib": peak, "size_mib": round(size / 2**20, 1)}


def timed_run(arguments: Sequence[str]) -> float:
    """Seconds of one whole `hereabouts` with these arguments."""
    start = time.perf_counter()
    subprocess.run([*_hereabouts(), *arguments], stdout=subprocess.DEVNULL, check=True)
    return time.perf_counter() - start


@contextmanager
def busy_process() -> Iterator[None]:
    """A neighbour that keeps one CPU busy."""
    process = subprocess.Popen([sys.executable, "-c", "while True: pass"])
    try:
        yield
    finally:
        process.kill()
        process.wait()


@contextmanager
def serving(index_dir: Path) -> Iterator[Service]:
    """A service of an index on a free local port, ready to answer.

    Raises:
        HereaboutsError: it does not become ready.
    """
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    key = load_settings().read_key
    headers = {} if key is None else {"Authorization": f"Bearer {key.get_secret_value()}"}
    command = [*_hereabouts(), "serve", "--index", str(index_dir), "--port", str(port)]
    server = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        url = f"http://127.0.0.1:{port}"
        with httpx.Client(base_url=url, headers=headers, timeout=30, trust_env=False) as client:
            _wait_until_ready(client, server)
            yield Service(client, server.pid)
    finally:
        server.terminate()
        server.wait(timeout=30)


def _wait_until_ready(client: httpx.Client, server: "subprocess.Popen[bytes]") -> None:
    deadline = time.monotonic() + START_S
    while time.monotonic() < deadline and server.poll() is None:
        try:
            if client.get("/readyz").status_code == httpx.codes.OK:
                return
        except httpx.TransportError:
            pass
        time.sleep(POLL_S)
    raise HereaboutsError("the service did not become ready; try 'hereabouts serve' to see why")


def _hereabouts() -> list[str]:
    return [sys.executable, "-m", "app.cli.main"]


def _memory_mib(pid: int) -> int:
    """Memory of a process and its descendants (Linux): their own pages, and each page of a file once.

    Their PSS would be less while other processes have the same libraries open, as who measures has.
    """
    own, files = 0, dict[str, int]()
    for each in _tree(pid):
        for part, kib in _mappings(each):
            if part:
                files[part] = max(files.get(part, 0), kib["Rss"] - kib["Anonymous"])
            own += kib.get("Pss_Dirty", 0) if part else kib["Pss"]
    return round((own + sum(files.values())) / 2**10)


def _tree(pid: int) -> Iterator[int]:
    """A process and its descendants (Linux)."""
    yield pid
    for file in Path(f"/proc/{pid}/task").glob("*/children"):  # any thread may have forked: workers are of another one
        try:
            children = file.read_text().split()
        except OSError:
            continue
        for child in children:
            yield from _tree(int(child))


def _mappings(pid: int) -> Iterator[tuple[str, dict[str, int]]]:
    """The mappings of a process: which part of which file, "" of none, and KiB by kind; nothing if it is gone."""
    try:
        lines = Path(f"/proc/{pid}/smaps").read_text().splitlines()
    except OSError:
        return
    part, kib = "", dict[str, int]()
    for line in lines:
        name, value, *rest = line.split(maxsplit=5)
        if name.endswith(":"):
            if rest == ["kB"]:
                kib[name[:-1]] = int(value)
        else:  # addresses, permissions, offset, device, inode, path
            if kib:
                yield part, kib
            part, kib = (" ".join((value, *rest)) if rest[2] != "0" else ""), {}
    if kib:
        yield part, kib
