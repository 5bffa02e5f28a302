"""The ways from positions to what stands around them, by geometry: compiled, since there are millions of them."""

from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.geometry.groups import group_pieces, pieces_near
from models.citymap.geometry.pieces import PieceTable
from models.citymap.geometry.segments import STEP_M, Steps
from models.citymap.geometry.solids import FORMS
from models.citymap.geometry.tiling import TILE_M
from models.citymap.points import Ints
from models.citymap.types import CutRules, Floats
from models.compiled import compiled, longer

AREA: Final = FORMS.index("area")
THING: Final = FORMS.index("thing")
CROWN_M: Final = 3.0  # a crown may reach nearer than the tile that its trunk is in
MIN_GROUP_SHARE: Final = 0.6  # what hangs together counts by itself if it has at least this share of what a part has
TILE_SLACK_M: Final = 1e-3  # by which a piece that fills its tile may stand over
GROUPS_LIMIT: Final = 1 << 32
EXPECTED_ROWS_PER_POINT: Final = 16  # things around a position, to begin with
# Near a position millimetres are as good in single precision, of which a processor takes twice as many at once.
FLOAT: Final = np.float32
STEP: Final = FLOAT(STEP_M)
ZERO: Final = FLOAT(0.0)
ONE: Final = FLOAT(1.0)
SIMD_LANES: Final = 8  # points that a processor takes at once
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
    """The ways from positions to what is around them.

    Pieces of an instance that hang together in a cell's cube are one thing, with what of the same goes on beside the
    cube; what is too small to be a part is left out, unless there is no more of its instance.

    Args:
        table: the map's pieces.
        rules: of its cells.
        centers_m: [N, 2 or more] of cells.
        points_m: [M, 2] metres; cell n owns those from point_starts[n] to point_starts[n + 1].
        point_starts: [N + 1].
        reach_m: beyond there are none; of a tree counts its crown where that is nearer than its trunk.
        step_m: of the ways.

    Returns:
        [R] point, ascending, [R] instance and [R, 2] point minus the thing's closest point, in steps;
        the nearest first, (0, 0) inside an area.
    """
    found: tuple[Ints, Ints, npt.NDArray[np.int8]] = _closest_instances(
        points_m.astype(np.float64), point_starts.astype(np.int64), centers_m[:, :2].astype(np.float64),
        rules.cell_size_m / 2 - TILE_SLACK_M, float(reach_m), float(step_m), MIN_GROUP_SHARE * rules.min_part_points,
        table.low, table.shape, table.tile_starts, table.tile, table.instance, table.form, table.point_count,
        table.bounds_m, table.crown_m, table.segment_starts, table.segments, table.link_starts, table.links,
    )  # fmt: skip
    return found


@compiled
def _closest_instances(
    points_m: Floats, point_starts: Ints, centers_m: Floats, half_m: float, reach_m: float, step_m: float,
    least: float, low: Ints, shape: Ints, tile_starts: Ints, tile: Ints, instance: Ints, form: Ints, worth: Floats,
    bounds_m: Floats, crown_m: Floats, segment_starts: Ints, segments: Steps, link_starts: Ints, links: Ints,
) -> tuple[Ints, Ints, npt.NDArray[np.int8]]:  # fmt: skip
    room = EXPECTED_ROWS_PER_POINT * len(points_m) + 1024
    point, found, way = np.empty(room, np.int64), np.empty(room, np.int64), np.empty((room, 2), np.int8)
    count = 0
    for n in range(len(point_starts) - 1):
        mine = points_m[point_starts[n] : point_starts[n + 1]]
        if len(mine) == 0:
            continue
        pieces, runs = pieces_near(mine, reach_m + CROWN_M, low, shape, tile_starts)
        order, starts = group_pieces(
            pieces, runs, centers_m[n], half_m, least, tile, instance, form, worth, link_starts, links
        )
        square, way_x, way_y = _offsets_to_groups(
            mine, order, starts, reach_m, tile, form, bounds_m, crown_m, segment_starts, segments
        )
        line = np.empty(len(starts), np.int64)
        for m in range(len(mine)):
            if count + len(starts) > room:
                room *= 2
                point, found, way = longer(point), longer(found), longer(way)
            for at in range(_sort_groups(m, step_m, square, way_x, way_y, line)):
                g = line[at] % GROUPS_LIMIT
                point[count], found[count] = point_starts[n] + m, instance[order[starts[g]]]
                way[count, 0] = np.int8(np.rint(way_x[g, m] / step_m))
                way[count, 1] = np.int8(np.rint(way_y[g, m] / step_m))
                count += 1
    return point[:count].copy(), found[:count].copy(), way[:count].copy()


