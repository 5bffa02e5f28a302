"""How far pixels are from the nearest that is drawn, exactly up to a reach, in machine code.

After Saito and Toriwaki (Pattern Recognition 27, 1994): first along columns, for all pixels, then along the rows of
those that are asked about.
"""

from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import compiled

MAX_REACH_PX: Final = 253  # pixels; the first step keeps a byte of each, and adds 1 to reach + 1
MAX_SQUARED_REACH_PX: Final = 180  # the same of `squared_distances`, whose squares have 16 bits
ColumnDistances = npt.NDArray[np.uint8]
SquaredDistances = npt.NDArray[np.uint16]


def column_distances(drawn: Ints, shape: tuple[int, int], reach: int) -> ColumnDistances:
    """[columns, rows + 2 reach] pixels to the nearest that is drawn in a column, at most reach + 1.

    Args:
        drawn: [n] of pixels column * rows + row.
        shape: columns and rows.
        reach: pixels, at most MOST_REACH; there is a margin of as many at both ends of rows.
    """
    away = np.full((shape[0], shape[1] + 2 * reach), reach + 1, np.uint8)
    _fill_columns(away, drawn, reach)
    return away


@compiled
def _fill_columns(away: ColumnDistances, drawn: Ints, reach: int) -> None:
    columns, rows = away.shape
    for pixel in drawn:
        away[pixel // (rows - 2 * reach), reach + pixel % (rows - 2 * reach)] = 0
    for x in range(1, columns):
        for y in range(rows):
            away[x, y] = min(away[x, y], np.uint8(away[x - 1, y] + 1))
    for x in range(columns - 2, -1, -1):
        for y in range(rows):
            away[x, y] = min(away[x, y], np.uint8(away[x + 1, y] + 1))


@compiled
def pixel_distances(away: ColumnDistances, asked: Ints, reach: int) -> Floats:
    """[n] float32 pixels from some [n] to the nearest that is drawn; inf beyond reach. `away` is of columns_away."""
    rows = away.shape[1] - 2 * reach
    across = (np.arange(2 * reach + 1).astype(np.int32) - np.int32(reach)) ** 2
    found = np.empty(len(asked), np.float32)
    for n in range(len(asked)):
        row, begin = away[asked[n] // rows], asked[n] % rows
        least = np.int32(reach * reach + 1)
        for step in range(len(across)):
            apart = np.int32(row[begin + step])
            least = min(least, apart * apart + across[step])
        found[n] = np.inf if least > reach * reach else np.sqrt(np.float32(least))
    return found


@compiled
def squared_distances(away: ColumnDistances, reach: int) -> SquaredDistances:
    """[columns, rows] squared pixels from all to the nearest that is drawn; more than reach * reach is beyond reach.

    Without a branch in the loop over pixels: so the processor takes many of them at once.

    Args:
        away: of `column_distances`.
        reach: as there, at most MOST_SQUARED.
    """
    columns, rows = away.shape[0], away.shape[1] - 2 * reach
    squares, square = np.full((columns, rows), 65535, np.uint16), np.empty(away.shape[1], np.uint16)
    for x in range(columns):
        least = np.uint8(255)
        for y in range(len(square)):
            least = min(least, away[x, y])
            square[y] = np.uint16(away[x, y]) * np.uint16(away[x, y])
        if least > reach:
            continue  # all of it is beyond
        found = squares[x]
        for step in range(reach + 1):
            before, behind, across = square[reach - step :], square[reach + step :], np.uint16(step * step)
            for y in range(rows):
                found[y] = min(found[y], np.uint16(min(before[y], behind[y]) + across))
    return squares
