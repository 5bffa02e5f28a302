"""Figures 3, 4 and 5 of MNCL (AAAI 2025), as `reproduce` draws them."""

import textwrap
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from index.answering.query import Query
from index.answering.result import LocalizerResult
from index.answering.vector_localizer import VectorLocalizer
from index.evaluation.report import DPI
from models.citymap.cells import CellTable
from models.citymap.gallery import MapData
from models.citymap.points import Ints
from models.citymap.queries import Queries
from models.citymap.types import Floats
from models.posterior.distribution import PositionDistribution
from models.training.metrics import RETRIEVAL_KS

QUERIES_SHOWN, CELLS_SHOWN = 4, 3  # queries, and retrieved cells of each
SEED = 0  # queries are chosen at random
CHARACTERS_PER_LINE, LEGEND_COLUMNS = 200, 8
POSITIVE_COLOUR, NEGATIVE_COLOUR = "#00a000", "#e60000"
# Colours of frequent classes; the others of a picture take the spare ones, the most frequent first.
CLASS_COLOURS = {
    "road": "#7f7f7f", "sidewalk": "#d98cb3", "parking": "#8fb8de", "terrain": "#c9a83a", "vegetation": "#3a9d5d",
    "building": "#8c564b", "wall": "#1b2a7a", "fence": "#ff7f0e", "garage": "#c49c94",
}  # fmt: skip
SPARE_COLOURS = ["#9467bd", "#17becf", "#b5d700", "#1f77b4", "#f7b6d2", "#98df8a", "#5254a3", "#ffdd55", "#637939"]
OTHER, OTHER_COLOUR = "other", "#c7c7c7"
PREDICTED: dict[str, Any] = {"marker": "*", "ms": 13, "color": "#ff1493", "mec": "white"}
TRUE: dict[str, Any] = {"marker": "X", "ms": 10, "color": "black", "mec": "white"}
Numbers = np.ndarray[Any, np.dtype[np.float64]]


def draw_figure_3(data: MapData, queries: Queries, localizers: Mapping[str, VectorLocalizer], path: Path) -> None:
    """Write a PNG: one row per query, with the first cells of each localizer, best first.

    A cell that contains the true position has a green frame. The colours of the points are classes.
    """
    rows = np.random.default_rng(SEED).choice(len(queries), min(QUERIES_SHOWN, len(queries)), replace=False)
    texts = [Query(description=" ".join(queries.sentences[q]), top_k=CELLS_SHOWN) for q in rows]
    located = {name: [_located(result) for result in localizer.find(texts)] for name, localizer in localizers.items()}
    shown = np.unique([one.rows[:CELLS_SHOWN] for by_query in located.values() for one in by_query])
    colours = class_colours(data, shown)
    figure = Figure(figsize=(2.2 * CELLS_SHOWN * len(located), 3.0 * len(rows) + 0.9), layout="constrained", dpi=DPI)
    heights = [3.0] * len(rows) + [0.9]
    *parts, last = figure.subfigures(len(heights), 1, height_ratios=heights, squeeze=False)[:, 0]
    for n, (q, part) in enumerate(zip(rows, parts, strict=True)):
        part.suptitle(textwrap.fill(texts[n].description, CHARACTERS_PER_LINE), fontsize=9, x=0.01, ha="left")
        groups = part.subfigures(1, len(located), wspace=0.03, squeeze=False)[0]
        for group, (name, by_query) in zip(groups, located.items(), strict=True):
            group.suptitle(name, fontsize=9, weight="bold")
            axes = group.subplots(1, CELLS_SHOWN)
            for rank, cell in enumerate(by_query[n].rows[:CELLS_SHOWN].tolist()):
                _draw_cell(axes[rank], data, cell, colours)
                _mark_positions(axes[rank], data, cell, queries.take(np.array([q])), by_query[n].positions[rank])
                axes[rank].set_title(f"{rank + 1}: {axes[rank].get_title()}", fontsize=8)
    last.legend(handles=_legend(colours), loc="center", ncols=LEGEND_COLUMNS, frameon=False, fontsize=8)
    FigureCanvasAgg(figure).print_png(path)


def _located(result: LocalizerResult) -> PositionDistribution:
    assert result.located is not None  # there is no filter
    return result.located


def class_colours(data: MapData, cells: Ints) -> dict[str, str]:
    """Return a colour for each class in some cells; the rarest share that of OTHER if there are too many."""
    labels = [data.gallery.labels[n] for n in data.cells.parts.take(cells).instance]
    by_frequency = [label for label, _ in Counter(labels).most_common()]
    unusual = [label for label in by_frequency if label not in CLASS_COLOURS]
    colours = {label: CLASS_COLOURS[label] for label in by_frequency if label in CLASS_COLOURS}
    colours |= dict(zip(unusual, SPARE_COLOURS, strict=False))
    return colours if len(unusual) <= len(SPARE_COLOURS) else colours | {OTHER: OTHER_COLOUR}


def contains(cells: CellTable, cell: int, position_m: Floats, scene: str) -> bool:
    """Return whether a cell contains a position [2] of a scene."""
    return bool(cells.scenes[cell] == scene and (abs(position_m - cells.center_m[cell, :2]) <= cells.size_m / 2).all())


