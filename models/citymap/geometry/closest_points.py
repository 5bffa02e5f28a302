"""Offsets from positions to the instances around them, in machine code because there are millions."""

from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.geometry.groups import group_pieces, pieces_near
from models.citymap.geometry.pieces import PieceTable
from models.citymap.geometry.segments import STEP_M, TILE_EDGES, Steps
from models.citymap.geometry.solids import AREA
from models.citymap.geometry.tiling import TILE_M, TILE_SLACK_M
from models.citymap.points import Ints
from models.citymap.types import CutRules, Floats
from models.compiled import compiled, longer

CROWN_M: Final = 3.0  # a crown may be nearer than the tile of its trunk by this much
MIN_GROUP_SHARE: Final = 0.6  # a group counts by itself if it has at least this share of `min_part_points`
GROUPS_LIMIT: Final = 1 << 32  # no cell has as many groups around it
EXPECTED_ROWS_PER_POINT: Final = 16  # initial capacity
# Single precision is exact to millimetres near a position, and a processor handles twice as many at once.
FLOAT: Final = np.float32
STEP: Final = FLOAT(STEP_M)
ZERO: Final = FLOAT(0.0)
ONE: Final = FLOAT(1.0)
SIMD_LANES: Final = 8  # points that a processor handles at once
INFINITE: Final = FLOAT(np.inf)


def closest_instances(
    table: PieceTable,
    rules: CutRules,
    centers_m: Floats,
    points_m: Floats,
    point_starts: Ints,
    reach_m: float,
    step_m: float,
) -> tuple[Ints, Ints, npt.NDArray[np.int8]]:
    """Return the offsets from points [M, 2] to the instances around them, the nearest first.

    Connected pieces in a cell's cube count as one instance part, together with the pieces beside the cube that continue
    them. A group too small to be a part is left out, unless it is all there is of its instance. Cell n owns the points
    from point_starts[n] to point_starts[n + 1]. For a tree the nearer of crown and trunk counts.

    Returns:
        [R] point, ascending, [R] instance and [R, 2] point minus the instance's closest point, in steps of `step_m`;
        (0, 0) inside an area.
    """
    return _closest_instances(
        points_m.astype(np.float64), point_starts.astype(np.int64), centers_m[:, :2].astype(np.float64),
        rules.cell_size_m / 2 - TILE_SLACK_M, float(reach_m), float(step_m), MIN_GROUP_SHARE * rules.min_part_points,
        table.low, table.column_starts, table.row, table.tile, table.instance, table.form, table.point_count,
        table.bounds_m, table.crown_m, table.segment_starts, table.segments, table.link_starts, table.links,
    )  # fmt: skip


@compiled
def _closest_instances(
    points_m: Floats, point_starts: Ints, centers_m: Floats, half_m: float, reach_m: float, step_m: float,
    min_count: float, low: Ints, column_starts: Ints, row: Ints, tile: Ints, instance: Ints, form: Ints,
    point_count: Floats, bounds_m: Floats, crown_m: Floats, segment_starts: Ints, segments: Steps, link_starts: Ints,
    links: Ints,
) -> tuple[Ints, Ints, npt.NDArray[np.int8]]:  # fmt: skip
    room = EXPECTED_ROWS_PER_POINT * len(points_m) + 1024
    point, target, offset = np.empty(room, np.int64), np.empty(room, np.int64), np.empty((room, 2), np.int8)
    count = 0
    for n in range(len(point_starts) - 1):
        own_points_m = points_m[point_starts[n] : point_starts[n + 1]]
        if len(own_points_m) == 0:
            continue
        pieces, runs = pieces_near(own_points_m, reach_m + CROWN_M, low, column_starts, row)
        order, starts = group_pieces(
            pieces, runs, centers_m[n], half_m, min_count, tile, instance, form, point_count, link_starts, links
        )
        square, offset_x, offset_y = _offsets_to_groups(
            own_points_m, order, starts, reach_m, tile, form, bounds_m, crown_m, segment_starts, segments
        )
        ranked = np.empty(len(starts), np.int64)
        for m in range(len(own_points_m)):
            if count + len(starts) > room:
                room *= 2
                point, target, offset = longer(point), longer(target), longer(offset)
            for n_group in range(_sort_groups(m, step_m, square, offset_x, offset_y, ranked)):
                g = ranked[n_group] % GROUPS_LIMIT
                point[count], target[count] = point_starts[n] + m, instance[order[starts[g]]]
                offset[count, 0] = np.int8(np.rint(offset_x[g, m] / step_m))
                offset[count, 1] = np.int8(np.rint(offset_y[g, m] / step_m))
                count += 1
    return point[:count].copy(), target[:count].copy(), offset[:count].copy()


@compiled
def _sort_groups(m: int, step_m: float, square: Floats, offset_x: Floats, offset_y: Floats, ranked: Ints) -> int:
    """Fill `ranked` with squared steps * GROUPS_LIMIT + group of the groups within reach; return their number."""
    count = 0
    for g in range(len(square)):
        if square[g, m] < 0.0:
            continue
        x, y = np.rint(offset_x[g, m] / step_m), np.rint(offset_y[g, m] / step_m)
        key, place = np.int64(x * x + y * y) * GROUPS_LIMIT + g, count
        while place > 0 and ranked[place - 1] > key:
            ranked[place] = ranked[place - 1]
            place -= 1
        ranked[place] = key
        count += 1
    return count


