"""The way from positions to the objects of a gazetteer, exactly: closest points of segments, insides of areas."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from models.city.gazetteer.gazetteer import Gazetteer
from models.city.points import Ints, ranges
from models.city.types import Floats


@dataclass(frozen=True, slots=True, eq=False)
class Around:
    """Positions in groups that lie close together, for which ways are looked up together.

    Attributes:
        points_m: [N, 2], in order of group.
        starts: [C + 1] group c has the points starts[c] to starts[c + 1].
        centers_m: [C, 2] of the groups.
        radius_m: no point is farther from its group's centre.
    """

    points_m: Floats
    starts: Ints
    centers_m: Floats
    radius_m: float

    @classmethod
    def of(cls, points_m: Floats, group: Ints) -> "Around":
        """Positions [N, 2] with the number of each one's group, ascending."""
        starts = np.flatnonzero(np.diff(group, prepend=-1))
        low, high = np.minimum.reduceat(points_m, starts), np.maximum.reduceat(points_m, starts)
        centers = (low + high) / 2
        ends = np.append(starts, len(points_m))
        away = np.hypot(*(points_m - np.repeat(centers, np.diff(ends), axis=0)).T)
        return cls(points_m, ends, centers, float(away.max()))


@dataclass(frozen=True, slots=True, eq=False)
class Ways:
    """Ways from positions to objects near them.

    Attributes:
        point: [P] position.
        item: [P] which of the objects that were asked for.
        way_m: [P, 2] from the position to the closest point of the object; no way inside an area.
    """

    point: Ints
    item: Ints
    way_m: Floats

    @property
    def metres(self) -> Floats:
        """[P] how far."""
        far: Floats = np.hypot(*self.way_m.T)
        return far


def ways_to(around: Around, segments_m: Floats, starts: Ints, is_area: npt.NDArray[np.bool_], reach_m: float) -> Ways:
    """The ways to objects, as far as they are within reach.

    Args:
        around: from where.
        segments_m: of the objects, see `Gazetteer`.
        starts: likewise.
        is_area: likewise.
        reach_m: beyond are none.
    """
    if not len(starts) - 1 or not len(around.points_m):
        return Ways(np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 2)))
    group, item = _near(around, segments_m, starts, reach_m)
    # segments of each pair, those alone that may be the closest to a point of the group
    count = np.diff(starts)[item]
    segment = ranges(starts[item], starts[item + 1])
    pair = np.repeat(np.arange(len(item)), count)
    ends = segments_m[segment].astype(np.float64)
    metres = np.hypot(*_way(around.centers_m[group[pair]], ends))
    first = np.cumsum(count) - count
    nearest = np.minimum.reduceat(metres, first) if len(first) else metres
    inside = _inside(around.centers_m[group[pair]], ends, first) & is_area[item] if len(first) else np.zeros(0, bool)
    wanted = (nearest <= reach_m + around.radius_m) | inside
    kept = wanted[pair] & (metres <= (nearest + 2 * around.radius_m)[pair])
    point, of_item, way = _exact(around, group, item, pair[kept], segment[kept], segments_m)
    surely = is_area[of_item]
    if surely.any():
        way[surely] = _without_inside(around, point[surely], of_item[surely], way[surely], segments_m, starts)
    near = np.hypot(*way.T) <= reach_m
    return Ways(point[near], of_item[near], way[near])


def cut(gazetteer: Gazetteer, objects: Ints) -> tuple[Floats, Ints, npt.NDArray[np.bool_]]:
    """Segments, starts and `is_area` of some objects of a gazetteer."""
    begin, end = gazetteer.starts[objects], gazetteer.starts[objects + 1]
    starts = np.concatenate([[0], np.cumsum(end - begin)])
    return gazetteer.segments_m[ranges(begin, end)], starts, gazetteer.is_area[objects]