def _draw_cell(axes: Axes, data: MapData, cell: int, colours: Mapping[str, str]) -> None:
    """Draw the points of a cell's instances from above, small instances over large ones."""
    cells = data.cells
    parts, half = cells.parts, cells.size_m / 2
    assert cells.sample is not None  # a data set has its points
    samples = cells.sample(np.array([cell]))
    rows = np.arange(parts.starts[cell], parts.starts[cell + 1])
    area = np.prod(parts.high_m[rows, :2] - parts.low_m[rows, :2], axis=1)
    for n in np.argsort(-area):
        low, high = parts.low_m[rows[n], :2], parts.high_m[rows[n], :2]
        reach = np.abs(samples[n, :, :2]).max(axis=0)  # samples have their own scale
        place = (low + high) / 2 + samples[n, :, :2] * (high - low) / 2 / np.maximum(reach, 1e-6)
        colour = colours.get(data.gallery.labels[parts.instance[rows[n]]], OTHER_COLOUR)
        axes.scatter(place[:, 0], place[:, 1], s=2.5, c=colour, linewidths=0)
    east, north = cells.center_m[cell, :2]
    axes.set(xlim=(east - half, east + half), ylim=(north - half, north + half), xticks=[], yticks=[])
    axes.set_aspect("equal")


def _mark_positions(axes: Axes, data: MapData, cell: int, query: Queries, predicted_m: Floats) -> None:
    """Mark the predicted and the true position, frame the cell and write the error into the title."""
    truth_m, scene = query.positions_m[0], query.scenes[0]
    is_positive = contains(data.cells, cell, truth_m, scene)
    error = f"{np.linalg.norm(predicted_m - truth_m):.0f} m off" if data.cells.scenes[cell] == scene else "other scene"
    axes.plot(*predicted_m, **PREDICTED)
    if is_positive:
        axes.plot(*truth_m, **TRUE)
    axes.set_title(error)
    for spine in axes.spines.values():
        spine.set(color=POSITIVE_COLOUR if is_positive else NEGATIVE_COLOUR, linewidth=3)


def _legend(colours: Mapping[str, str]) -> list[Artist]:
    """Return the entries of the legend: classes by name, then frames and marks."""
    classes = [Line2D([], [], ls="", marker="o", color=colours[name], label=name) for name in sorted(colours)]
    frames = {"contains the true position": POSITIVE_COLOUR, "does not": NEGATIVE_COLOUR}
    return [
        *classes,
        *(Patch(fill=False, ec=colour, lw=2, label=label) for label, colour in frames.items()),
        Line2D([], [], ls="", label="predicted", **PREDICTED),
        Line2D([], [], ls="", label="true", **TRUE),
    ]


def draw_figure_4(path: Path, x_labels: Sequence[str], curves: Sequence[Sequence[tuple[Numbers, Numbers]]]) -> None:
    """Write a PNG with one plot per label of the x axis; its points have x = 0, 1, 2 and so on.

    A point is the recall [seeds, metrics] on test and on validation scenes, of which the first seed is drawn.
    """
    figure = Figure(figsize=(4.5 * len(x_labels), 3.8), layout="constrained", dpi=DPI)
    for axes, x_label, points in zip(
        figure.subplots(1, len(x_labels), squeeze=False)[0], x_labels, curves, strict=True
    ):
        for n, k in enumerate(RETRIEVAL_KS):
            for split, style in enumerate(("o-", "o--")):
                recalls = [point[split][0, n] for point in points]
                label = f"R@{k}" + (", validation" if split else "")
                axes.plot(recalls, style, color=f"C{n}", ms=4, alpha=0.6 if split else 1, label=label)
        axes.set(xlabel=x_label, ylabel="retrieval recall", xticks=range(len(points)))
        axes.grid(alpha=0.3)
    lines = axes.get_legend_handles_labels()
    figure.legend(*lines, loc="outside lower center", ncols=3 * len(x_labels), frameon=False, fontsize=8)
    FigureCanvasAgg(figure).print_png(path)


def draw_figure_5(path: Path, plots: Mapping[str, tuple[Sequence[int], Sequence[tuple[str, Numbers]]]]) -> None:
    """Write a PNG with one plot per title: named curves [seeds, radii] of recall@1 over the number of cells."""
    figure = Figure(figsize=(4.8 * len(plots), 3.8), layout="constrained", dpi=DPI)
    names = list(dict.fromkeys(name for _, curves in plots.values() for name, _ in curves))
    all_axes = figure.subplots(1, len(plots), squeeze=False)[0]
    for axes, (title, (cells, curves)) in zip(all_axes, plots.items(), strict=True):
        for name, recalls in curves:
            means, spread, colour = recalls.mean(axis=0), recalls.std(axis=0), f"C{names.index(name)}"
            axes.errorbar(cells, means, spread, marker="o", capsize=3, color=colour)
        axes.set(title=title, xlabel="cells in the gallery", ylabel="recall@1, the same queries")
        axes.set_ylim(bottom=0)
        axes.grid(alpha=0.3)
    handles = [Line2D([], [], color=f"C{n}", marker="o", label=name) for n, name in enumerate(names)]
    figure.legend(handles=handles, loc="outside lower center", ncols=2, frameon=False, fontsize=8)
    FigureCanvasAgg(figure).print_png(path)
