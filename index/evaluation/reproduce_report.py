"""The report of `reproduce`: our figures beside the published ones, in Markdown, with plots."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from index.evaluation.report import DPI, Table, as_markdown
from models.training.experiments import (
    EXPERIMENTS,
    FIGURE_4A,
    FIGURE_4B,
    FINE,
    GROWTH,
    LOCALIZATION,
    MNCL,
    ORDERS,
    Experiment,
    Row,
    Run,
)
from models.training.metrics import RETRIEVAL_KS

PUBLISHED = " (paper)"
Found = dict[str, Any]


def write_reproduction(directory: Path, found: Found, name: str) -> None:
    """Write results.json, report.md, figure4.png and figure5.png.

    Args:
        directory: made if it is missing.
        found: what `index.evaluation.reproduce.reproduce` gave.
        name: of the data.
    """
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "results.json").write_text(json.dumps(found, indent=1) + "\n")
    (directory / "report.md").write_text(markdown(found, name))
    _draw_figure_4(directory / "figure4.png", found)
    _draw_figure_5(directory / "figure5.png", found)


def markdown(found: Found, name: str) -> str:
    """The report as a page."""
    data, seeds = found["data"], found["seeds"]
    exact = ", ".join(f"R@{k} {value:.3f}" for k, value in data["exact_matching"].items())
    spread = "mean ± standard deviation over them, figure 4 of the first" if len(seeds) > 1 else "one run each"
    parts = [
        f"# The paper's tables and figures on {name}",
        f"Test scenes: {data['cells']} cells, {data['queries']} queries. Seeds {', '.join(map(str, seeds))}; {spread}. "
        f"Exact matching of the hints, which knows what each sentence means: {exact}. Columns marked (paper) are "
        "published figures on KITTI360Pose's test scenes: other data, so their order is what compares.",
    ]
    for experiment in EXPERIMENTS:
        parts += [f"## {experiment.title}", as_markdown(_table(experiment, found))]
    parts += ["![figure 4](figure4.png)", "## Figure 5: a growing gallery", as_markdown(_growth_table(found))]
    parts += ["![figure 5](figure5.png)", "## Do the orders hold?", as_markdown(_orders_table(found))]
    parts += ["## Ranking, validation scenes", as_markdown(_ranking_table(found))]
    parts += ["## Fine stages, true cell given, validation scenes", as_markdown(_fine_table(found))]
    parts += ["## What training costs", as_markdown(_cost_table(found))]
    return "\n\n".join(parts) + "\n"


def _table(experiment: Experiment, found: Found) -> Table:
    head = ["", *experiment.metrics]
    published = [m for m in experiment.metrics if any(m in row.published for row in experiment.rows)]
    rows = [
        (row.name, *_figures(row, experiment, found), *(row.published.get(m, "-") for m in published))
        for row in experiment.rows
    ]
    return (*head, *(m + PUBLISHED for m in published)), rows


def _figures(row: Row, experiment: Experiment, found: Found) -> list[str]:
    results = found["runs"][row.run.name]
    if not experiment.every_seed:
        results = results[:1]
    if experiment.metrics == LOCALIZATION:
        by_k = [{k: list(by.values()) for k, by in r["localization"].items()} for r in results]
        return ["/".join(_spread([r[k][n] for r in by_k]) for n in range(3)) for k in by_k[0]]
    return [_spread([r["retrieval"][str(k)] for r in results]) for k in RETRIEVAL_KS]


def _spread(values: Sequence[float] | np.ndarray[Any, Any]) -> str:
    text = f"{np.mean(values):.3f}"
    return text if len(values) < 2 else f"{text} ± {np.std(values, ddof=1):.3f}"


def _recall_at_1(found: Found, run: Run) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.array([result["retrieval"]["1"] for result in found["runs"][run.name]])


def _orders_table(found: Found) -> Table:
    rows: list[tuple[str, ...]] = []
    for claim, worse, better in ORDERS:
        gain = _recall_at_1(found, better) - _recall_at_1(found, worse)
        holds = "yes" if gain.mean() > 0 else "no"
        rows.append((claim, holds, f"{(gain > 0).sum()} of {len(gain)}", _spread(gain)))
    return ("R@1", "in the mean", "seeds where it holds", "difference"), rows


def _growth_table(found: Found) -> Table:
    radii = [row["radius_m"] for row in found["runs"][MNCL.name][0]["growth"]]
    rows: list[tuple[str, ...]] = []
    for name, (run, published) in GROWTH.items():
        recalls = _growth(found, run)
        loss = recalls.mean(axis=0)[1:] / max(recalls.mean(axis=0)[0], 1e-9) - 1
        rows.append(
            (
                name,
                *(f"{r:.3f}" for r in recalls.mean(axis=0)),
                "/".join(f"{100 * x:+.1f}" for x in loss) + " %",
                published,
            )
        )
    return ("R@1 within", *(f"{r:g} m" for r in radii), "against the first", "against the first" + PUBLISHED), rows


def _growth(found: Found, run: Run) -> np.ndarray[Any, np.dtype[np.float64]]:
    """[seeds, radii] recall@1."""
    return np.array([[row["R@1"] for row in result["growth"]] for result in found["runs"][run.name]])


def _ranking_table(found: Found) -> Table:
    results = [result["rankings"] for result in found["runs"][MNCL.name]]
    rows = [
        (name, *(_spread([result[name][str(k)] for result in results]) for k in RETRIEVAL_KS)) for name in results[0]
    ]
    return ("MNCL", *(f"R@{k}" for k in RETRIEVAL_KS)), rows


def _fine_table(found: Found) -> Table:
    runs = list(dict.fromkeys(FINE.values()))
    measured = [(run.name, [result["validation"] for result in found["runs"][run.name]]) for run in runs]
    names = ("within_5m", "within_10m", "neighbour_within_5m", "neighbour_within_10m")
    rows = [("cell's centre", *(f"{measured[0][1][0]['cell_center'][name]:.3f}" for name in names))]
    rows += [(name, *(_spread([f[key] for f in figures]) for key in names)) for name, figures in measured]
    return ("", "5 m", "10 m", "5 m, neighbour cell", "10 m, neighbour cell"), rows


def _cost_table(found: Found) -> Table:
    rows: list[tuple[str, ...]] = []
    for name, results in found["runs"].items():
        training = [result["training"] for result in results]
        # The median over the seeds: one of them may have shared the machine, or been stopped for a while.
        typical = {key: np.median([facts[key] for facts in training]) for key in training[0]}
        size = f"{results[0]['parameters'] / 1e6:.2f} M" if "parameters" in results[0] else "-"
        cell = f"{results[0]['bytes_a_cell']:.0f}" if "bytes_a_cell" in results[0] else "-"
        rows.append((
            name, f"{typical['descriptions_per_second']:.0f}", f"{typical['seconds_to_best']:.0f} s",
            f"{typical['peak_memory_mb']:.0f} MB", size, cell,
        ))  # fmt: skip
    return ("", "descriptions/s", "to the best weights", "peak memory", "parameters", "bytes a cell"), rows


def _draw_figure_4(path: Path, found: Found) -> None:
    figure = Figure(figsize=(9, 3.6), layout="constrained", dpi=DPI)
    for axes, experiment, label in zip(
        figure.subplots(1, 2), (FIGURE_4A, FIGURE_4B), ("layers of the graph", "exponent a"), strict=True
    ):
        for k in RETRIEVAL_KS:
            recalls = [found["runs"][row.run.name][0]["retrieval"][str(k)] for row in experiment.rows]
            axes.plot(range(len(recalls)), recalls, marker="o", label=f"R@{k}")
        axes.set(xlabel=label, ylabel="retrieval recall", ylim=(0, 1), xticks=range(len(experiment.rows)))
        axes.grid(alpha=0.3)
        axes.legend(frameon=False)
    FigureCanvasAgg(figure).print_png(path)


def _draw_figure_5(path: Path, found: Found) -> None:
    figure = Figure(figsize=(5.4, 3.6), layout="constrained", dpi=DPI)
    axes = figure.subplots()
    cells = [row["cells"] for row in found["runs"][MNCL.name][0]["growth"]]
    for name, (run, _) in GROWTH.items():
        recalls = _growth(found, run)
        axes.errorbar(cells, recalls.mean(axis=0), recalls.std(axis=0), marker="o", label=name)
    axes.set(xlabel="cells in the gallery", ylabel="recall@1, the same queries", ylim=(0, 1))
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)
    FigureCanvasAgg(figure).print_png(path)
