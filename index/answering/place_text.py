"""A position in words: "on West 25th Street, between 9th Avenue and 10th Avenue, 12 m west of Bottino"."""

from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.gazetteer.closest_points import ClosestPoints, PointGroups, find_closest_points, select_objects
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.language.measures import compass_name

ON_STREET_M: Final = 30.0
AT_CORNER_M: Final = 18.0
NAMED_M: Final = 60.0
LONGEST_BLOCK_M: Final = 400.0
SLACK_M: Final = 0.1  # more than single precision is off by in a city


def place_text(gazetteer: Gazetteer, position: Floats) -> str | None:
    """What is at a position [2], in words; None where nothing has a name."""
    found = nearest_street(gazetteer, position)
    street = found and street_text(gazetteer, found[0], position)
    return ", ".join(part for part in (street, _beside(gazetteer, position)) if part) or None


def nearest_street(gazetteer: Gazetteer, position: Floats) -> tuple[int, Floats] | None:
    """The street that a position [2] is on, and the way [2] to its line; None where there is none."""
    streets = gazetteer.streets[_may_be_near(*gazetteer.street_extents, position, ON_STREET_M)]
    ways = ways_from(gazetteer, streets, position, ON_STREET_M)
    if not len(ways.target):
        return None
    best = int(ways.distance_m.argmin())
    return int(streets[ways.target[best]]), ways.offset_m[best]


def street_text(gazetteer: Gazetteer, street: int, position: Floats) -> str:
    """Where on a street a position [2] is: at which corner, or between which."""
    name = gazetteer.objects[street].names[0]
    meeting = gazetteer.corner_streets
    rows = np.flatnonzero((meeting[:, 0] == street) | (meeting[:, 1] == street))
    away = gazetteer.corners_m[rows].astype(np.float64) - position
    metres = np.hypot(*away.T)
    if len(rows) and metres.min() <= AT_CORNER_M:
        return f"at the corner of {name} and {_other(gazetteer, int(rows[metres.argmin()]), street)}"
    near = np.flatnonzero(metres <= LONGEST_BLOCK_M)
    if len(near):
        first = near[metres[near].argmin()]
        # the next corner the other way along the street
        behind = near[(away[near] @ away[first]) < -0.5 * metres[near] * metres[first]]
        one = _other(gazetteer, int(rows[first]), street)
        if len(behind):
            two = _other(gazetteer, int(rows[behind[metres[behind].argmin()]]), street)
            if one != two:
                return f"on {name}, between {one} and {two}"
        return f"on {name}, {metres[first]:.0f} m from {one}"
    return f"on {name}"


def _beside(gazetteer: Gazetteer, position: Floats) -> str | None:
    near = gazetteer.named[_may_be_near(*gazetteer.named_extents, position, NAMED_M)]
    ways = ways_from(gazetteer, near, position, NAMED_M)
    if not len(ways.target):
        return None
    best = int(ways.distance_m.argmin())
    name, metres = gazetteer.objects[int(near[ways.target[best]])].names[0], float(ways.distance_m[best])
    if metres < 1.0:
        return f"at {name}"
    return f"{metres:.0f} m {wind_of(-ways.offset_m[best])} of {name}"


def _may_be_near(middles_m: Floats, reach_m: Floats, position: Floats, apart_m: float) -> npt.NDArray[np.bool_]:
    """[n] whether something of a reach [n] round a middle [2, n] may be so near to a position [2]."""
    east, north = middles_m - position[:, None].astype(np.float32)
    return np.asarray(east * east + north * north <= (reach_m + np.float32(apart_m + SLACK_M)) ** 2)


def wind_of(way_m: Floats) -> str:
    """The wind in which a way [2] (east, north) leads."""
    east, north = way_m
    return compass_name(float(np.degrees(np.arctan2(east, north))))


def ways_from(gazetteer: Gazetteer, objects: Ints, position: Floats, reach_m: float) -> ClosestPoints:
    """The ways from a position [2] to some objects of a gazetteer."""
    return find_closest_points(
        PointGroups.from_groups(position[None], np.zeros(1, np.int64)), *select_objects(gazetteer, objects), reach_m
    )


def _other(gazetteer: Gazetteer, corner: int, street: int) -> str:
    one, two = gazetteer.corner_streets[corner]
    return gazetteer.objects[int(two if one == street else one)].names[0]
