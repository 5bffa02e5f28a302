"""Exact distances from pixels to the nearest drawn pixel, up to a reach, in machine code.

After Saito and Toriwaki (Pattern Recognition 27, 1994): first along columns, for all pixels, then along rows for the
pixels wanted.
"""

from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import compiled

MAX_SQUARED_REACH_PX: Final = 180  # sums of two squares have 16 bits
ColumnDistances = npt.NDArray[np.uint8]
SquaredDistances = npt.NDArray[np.uint16]


def column_distances(pixels: Ints, shape: tuple[int, int], reach: int) -> ColumnDistances:
    """Return the pixels [columns, rows + 2 reach] to the nearest drawn pixel in a column, at most reach + 1.

    Drawn pixels [n] are column * rows + row. Rows have a margin of `reach` at both ends. The reach is at most 253,
    because distances are bytes and the scan adds 1 to reach + 1.
    """
    distances = np.full((shape[0], shape[1] + 2 * reach), reach + 1, np.uint8)
    _fill_columns(distances, pixels, reach)
    return distances


@compiled
def _fill_columns(distances: ColumnDistances, pixels: Ints, reach: int) -> None:
    columns, rows = distances.shape
    for pixel in pixels:
        distances[pixel // (rows - 2 * reach), reach + pixel % (rows - 2 * reach)] = 0
    for x in range(1, columns):
        for y in range(rows):
            distances[x, y] = min(distances[x, y], np.uint8(distances[x - 1, y] + 1))
    for x in range(columns - 2, -1, -1):
        for y in range(rows):
            distances[x, y] = min(distances[x, y], np.uint8(distances[x + 1, y] + 1))


@compiled
def pixel_distances(columns: ColumnDistances, pixels: Ints, reach: int) -> Floats:
    """Return the distances [n] (float32, in pixels) from some pixels to the nearest drawn one; inf beyond reach."""
    rows = columns.shape[1] - 2 * reach
    across = (np.arange(2 * reach + 1).astype(np.int32) - np.int32(reach)) ** 2
    distances = np.empty(len(pixels), np.float32)
    for n in range(len(pixels)):
        row, begin = columns[pixels[n] // rows], pixels[n] % rows
        smallest = np.int32(reach * reach + 1)
        for step in range(len(across)):
            apart = np.int32(row[begin + step])
            smallest = min(smallest, apart * apart + across[step])
        distances[n] = np.inf if smallest > reach * reach else np.sqrt(np.float32(smallest))
    return distances


@compiled
def squared_distances(distances: ColumnDistances, reach: int) -> SquaredDistances:
    """Return the squared pixels [columns, rows] to the nearest drawn pixel; more than reach * reach is beyond reach.

    The reach is that of `column_distances`, at most MAX_SQUARED_REACH_PX. The loop over pixels has no branch, so that
    the compiler vectorises it.
    """
    columns, rows = distances.shape[0], distances.shape[1] - 2 * reach
    squares, square = np.full((columns, rows), 65535, np.uint16), np.empty(distances.shape[1], np.uint16)
    for x in range(columns):
        smallest = np.uint8(255)
        for y in range(len(square)):
            smallest = min(smallest, distances[x, y])
            square[y] = np.uint16(distances[x, y]) * np.uint16(distances[x, y])
        if smallest > reach:
            continue  # no pixel is within reach
        line = squares[x]
        for step in range(reach + 1):
            before, after, across = square[reach - step :], square[reach + step :], np.uint16(step * step)
            for y in range(rows):
                line[y] = min(line[y], np.uint16(min(before[y], after[y]) + across))
    return squares
