"""Reports for people: tables in Markdown, and plots."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from scipy.stats import ecdf

from index.evaluation.predictions import Predictions
from models.citymap.types import Floats
from models.training.metrics import LOCALIZATION_RADII_M

DPI = 130
MAX_ERROR_M = 100.0  # end of the error curve
MAX_SCENES = 9  # panels of the error map
ERROR_BANDS = (
    (15.0, np.inf, "#e63946", "over 15 m"),
    (5.0, 15.0, "#e0a84f", "5 to 15 m"),
    (-1.0, 5.0, "#2a9d8f", "within 5 m"),
)
Table = tuple[tuple[str, ...], list[tuple[str, ...]]]  # head, rows


def write_report(directory: Path, predictions: Predictions, report: dict[str, Any]) -> None:
    """Write report.json, report.md and PNGs: recall, errors, calibration, map, and growth if the gallery grew."""
    (directory / "report.json").write_text(json.dumps(report, indent=2, ensure_ascii=False) + "\n")
    (directory / "report.md").write_text(markdown(report))
    curve = _recall_curve(predictions)
    _draw(directory / "recall.png", lambda axes: _draw_recall(axes, curve, report))
    _draw(directory / "errors.png", lambda axes: _draw_errors(axes, predictions))
    _draw(directory / "calibration.png", lambda axes: _draw_calibration(axes, report))
    _draw_maps(directory / "map.png", predictions, report)
    (directory / "growth.png").unlink(missing_ok=True)
    if "growth" in report:
        _draw(directory / "growth.png", lambda axes: _draw_growth(axes, report["growth"]))


def main_table(report: dict[str, Any]) -> Table:
    """Return the recalls of the model, cell centres, chance and exact matching."""
    rows = {
        "model": report,
        "retrieved cell's centre": {"localization": report["cell_center"]},
        "oracle cell's centre": {"localization": report["oracle"]},
        "chance": report["chance"],
    }
    if "ambiguity" in report:
        rows["exact matching of hints"] = {"retrieval": report["ambiguity"]["exact_matching"]}
    head = ("", "R@1", "R@3", "R@5", "k=1: 5/10/15 m", "k=5", "k=10")
    return head, [(name, *_cells(row)) for name, row in rows.items()]


def group_table(title: str, groups: dict[str, Any]) -> Table:
    """Return the recalls of groups of queries."""
    head = (title, "queries", "R@1", "R@3", "R@5", "k=1: 5/10/15 m", "k=5", "k=10")
    return head, [(name, f"{row['queries']}", *_cells(row)) for name, row in groups.items()]


def growth_table(growth: list[dict[str, Any]]) -> Table:
    """Return the recalls by size of the gallery, and the relative change of recall@1."""
    head = ("radius", "cells", "queries", "R@1", "R@3", "R@5", "R@1 against the first")
    first = growth[0]["retrieval"]["1"] or 1.0
    return head, [
        (f"{row['radius_m']:g} m", f"{row['cells']}", f"{row['queries']}", *(_cells(row)[:3]),
         f"{row['retrieval']['1'] / first - 1:+.1%}")
        for row in growth
    ]  # fmt: skip


def markdown(report: dict[str, Any]) -> str:
    """Return the report as a page."""
    intervals = report["intervals"]["retrieval"]
    lines = [
        f"# {report['data']}, {report['split']}",
        f"{report['queries']} queries, {report['cells']} cells; {report['model']} ({report['method']})",
        as_markdown(main_table(report)),
        "95 % intervals (bootstrap over queries): "
        + ", ".join(f"R@{k} {low:.3f}-{high:.3f}" for k, (low, high) in intervals.items())
        + f". Calibration error of the probability: {report['calibration']['expected_calibration_error']:.3f}."
        + _coverage_text(report),
    ]
    for title, key in (("scene", "by_scene"), ("strategy", "by_strategy")):
        if report[key]:
            lines.append(as_markdown(group_table(title, report[key])))
    if "growth" in report:
        lines.append(as_markdown(growth_table(report["growth"])))
    plots = ["recall", "errors", "calibration", "map", *(["growth"] if "growth" in report else [])]
    lines += [f"![{name}]({name}.png)" for name in plots]
    return "\n\n".join(lines) + "\n"


def _coverage_text(report: dict[str, Any]) -> str:
    return "".join(
        f" Its {name[1:]} % radius contains {row['true']:.1%} of the queries (median {row['median_m']:.1f} m)."
        for name, row in report.get("coverage", {}).items()
    )


def as_markdown(table: Table) -> str:
    """Return a table in Markdown."""
    head, rows = table
    return "\n".join("| " + " | ".join(row) + " |" for row in (head, ("---",) * len(head), *rows))


def _cells(row: dict[str, Any]) -> list[str]:
    """Return six cells: recall@1, 3, 5, and localization recall for k = 1, 5, 10."""
    recall = [f"{value:.3f}" for value in row.get("retrieval", {}).values()] or ["-"] * 3
    within = ["/".join(f"{v:.3f}" for v in by.values()) for by in row.get("localization", {}).values()] or ["-"] * 3
    return recall + within


def _recall_curve(p: Predictions) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    hits = (p.ranked == p.queried_cells[:, None]) & (p.queried_cells[:, None] >= 0)
    return np.cumsum(hits.mean(axis=0))


def _draw(path: Path, draw: Callable[[Axes], None]) -> None:
    figure = Figure(figsize=(6.4, 4.2), layout="constrained", dpi=DPI)
    draw(figure.subplots())
    FigureCanvasAgg(figure).print_png(path)


def _draw_recall(axes: Axes, curve: np.ndarray[Any, Any], report: dict[str, Any]) -> None:
    ks = np.arange(1, len(curve) + 1)
    axes.plot(ks, curve, marker="o", ms=3, color="#1d3557", label="model")
    if "ambiguity" in report:
        exact = report["ambiguity"]["exact_matching"]
        ks_of_exact = [int(k) for k in exact]
        axes.plot(ks_of_exact, exact.values(), "s--", ms=4, color="#e0a84f", label="exact matching of hints")
    axes.plot(ks, ks / report["cells"], ":", color="#8d99ae", label="chance")
    axes.set(xlabel="k", ylabel="retrieval recall@k", ylim=(0, 1), xlim=(0.5, len(curve) + 0.5))
    axes.set_title(f"{report['data']}, {report['split']}: {report['cells']} cells", fontsize=10)
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)


def _draw_errors(axes: Axes, p: Predictions) -> None:
    rows = {
        "first prediction": p.errors_m()[:, 0],
        "best of 5": p.errors_m()[:, :5].min(axis=1),
        "oracle cell's centre": p.center_errors_m(p.queried_cells[:, None])[:, 0],
    }
    for (name, errors), style in zip(rows.items(), ("-", "--", ":"), strict=True):
        steps = ecdf(np.minimum(errors, 10 * MAX_ERROR_M)).cdf  # another scene is further than any error
        axes.plot([0, *steps.quantiles], [0, *steps.probabilities], style, drawstyle="steps-post", label=name)
    for radius in LOCALIZATION_RADII_M:
        axes.axvline(radius, color="#c5cad3", lw=0.8, zorder=0)
    axes.set(xlabel="error in the plane (m)", ylabel="share of queries", xlim=(0, MAX_ERROR_M), ylim=(0, 1.01))
    axes.legend(frameon=False, loc="lower right")
    axes.grid(alpha=0.3)


def _draw_calibration(axes: Axes, report: dict[str, Any]) -> None:
    """Draw how often the first cell is right by its probability; a dot's area is its share of queries."""
    bins = report["calibration"]["bins"]
    claimed, true = ([b[name] for b in bins] for name in ("claimed", "true"))
    area = [20 + 600 * b["queries"] / report["queries"] for b in bins]
    axes.plot([0, 1], [0, 1], ":", color="#8d99ae", label="calibrated")
    axes.plot(claimed, true, color="#1d3557", lw=1)
    axes.scatter(claimed, true, s=area, color="#1d3557", alpha=0.7, label="model")
    error = report["calibration"]["expected_calibration_error"]
    axes.set(xlabel="probability claimed", ylabel="share true", xlim=(0, 1), ylim=(0, 1.02))
    axes.set_title(f"{report['data']}, {report['split']}: expected calibration error {error:.3f}", fontsize=10)
    axes.grid(alpha=0.3)
    axes.legend(frameon=False, loc="upper left")


