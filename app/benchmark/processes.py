"""Starting `hereabouts index`, `hereabouts serve` and a busy process, and measuring time and memory."""

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
POLL_DUTY_DIVISOR = 20  # at most 1/20 of the time is spent reading smaps, which slows processes with many pages
START_S = 600.0  # a large index takes long to read


@dataclass(frozen=True, slots=True)
class Service:
    """A running service: an HTTP client, and its first process."""

    client: httpx.Client
    pid: int

    def memory_mib(self) -> int:
        """Return the memory of all its processes together in MiB."""
        return _memory_mib(self.pid)


def measure_index(map_path: Path, out: Path) -> dict[str, float]:
    """Run `hereabouts index`; return its seconds, the peak memory of all its processes, and the size of the index."""
    start = time.perf_counter()
    job = subprocess.Popen(
        [*_hereabouts(), "index", "--map", str(map_path), "--out", str(out)], stdout=subprocess.DEVNULL
    )
    peak = 0
    try:
        while job.poll() is None:
            poll_start = time.perf_counter()
            peak = max(peak, _memory_mib(job.pid))
            time.sleep(max(POLL_S, POLL_DUTY_DIVISOR * (time.perf_counter() - poll_start)))
    finally:
        job.kill()
    if job.returncode:
        raise HereaboutsError(
            f"'hereabouts index' of {map_path.name} failed with exit status {job.returncode}; -9 usually "
            "means that memory ran out: use a smaller city"
        )
    seconds = time.perf_counter() - start
    size = sum(path.stat().st_size for path in out.rglob("*") if path.is_file())
    return {"seconds": round(seconds, 1), "peak_memory_mib": peak, "size_mib": round(size / 2**20, 1)}


def timed_run(arguments: Sequence[str]) -> float:
    """Return the seconds of one run of `hereabouts` with the given arguments."""
    start = time.perf_counter()
    subprocess.run([*_hereabouts(), *arguments], stdout=subprocess.DEVNULL, check=True)
    return time.perf_counter() - start


@contextmanager
def busy_process() -> Iterator[None]:
    """Keep one CPU busy with another process."""
    process = subprocess.Popen([sys.executable, "-c", "while True: pass"])
    try:
        yield
    finally:
        process.kill()
        process.wait()


@contextmanager
def serving(index_dir: Path) -> Iterator[Service]:
    """Start a service of an index on a free local port and yield it when it is ready; HereaboutsError if it is not."""
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
    raise HereaboutsError("the service did not become ready; run 'hereabouts serve' to see why")


def _hereabouts() -> list[str]:
    return [sys.executable, "-m", "app.cli.main"]


def _memory_mib(pid: int) -> int:
    """Return the memory of a process and its descendants (Linux): private pages, and each page of a file once.

    The sum of PSS would be too low, because this process maps the same libraries.
    """
    own, files = 0, dict[str, int]()
    for each in _tree(pid):
        for part, kib in _mappings(each):
            if part:
                files[part] = max(files.get(part, 0), kib["Rss"] - kib["Anonymous"])
            own += kib.get("Pss_Dirty", 0) if part else kib["Pss"]
    return round((own + sum(files.values())) / 2**10)


def _tree(pid: int) -> Iterator[int]:
    yield pid
    for file in Path(f"/proc/{pid}/task").glob("*/children"):  # any thread may have forked
        try:
            children = file.read_text().split()
        except OSError:
            continue
        for child in children:
            yield from _tree(int(child))


def _mappings(pid: int) -> Iterator[tuple[str, dict[str, int]]]:
    """Yield the mappings of a process: the part of a file ("" if anonymous) and KiB by kind; none if it has exited."""
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
