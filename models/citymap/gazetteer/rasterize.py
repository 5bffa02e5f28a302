"""Objects drawn on a grid, in machine code: their lines, and what is inside areas."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import compiled, longer

Mask = npt.NDArray[np.bool_]


class PixelGrid(NamedTuple):
    """A grid of pixels, of which each has a number: column * rows + row.

    Attributes:
        west_m, south_m: middle of the first pixel, map frame.
        spacing_m: of the grid.
        columns, rows: how many.
    """

    west_m: float
    south_m: float
    spacing_m: float
    columns: int
    rows: int


@compiled
def pixel_at(grid: PixelGrid, x: float, y: float) -> np.int64:
    """The pixel of a point, -1 outside."""
    column, row = np.rint((x - grid.west_m) / grid.spacing_m), np.rint((y - grid.south_m) / grid.spacing_m)
    if 0 <= column < grid.columns and 0 <= row < grid.rows:
        return np.int64(column) * grid.rows + np.int64(row)
    return np.int64(-1)


@compiled
def pixels_at(grid: PixelGrid, points_m: Floats) -> Ints:
    """[n] pixel of points [n, 2], -1 outside."""
    pixel = np.empty(len(points_m), np.int64)
    for n in range(len(points_m)):
        pixel[n] = pixel_at(grid, np.float64(points_m[n, 0]), np.float64(points_m[n, 1]))
    return pixel


@compiled
def draw_lines(grid: PixelGrid, segments_m: Floats, starts: Ints, objects: Ints, sampled_m: float) -> tuple[Ints, Ints]:
    """[S] int32 pixels on the lines of some objects, one object after the other; starts [n + 1].

    Args:
        grid: what to draw on; what is outside is left out.
        segments_m: of all objects, see `Gazetteer`.
        starts: likewise.
        objects: [n] of them.
        sampled_m: between points, at most.
    """
    steps = _segment_steps(segments_m, starts, objects, sampled_m)
    pixels, count, n, until = np.empty(steps.sum() + len(steps), np.int32), 0, 0, np.zeros(len(objects) + 1, np.int64)
    for o in range(len(objects)):
        for s in range(starts[objects[o]], starts[objects[o] + 1]):
            x1, y1, x2, y2 = _end_points(segments_m, s)
            last = -1
            for k in range(steps[n] + 1):
                pixel = pixel_at(grid, x1 + k / steps[n] * (x2 - x1), y1 + k / steps[n] * (y2 - y1))
                if pixel >= 0 and pixel != last:
                    pixels[count] = pixel
                    count += 1
                last = pixel
            n += 1
        until[o + 1] = count
    return pixels[:count].copy(), until


@compiled
def _segment_steps(segments_m: Floats, starts: Ints, objects: Ints, sampled_m: float) -> Ints:
    """How many each segment of some objects is cut into, one object after the other."""
    steps, n = np.empty(np.sum(starts[objects + 1] - starts[objects]), np.int64), 0
    for number in objects:
        for s in range(starts[number], starts[number + 1]):
            x1, y1, x2, y2 = _end_points(segments_m, s)
            steps[n] = max(1, int(np.ceil(np.hypot(x2 - x1, y2 - y1) / sampled_m)))
            n += 1
    return steps


@compiled
def _end_points(segments_m: Floats, s: int) -> tuple[float, float, float, float]:
    one = segments_m[s]
    return np.float64(one[0]), np.float64(one[1]), np.float64(one[2]), np.float64(one[3])


@compiled
def draw_areas(grid: PixelGrid, segments_m: Floats, starts: Ints, objects: Ints, lattice_m: float) -> tuple[Ints, Ints]:
    """The same inside areas, without their edge: where the points of a lattice are, so far apart."""
    pixels, count, until = np.empty(1024, np.int32), 0, np.zeros(len(objects) + 1, np.int64)
    for n in range(len(objects)):
        lines = segments_m[starts[objects[n]] : starts[objects[n] + 1]].astype(np.float64)
        xs, ys = _lattice_coordinates(lines[:, 0::2], lattice_m), _lattice_coordinates(lines[:, 1::2], lattice_m)
        is_in = inside_mask(xs, ys, lines)
        while len(pixels) < count + is_in.sum():
            pixels = longer(pixels)
        for column in range(len(xs)):
            last = -1
            for row in range(len(ys)):
                pixel = pixel_at(grid, xs[column], ys[row]) if is_in[column, row] else -1
                if pixel >= 0 and pixel != last:
                    pixels[count] = pixel
                    count += 1
                last = pixel
        until[n + 1] = count
    return pixels[:count].copy(), until


@compiled
def _lattice_coordinates(ends: Floats, lattice_m: float) -> Floats:
    """Along one axis, from the lowest of some ends to the highest."""
    return np.arange(ends.min() + lattice_m / 2, ends.max(), lattice_m)


@compiled
def inside_mask(xs: Floats, ys: Floats, lines: Floats) -> Mask:
    """[columns, rows] whether the points of a lattice are inside rings of segments [n, 4], see `is_inside`."""
    is_odd = np.zeros((len(xs) + 1, len(ys)), np.bool_)  # where the number of edges to the east changes
    for s in range(len(lines)):
        x1, y1, x2, y2 = lines[s]
        for row in range(np.searchsorted(ys, min(y1, y2)), np.searchsorted(ys, max(y1, y2))):
            before = np.searchsorted(xs, x1 + (ys[row] - y1) * (x2 - x1) / (y2 - y1))  # columns west of it
            is_odd[before, row] = not is_odd[before, row]
    for column in range(len(xs) - 1, -1, -1):
        for row in range(len(ys)):
            is_odd[column, row] = is_odd[column, row] != is_odd[column + 1, row]
    return is_odd[1:]
