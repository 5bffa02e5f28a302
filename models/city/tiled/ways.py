"""The ways from positions to what stands around them, by geometry: compiled, since there are millions of them."""

from typing import Any

import numba
import numpy as np
import numpy.typing as npt

from models.city.points import Ints
from models.city.tiled.pieces import PieceTable
from models.city.tiled.solids import FORMS
from models.city.types import Floats

AREA = FORMS.index("area")


def compiled(function: Any) -> Any:
    """A function as machine code, kept for the next process where it may be written."""
    try:
        return numba.njit(cache=True)(function)
    except RuntimeError:  # a read-only installation, and no home
        return numba.njit(function)


def ways_to_groups(
    table: PieceTable,
    points_m: Floats,
    point_starts: Ints,
    piece: Ints,
    group_starts: Ints,
    cell_groups: Ints,
    reach_m: float,
) -> tuple[Ints, Ints, Floats]:
    """The ways from points to groups of pieces, as far as they are within reach.

    Args:
        table: all pieces.
        points_m: [M, 2] in order of cell.
        point_starts: [N + 1] cell n has the points point_starts[n] to point_starts[n + 1].
        piece: [P] pieces of groups.
        group_starts: [G + 1] group g has the pieces piece[group_starts[g]:group_starts[g + 1]].
        cell_groups: [N + 1] from the points of cell n are looked at the groups cell_groups[n] to cell_groups[n + 1].
        reach_m: beyond there are none; of a tree counts its crown where that is nearer than its trunk.

    Returns:
        [R] point, ascending, [R] group and [R, 2] point minus the group's closest point; (0, 0) inside an area.
    """
    most = int((np.diff(point_starts) * np.diff(cell_groups)).sum())
    point, group, way = np.empty(most, np.int64), np.empty(most, np.int64), np.empty((most, 2))
    count = _fill(
        points_m.astype(np.float64), point_starts, piece, group_starts, cell_groups, reach_m, table.segment_starts,
        table.segments_m, table.bounds_m, table.form == AREA, table.crown_m, point, group, way,
    )  # fmt: skip
    return point[:count], group[:count], way[:count]


@compiled
def _fill(
    points_m: Floats, point_starts: Ints, piece: Ints, group_starts: Ints, cell_groups: Ints, reach_m: float,
    segment_starts: Ints, segments_m: Floats, bounds_m: Floats, is_area: npt.NDArray[np.bool_],
    crown_m: Floats, point: Ints, group: Ints, way: Floats,
) -> int:  # fmt: skip
    count = 0
    for n in range(len(point_starts) - 1):
        for m in range(point_starts[n], point_starts[n + 1]):
            x, y = points_m[m]
            for g in range(cell_groups[n], cell_groups[n + 1]):
                best, best_x, best_y = reach_m * reach_m, 0.0, 0.0
                found = False
                for k in piece[group_starts[g] : group_starts[g + 1]]:
                    west, south, east, north = bounds_m[k]
                    away_x, away_y = max(west - x, 0.0, x - east), max(south - y, 0.0, y - north)
                    if away_x * away_x + away_y * away_y > best:
                        continue
                    square, way_x, way_y = _way_to_piece(
                        x, y, segments_m[segment_starts[k] : segment_starts[k + 1]], is_area[k]
                    )
                    if square > 16.0 * crown_m[k] * crown_m[k] > 0.0:  # as `crown_reach_m`
                        nearer = 1.0 - crown_m[k] / np.sqrt(square + 9.0 * crown_m[k] * crown_m[k])
                        square, way_x, way_y = square * nearer * nearer, way_x * nearer, way_y * nearer
                    if square <= best:
                        best, best_x, best_y, found = square, way_x, way_y, True
                        if best == 0.0:
                            break
                if found:
                    point[count], group[count] = m, g
                    way[count, 0], way[count, 1] = best_x, best_y
                    count += 1
    return count


@compiled
def _way_to_piece(x: float, y: float, segments_m: Floats, is_area: bool) -> tuple[float, float, float]:
    """Squared distance and way of a point from the closest point of some segments, or from what they enclose."""
    best, best_x, best_y, is_inside = np.inf, 0.0, 0.0, False
    for s in range(len(segments_m)):
        x1, y1, x2, y2 = segments_m[s]
        along_x, along_y, from_x, from_y = x2 - x1, y2 - y1, x - x1, y - y1
        length = along_x * along_x + along_y * along_y
        share = 0.0
        if length > 0.0:
            share = min(1.0, max(0.0, (from_x * along_x + from_y * along_y) / length))
        way_x, way_y = from_x - share * along_x, from_y - share * along_y
        square = way_x * way_x + way_y * way_y
        if square < best:
            best, best_x, best_y = square, way_x, way_y
        if is_area and (y1 > y) != (y2 > y) and from_x < (y - y1) * along_x / (y2 - y1):
            is_inside = not is_inside
    if is_inside:
        return 0.0, 0.0, 0.0
    return best, best_x, best_y
