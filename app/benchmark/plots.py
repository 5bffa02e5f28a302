"""Charts of a growing city: its costs and its latencies."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator

from index.evaluation.report import DPI

Size = dict[str, Any]
Lines = dict[str, tuple[str, ...]]  # label: keys of its value
COSTS: Final[dict[str, Lines]] = {
    "seconds": {"writing the map": ("map", "seconds"), "building the index": ("index", "seconds")},
    "memory (MiB)": {
        "building, peak": ("index", "peak_memory_mib"),
        "service, ready": ("serve", "memory_mib", "ready"),
        "service, after queries": ("serve", "memory_mib", "after_queries"),
    },
    "bytes a cell": {
        "index, all files": ("index", "bytes_a_cell", "all"),
        "pieces": ("index", "bytes_a_cell", "pieces.safetensors"),
        "vectors": ("index", "bytes_a_cell", "vectors.faiss"),
    },
}
LATENCIES: Final[Lines] = {
    "POST /localize, p99": ("localize", "anywhere", "p99"),
    "POST /localize, p50": ("localize", "anywhere", "p50"),
    "the same within 1 % of the area, p50": ("localize", "within_1_percent", "p50"),
    "reading": ("one_thread", "read_ms"),
    "encoding": ("one_thread", "encode_ms"),
    "candidates": ("one_thread", "candidates_ms"),
    "posterior": ("one_thread", "posterior_ms"),
    "vector search, FAISS": ("vector_search", "faiss_ms"),
    "vector search, Milvus": ("vector_search", "milvus", "ms"),
}


def draw_costs(path: Path, sizes: Sequence[Size]) -> None:
    """Write a PNG of seconds, memory and bytes per cell over cells, from the sizes of `run_growth`."""
    figure = Figure(figsize=(13, 4.2), layout="constrained", dpi=DPI)
    for axes, (unit, lines) in zip(figure.subplots(1, len(COSTS)), COSTS.items(), strict=True):
        _draw(axes, sizes, lines, unit)
        if axes.lines:
            axes.legend(frameon=False, fontsize=8)
    FigureCanvasAgg(figure).print_png(path)


def draw_latencies(path: Path, sizes: Sequence[Size]) -> None:
    """Write a PNG of the milliseconds of answers and their parts over cells, from the sizes of `run_growth`."""
    figure = Figure(figsize=(9, 4.6), layout="constrained", dpi=DPI)
    axes = figure.subplots()
    _draw(axes, sizes, LATENCIES, "ms")
    if axes.lines:
        figure.legend(loc="outside right upper", frameon=False, fontsize=8)
    FigureCanvasAgg(figure).print_png(path)


def _draw(axes: Any, sizes: Sequence[Size], lines: Lines, unit: str) -> None:
    """Draw lines over cells on logarithmic axes, without values that were not measured."""
    for n, (label, keys) in enumerate(lines.items()):
        points = [(size["cells"], _value(size, keys)) for size in sizes]
        known = [(cells, value) for cells, value in points if value]
        if known:
            axes.plot(*zip(*known, strict=True), marker="osD^v"[n % 5], markersize=5, label=label)
    axes.set(xscale="log", yscale="log", xlabel="cells", ylabel=unit)
    axes.set_xticks([size["cells"] for size in sizes], [f"{size['cells']:,}" for size in sizes], fontsize=8)
    axes.minorticks_off()
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.6g}"))
    axes.grid(alpha=0.3)


def _value(size: Any, keys: Sequence[str]) -> Any:
    for key in keys:
        size = size.get(key) if isinstance(size, dict) else None
    return size
