"""Build time, memory, size, latency and accuracy of growing cities, which are tiled copies of a real one."""

import json
import time
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from app.benchmark.processes import measure_index, serving
from app.benchmark.questions import BenchmarkQuery, draw_queries, localize_all, split_questions
from app.benchmark.searches import measure_searches
from app.benchmark.service import PARTS, measure_parts
from app.settings import open_index
from models.errors import DataError, HereaboutsError
from models.sources.osm.city_copies import CityExtract, CopyGrid

if TYPE_CHECKING:  # so that the command line starts without torch
    from index.answering.localizer import Localizer

QUERY_SPLIT = "test"  # split of the map whose places are described
COMPARED = (
    "All figures are from one run on one machine. 'ratios' are relative to the smallest size. FAISS and Milvus search "
    "the same vectors with the same queries. PostGIS and Nominatim are not measured."
)
REPORT_FILE = "benchmark.json"


def parse_sizes(text: str) -> list[int]:
    """Parse numbers of cells such as "1e4,1e5"; return them sorted and without duplicates."""
    try:
        sizes = sorted({round(float(size)) for size in text.split(",")})
    except (ValueError, OverflowError):
        sizes = [0]
    if sizes[0] < 1:
        raise DataError(f"--cells {text}: not a list of numbers of cells; write it as 1e4,1e5,1e6")
    return sizes


def run_growth(map_path: Path, sizes: Sequence[int], out: Path | None = None) -> dict[str, Any]:
    """Measure cities of several sizes, copies of a small one; write benchmark.json and plots to `out` after each size.

    After a size that "failed", larger sizes are skipped. DataError if a size is smaller than the map.
    """
    extract = CityExtract.read(map_path)
    cells, questions = _measure_one_copy(map_path)
    if sizes[0] < cells:
        raise DataError(
            f"--cells {sizes[0]}: one copy of {map_path.name} has {cells} cells; give at least {cells}, or a "
            "smaller map as --map"
        )
    report: dict[str, Any] = {"compared": COMPARED, "assumed": _assumed(map_path, cells), "sizes": [], "ratios": []}
    for size in sizes:
        try:
            with TemporaryDirectory() as scratch:
                report["sizes"].append(_measure_size(extract, round(size / cells), questions, Path(scratch)))
        except HereaboutsError as error:
            report["failed"] = {"cells": size, "why": str(error)}
        report["ratios"] = [ratios(each, report["sizes"][0]) for each in report["sizes"]]
        if out is not None:
            _write(report, out)
        if "failed" in report:
            break
    return report


def _measure_one_copy(map_path: Path) -> tuple[int, list[BenchmarkQuery]]:
    """Return the number of cells of a map and the queries about it."""
    from models.sources.source import open_sources  # noqa: PLC0415 - heavy

    whole, held_out = open_sources(map_path, [None, QUERY_SPLIT])
    questions = draw_queries(held_out)
    split_questions(questions)  # raises MapError before anything is built
    return len(whole.data.cells), questions


def _assumed(map_path: Path, cells: int) -> str:
    return (
        f"One copy of {map_path.name} has {cells} cells on a grid of 10 m, and n copies have about n times as many. "
        f"Descriptions are of places in copy 0, in the split '{QUERY_SPLIT}'. They give classes, colours and "
        "directions, which all copies share, so without a street or a box an answer is in the right copy by chance, "
        "once in n times."
    )


def _measure_size(extract: CityExtract, copies: int, questions: list[BenchmarkQuery], scratch: Path) -> dict[str, Any]:
    """Measure one size: the map, the index, the service, its parts on one thread, and vector search."""
    path, index_dir, start = scratch / "city.osm.pbf", scratch / "index", time.perf_counter()
    block = extract.write_tiled(copies, path)
    written = {"seconds": round(time.perf_counter() - start, 2), "size_mb": round(path.stat().st_size / 1e6, 3)}
    index = measure_index(path, index_dir)
    served = _measure_service(index_dir, questions, block)
    localizer = open_index(index_dir)  # after the service has stopped, so that only one copy is in memory
    cells, texts = localizer.manifest.cells, [question.hints for question in questions[:PARTS]]
    return {
        "cells": cells,
        "copies": copies,
        "map": written,
        "index": index | {"bytes_a_cell": _bytes_a_cell(localizer, index_dir)},
        **served,
        "one_thread": measure_parts(localizer, texts),
        "vector_search": measure_searches(localizer, texts),
    }


def _measure_service(index_dir: Path, questions: list[BenchmarkQuery], block: CopyGrid) -> dict[str, Any]:
    start = time.perf_counter()
    with serving(index_dir) as service:
        ready_s, ready_mib = time.perf_counter() - start, service.memory_mib()
        answers = localize_all(service.client, questions, block)
        memory = {"ready": ready_mib, "after_queries": service.memory_mib()}
    return {"serve": {"ready_seconds": round(ready_s, 1), "memory_mib": memory}, "localize": answers}


def _bytes_a_cell(localizer: "Localizer", index_dir: Path) -> dict[str, float]:
    version, cells = index_dir / localizer.manifest.version, localizer.manifest.cells
    sizes = {path.name: path.stat().st_size for path in sorted(version.iterdir())}
    return {name: round(size / cells, 1) for name, size in {**sizes, "all": sum(sizes.values())}.items()}


def ratios(figures: Any, first: Any) -> Any:
    """Divide figures by those of another size, keeping their structure; None where there is no ratio."""
    if isinstance(figures, dict) and isinstance(first, dict):
        return {key: ratios(value, first.get(key)) for key, value in figures.items()}
    is_number = all(isinstance(value, int | float) for value in (figures, first))
    return round(figures / first, 3) if is_number and first else None


def _write(report: dict[str, Any], out: Path) -> None:
    from app.benchmark.plots import draw_costs, draw_latencies  # noqa: PLC0415 - heavy

    try:
        out.mkdir(parents=True, exist_ok=True)
        (out / REPORT_FILE).write_text(json.dumps(report, indent=2) + "\n")
        if report["sizes"]:
            draw_costs(out / "costs.png", report["sizes"])
            draw_latencies(out / "latencies.png", report["sizes"])
    except OSError as error:
        raise DataError(
            f"{out} cannot be written: {error}; free some space, or give another directory as --out"
        ) from error
