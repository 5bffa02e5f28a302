"""An answer as a picture in the style of the page: the map, the estimate and its uncertainty."""

import textwrap
from collections.abc import Iterator, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any, Final

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Circle, PathPatch, Rectangle
from matplotlib.path import Path as Line
from matplotlib.patheffects import withStroke

from index.answering.answers import Answer, Estimate
from index.answering.localizer import Localizer
from models.citymap.scenery.reading import AREA, LINE, POINT, DecodedScenery, Outline, load_look, read_scenery

SIZE_IN: Final = (11.0, 6.2)
WIDE_SIZE_IN: Final = (7.4, 3.3)  # across a sheet of A4
DPI: Final = 130
MARGIN: Final = 1.15  # of the map around circles
MIN_REACH_M, REACH_RADII = 70.0, 1.6  # of the left map around the estimate, as on the page
MAX_NAMES = 60  # candidates to draw, long streets first
MIN_NAME_DISTANCE: Final = (0.16, 0.035)  # as shares of the sides; closer names would overlap


def draw_answer(localizer: Localizer, text: str, answer: Answer, path: Path) -> None:
    """Write a PNG of an answer: the estimate with its surroundings on the left, the whole map on the right."""
    if answer.estimate is None:
        raise ValueError("an answer without an estimate cannot be drawn")
    scenery_part = localizer.scenery(0)
    if scenery_part is None:
        raise ValueError("the index has no drawing of the map; rebuild it")
    scenery, colours = read_scenery(scenery_part.path), load_look()["light"]
    figure = Figure(figsize=SIZE_IN, dpi=DPI, facecolor="white")
    near = figure.add_axes((0.01, 0.05, 0.64, 0.8))
    whole = figure.add_axes((0.665, 0.05, 0.325, 0.8))
    x, y = answer.estimate.position
    aspect = 0.64 * SIZE_IN[0] / (0.8 * SIZE_IN[1])
    west, south, east, north = localizer.facts.box_m
    map_m = max(y - south, north - y, (x - west) / aspect, (east - x) / aspect)  # show no more than the whole map
    reach = max(MIN_REACH_M, min(REACH_RADII * answer.estimate.radius_m.p90, map_m))
    wide = reach * aspect
    _draw_map(near, scenery, (x - wide, y - reach, x + wide, y + reach), colours)
    _draw_names(near, scenery, colours)
    _draw_estimate(near, answer.estimate, colours)
    _draw_map(whole, scenery, (west, south, east, north), colours)
    whole.add_patch(
        Rectangle((x - wide, y - reach), 2 * wide, 2 * reach, fill=False, lw=1.5, ec=colours["accent"], zorder=8)
    )
    whole.plot(x, y, "o", ms=6, color=colours["accent"], mec="white", mew=1.2, zorder=8)
    _draw_captions(figure, localizer, text, answer)
    FigureCanvasAgg(figure).print_png(path)


def draw_circles(localizer: Localizer, circles: Sequence[tuple[tuple[float, float], float]]) -> bytes | None:
    """Return a PNG of numbered circles (center, radius_m) on the map; None if there are none, or no drawing of it.

    Circles off the map are left out.
    """
    west, south, east, north = localizer.facts.box_m
    diagonal_m = float(np.hypot(east - west, north - south))
    inside = [
        (number, center, min(radius_m, diagonal_m))
        for number, (center, radius_m) in enumerate(circles, 1)
        if _is_in(center, (west, south, east, north))
    ]
    scenery_part = localizer.scenery(0)
    if scenery_part is None or not inside:
        return None
    scenery, colours = read_scenery(scenery_part.path), load_look()["light"]
    figure = Figure(figsize=WIDE_SIZE_IN, dpi=DPI, facecolor="white")
    axes = figure.add_axes((0, 0, 1, 1))
    centers, radii = np.array([center for _, center, _ in inside]), np.array([[radius] for *_, radius in inside])
    low, high = (centers - radii).min(axis=0), (centers + radii).max(axis=0)
    aspect = WIDE_SIZE_IN[0] / WIDE_SIZE_IN[1]
    (x, y), (width, height) = (low + high) / 2, (high - low) / 2
    reach = max(MIN_REACH_M, MARGIN * height, MARGIN * width / aspect)
    _draw_map(axes, scenery, (x - reach * aspect, y - reach, x + reach * aspect, y + reach), colours)
    _draw_names(axes, scenery, colours)
    for number, center, radius_m in reversed(inside):  # the likeliest on top
        axes.add_patch(Circle(center, radius_m, fc=(*to_rgb(colours["accent"]), 0.12), ec=colours["accent"], zorder=6))
        axes.plot(*center, "o", ms=13, color=colours["accent"], mec="white", mew=1.5, zorder=7)
        axes.text(*center, str(number), color="white", weight="bold", fontsize=8, ha="center", va="center", zorder=8)
    png = BytesIO()
    FigureCanvasAgg(figure).print_png(png)
    return png.getvalue()


def _draw_captions(figure: Figure, localizer: Localizer, text: str, answer: Answer) -> None:
    assert answer.estimate is not None
    quoted = textwrap.shorten(text, 150, placeholder=" …")
    place = answer.estimate.place or "here"
    radius = f"within {answer.estimate.radius_m.p90:.0f} m, nine times out of ten"
    radius_text = radius if answer.status == "ok" else f"several places fit; the likeliest is shown, {radius}"
    quiet: dict[str, Any] = {"color": "#625c52", "parse_math": False}
    dark: dict[str, Any] = {"color": "#23211d", "parse_math": False}
    figure.text(0.01, 0.955, f"“{quoted}”", fontsize=9, style="italic", **quiet)
    figure.text(0.01, 0.905, place[0].upper() + place[1:], fontsize=13, weight="bold", **dark)
    figure.text(0.01, 0.868, radius_text, fontsize=9, **dark)
    figure.text(0.99, 0.015, localizer.facts.attribution, fontsize=6, ha="right", **quiet)