@compiled
def _offsets_to_groups(
    points_m: Floats, order: Ints, starts: Ints, reach_m: float, tile: Ints, form: Ints, bounds_m: Floats,
    crown_m: Floats, segment_starts: Ints, segments: Steps,
) -> tuple[Floats, Floats, Floats]:  # fmt: skip
    """Return the squared distance and offset [G, P] of points from the closest point of each group.

    Squares are -1 beyond reach. P is a multiple of SIMD_LANES; the points are padded with copies of the first.
    """
    points, beyond = len(points_m), reach_m * reach_m
    count = -(-points // SIMD_LANES) * SIMD_LANES
    shape = len(starts) - 1, count
    best, best_x, best_y = np.empty(shape, FLOAT), np.empty(shape, FLOAT), np.empty(shape, FLOAT)
    x, y, inside = np.empty(count, FLOAT), np.empty(count, FLOAT), np.empty(count, FLOAT)
    box_m = np.array([points_m[:, 0].min(), points_m[:, 1].min(), points_m[:, 0].max(), points_m[:, 1].max()])
    for g in range(len(best)):
        for p in range(count):
            best[g, p], best_x[g, p] = beyond, np.inf
        for n in range(starts[g], starts[g + 1]):
            k = order[n]
            if _squared_box_distance(bounds_m, k, box_m) > beyond:
                continue
            ends, first, last = segments, segment_starts[k], segment_starts[k + 1]
            if first == last:
                ends, first, last = TILE_EDGES, 0, len(TILE_EDGES)
            for p in range(count):
                m = p if p < points else 0
                x[p], y[p] = points_m[m, 0] - tile[k, 0] * TILE_M, points_m[m, 1] - tile[k, 1] * TILE_M
            if crown_m[k] > 0.0:
                _improve_by_crown(x, y, ends, first, last, crown_m[k], g, best, best_x, best_y)
            else:
                _improve_by_segments(x, y, ends, first, last, g, best, best_x, best_y)
            if form[k] == AREA:
                _fill_inside(x, y, ends, first, last, inside)
                for p in range(count):
                    if inside[p] == 1.0:
                        best[g, p], best_x[g, p], best_y[g, p] = 0.0, 0.0, 0.0
        for p in range(count):
            best[g, p] = -1.0 if best_x[g, p] == np.inf else best[g, p]
    return best, best_x, best_y


@compiled
def _squared_box_distance(bounds_m: Floats, k: int, other_m: Floats) -> float:
    gap_x = max(bounds_m[k, 0] - other_m[2], 0.0, other_m[0] - bounds_m[k, 2])
    gap_y = max(bounds_m[k, 1] - other_m[3], 0.0, other_m[1] - bounds_m[k, 3])
    return gap_x * gap_x + gap_y * gap_y


@compiled
def _improve_by_segments(
    x: Floats, y: Floats, segments: Steps, first: int, last: int, g: int, best: Floats, best_x: Floats, best_y: Floats
) -> None:
    """Improve the squared distances and offsets of points, relative to a tile's middle, to the nearest segment.

    The loop over points has no branch, so that the compiler vectorises it. The arrays [G, P] are of all groups, because
    slices would cost as much as the arithmetic.
    """
    for s in range(first, last):
        x1, y1, x2, y2 = segments[s, 0] * STEP, segments[s, 1] * STEP, segments[s, 2] * STEP, segments[s, 3] * STEP
        along_x, along_y = x2 - x1, y2 - y1
        length = along_x * along_x + along_y * along_y
        a_share = ONE / length if length > ZERO else ZERO
        for p in range(len(x)):
            from_x, from_y = x[p] - x1, y[p] - y1
            share = (from_x * along_x + from_y * along_y) * a_share
            share = ZERO if share < ZERO else share
            share = ONE if share > ONE else share
            offset_x, offset_y = from_x - share * along_x, from_y - share * along_y
            square, smallest = offset_x * offset_x + offset_y * offset_y, best[g, p]
            best[g, p] = square if square <= smallest else smallest
            best_x[g, p] = offset_x if square <= smallest else best_x[g, p]
            best_y[g, p] = offset_y if square <= smallest else best_y[g, p]


@compiled
def _fill_inside(x: Floats, y: Floats, segments: Steps, first: int, last: int, inside: Floats) -> None:
    """Set 1 for points with an odd number of segments to their east, else 0."""
    for p in range(len(x)):
        inside[p] = ZERO
    for s in range(first, last):
        x1, y1, x2, y2 = segments[s, 0] * STEP, segments[s, 1] * STEP, segments[s, 2] * STEP, segments[s, 3] * STEP
        slope = (x2 - x1) / (y2 - y1)
        for p in range(len(x)):
            sees = ((y1 > y[p]) != (y2 > y[p])) & (x[p] - x1 < (y[p] - y1) * slope)
            inside[p] = ONE - inside[p] if sees else inside[p]


@compiled
def _improve_by_crown(
    x: Floats, y: Floats, segments: Steps, first: int, last: int, crown_m: float, g: int, best: Floats, best_x: Floats,
    best_y: Floats,
) -> None:  # fmt: skip
    """Improve distances and offsets by the crown around a tree's trunk; see `crown_reach_m`."""
    shape = (1, len(x))
    trunk, trunk_x, trunk_y = np.full(shape, INFINITE), np.empty(shape, FLOAT), np.empty(shape, FLOAT)
    _improve_by_segments(x, y, segments, first, last, 0, trunk, trunk_x, trunk_y)
    for p in range(len(x)):
        nearer = 1.0
        if trunk[0, p] > 16.0 * crown_m * crown_m:
            nearer -= crown_m / np.sqrt(trunk[0, p] + 9.0 * crown_m * crown_m)
        square = trunk[0, p] * nearer * nearer
        if square <= best[g, p]:
            best[g, p], best_x[g, p], best_y[g, p] = square, trunk_x[0, p] * nearer, trunk_y[0, p] * nearer
