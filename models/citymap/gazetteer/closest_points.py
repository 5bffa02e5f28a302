"""Exact offsets from positions to the objects of a gazetteer: closest points of segments, insides of areas."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats
from models.compiled import compiled, longer


@dataclass(frozen=True, slots=True, eq=False)
class PointGroups:
    """Positions in groups of near ones, which are searched together."""

    points_m: Floats  # [N, 2], in order of group
    starts: Ints  # [C + 1] group c has the points starts[c] to starts[c + 1]
    centers_m: Floats  # [C, 2] of the groups
    radius_m: float  # greatest distance of a point from its group's centre

    @classmethod
    def from_groups(cls, points_m: Floats, group: Ints) -> "PointGroups":
        """Build groups from positions [N, 2] and the ascending group number [N] of each."""
        starts = np.flatnonzero(np.diff(group, prepend=-1))
        low, high = np.minimum.reduceat(points_m, starts), np.maximum.reduceat(points_m, starts)
        centers = (low + high) / 2
        ends = np.append(starts, len(points_m))
        distance_m = np.hypot(*(points_m - np.repeat(centers, np.diff(ends), axis=0)).T)
        return cls(points_m, ends, centers, float(distance_m.max()))


@dataclass(frozen=True, slots=True, eq=False)
class ClosestPoints:
    """Offsets from positions to the closest points of objects near them."""

    point: Ints  # [P] position
    target: Ints  # [P] index among the objects searched
    offset_m: Floats  # [P, 2] from the position to the closest point of the object; zero inside an area

    @property
    def distance_m(self) -> Floats:
        """Return the distances [P]."""
        return np.hypot(*self.offset_m.T)


def find_closest_points(
    groups: PointGroups, segments_m: Floats, starts: Ints, is_area: npt.NDArray[np.bool_], reach_m: float
) -> ClosestPoints:
    """Return the closest points of all objects within reach; objects are given as in `Gazetteer`."""
    return ClosestPoints(*_closest_points(
        groups.points_m, groups.starts, groups.centers_m, groups.radius_m,
        segments_m.astype(np.float64, copy=False), starts, is_area, float(reach_m),
    ))  # fmt: skip


def select_objects(gazetteer: Gazetteer, objects: Ints) -> tuple[Floats, Ints, npt.NDArray[np.bool_]]:
    """Return the segments, starts and `is_area` of some objects of a gazetteer."""
    begin, end = gazetteer.starts[objects], gazetteer.starts[objects + 1]
    starts = np.concatenate([[0], np.cumsum(end - begin)])
    return gazetteer.segments_m[ranges(begin, end)], starts, gazetteer.is_area[objects]


@compiled
def _closest_points(
    points_m: Floats, group_starts: Ints, centers_m: Floats, radius_m: float,
    segments_m: Floats, starts: Ints, is_area: npt.NDArray[np.bool_], reach_m: float,
) -> tuple[Ints, Ints, Floats]:  # fmt: skip
    """Return (point, object, offset) by group, then object; each group tests only segments that may be the closest."""
    count, room = 0, len(points_m) + 64
    point, target, offsets = np.empty(room, np.int64), np.empty(room, np.int64), np.empty((room, 2))
    boxes_m, metres = _boxes_with_margin(segments_m, starts, reach_m + radius_m), np.empty(len(segments_m))
    for c in range(len(centers_m)):
        x, y = centers_m[c]
        for i in range(len(starts) - 1):
            if x < boxes_m[i, 0] or x > boxes_m[i, 2] or y < boxes_m[i, 1] or y > boxes_m[i, 3]:
                continue
            ends = segments_m[starts[i] : starts[i + 1]]
            for s in range(len(ends)):
                metres[s] = _length(_offset_to_segment(x, y, ends[s]))
            nearest = metres[: len(ends)].min()
            if nearest > reach_m + radius_m and not (is_area[i] and is_inside(x, y, ends)):
                continue
            for p in range(group_starts[c], group_starts[c + 1]):
                offset = _closest_offset(points_m[p, 0], points_m[p, 1], ends, metres, nearest + 2 * radius_m)
                if is_area[i] and is_inside(points_m[p, 0], points_m[p, 1], ends):
                    offset = (0.0, 0.0)
                if _length(offset) > reach_m:
                    continue
                if count == room:
                    room *= 2
                    point, target, offsets = longer(point), longer(target), longer(offsets)
                point[count], target[count] = p, i
                offsets[count, 0], offsets[count, 1] = offset
                count += 1
    return point[:count].copy(), target[:count].copy(), offsets[:count].copy()


@compiled
def _boxes_with_margin(segments_m: Floats, starts: Ints, margin_m: float) -> Floats:
    """Return the bounding box [objects, 4] of each object, enlarged by a margin."""
    boxes = np.empty((len(starts) - 1, 4))
    for i in range(len(starts) - 1):
        ends = segments_m[starts[i] : starts[i + 1]]
        for axis in range(2):
            boxes[i, axis] = min(ends[:, axis].min(), ends[:, axis + 2].min()) - margin_m
            boxes[i, axis + 2] = max(ends[:, axis].max(), ends[:, axis + 2].max()) + margin_m
    return boxes


@compiled
def _offset_to_segment(x: float, y: float, ends: Floats) -> tuple[float, float]:
    along_x, along_y = ends[2] - ends[0], ends[3] - ends[1]
    from_x, from_y = x - ends[0], y - ends[1]
    square = along_x * along_x + along_y * along_y
    share = min(1.0, max(0.0, (from_x * along_x + from_y * along_y) / max(square, 1e-9)))
    return share * along_x - from_x, share * along_y - from_y


@compiled
def _length(offset: tuple[float, float]) -> float:
    """Return a length in metres; this takes a third of the time of `hypot`, which guards against overflow."""
    return np.sqrt(offset[0] * offset[0] + offset[1] * offset[1])


@compiled
def _closest_offset(x: float, y: float, ends: Floats, metres: Floats, reach_m: float) -> tuple[float, float]:
    """Return the offset to the closest of the segments [n, 4] within `reach_m` of the group's centre."""
    best, closest = np.inf, (0.0, 0.0)
    for s in range(len(ends)):
        if metres[s] <= reach_m:
            offset = _offset_to_segment(x, y, ends[s])
            square = offset[0] * offset[0] + offset[1] * offset[1]
            if square < best:
                best, closest = square, offset
    return closest


@compiled
def is_inside(x: float, y: float, ends: Floats) -> bool:
    """Whether a point is inside the rings of segments [n, 4]: a ray to the east crosses an odd number of them."""
    is_odd = False
    for s in range(len(ends)):
        x1, y1, x2, y2 = ends[s]
        if (y1 > y) != (y2 > y) and x < x1 + (y - y1) * (x2 - x1) / (y2 - y1):
            is_odd = not is_odd
    return is_odd
