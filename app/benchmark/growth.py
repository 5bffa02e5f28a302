"""How building, memory, size, latency and accuracy grow with a city: copies of a real one side by side."""

import json
import time
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from app.benchmark.processes import measure_index, serving
from app.benchmark.questions import Question, ask_all, shared_out, take_questions
from app.benchmark.searches import measure_searches
from app.benchmark.service import PARTS, measure_parts, open_index
from models.errors import DataError, HereaboutsError
from models.sources.osm.city_copies import CityExtract, CopyGrid

if TYPE_CHECKING:  # so that the command line starts without torch
    from index.answering.localizer import Localizer

ASKED_IN = "test"  # split of the map whose places are described
COMPARED = (
    "Figures are of one run on one machine: 'ratios' are against the smallest size of it, FAISS against Milvus on the "
    "same vectors and queries. PostGIS and Nominatim are not run."
)
REPORT_FILE = "benchmark.json"


def parse_sizes(text: str) -> list[int]:
    """Numbers of cells from "1e4,1e5", ascending, each once.

    Raises:
        DataError: it is no list of numbers of 1 or more.
    """
    try:
        sizes = sorted({round(float(size)) for size in text.split(",")})
    except (ValueError, OverflowError):
        sizes = [0]
    if sizes[0] < 1:
        raise DataError(f"--cells {text}: no list of numbers of cells; give it as 1e4,1e5,1e6")
    return sizes


def run_growth(map_path: Path, sizes: Sequence[int], out: Path | None = None) -> dict[str, Any]:
    """Measure this machine with a city of several sizes.

    Args:
        map_path: OpenStreetMap file of a small city; larger ones are copies of it.
        sizes: cells that each size is to have, about, ascending.
        out: where benchmark.json and two plots go, the first after each size; None to write nothing.

    Returns:
        "compared" and "assumed", what the figures mean; "sizes", see `_measure_size`; "ratios" of their figures to
        those of the smallest; and where a size could not be measured, "failed": which and why. No larger one is tried.

    Raises:
        MapError, DataError: the map cannot be used, or a size is smaller than it.
    """
    extract = CityExtract.read(map_path)
    cells, questions = _of_one_copy(map_path)
    if sizes[0] < cells:
        raise DataError(
            f"--cells {sizes[0]}: one copy of {map_path.name} has {cells} cells; ask for {cells} or more, or give a "
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


def _of_one_copy(map_path: Path) -> tuple[int, list[Question]]:
    """Cells of a map, and what to ask about it."""
    from models.sources.source import open_sources  # noqa: PLC0415 - heavy

    whole, asked = open_sources(map_path, [None, ASKED_IN])
    questions = take_questions(asked)
    shared_out(questions)  # or MapError, before anything is built
    return len(whole.data.cells), questions


def _assumed(map_path: Path, cells: int) -> str:
    return (
        f"one copy of {map_path.name} has {cells} cells on a grid of 10 m, and n copies about n times as many; "
        f"descriptions are of places of copy 0, of the split '{ASKED_IN}'; they tell classes, colours and directions, "
        "which all copies share, so 'accuracy' without a street or a box is right by chance, in one of n copies"
    )


def _measure_size(extract: CityExtract, copies: int, questions: list[Question], scratch: Path) -> dict[str, Any]:
    """All figures of one size.

    Args:
        extract: what is copied.
        copies: how often.
        questions: about copy 0.
        scratch: a directory for the map and its index.

    Returns:
        "cells", "copies"; "map" {"seconds", "size_mb"}; "index", see `measure_index`, with "bytes_a_cell" by file;
        "serve" {"ready_seconds", "memory_mib" when ready and after the queries}; "localize", see `ask_all`;
        "one_thread", see `measure_parts`; "vector_search", see `measure_searches`.
    """
    path, index_dir, start = scratch / "city.osm.pbf", scratch / "index", time.perf_counter()
    block = extract.write_tiled(copies, path)
    written = {"seconds": round(time.perf_counter() - start, 2), "size_mb": round(path.stat().st_size / 1e6, 3)}
    index = measure_index(path, index_dir)
    served = _measure_service(index_dir, questions, block)
    localizer = open_index(index_dir)  # when the service has ended, so that memory holds one of them
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


def _measure_service(index_dir: Path, questions: list[Question], block: CopyGrid) -> dict[str, Any]:
    start = time.perf_counter()
    with serving(index_dir) as service:
        ready_s, ready_mib = time.perf_counter() - start, service.memory_mib()
        asked = ask_all(service.client, questions, block)
        memory = {"ready": ready_mib, "after_queries": service.memory_mib()}
    return {"serve": {"ready_seconds": round(ready_s, 1), "memory_mib": memory}, "localize": asked}


def _bytes_a_cell(localizer: "Localizer", index_dir: Path) -> dict[str, float]:
    """Of an index on disk, by file, and of all."""
    version, cells = index_dir / localizer.manifest.version, localizer.manifest.cells
    sizes = {path.name: path.stat().st_size for path in sorted(version.iterdir())}
    return {name: round(size / cells, 1) for name, size in {**sizes, "all": sum(sizes.values())}.items()}


def ratios(figures: Any, first: Any) -> Any:
    """Figures as multiples of those of another size, of the same shape; None where there is no ratio."""
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
        raise DataError(f"{out} cannot be written: {error}; make room, or give another directory as --out") from error