def _draw_maps(path: Path, p: Predictions, report: dict[str, Any]) -> None:
    """Draw where the first prediction is right, near or far; one panel per scene, at the same scale."""
    scenes = np.unique(p.scenes).tolist()[:MAX_SCENES]
    columns = min(3, len(scenes))
    rows = -(-len(scenes) // columns)
    figure = Figure(figsize=(1.5 + 5 * columns, 0.6 + 5 * rows), layout="constrained", dpi=DPI)
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    errors = p.errors_m()[:, 0]
    for axes, scene in zip(panels[: len(scenes)], scenes, strict=True):
        _draw_map(axes, p, scene, errors)
    for axes in panels[len(scenes) :]:
        axes.set_axis_off()
    names = [f"{name}: {_between(errors, low, high).mean():.0%}" for low, high, _, name in ERROR_BANDS]
    figure.legend(panels[0].collections[1:], names, loc="outside upper right", frameon=False, fontsize=8, markerscale=3)
    figure.suptitle(
        f"{report['data']}, {report['split']}: error of the first prediction", fontsize=10, x=0.02, ha="left"
    )
    figure.text(0.995, 0.002, report["attribution"], fontsize=6, ha="right")
    FigureCanvasAgg(figure).print_png(path)


def _draw_map(axes: Axes, p: Predictions, scene: str, errors_m: Floats) -> None:
    in_scene = p.scenes == scene
    x, y = p.cell_centers_m[p.cell_scenes == scene].T
    axes.scatter(x, y, s=2, color="#e3e6eb", linewidths=0)
    for low, high, colour, _ in ERROR_BANDS:
        x, y = p.positions_m[in_scene & _between(errors_m, low, high)].T
        axes.scatter(x, y, s=5, color=colour, linewidths=0)
    axes.set_aspect("equal")
    axes.set(xlabel="east (m)", ylabel="north (m)")
    axes.set_title(f"{scene}: {in_scene.sum()} queries", fontsize=9)
    axes.tick_params(labelsize=7)


def _between(errors_m: Floats, low: float, high: float) -> np.ndarray[Any, np.dtype[np.bool_]]:
    return (errors_m > low) & (errors_m <= high)


def _draw_growth(axes: Axes, growth: list[dict[str, Any]]) -> None:
    cells = [row["cells"] for row in growth]
    for k in growth[0]["retrieval"]:
        axes.plot(cells, [row["retrieval"][k] for row in growth], marker="o", label=f"recall@{k}")
    axes.set(xlabel="cells in the gallery", ylabel=f"recall, the same {growth[0]['queries']} queries", ylim=(0, 1))
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)
