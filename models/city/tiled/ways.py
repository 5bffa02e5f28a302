"""The ways from positions to what stands around them, by geometry: compiled, since there are millions of them."""

from typing import Final

import numpy as np
import numpy.typing as npt

from models.city.points import Ints
from models.city.tiled.groups import groups, window
from models.city.tiled.pieces import PieceTable
from models.city.tiled.segments import STEP_M, Steps
from models.city.tiled.solids import FORMS
from models.city.tiled.tiling import TILE_M
from models.city.types import CutRules, Floats
from models.compiled import compiled, longer

AREA: Final = FORMS.index("area")
THING: Final = FORMS.index("thing")
CROWN_M: Final = 3.0  # a crown may reach nearer than the tile that its trunk is in
LEAST: Final = 0.6  # what hangs together counts by itself if it has at least this share of what a part has
SLACK_M: Final = 1e-3  # by which a piece that fills its tile may stand over
USUAL: Final = 16  # things around a position, to begin with


def ways_around(
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
    found: tuple[Ints, Ints, npt.NDArray[np.int8]] = _all_ways(
        points_m.astype(np.float64), point_starts.astype(np.int64), centers_m[:, :2].astype(np.float64),
        rules.cell_size_m / 2 - SLACK_M, float(reach_m), float(step_m), LEAST * rules.min_part_points,
        table.low, table.shape, table.tile_starts, table.tile, table.instance, table.form, table.worth,
        table.bounds_m, table.crown_m, table.segment_starts, table.segments, table.link_starts, table.links,
    )  # fmt: skip
    return found


@compiled
def _all_ways(
    points_m: Floats, point_starts: Ints, centers_m: Floats, half_m: float, reach_m: float, step_m: float,
    least: float, low: Ints, shape: Ints, tile_starts: Ints, tile: Ints, instance: Ints, form: Ints, worth: Floats,
    bounds_m: Floats, crown_m: Floats, segment_starts: Ints, segments: Steps, link_starts: Ints, links: Ints,
) -> tuple[Ints, Ints, npt.NDArray[np.int8]]:  # fmt: skip
    room = USUAL * len(points_m) + 1024
    point, found, way = np.empty(room, np.int64), np.empty(room, np.int64), np.empty((room, 2), np.int8)
    squares, count = np.empty(room, np.int64), 0
    for n in range(len(point_starts) - 1):
        mine = points_m[point_starts[n] : point_starts[n + 1]]
        if len(mine) == 0:
            continue
        pieces, runs = window(mine, reach_m + CROWN_M, low, shape, tile_starts)
        order, starts = groups(
            pieces, runs, centers_m[n], half_m, least, tile, instance, form, worth, link_starts, links
        )
        square, way_x, way_y = _ways_to_groups(
            mine, order, starts, reach_m, tile, form, bounds_m, crown_m, segment_starts, segments
        )
        for m in range(len(mine)):
            if count + len(starts) > room:
                room *= 2
                point, found, way = longer(point), longer(found), longer(way)
                squares = longer(squares)
            begin = count
            for g in range(len(starts) - 1):
                if square[g, m] < 0.0:
                    continue
                x, y = np.rint(way_x[g, m] / step_m), np.rint(way_y[g, m] / step_m)
                key, at = np.int64(x * x + y * y), count
                while at > begin and squares[at - 1] > key:
                    squares[at], found[at] = squares[at - 1], found[at - 1]
                    way[at, 0], way[at, 1] = way[at - 1, 0], way[at - 1, 1]
                    at -= 1
                squares[at], found[at] = key, instance[order[starts[g]]]
                way[at, 0], way[at, 1] = np.int8(x), np.int8(y)
                point[count] = point_starts[n] + m
                count += 1
    return point[:count].copy(), found[:count].copy(), way[:count].copy()


@compiled
def _ways_to_groups(
    points_m: Floats, order: Ints, starts: Ints, reach_m: float, tile: Ints, form: Ints, bounds_m: Floats,
    crown_m: Floats, segment_starts: Ints, segments: Steps,
) -> tuple[Floats, Floats, Floats]:  # fmt: skip
    """[G, P] squared distance and way of points from the closest point of groups of pieces; squares -1 beyond reach."""
    shape, count = (len(starts) - 1, len(points_m)), len(points_m)
    best, best_x, best_y = np.full(shape, -1.0), np.empty(shape), np.empty(shape)
    x, y, inside = np.empty(count), np.empty(count), np.empty(count)
    square, nearest = np.empty(count), np.empty(count)
    box_m = np.array([points_m[:, 0].min(), points_m[:, 1].min(), points_m[:, 0].max(), points_m[:, 1].max()])
    for g in range(len(best)):
        for k in order[starts[g] : starts[g + 1]]:
            if _square_apart(bounds_m[k], box_m[0], box_m[1], box_m[2], box_m[3]) > reach_m * reach_m:
                continue
            ends = segments[segment_starts[k] : segment_starts[k + 1]]
            for p in range(count):
                x[p], y[p] = points_m[p, 0] - tile[k, 0] * TILE_M, points_m[p, 1] - tile[k, 1] * TILE_M
            _nearest_segments(x, y, ends, square, nearest)
            inside[:] = 0.0
            if form[k] == AREA:
                _insides(x, y, ends, inside)
            for p in range(count):
                most = reach_m * reach_m if best[g, p] < 0.0 else best[g, p]
                if crown_m[k] == 0.0 and square[p] > most and inside[p] == 0.0:
                    continue
                if _square_apart(bounds_m[k], points_m[p, 0], points_m[p, 1], points_m[p, 0], points_m[p, 1]) > most:
                    continue
                this, way_x, way_y = 0.0, 0.0, 0.0
                if inside[p] == 0.0:
                    this, way_x, way_y = _way_to_segment(x[p], y[p], ends[int(nearest[p])], crown_m[k])
                if this <= most:
                    best[g, p], best_x[g, p], best_y[g, p] = this, way_x, way_y
    return best, best_x, best_y


@compiled
def _square_apart(bounds_m: Floats, west: float, south: float, east: float, north: float) -> float:
    """The square of how far two boxes are apart."""
    away_x = max(bounds_m[0] - east, 0.0, west - bounds_m[2])
    away_y = max(bounds_m[1] - north, 0.0, south - bounds_m[3])
    square: float = away_x * away_x + away_y * away_y
    return square


@compiled
def _nearest_segments(x: Floats, y: Floats, segments: Steps, square: Floats, nearest: Floats) -> None:
    """Fill in the squared distance of points, seen from the middle of a tile, from the nearest of some segments.

    Segment by segment, without a branch in the loop over points: so the processor takes several of them at once.
    """
    square[:], nearest[:] = np.inf, 0.0
    for s in range(len(segments)):
        x1, y1 = segments[s, 0] * STEP_M, segments[s, 1] * STEP_M
        along_x, along_y = segments[s, 2] * STEP_M - x1, segments[s, 3] * STEP_M - y1
        length = along_x * along_x + along_y * along_y
        length, number = (length if length > 0.0 else 1.0), float(s)
        for p in range(len(x)):
            from_x, from_y = x[p] - x1, y[p] - y1
            share = (from_x * along_x + from_y * along_y) / length
            share = 0.0 if share < 0.0 else share
            share = 1.0 if share > 1.0 else share
            way_x, way_y = from_x - share * along_x, from_y - share * along_y
            this, so_far = way_x * way_x + way_y * way_y, square[p]
            square[p] = this if this < so_far else so_far
            nearest[p] = number if this < so_far else nearest[p]


@compiled
def _insides(x: Floats, y: Floats, segments: Steps, inside: Floats) -> None:
    """Turn 0 into 1 and 1 into 0 for points that see an odd number of segments in the east."""
    for s in range(len(segments)):
        x1, y1, y2 = segments[s, 0] * STEP_M, segments[s, 1] * STEP_M, segments[s, 3] * STEP_M
        along_x, along_y = segments[s, 2] * STEP_M - x1, y2 - y1
        for p in range(len(x)):
            sees = ((y1 > y[p]) != (y2 > y[p])) & (x[p] - x1 < (y[p] - y1) * along_x / along_y)
            inside[p] = 1.0 - inside[p] if sees else inside[p]


@compiled
def _way_to_segment(x: float, y: float, segment: Steps, crown_m: float) -> tuple[float, float, float]:
    """Squared distance and way of a point, seen from the middle of a tile, from a segment [4] or the crown round it."""
    x1, y1 = segment[0] * STEP_M, segment[1] * STEP_M
    along_x, along_y, from_x, from_y = segment[2] * STEP_M - x1, segment[3] * STEP_M - y1, x - x1, y - y1
    length = along_x * along_x + along_y * along_y
    share = min(1.0, max(0.0, (from_x * along_x + from_y * along_y) / length)) if length > 0.0 else 0.0
    way_x, way_y = from_x - share * along_x, from_y - share * along_y
    square = way_x * way_x + way_y * way_y
    if square > 16.0 * crown_m * crown_m > 0.0:  # as `crown_reach_m`
        nearer = 1.0 - crown_m / np.sqrt(square + 9.0 * crown_m * crown_m)
        return square * nearer * nearer, way_x * nearer, way_y * nearer
    return square, way_x, way_y
