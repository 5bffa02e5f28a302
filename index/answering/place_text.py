"""A position in words: "on West 25th Street, between 9th Avenue and 10th Avenue, 12 m west of Bottino"."""

from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.gazetteer.closest_points import ClosestPoints, PointGroups, find_closest_points, select_objects
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.language.languages.translation import translate
from models.language.measures import compass_name

STREET_REACH_M: Final = 30.0  # from a street's line; like the other reaches, not measured
CORNER_REACH_M: Final = 18.0
NAMED_REACH_M: Final = 60.0
MAX_BLOCK_M: Final = 400.0
ROUNDING_SLACK_M: Final = 0.1  # above the error of single precision in a city


def place_text(gazetteer: Gazetteer, position: Floats) -> str | None:
    """Return the words for a position [2]; None where nothing has a name."""
    nearest = nearest_street(gazetteer, position)
    street = nearest and street_text(gazetteer, nearest[0], position)
    return ", ".join(part for part in (street, _nearest_named(gazetteer, position)) if part) or None


def nearest_street(gazetteer: Gazetteer, position: Floats) -> tuple[int, Floats] | None:
    """Return the street at a position [2] and the offset [2] to its line; None if there is none."""
    streets = gazetteer.streets[_is_possibly_near(*gazetteer.street_extents, position, STREET_REACH_M)]
    ways = closest_points_from(gazetteer, streets, position, STREET_REACH_M)
    if not len(ways.target):
        return None
    best = int(ways.distance_m.argmin())
    return int(streets[ways.target[best]]), ways.offset_m[best]


def street_text(gazetteer: Gazetteer, street: int, position: Floats) -> str:
    """Return where on a street a position [2] is: at a corner, or between two."""
    name = gazetteer.objects[street].names[0]
    meeting = gazetteer.corner_streets
    rows = np.flatnonzero((meeting[:, 0] == street) | (meeting[:, 1] == street))
    away = gazetteer.corners_m[rows].astype(np.float64) - position
    distance_m = np.hypot(*away.T)
    if len(rows) and distance_m.min() <= CORNER_REACH_M:
        other = _other_street(gazetteer, int(rows[distance_m.argmin()]), street)
        return translate("at the corner of {street} and {other}", street=name, other=other)
    near = np.flatnonzero(distance_m <= MAX_BLOCK_M)
    if len(near):
        first = near[distance_m[near].argmin()]
        # the next corner the other way along the street
        behind = near[(away[near] @ away[first]) < -0.5 * distance_m[near] * distance_m[first]]
        one = _other_street(gazetteer, int(rows[first]), street)
        if len(behind):
            two = _other_street(gazetteer, int(rows[behind[distance_m[behind].argmin()]]), street)
            if one != two:
                return translate("on {street}, between {one} and {other}", street=name, one=one, other=two)
        return translate("on {street}, {metres:.0f} m from {other}", street=name, metres=distance_m[first], other=one)
    return translate("on {street}", street=name)


def _nearest_named(gazetteer: Gazetteer, position: Floats) -> str | None:
    near = gazetteer.named[_is_possibly_near(*gazetteer.named_extents, position, NAMED_REACH_M)]
    ways = closest_points_from(gazetteer, near, position, NAMED_REACH_M)
    if not len(ways.target):
        return None
    best = int(ways.distance_m.argmin())
    name, distance_m = gazetteer.objects[int(near[ways.target[best]])].names[0], float(ways.distance_m[best])
    if distance_m < 1.0:
        return translate("at {name}", name=name)
    direction = compass_direction(-ways.offset_m[best])
    return translate("{metres:.0f} m {direction} of {name}", metres=distance_m, direction=direction, name=name)


def _is_possibly_near(middles_m: Floats, reach_m: Floats, position: Floats, apart_m: float) -> npt.NDArray[np.bool_]:
    """Return which objects [n] with given middles [2, n] and reach [n] may be within a distance of a position [2]."""
    east, north = middles_m - position[:, None].astype(np.float32)
    return np.asarray(east * east + north * north <= (reach_m + np.float32(apart_m + ROUNDING_SLACK_M)) ** 2)


def compass_direction(way_m: Floats) -> str:
    """Return the compass direction of an offset [2] (east, north), in the language of the reply."""
    east, north = way_m
    return translate(compass_name(float(np.degrees(np.arctan2(east, north)))))


def closest_points_from(gazetteer: Gazetteer, objects: Ints, position: Floats, reach_m: float) -> ClosestPoints:
    """Return the closest points of some objects of a gazetteer to a position [2]."""
    return find_closest_points(
        PointGroups.from_groups(position[None], np.zeros(1, np.int64)), *select_objects(gazetteer, objects), reach_m
    )


def _other_street(gazetteer: Gazetteer, corner: int, street: int) -> str:
    one, two = gazetteer.corner_streets[corner]
    return gazetteer.objects[int(two if one == street else one)].names[0]
