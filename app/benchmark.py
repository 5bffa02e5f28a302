"""How fast and how large, on this machine: building an index, and answering over HTTP."""

import itertools
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import numpy as np

from app.settings import load_settings
from models.errors import HereaboutsError

if TYPE_CHECKING:  # so that the command line starts without torch
    from index.localizer import Localizer

REQUESTS = 200
WARM_UP = 10  # requests that are not counted
HINTS = 6
PARTS = 100  # descriptions whose parts are measured in one thread
POLL_S = 0.1
START_S = 120.0


def run_benchmark(map_path: Path, index_dir: Path) -> dict[str, Any]:
    """Measure this machine.

    Args:
        map_path: map to index once more, into a directory that is removed again.
        index_dir: index to serve.

    Returns:
        Figures by stage: index building, seconds from starting `hereabouts serve` until it is ready and of one whole
        `hereabouts localize`, then latencies of `POST /localize` with one client, warm, each
        description of six hints: new text about places of the map, the same beside a process that keeps a CPU busy,
        new text that fits many places, text that was read before, and, as the baseline of the same run, an endpoint
        that computes nothing; then the parts of an answer, see `measure_parts`.
    """
    with tempfile.TemporaryDirectory() as scratch:
        index = measure_index(map_path, Path(scratch) / "index")
    settings = load_settings(index_dir=index_dir)
    localizer = _open(index_dir, settings.weights_dir, settings.posterior_weights_dir)
    texts = descriptions(localizer, 2 * (WARM_UP + REQUESTS))
    a_text = ["localize", "--index", str(index_dir), " ".join(texts[0])]
    localize_s = _timed_run(a_text)
    start = time.perf_counter()
    with serving(index_dir) as client:
        ready_s = time.perf_counter() - start
        new, number = iter(texts), itertools.count()
        fresh = latencies(lambda: _localize(client, next(new)))
        with busy_process():
            beside = latencies(lambda: _localize(client, next(new)))
        vague = latencies(lambda: _localize(client, tuple(_vague_hint(next(number)) for _ in range(HINTS))))
        cached = latencies(lambda: _localize(client, texts[0]))
        nothing = latencies(lambda: client.get("/healthz").raise_for_status())
    return {
        "index": index,
        "start_seconds": {"serve_until_ready": round(ready_s, 1), "localize": round(localize_s, 1)},
        "localize_new_text_ms": fresh,
        "localize_new_text_beside_a_busy_process_ms": beside,
        "localize_new_vague_text_ms": vague,
        "localize_cached_hints_ms": cached,
        "healthz_ms": nothing,
        "new_text_over_cached": round(fresh["p50"] / cached["p50"], 1),
        "busy_over_idle": round(beside["p50"] / fresh["p50"], 2),
        "one_thread": measure_parts(localizer, texts[:PARTS]),
    }


def descriptions(localizer: "Localizer", count: int) -> list[tuple[str, ...]]:
    """The nearest things round random positions of a map, in the benchmark's words, at most `HINTS` each.

    Args:
        localizer: of the map.
        count: descriptions; fewer where there is little to tell.
    """
    from index.evaluation.robustness import nearest_hints  # noqa: PLC0415 - heavy
    from models.city.templates import render_hint  # noqa: PLC0415

    cells, rng = localizer.gallery.cells, np.random.default_rng(0)
    around, data = localizer.posterior.surroundings, localizer.map_data()
    told = np.flatnonzero(np.diff(around.cell_starts))  # where something is
    rows = rng.choice(told, 2 * count)
    positions_m = cells.center_m[rows, :2] + rng.uniform(-cells.size_m / 4, cells.size_m / 4, (len(rows), 2))
    hints = nearest_hints(data, positions_m, rows, around, HINTS)
    return [tuple(map(render_hint, some)) for some in hints if some][:count]


