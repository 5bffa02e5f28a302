"""Draw objects on a pixel grid, in machine code: their lines, and the insides of areas."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import compiled, longer

Mask = npt.NDArray[np.bool_]


class PixelGrid(NamedTuple):
    """A grid of pixels, each numbered column * rows + row."""

    west_m: float  # middle of the first pixel, map frame
    south_m: float
    spacing_m: float  # edge of a pixel
    columns: int
    rows: int


@compiled
def pixel_at(grid: PixelGrid, x: float, y: float) -> np.int64:
    """Return the pixel of a point, -1 outside."""
    column, row = np.rint((x - grid.west_m) / grid.spacing_m), np.rint((y - grid.south_m) / grid.spacing_m)
    if 0 <= column < grid.columns and 0 <= row < grid.rows:
        return np.int64(column) * grid.rows + np.int64(row)
    return np.int64(-1)


@compiled
def pixels_at(grid: PixelGrid, points_m: Floats) -> Ints:
    """Return the pixel [n] of each point [n, 2], -1 outside."""
    pixel = np.empty(len(points_m), np.int64)
    for n in range(len(points_m)):
        pixel[n] = pixel_at(grid, np.float64(points_m[n, 0]), np.float64(points_m[n, 1]))
    return pixel


@compiled
def draw_lines(grid: PixelGrid, segments_m: Floats, starts: Ints, objects: Ints, sample_m: float) -> tuple[Ints, Ints]:
    """Return the pixels [S] (int32) on the lines of some objects [n], object after object, and starts [n + 1].

    Segments and their starts are as in `Gazetteer`; sampled points on them are at most `sample_m` apart.
    """
    steps = _segment_steps(segments_m, starts, objects, sample_m)
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
def _segment_steps(segments_m: Floats, starts: Ints, objects: Ints, sample_m: float) -> Ints:
    """Return the number of steps of each segment of some objects, object after object."""
    steps, n = np.empty(np.sum(starts[objects + 1] - starts[objects]), np.int64), 0
    for number in objects:
        for s in range(starts[number], starts[number + 1]):
            x1, y1, x2, y2 = _end_points(segments_m, s)
            steps[n] = max(1, int(np.ceil(np.hypot(x2 - x1, y2 - y1) / sample_m)))
            n += 1
    return steps


@compiled
def _end_points(segments_m: Floats, s: int) -> tuple[float, float, float, float]:
    one = segments_m[s]
    return np.float64(one[0]), np.float64(one[1]), np.float64(one[2]), np.float64(one[3])


@compiled
def draw_areas(grid: PixelGrid, segments_m: Floats, starts: Ints, objects: Ints, lattice_m: float) -> tuple[Ints, Ints]:
    """Return the pixels inside areas, without their edges, at the points of a lattice; else as `draw_lines`."""
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
    return np.arange(ends.min() + lattice_m / 2, ends.max(), lattice_m)


@compiled
def inside_mask(xs: Floats, ys: Floats, lines: Floats) -> Mask:
    """Whether each point [columns, rows] of a lattice is inside rings of segments [n, 4]; see `is_inside`."""
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
