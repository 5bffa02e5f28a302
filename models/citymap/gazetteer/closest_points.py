"""The way from positions to the objects of a gazetteer, exactly: closest points of segments, insides of areas."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats
from models.compiled import compiled, longer


@dataclass(frozen=True, slots=True, eq=False)
class PointGroups:
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
    def from_groups(cls, points_m: Floats, group: Ints) -> "PointGroups":
        """Positions [N, 2] with the number of each one's group, ascending."""
        starts = np.flatnonzero(np.diff(group, prepend=-1))
        low, high = np.minimum.reduceat(points_m, starts), np.maximum.reduceat(points_m, starts)
        centers = (low + high) / 2
        ends = np.append(starts, len(points_m))
        away = np.hypot(*(points_m - np.repeat(centers, np.diff(ends), axis=0)).T)
        return cls(points_m, ends, centers, float(away.max()))


@dataclass(frozen=True, slots=True, eq=False)
class ClosestPoints:
    """Ways from positions to objects near them.

    Attributes:
        point: [P] position.
        target: [P] which of the objects that were asked for.
        offset_m: [P, 2] from the position to the closest point of the object; no way inside an area.
    """

    point: Ints
    target: Ints
    offset_m: Floats

    @property
    def distance_m(self) -> Floats:
        """[P] how far."""
        far: Floats = np.hypot(*self.offset_m.T)
        return far


def find_closest_points(
    around: PointGroups, segments_m: Floats, starts: Ints, is_area: npt.NDArray[np.bool_], reach_m: float
) -> ClosestPoints:
    """The ways to objects, as far as they are within reach.

    Args:
        around: from where.
        segments_m: of the objects, see `Gazetteer`.
        starts: likewise.
        is_area: likewise.
        reach_m: beyond are none.
    """
    return ClosestPoints(*_closest_points(
        around.points_m, around.starts, around.centers_m, around.radius_m,
        segments_m.astype(np.float64, copy=False), starts, is_area, float(reach_m),
    ))  # fmt: skip


def select_objects(gazetteer: Gazetteer, objects: Ints) -> tuple[Floats, Ints, npt.NDArray[np.bool_]]:
    """Segments, starts and `is_area` of some objects of a gazetteer."""
    begin, end = gazetteer.starts[objects], gazetteer.starts[objects + 1]
    starts = np.concatenate([[0], np.cumsum(end - begin)])
    return gazetteer.segments_m[ranges(begin, end)], starts, gazetteer.is_area[objects]


@compiled
def _closest_points(
    points_m: Floats, group_starts: Ints, centers_m: Floats, radius_m: float,
    segments_m: Floats, starts: Ints, is_area: npt.NDArray[np.bool_], reach_m: float,
) -> tuple[Ints, Ints, Floats]:  # fmt: skip
    """(point, object, way) in order of group, then object: of a group only the segments that may be the closest."""
    count, room = 0, len(points_m) + 64
    point, item, way = np.empty(room, np.int64), np.empty(room, np.int64), np.empty((room, 2))
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
                found = _closest_offset(points_m[p, 0], points_m[p, 1], ends, metres, nearest + 2 * radius_m)
                if is_area[i] and is_inside(points_m[p, 0], points_m[p, 1], ends):
                    found = (0.0, 0.0)
                if _length(found) > reach_m:
                    continue
                if count == room:
                    room *= 2
                    point, item, way = longer(point), longer(item), longer(way)
                point[count], item[count] = p, i
                way[count, 0], way[count, 1] = found
                count += 1
    return point[:count].copy(), item[:count].copy(), way[:count].copy()


@compiled
def _boxes_with_margin(segments_m: Floats, starts: Ints, margin_m: float) -> Floats:
    """[objects, 4] of each, wider by a margin."""
    boxes = np.empty((len(starts) - 1, 4))
    for i in range(len(starts) - 1):
        ends = segments_m[starts[i] : starts[i + 1]]
        for axis in range(2):
            boxes[i, axis] = min(ends[:, axis].min(), ends[:, axis + 2].min()) - margin_m
            boxes[i, axis + 2] = max(ends[:, axis].max(), ends[:, axis + 2].max()) + margin_m
    return boxes


@compiled
def _offset_to_segment(x: float, y: float, ends: Floats) -> tuple[float, float]:
    """From a point to the closest one of a segment [4]."""
    along_x, along_y = ends[2] - ends[0], ends[3] - ends[1]
    away_x, away_y = x - ends[0], y - ends[1]
    square = along_x * along_x + along_y * along_y
    share = min(1.0, max(0.0, (away_x * along_x + away_y * along_y) / max(square, 1e-9)))
    return share * along_x - away_x, share * along_y - away_y


@compiled
def _length(way: tuple[float, float]) -> float:
    """Metres; a third of the time that `hypot` takes, which heeds numbers as large as none here."""
    metres: float = np.sqrt(way[0] * way[0] + way[1] * way[1])
    return metres


@compiled
def _closest_offset(x: float, y: float, ends: Floats, metres: Floats, farthest_m: float) -> tuple[float, float]:
    """The way to the closest of those segments [n, 4] that are no farther from the group's centre than that."""
    best, found = np.inf, (0.0, 0.0)
    for s in range(len(ends)):
        if metres[s] <= farthest_m:
            way = _offset_to_segment(x, y, ends[s])
            square = way[0] * way[0] + way[1] * way[1]
            if square < best:
                best, found = square, way
    return found


@compiled
def is_inside(x: float, y: float, ends: Floats) -> bool:
    """Whether a point is inside the rings of segments [n, 4]: a ray to the east crosses an odd number of them."""
    is_odd = False
    for s in range(len(ends)):
        x1, y1, x2, y2 = ends[s]
        if (y1 > y) != (y2 > y) and x < x1 + (y - y1) * (x2 - x1) / (y2 - y1):
            is_odd = not is_odd
    return is_odd