def measure_parts(localizer: "Localizer", texts: Sequence[tuple[str, ...]]) -> dict[str, float]:
    """What a description costs, and a cell in bytes.

    Args:
        localizer: what to ask.
        texts: descriptions that it has not read.

    Returns:
        Medians in milliseconds of reading a new description, of its candidates from the vector index and of the
        posterior, and, as the baseline of the same run, of encoding its sentences and of ranking by them.
    """
    from index.vector_localizer import DEPTH  # noqa: PLC0415 - heavy
    from models.posterior.locate import locate  # noqa: PLC0415 - heavy

    posterior, retriever = localizer.posterior, localizer.retriever
    ranker = localizer.by_vectors("none").ranker
    steps: dict[str, list[float]] = {"read": [], "posterior": [], "candidates": [], "encode": [], "vector_search": []}
    for text in texts:
        [hints] = _timed(steps["read"], posterior.texts.parse, [" ".join(text)])
        reading = posterior.binding.reading(hints)
        also = _timed(steps["candidates"], posterior.candidates, hints, reading)
        _timed(steps["posterior"], partial(locate, also=also), posterior.nodes, reading)
        encoded = _timed(steps["encode"], retriever.encode_texts, [text])
        _timed(steps["vector_search"], ranker.rank, encoded, DEPTH)
    surroundings, cells = posterior.surroundings, len(localizer.gallery.cells)
    return {f"{name}_ms": round(1000 * float(np.median(seconds)), 1) for name, seconds in steps.items()} | {
        "cells": cells,
        "surroundings_bytes_a_cell": round(surroundings.num_bytes / cells),
        "vectors_bytes_a_cell": round(4 * localizer.facts.dim + ranker.table.bytes_a_cell),
    }


def _open(index_dir: Path, weights_dir: Path | None, posterior_weights_dir: Path | None) -> "Localizer":
    from index.localizer import Localizer  # noqa: PLC0415 - heavy

    return Localizer.open(index_dir, weights_dir, posterior_weights_dir=posterior_weights_dir)


def _timed(seconds: list[float], work: Callable[..., Any], *given: Any) -> Any:
    start = time.perf_counter()
    done = work(*given)
    seconds.append(time.perf_counter() - start)
    return done


def _timed_run(arguments: Sequence[str]) -> float:
    start = time.perf_counter()
    subprocess.run([*_hereabouts(), *arguments], stdout=subprocess.DEVNULL, check=True)
    return time.perf_counter() - start


def measure_index(map_path: Path, out: Path) -> dict[str, float]:
    """Seconds, peak memory of all its processes together (PSS), and size of one `hereabouts index`."""
    start = time.perf_counter()
    job = subprocess.Popen(
        [*_hereabouts(), "index", "--map", str(map_path), "--out", str(out)], stdout=subprocess.DEVNULL
    )
    peak = 0
    while job.poll() is None:
        peak = max(peak, sum(_pss_bytes(pid) for pid in _tree(job.pid)))
        time.sleep(POLL_S)
    if job.returncode:
        raise subprocess.CalledProcessError(job.returncode, "hereabouts index")
    seconds = time.perf_counter() - start
    size = sum(path.stat().st_size for path in out.rglob("*") if path.is_file())
    shutil.rmtree(out)
    return {"seconds": round(seconds, 1), "peak_memory_mib": round(peak / 2**20), "size_mib": round(size / 2**20, 1)}


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
def serving(index_dir: Path) -> Iterator[httpx.Client]:
    """A service of an index on a free local port, ready to answer."""
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
            yield client
    finally:
        server.terminate()
        server.wait(timeout=30)


def latencies(request: Callable[[], Any]) -> dict[str, float]:
    """p50 and p99 in milliseconds of a request repeated, after a few that are not counted."""
    seconds = []
    for n in range(WARM_UP + REQUESTS):
        start = time.perf_counter()
        request()
        if n >= WARM_UP:
            seconds.append(time.perf_counter() - start)
    p50, p99 = np.percentile(seconds, [50, 99]) * 1000
    return {"p50": round(float(p50), 1), "p99": round(float(p99), 1)}


def _localize(client: httpx.Client, hints: tuple[str, ...]) -> None:
    client.post("/localize", json={"hints": hints}).raise_for_status()


def _vague_hint(n: int) -> str:
    """A sentence that no one has sent before and that fits many places."""
    direction = ("north", "south", "east", "west")[n % 4]
    return f"I am {direction} of a gray building with the number {n}."


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


def _tree(pid: int) -> Iterator[int]:
    """A process and its descendants (Linux)."""
    yield pid
    try:
        children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    except OSError:
        return
    for child in children:
        yield from _tree(int(child))


def _pss_bytes(pid: int) -> int:
    """Memory of a process, with what it shares split among those that share it; 0 if it is gone."""
    try:
        lines = Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) * 1024 for line in lines if line.startswith("Pss:")), 0)
