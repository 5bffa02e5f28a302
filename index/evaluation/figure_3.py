"""Figure 3 of MNCL (AAAI 2025): queries, the cells that were retrieved for them, and how far off each position is."""

import textwrap
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from index.answers import Query
from index.evaluation.report import DPI
from index.vector_localizer import VectorLocalizer
from models.city.gallery import MapData
from models.city.points import Ints
from models.city.queries import Queries

SHOWN, LISTED = 4, 3  # queries, and retrieved cells of each
SEED = 0  # which queries are shown is drawn, not picked
UNKNOWN_COLOUR = 0.7
RIGHT, WRONG = "#2a9d4b", "#d1495b"
LABELLED_M = 3.0  # instances at least this large are named


def draw_figure_3(data: MapData, queries: Queries, localizer: VectorLocalizer, path: Path) -> None:
    """Write a PNG: a row a query, the true cell at the left, then those retrieved, best first.

    A retrieved cell is framed in green if it is the true one; the star is the position found in it, the cross the true
    one where the cell holds it; above it how far they are apart ("other scene" where they are in different ones).

    Args:
        data: the gallery.
        queries: of which some are drawn.
        localizer: of the gallery.
        path: file to write.
    """
    rows = np.random.default_rng(SEED).choice(len(queries), min(SHOWN, len(queries)), replace=False)
    given = [Query(description=" ".join(queries.sentences[q]), top_k=LISTED) for q in rows]
    figure = Figure(figsize=(3 * (LISTED + 1), 3.9 * len(rows)), layout="constrained", dpi=DPI)
    grid = figure.subplots(len(rows), LISTED + 1, squeeze=False)
    for q, axes, query, found in zip(rows, grid, given, localizer.find(given), strict=True):
        truth = int(queries.truth[q])
        _draw_cell(axes[0], data, truth)
        axes[0].plot(*queries.positions_m[q], marker="x", ms=9, mew=2, color="black")
        axes[0].set_title("true cell", fontsize=8)
        axes[0].text(0, -0.06, textwrap.fill(query.description, 160), fontsize=7, va="top", transform=axes[0].transAxes)
        assert found.located is not None  # nothing was left out of the gallery
        listed: Ints = found.located.rows[:LISTED]
        for rank, (ax, cell) in enumerate(zip(axes[1:], listed, strict=False)):
            _draw_cell(ax, data, int(cell), RIGHT if cell == truth else WRONG)
            position = found.located.positions[rank]
            ax.plot(*position, marker="*", ms=12, color="#e63946", mec="white")
            _mark_truth(ax, queries.positions_m[q])
            same = data.cells.scenes[int(cell)] == queries.scenes[q]
            error = f"{np.linalg.norm(position - queries.positions_m[q]):.1f} m off" if same else "other scene"
            ax.set_title(f"{rank + 1}: {error}", fontsize=8, color=RIGHT if cell == truth else WRONG)
    FigureCanvasAgg(figure).print_png(path)


def _draw_cell(axes: Axes, data: MapData, cell: int, frame: str = "black") -> None:
    """The instances of a cell as boxes of their colours, large ones with their names."""
    cells = data.cells
    parts, half = cells.parts, cells.size_m / 2
    rows = np.arange(parts.starts[cell], parts.starts[cell + 1])
    rows = rows[np.argsort(-np.prod(parts.high_m[rows, :2] - parts.low_m[rows, :2], axis=1))]  # small ones on top
    for row in rows:
        low, size = parts.low_m[row, :2], parts.high_m[row, :2] - parts.low_m[row, :2]
        colour = np.nan_to_num(parts.rgb[row], nan=UNKNOWN_COLOUR)
        axes.add_patch(Rectangle(tuple(low), *size, fc=(*colour, 0.6), ec=(*colour * 0.6, 1.0), lw=0.8))
        if max(size) >= LABELLED_M:
            label = data.gallery.labels[parts.instance[row]]
            east, north = low + size / 2
            axes.text(east, north, label, fontsize=5, ha="center", va="center", clip_on=True)
    east, north = cells.center_m[cell, :2]
    axes.set(xlim=(east - half, east + half), ylim=(north - half, north + half), xticks=[], yticks=[])
    axes.set_aspect("equal")
    for spine in axes.spines.values():
        spine.set(color=frame, linewidth=2)


def _mark_truth(axes: Axes, position_m: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> None:
    """A cross at the true position, if the cell holds it."""
    (west, east), (south, north) = axes.get_xlim(), axes.get_ylim()
    if west <= position_m[0] <= east and south <= position_m[1] <= north:
        axes.plot(*position_m, marker="x", ms=9, mew=2, color="black")