@compiled
def _sort_groups(m: int, step_m: float, square: Floats, way_x: Floats, way_y: Floats, line: Ints) -> int:
    """Fill in the groups that a point has a way to, the nearest first: squared steps times MOST_GROUPS, plus number."""
    count = 0
    for g in range(len(square)):
        if square[g, m] < 0.0:
            continue
        x, y = np.rint(way_x[g, m] / step_m), np.rint(way_y[g, m] / step_m)
        key, at = np.int64(x * x + y * y) * GROUPS_LIMIT + g, count
        while at > 0 and line[at - 1] > key:
            line[at] = line[at - 1]
            at -= 1
        line[at] = key
        count += 1
    return count


@compiled
def _offsets_to_groups(
    points_m: Floats, order: Ints, starts: Ints, reach_m: float, tile: Ints, form: Ints, bounds_m: Floats,
    crown_m: Floats, segment_starts: Ints, segments: Steps,
) -> tuple[Floats, Floats, Floats]:  # fmt: skip
    """[G, P] squared distance and way of points from the closest point of groups of pieces; squares -1 beyond reach.

    P is a multiple of LANES; what is beyond the points is of the first one.
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
            first, last = segment_starts[k], segment_starts[k + 1]
            for p in range(count):
                m = p if p < points else 0
                x[p], y[p] = points_m[m, 0] - tile[k, 0] * TILE_M, points_m[m, 1] - tile[k, 1] * TILE_M
            if crown_m[k] > 0.0:
                _improve_by_crown(x, y, segments, first, last, crown_m[k], g, best, best_x, best_y)
            else:
                _improve_by_segments(x, y, segments, first, last, g, best, best_x, best_y)
            if form[k] == AREA:
                _fill_inside(x, y, segments, first, last, inside)
                for p in range(count):
                    if inside[p] == 1.0:
                        best[g, p], best_x[g, p], best_y[g, p] = 0.0, 0.0, 0.0
        for p in range(count):
            best[g, p] = -1.0 if best_x[g, p] == np.inf else best[g, p]
    return best, best_x, best_y


@compiled
def _squared_box_distance(bounds_m: Floats, k: int, other_m: Floats) -> float:
    """The square of how far the box of a piece and another are apart."""
    away_x = max(bounds_m[k, 0] - other_m[2], 0.0, other_m[0] - bounds_m[k, 2])
    away_y = max(bounds_m[k, 1] - other_m[3], 0.0, other_m[1] - bounds_m[k, 3])
    square: float = away_x * away_x + away_y * away_y
    return square


@compiled
def _improve_by_segments(
    x: Floats, y: Floats, segments: Steps, first: int, last: int, g: int, best: Floats, best_x: Floats, best_y: Floats
) -> None:
    """Improve the squared distance and the way of points, seen from the middle of a tile, to the nearest segment.

    Segment by segment, without a branch in the loop over points: so the processor takes several of them at once. The
    best [G, P] are of a group; slices of arrays would cost as much as the arithmetic.
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
            way_x, way_y = from_x - share * along_x, from_y - share * along_y
            this, so_far = way_x * way_x + way_y * way_y, best[g, p]
            best[g, p] = this if this <= so_far else so_far
            best_x[g, p] = way_x if this <= so_far else best_x[g, p]
            best_y[g, p] = way_y if this <= so_far else best_y[g, p]


@compiled
def _fill_inside(x: Floats, y: Floats, segments: Steps, first: int, last: int, inside: Floats) -> None:
    """1 for points that see an odd number of segments in the east, else 0."""
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
    """As `_improve_by_segments`, to the crown round a tree's trunk, which reaches nearer, as `crown_reach_m`."""
    shape = (1, len(x))
    trunk, trunk_x, trunk_y = np.full(shape, INFINITE), np.empty(shape, FLOAT), np.empty(shape, FLOAT)
    _improve_by_segments(x, y, segments, first, last, 0, trunk, trunk_x, trunk_y)
    for p in range(len(x)):
        nearer = 1.0
        if trunk[0, p] > 16.0 * crown_m * crown_m:
            nearer -= crown_m / np.sqrt(trunk[0, p] + 9.0 * crown_m * crown_m)
        this = trunk[0, p] * nearer * nearer
        if this <= best[g, p]:
            best[g, p], best_x[g, p], best_y[g, p] = this, trunk_x[0, p] * nearer, trunk_y[0, p] * nearer
