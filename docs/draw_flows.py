"""Draw docs/flows.svg: how a description becomes an answer, and a map becomes an index.

python docs/draw_flows.py
"""

from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch, Rectangle

OUT = Path(__file__).parent / "flows.svg"
WIDTH, HEIGHT = 132.0, 112.0  # of the drawing, in its own units; 10 of them are an inch
FILL = {"app": "#dbe9f6", "index": "#e3f1dd", "models": "#fbe9d3", "file": "#f1f1f1"}
LAYERS = {
    "app": "app: HTTP, command line, page",
    "index": "index: building and answering",
    "models": "models: map, language, learned parts",
}
INK, SOFT = "#222222", "#5a5a5a"
TALL = 8.0
Box = tuple[float, float, float, float]  # middle x, middle y, width, height


def box(axes: Axes, place: Box, layer: str, title: str, *notes: str) -> Box:
    """Draw a box with a title and smaller lines below it."""
    x, y, width, height = place
    corner = (x - width / 2, y - height / 2)
    shape = "square,pad=0" if layer == "file" else "round,pad=0,rounding_size=1.2"
    axes.add_patch(FancyBboxPatch(corner, width, height, boxstyle=shape, fc=FILL[layer], ec=SOFT, lw=0.8))
    step = 2.15
    top = y + step * len(notes) / 2
    axes.text(x, top, title, ha="center", va="center", fontsize=8.6, color=INK, weight="bold")
    for n, note in enumerate(notes, start=1):
        axes.text(x, top - step * n, note, ha="center", va="center", fontsize=6.9, color=SOFT)
    return place


def arrow(axes: Axes, start: tuple[float, float], end: tuple[float, float], label: str = "") -> None:
    """Draw an arrow with a label right of its middle."""
    axes.add_patch(
        FancyArrowPatch(start, end, arrowstyle="-|>", mutation_scale=9, lw=1, color=SOFT, shrinkA=0, shrinkB=0)
    )
    if label:
        x, y = (start[0] + end[0]) / 2 + 1, (start[1] + end[1]) / 2
        axes.text(x, y, label, ha="left", va="center", fontsize=6.9, color=INK, style="italic")


def down(axes: Axes, upper: Box, lower: Box, label: str = "", at_x: float | None = None) -> None:
    """Draw an arrow straight down from one box to another."""
    x = lower[0] if at_x is None else at_x
    arrow(axes, (x, upper[1] - upper[3] / 2), (x, lower[1] + lower[3] / 2), label)


def description(axes: Axes) -> Box:
    """Draw the left half and return the frame around the boxes that read the index."""
    x, wide = 37.0, 58.0
    axes.text(x, 109.5, "A description becomes an answer", ha="center", fontsize=11, weight="bold", color=INK)
    route = box(axes, (x, 101, wide, TALL), "app", "POST /localize", "app/http/routes/localize.py, app/http/queue.py",
                "validation, a bounded queue, worker processes")  # fmt: skip
    reader = box(axes, (x, 88.5, wide, TALL), "models", "Readers", "models/language/",
                 "hints and mentions: class, name, street, colour, direction, distance")  # fmt: skip
    bound = box(axes, (x, 76, wide, TALL), "models", "Binding to the map's vocabulary", "models/posterior/binding.py",
                "labels, colours and names of this map, each with a probability")  # fmt: skip
    left, right, half = x - 15.5, x + 15.5, 27.0
    render = box(axes, (left, 62.5, half, TALL), "models", "Template hints", "models/citymap/templates.py",
                 "the bound hints as sentences")  # fmt: skip
    encode = box(axes, (left, 51, half, TALL), "models", "Retriever encodes", "models/paper/",
                 "MNCL: one vector a description")  # fmt: skip
    vector = box(axes, (left, 39.5, half, TALL), "index", "Vector search", "index/stores/, index/answering/ranking.py",
                 "FAISS: the 100 nearest cells")  # fmt: skip
    inverted = box(axes, (right, 39.5, half, TALL), "models", "Inverted list", "models/posterior/statements.py",
                   "class, colour, direction: 100 cells")  # fmt: skip
    grid = box(axes, (x, 26.5, wide, TALL), "models", "Posterior on a grid of 1.5 m", "models/posterior/",
               "the likelihood of all hints and mentions at every node")  # fmt: skip
    answer = box(axes, (x, 14, wide, TALL), "index", "Answer", "index/answering/, index/asking/",
                 "position, radii, candidates, evidence, question")  # fmt: skip
    reply = box(axes, (x, 3.6, wide, 5.6), "app", "JSON or GeoJSON", "app/http/schemas, app/http/formats")
    frame = (x, (vector[1] + grid[1]) / 2, wide + 4, vector[1] - grid[1] + TALL + 1.6)
    corner = (frame[0] - frame[2] / 2, frame[1] - frame[3] / 2)
    axes.add_patch(Rectangle(corner, frame[2], frame[3], fc="none", ec=SOFT, lw=0.8, ls="--", zorder=0))
    down(axes, route, reader, "text")
    down(axes, reader, bound, "hints, mentions")
    down(axes, bound, render, at_x=left)
    down(axes, bound, inverted, "bound hints", at_x=right)
    down(axes, render, encode, "sentences")
    down(axes, encode, vector, "vector")
    down(axes, vector, grid, "cells of both", at_x=left)
    down(axes, inverted, grid, at_x=right)
    down(axes, grid, answer, "position distribution")
    down(axes, answer, reply, "")
    return frame


