"""Benchmark of building an index and answering over HTTP on this machine."""

import itertools
import tempfile
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx
import numpy as np

from app.benchmark.processes import busy_process, measure_index, serving, timed_run
from app.settings import open_index

if TYPE_CHECKING:  # so that the command line starts without torch
    from index.answering.localizer import Localizer

REQUESTS = 200
WARM_UP = 10  # requests that are not measured
MAX_HINTS = 6  # per description
PARTS = 100  # descriptions for `measure_parts`


def run_benchmark(map_path: Path, index_dir: Path) -> dict[str, Any]:
    """Measure indexing of a map, and the start and warm latencies of the service of an index, on this machine."""
    with tempfile.TemporaryDirectory() as scratch:
        index = measure_index(map_path, Path(scratch) / "index")
    localizer = open_index(index_dir)
    texts = descriptions(localizer, 2 * (WARM_UP + REQUESTS))
    a_text = ["localize", "--index", str(index_dir), " ".join(texts[0])]
    localize_s = timed_run(a_text)
    start = time.perf_counter()
    with serving(index_dir) as service:
        ready_s, client = time.perf_counter() - start, service.client
        new, number = iter(texts), itertools.count()
        fresh = latencies(lambda: _localize(client, next(new)))
        with busy_process():
            busy = latencies(lambda: _localize(client, next(new)))
        vague = latencies(lambda: _localize(client, tuple(_vague_hint(next(number)) for _ in range(MAX_HINTS))))
        again = iter(texts)
        cached = latencies(lambda: _localize(client, next(again)))
        nothing = latencies(lambda: client.get("/healthz").raise_for_status())
    return {
        "index": index,
        "start_seconds": {"serve_until_ready": round(ready_s, 1), "localize": round(localize_s, 1)},
        "localize_new_text_ms": fresh,
        "localize_new_text_beside_a_busy_process_ms": busy,
        "localize_new_vague_text_ms": vague,
        "localize_cached_hints_ms": cached,
        "healthz_ms": nothing,
        "new_text_over_cached": round(fresh["p50"] / cached["p50"], 1),
        "busy_over_idle": round(busy["p50"] / fresh["p50"], 2),
        "one_thread": measure_parts(localizer, texts[:PARTS]),
    }


def descriptions(localizer: "Localizer", count: int) -> list[tuple[str, ...]]:
    """Describe the nearest objects of at most `count` random positions by templates, up to `MAX_HINTS` each."""
    from index.evaluation.localizers import map_of_index  # noqa: PLC0415 - heavy
    from index.evaluation.robustness import nearest_hints  # noqa: PLC0415
    from models.citymap.templates import render_hint  # noqa: PLC0415

    cells, rng = localizer.gallery.cells, np.random.default_rng(0)
    around, data = localizer.posterior.surroundings, map_of_index(localizer)
    occupied = np.flatnonzero(np.diff(around.cell_starts))  # cells with objects
    rows = rng.choice(occupied, 2 * count)
    positions_m = cells.center_m[rows, :2] + rng.uniform(-cells.size_m / 4, cells.size_m / 4, (len(rows), 2))
    hints = nearest_hints(data, positions_m, rows, around, MAX_HINTS)
    return [tuple(map(render_hint, nearest)) for nearest in hints if nearest][:count]


def measure_parts(localizer: "Localizer", texts: Sequence[tuple[str, ...]]) -> dict[str, float]:
    """Measure the steps of answering new descriptions, median ms, and the bytes per cell."""
    from index.answering.vector_localizer import RANKED_CELLS  # noqa: PLC0415 - heavy
    from models.posterior.locate import locate  # noqa: PLC0415 - heavy
    from models.posterior.posterior import PositionEvidence  # noqa: PLC0415 - heavy

    posterior, retriever = localizer.posterior, localizer.retriever
    ranker = localizer.vector_localizer("none").ranker
    steps: dict[str, list[float]] = {"read": [], "posterior": [], "candidates": [], "encode": [], "vector_search": []}
    for text in texts:
        [hints] = _timed(steps["read"], posterior.chunk_reader.parse, [" ".join(text)])
        bound_hints = posterior.binding.bind(hints)
        rows = _timed(steps["candidates"], posterior.search, hints, bound_hints)
        evidence = PositionEvidence(bound_hints)
        _timed(steps["posterior"], partial(locate, proposed=rows), posterior.nodes, evidence)
        encoded = _timed(steps["encode"], retriever.encode_texts, [text])
        _timed(steps["vector_search"], ranker.rank, encoded, RANKED_CELLS)
    surroundings, cells = posterior.surroundings, len(localizer.gallery.cells)
    return {f"{name}_ms": round(1000 * float(np.median(seconds)), 1) for name, seconds in steps.items()} | {
        "cells": cells,
        "surroundings_bytes_a_cell": round(surroundings.num_bytes / cells),
        "vectors_bytes_a_cell": round(4 * localizer.facts.dim + ranker.table.bytes_per_cell),
    }


def _timed(seconds: list[float], work: Callable[..., Any], *arguments: Any) -> Any:
    start = time.perf_counter()
    result = work(*arguments)
    seconds.append(time.perf_counter() - start)
    return result


def latencies(request: Callable[[], Any]) -> dict[str, float]:
    """Repeat a request; return p50 and p99 in milliseconds, without the warm-up."""
    seconds = []
    for n in range(WARM_UP + REQUESTS):
        start = time.perf_counter()
        request()
        if n >= WARM_UP:
            seconds.append(time.perf_counter() - start)
    return percentiles(seconds)


def percentiles(seconds: Sequence[float]) -> dict[str, float]:
    """Return p50 and p99 in milliseconds of one or more durations."""
    p50, p99 = np.percentile(seconds, [50, 99]) * 1000
    return {"p50": round(float(p50), 1), "p99": round(float(p99), 1)}


def _localize(client: httpx.Client, hints: tuple[str, ...]) -> None:
    client.post("/localize", json={"hints": hints}).raise_for_status()


def _vague_hint(n: int) -> str:
    direction = ("north", "south", "east", "west")[n % 4]
    return f"I am {direction} of a gray building with the number {n}."
