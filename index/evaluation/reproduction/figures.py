"""Figures 3, 4 and 5 of MNCL (AAAI 2025), as `reproduce` draws them."""

import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from index.answering.query import Query
from index.answering.vector_localizer import VectorLocalizer
from index.evaluation.report import DPI
from models.citymap.gallery import MapData
from models.citymap.queries import Queries
from models.training.metrics import RETRIEVAL_KS

QUERIES_SHOWN, CELLS_SHOWN = 4, 3  # queries, and retrieved cells of each
SEED = 0  # queries are chosen at random
UNKNOWN_COLOUR = 0.7
RIGHT_COLOUR, WRONG_COLOUR = "#2a9d4b", "#d1495b"
MIN_LABELLED_M = 3.0  # smaller instances get no name
Numbers = np.ndarray[Any, np.dtype[np.float64]]


def draw_figure_3(data: MapData, queries: Queries, localizer: VectorLocalizer, path: Path) -> None:
    """Write a PNG: one row per query, the true cell on the left, then the retrieved cells, best first.

    The true cell has a green frame. The star is the predicted position, the cross the true one if the cell contains it.
    The title has the error, or "other scene".
    """
    rows = np.random.default_rng(SEED).choice(len(queries), min(QUERIES_SHOWN, len(queries)), replace=False)
    shown_queries = [Query(description=" ".join(queries.sentences[q]), top_k=CELLS_SHOWN) for q in rows]
    figure = Figure(figsize=(2.6 * (CELLS_SHOWN + 1), 3.1 * len(rows)), layout="constrained", dpi=DPI)
    parts = figure.subfigures(len(rows), 1, squeeze=False)[:, 0]
    for q, part, query, result in zip(rows, parts, shown_queries, localizer.find(shown_queries), strict=True):
        part.suptitle(textwrap.fill(query.description, 130), fontsize=8, x=0.01, ha="left", style="italic")
        axes, truth = part.subplots(1, CELLS_SHOWN + 1), int(queries.truth[q])
        _draw_cell(axes[0], data, truth)
        _mark_truth(axes[0], queries.positions_m[q])
        axes[0].set_title("true cell", fontsize=8)
        assert result.located is not None  # there is no filter
        for rank, (ax, cell) in enumerate(zip(axes[1:], result.located.rows[:CELLS_SHOWN].tolist(), strict=False)):
            colour = RIGHT_COLOUR if cell == truth else WRONG_COLOUR
            _draw_cell(ax, data, cell, colour)
            position = result.located.positions[rank]
            ax.plot(*position, marker="*", ms=12, color="#e63946", mec="white")
            _mark_truth(ax, queries.positions_m[q])
            same = data.cells.scenes[cell] == queries.scenes[q]
            error = f"{np.linalg.norm(position - queries.positions_m[q]):.1f} m off" if same else "other scene"
            ax.set_title(f"{rank + 1}: {error}", fontsize=8, color=colour)
    FigureCanvasAgg(figure).print_png(path)


def _draw_cell(axes: Axes, data: MapData, cell: int, frame: str = "black") -> None:
    """Draw the points of a cell's instances from above, with names of large instances."""
    cells = data.cells
    parts, half = cells.parts, cells.size_m / 2
    assert cells.sample is not None  # a data set has its points
    samples = cells.sample(np.array([cell]))
    for row, points in zip(range(parts.starts[cell], parts.starts[cell + 1]), samples, strict=True):
        low, high = parts.low_m[row, :2], parts.high_m[row, :2]
        reach = np.abs(points[:, :2]).max(axis=0)  # samples have their own scale
        place = (low + high) / 2 + points[:, :2] * (high - low) / 2 / np.maximum(reach, 1e-6)
        colour = np.where(points[:, 3:] < 0, UNKNOWN_COLOUR, points[:, 3:])
        axes.scatter(place[:, 0], place[:, 1], s=1.5, c=colour, linewidths=0)
        if max(high - low) >= MIN_LABELLED_M:
            east, north = np.clip((low + high) / 2, *(cells.center_m[cell, :2] + side * half for side in (-0.9, 0.9)))
            axes.text(east, north, data.gallery.labels[parts.instance[row]], fontsize=5, ha="center", clip_on=True)
    east, north = cells.center_m[cell, :2]
    axes.set(xlim=(east - half, east + half), ylim=(north - half, north + half), xticks=[], yticks=[])
    axes.set_aspect("equal")
    axes.set_facecolor("#f4f1ea")
    for spine in axes.spines.values():
        spine.set(color=frame, linewidth=2)


def _mark_truth(axes: Axes, position_m: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> None:
    (west, east), (south, north) = axes.get_xlim(), axes.get_ylim()
    if west <= position_m[0] <= east and south <= position_m[1] <= north:
        axes.plot(*position_m, marker="x", ms=9, mew=2, color="black")


def draw_figure_4(path: Path, titles: Sequence[str], curves: Sequence[Sequence[Numbers]]) -> None:
    """Write a PNG with one plot per title; each point is [seeds, metrics] recall, of which the first seed is drawn."""
    figure = Figure(figsize=(4.5 * len(titles), 3.8), layout="constrained", dpi=DPI)
    for axes, title, points in zip(figure.subplots(1, len(titles), squeeze=False)[0], titles, curves, strict=True):
        for n, k in enumerate(RETRIEVAL_KS):
            axes.plot(range(len(points)), [point[0, n] for point in points], marker="o", label=f"R@{k}")
        axes.set(ylabel="retrieval recall", ylim=(0, 1), xticks=range(len(points)))
        axes.set_xlabel(title.removeprefix("Figure 4: "), fontsize=8)
        axes.grid(alpha=0.3)
        axes.legend(frameon=False)
    FigureCanvasAgg(figure).print_png(path)


def draw_figure_5(path: Path, cells: Sequence[int], curves: Sequence[tuple[str, Numbers]]) -> None:
    """Write a PNG of named curves [seeds, radii] of recall@1 over the number of cells."""
    figure = Figure(figsize=(5.4, 3.6), layout="constrained", dpi=DPI)
    axes = figure.subplots()
    for name, recalls in curves:
        axes.errorbar(cells, recalls.mean(axis=0), recalls.std(axis=0), marker="o", label=name)
    axes.set(xlabel="cells in the gallery", ylabel="recall@1, the same queries", ylim=(0, 1))
    axes.grid(alpha=0.3)
    axes.legend(frameon=False, fontsize=8)
    FigureCanvasAgg(figure).print_png(path)