def city(axes: Axes) -> Box:
    """Draw the right half and return the box of the files."""
    x, wide = 103.0, 52.0
    axes.text(x, 109.5, "A map becomes an index", ha="center", fontsize=11, weight="bold", color=INK)
    command = box(axes, (x, 101, wide, TALL), "app", "hereabouts index", "app/cli/main.py", "a map and a directory")
    door = box(axes, (x, 88.5, wide, TALL), "models", "Sources", "models/sources/",
               "OpenStreetMap, KITTI360Pose, a converted store")  # fmt: skip
    cells = box(axes, (x, 76, wide, TALL), "models", "Cells", "models/citymap/",
                "cubes of 30 m, every 10 m, with the objects in them")  # fmt: skip
    left, right, half = x - 13.5, x + 13.5, 25.0
    encode = box(axes, (left, 62.5, half, TALL), "models", "Retriever encodes", "models/paper/",
                 "MNCL: one vector a cell")  # fmt: skip
    around = box(axes, (right, 62.5, half, TALL), "models", "Neighbours, gazetteer", "models/posterior/",
                 "objects near a node, names, streets")  # fmt: skip
    write = box(axes, (x, 49.5, wide, TALL), "index", "A new version", "index/build/",
                "written completely or not at all; the alias moves last")  # fmt: skip
    files = box(axes, (x, 31.5, wide, 16), "file", "Index directory", "vectors, hints, cells",
                "geometry, statements, gazetteer", "manifest.json: sizes and checksums",
                "aliases.json: names of versions")  # fmt: skip
    down(axes, command, door, "path")
    down(axes, door, cells, "objects")
    down(axes, cells, encode, at_x=left)
    down(axes, cells, around, at_x=right)
    down(axes, encode, write, at_x=left)
    down(axes, around, write, at_x=right)
    down(axes, write, files)
    return files


def draw() -> Figure:
    """Return the picture."""
    figure = Figure(figsize=(WIDTH / 10, HEIGHT / 10))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, WIDTH), ylim=(0, HEIGHT))
    axes.set_axis_off()
    reading = description(axes)
    files = city(axes)
    start, end = files[0] - files[2] / 2, reading[0] + reading[2] / 2
    arrow(axes, (start, reading[1]), (end, reading[1]))
    note: dict[str, Any] = {"ha": "center", "va": "top", "fontsize": 6.5, "color": INK, "style": "italic"}
    axes.text((start + end) / 2, reading[1] - 1, "opened at the\nstart and when\nthe alias moves", **note)
    for n, (layer, meaning) in enumerate(LAYERS.items()):
        corner = (79, 15 - 4.2 * n)
        axes.add_patch(
            FancyBboxPatch(corner, 5, 2.4, boxstyle="round,pad=0,rounding_size=0.8", fc=FILL[layer], ec=SOFT, lw=0.8)
        )
        axes.text(86, corner[1] + 1.2, meaning, va="center", fontsize=7.6, color=INK)
    return figure


def main() -> None:
    """Write the picture, with the same bytes in every run."""
    with mpl.rc_context(
        {
            "svg.hashsalt": "hereabouts",
            "svg.fonttype": "none",
            "font.family": "sans-serif",
            "font.sans-serif": ["DejaVu Sans"],
        }
    ):
        draw().savefig(OUT, metadata={"Date": None})
    OUT.write_text("".join(f"{line.rstrip()}\n" for line in OUT.read_text().splitlines()))


if __name__ == "__main__":
    main()
