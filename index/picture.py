"""An answer as a picture: the map, the candidates, the estimate and how sure it is."""

import textwrap
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Circle as CirclePatch
from matplotlib.patches import Rectangle

from index.answers import Answer
from index.localizer import Localizer

COLOURS = {
    "building": "#b08968",
    "road": "#8d99ae",
    "driveway": "#8d99ae",
    "sidewalk": "#c5cad3",
    "footpath": "#c5cad3",
    "square": "#d9cfc1",
    "crossing": "#c5cad3",
    "tram track": "#6c757d",
    "railway track": "#6c757d",
    "park": "#b5d6a7",
    "grass": "#b5d6a7",
    "bushes": "#8fbf7f",
    "tree": "#5a9e4b",
    "tree row": "#5a9e4b",
    "water": "#8ecae6",
}
OTHER_COLOUR = "#e0a84f"
DPI = 130
LABEL_BOX = {"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.8}
LISTED = 10  # cells whose probabilities are written


def draw_answer(localizer: Localizer, text: str, answer: Answer, path: Path) -> None:
    """Write a PNG of an answer: the whole map at the left, the surroundings of the estimate at the right.

    Args:
        localizer: what answered; its index holds the points that are drawn.
        text: the description.
        answer: with an estimate.
        path: file to write.
    """
    if answer.estimate is None:
        raise ValueError("an answer without an estimate cannot be drawn")
    parts = localizer.gallery.cells.parts
    xy = parts.closest_m[:, :2]
    colours = np.array([COLOURS.get(label, OTHER_COLOUR) for label in localizer.gallery.labels])[parts.instance]
    figure = Figure(figsize=(11, 6.2), layout="constrained")
    figure.suptitle(textwrap.fill(text, 120), fontsize=10, x=0.01, ha="left", style="italic")
    x, y = answer.estimate.position
    for axes, reach in zip(figure.subplots(1, 2), (None, 90.0), strict=True):
        axes.scatter(xy[:, 0], xy[:, 1], s=0.5 if reach is None else 7, c=colours, linewidths=0)
        for candidate in reversed(answer.candidates):
            west, south, east, north = candidate.bbox
            axes.add_patch(
                Rectangle((west, south), east - west, north - south, fill=False, lw=1.2, color="#1d3557", alpha=0.9)
            )
            if reach and abs(candidate.center[0] - x) < reach and abs(candidate.center[1] - y) < reach:
                at = candidate.center[:2]
                axes.annotate(str(candidate.rank), at, fontsize=8, ha="center", va="center", bbox=LABEL_BOX)
        radius = answer.estimate.radius_m.p90
        axes.add_patch(CirclePatch((x, y), radius, fill=False, ls="--", lw=1.2, color="#e63946"))
        axes.plot(x, y, marker="*", ms=13, color="#e63946", mec="white")
        axes.set_aspect("equal")
        axes.set_xlabel("east (m)")
        axes.set_ylabel("north (m)")
        if reach:
            shares = (f"{candidate.rank}: {candidate.probability:.0%}" for candidate in answer.candidates[:LISTED])
            told = "cells by their middles\n" + "\n".join(shares)
            axes.text(0.02, 0.98, told, transform=axes.transAxes, fontsize=8, va="top", bbox=LABEL_BOX)
            axes.set(xlim=(x - reach, x + reach), ylim=(y - reach, y + reach))
            axes.set_title(
                f"best position, and the circle that holds the true one with 90 %: {radius:.0f} m", fontsize=9
            )
        else:
            axes.set(xlim=(xy[:, 0].min(), xy[:, 0].max()), ylim=(xy[:, 1].min(), xy[:, 1].max()))
            facts = localizer.facts
            listed = len(answer.candidates)
            axes.set_title(f"{facts.map_name}: {facts.num_cells} cells, the best {listed} framed", fontsize=9)
    figure.text(0.995, 0.005, localizer.facts.attribution, fontsize=6, ha="right")
    FigureCanvasAgg(figure).print_png(path)