def _near(around: Around, segments_m: Floats, starts: Ints, reach_m: float) -> tuple[Ints, Ints]:
    """(group, object) pairs whose boxes are within reach, in order."""
    ends = segments_m.reshape(-1, 2, 2)
    low = np.minimum.reduceat(ends.min(axis=1), starts[:-1]) - reach_m - around.radius_m
    high = np.maximum.reduceat(ends.max(axis=1), starts[:-1]) + reach_m + around.radius_m
    groups, items = [], []
    step = max(1, 2_000_000 // max(1, len(low)))
    for begin in range(0, len(around.centers_m), step):
        x, y = around.centers_m[begin : begin + step, :, None].transpose(1, 0, 2)
        inside = (x >= low[:, 0]) & (x <= high[:, 0]) & (y >= low[:, 1]) & (y <= high[:, 1])
        group, item = np.nonzero(inside)
        groups.append(group + begin)
        items.append(item)
    return np.concatenate(groups), np.concatenate(items)


def _way(points_m: Floats, ends: Floats) -> Floats:
    """[2, n] from points [n, 2] to the closest points of segments [n, 4]."""
    x1, y1 = ends[:, 0], ends[:, 1]
    along_x, along_y = ends[:, 2] - x1, ends[:, 3] - y1
    x, y = points_m[:, 0] - x1, points_m[:, 1] - y1
    square = along_x * along_x + along_y * along_y
    share = (x * along_x + y * along_y) / np.maximum(square, 1e-9)
    np.clip(share, 0.0, 1.0, out=share)
    way: Floats = np.stack([share * along_x - x, share * along_y - y])
    return way


def _inside(points_m: Floats, ends: Floats, first: Ints) -> npt.NDArray[np.bool_]:
    """[pairs] whether points are inside the rings of segments: a ray to the east crosses an odd number of them."""
    x, y = points_m.T
    x1, y1, x2, y2 = ends.T
    with np.errstate(divide="ignore", invalid="ignore"):
        crosses = ((y1 > y) != (y2 > y)) & (x < x1 + (y - y1) * (x2 - x1) / (y2 - y1))
    odd: npt.NDArray[np.bool_] = np.add.reduceat(crosses.astype(np.int64), first) % 2 == 1
    return odd


def _exact(
    around: Around, group: Ints, item: Ints, pair: Ints, segment: Ints, segments_m: Floats
) -> tuple[Ints, Ints, Floats]:
    """(point, object, way) of every point of a pair's group to the closest of the pair's segments."""
    if not len(pair):
        return np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 2))
    begin = np.flatnonzero(np.diff(pair, prepend=-1))
    pairs, sizes = pair[begin], np.diff(np.append(begin, len(pair)))
    low, high = around.starts[group[pairs]], around.starts[group[pairs] + 1]
    points = ranges(low, high)  # of each pair
    of = np.repeat(np.arange(len(pairs)), high - low)
    rows = ranges(begin[of], begin[of] + sizes[of])
    owner = np.repeat(np.arange(len(of)), sizes[of])
    way = _way(around.points_m[points[owner]], segments_m[segment[rows]].astype(np.float64))
    metres = way[0] * way[0] + way[1] * way[1]
    first = np.cumsum(sizes[of]) - sizes[of]
    best = np.minimum.reduceat(metres, first)
    chosen = np.flatnonzero(metres == np.repeat(best, sizes[of]))
    chosen = chosen[np.diff(owner[chosen], prepend=-1) > 0]
    return points, item[pairs][of], way[:, chosen].T


def _without_inside(around: Around, point: Ints, item: Ints, way: Floats, segments_m: Floats, starts: Ints) -> Floats:
    """Ways to areas, none from inside."""
    count = np.diff(starts)[item]
    segment = ranges(starts[item], starts[item + 1])
    first = np.cumsum(count) - count
    points = np.repeat(around.points_m[point], count, axis=0)
    inside = _inside(points, segments_m[segment].astype(np.float64), first)
    found: Floats = np.where(inside[:, None], 0.0, way)
    return found
