"""Figures 4 and 5 of `reproduce`."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from index.evaluation.report import DPI
from models.training.metrics import RETRIEVAL_KS

Numbers = np.ndarray[Any, np.dtype[np.float64]]


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