def _draw_map(
    axes: Axes, scenery: DecodedScenery, box: tuple[float, float, float, float], colours: dict[str, Any]
) -> None:
    west, south, east, north = box
    axes.set(xlim=(west, east), ylim=(south, north), xticks=[], yticks=[], facecolor=colours["ground"])
    axes.set_aspect("equal")
    for spine in axes.spines.values():
        spine.set_visible(False)
    if len(scenery.xyz_m):
        axes.scatter(scenery.xyz_m[:, 0], scenery.xyz_m[:, 1], s=0.6, c=scenery.rgb / 255, linewidths=0)
    points_a_metre = 72 * axes.bbox.height / DPI / (north - south)
    order = {"ground": 0, "walls": 1, "rising": 2}
    for kind, level in order.items():
        paints = load_look()[kind]
        for outline in reversed(scenery.outlines):
            if outline.label in paints and _is_visible(outline, box):
                edge = colours["rail"] if kind == "rising" else "none"
                _draw_outline(axes, outline, colours[paints[outline.label]], edge, points_a_metre, level)
    trees = [outline.paths[0][0] for outline in scenery.outlines if outline.form == POINT and outline.label == "tree"]
    if trees:
        x, y = np.array(trees).T
        axes.scatter(x, y, s=max(2.0, (4 * points_a_metre) ** 2), c=colours["tree"], lw=0, zorder=3)


def _is_visible(outline: Outline, box: tuple[float, float, float, float]) -> bool:
    low = np.min([path.min(axis=0) for path in outline.paths], axis=0)
    high = np.max([path.max(axis=0) for path in outline.paths], axis=0)
    return bool(low[0] <= box[2] and low[1] <= box[3] and high[0] >= box[0] and high[1] >= box[1])


def _draw_outline(axes: Axes, outline: Outline, colour: str, edge: str, points_a_metre: float, level: int) -> None:
    if outline.form == AREA:
        whole = Line.make_compound_path(*(Line(path, closed=True) for path in outline.paths))
        axes.add_patch(PathPatch(whole, fc=colour, ec=edge, lw=0.6, zorder=level))
    elif outline.form == LINE:
        width = max(0.5, outline.width_m * points_a_metre)
        for path in outline.paths:
            axes.plot(*path.T, color=colour, lw=width, solid_capstyle="butt", zorder=level)


def _draw_estimate(axes: Axes, estimate: Estimate, colours: dict[str, Any]) -> None:
    accent, position_m = colours["accent"], estimate.position
    axes.add_patch(Circle(position_m, estimate.radius_m.p50, fc=accent, alpha=0.25, zorder=6))
    axes.add_patch(Circle(position_m, estimate.radius_m.p90, fill=False, ec=accent, lw=1.6, zorder=6))
    axes.plot(*position_m, "o", ms=10, color=accent, mec="white", mew=2, zorder=7)


def _draw_names(axes: Axes, scenery: DecodedScenery, colours: dict[str, Any]) -> None:
    (west, east), (south, north) = axes.get_xlim(), axes.get_ylim()
    used: list[tuple[float, float]] = []
    effects = [withStroke(linewidth=2.5, foreground=colours["halo"])]
    style: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": 7.5, "color": colours["name"], "zorder": 5}
    style |= {"path_effects": effects, "clip_on": True, "parse_math": False}
    for name, x, y, angle in list(_names(scenery, (west, south, east, north)))[:MAX_NAMES]:
        share_xy = ((x - west) / (east - west), (y - south) / (north - south))
        if not (0.08 < share_xy[0] < 0.92 and 0.03 < share_xy[1] < 0.97):
            continue
        if any(
            abs(share_xy[0] - a) < MIN_NAME_DISTANCE[0] and abs(share_xy[1] - b) < MIN_NAME_DISTANCE[1] for a, b in used
        ):
            continue
        used.append(share_xy)
        axes.text(x, y, name, rotation=angle, **style)


def _names(
    scenery: DecodedScenery, box: tuple[float, float, float, float]
) -> Iterator[tuple[str, float, float, float]]:
    west, south, east, north = box
    lines: dict[str, np.ndarray[Any, Any]] = {}
    for outline in scenery.outlines:
        if outline.form != LINE or not outline.name:
            continue
        for path in outline.paths:
            inside = path[(path[:, 0] > west) & (path[:, 0] < east) & (path[:, 1] > south) & (path[:, 1] < north)]
            if len(inside) > 1 and _length(inside) > _length(lines.get(outline.name, inside[:1])):
                lines[outline.name] = inside
    for name, path in sorted(lines.items(), key=lambda item: -_length(item[1])):
        middle = path[len(path) // 2 - 1 : len(path) // 2 + 1]
        (dx, dy), (x, y) = middle[1] - middle[0], middle.mean(axis=0)
        yield name, float(x), float(y), float((np.degrees(np.arctan2(dy, dx)) + 90) % 180 - 90)
    for place in {place.name: place for place in scenery.places if _is_in(place.position_m, box)}.values():
        yield place.name, *place.position_m, 0.0


def _is_in(position_m: tuple[float, float], box: tuple[float, float, float, float]) -> bool:
    return box[0] < position_m[0] < box[2] and box[1] < position_m[1] < box[3]


def _length(path: Sequence[Any] | np.ndarray[Any, Any]) -> float:
    return float(np.linalg.norm(np.diff(np.asarray(path), axis=0), axis=1).sum())
