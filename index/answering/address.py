"""The address of a position, in parts that have Nominatim's names."""

from typing import Final

import numpy as np

from index.answering.place_text import closest_points_from, nearest_street
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.points import Ints
from models.citymap.types import Floats

HOUSE_REACH_M: Final = 40.0  # across a wide street; like the next one, not measured
POSTCODE_REACH_M: Final = 150.0
POSTCODE: Final = "post "  # starts the code of an object
# Districts and settlements have no kind, so their reach tells: these are below DISTRICT_RADII_M of models/sources/osm
DISTRICTS: Final = (
    ("neighbourhood", 250.0), ("village", 800.0), ("suburb", 900.0), ("town", 1800.0), ("city", 3000.0),
)  # fmt: skip


def address_at(gazetteer: Gazetteer, position: Floats) -> dict[str, str]:
    """Return the address of a position [2], as far as the map has it."""
    nearest = nearest_street(gazetteer, position)
    road = None if nearest is None else gazetteer.objects[nearest[0]].names[0]
    number, postcode = _house(gazetteer, position, road)
    parts = {"house_number": number, "road": road, **_districts(gazetteer, position), "postcode": postcode}
    return {name: part for name, part in parts.items() if part is not None}


def _house(gazetteer: Gazetteer, position: Floats, road: str | None) -> tuple[str | None, str | None]:
    """Return the number of the nearest house on a road, and the postcode of the nearest house that has one."""
    number = postcode = None
    rows = _near(gazetteer, np.flatnonzero(gazetteer.objects.has_number), position, POSTCODE_REACH_M)
    ways = closest_points_from(gazetteer, rows, position, POSTCODE_REACH_M)
    for n in np.argsort(ways.distance_m, kind="stable").tolist():
        house = gazetteer.objects[int(rows[ways.target[n]])]
        if number is None and road == house.street and ways.distance_m[n] <= HOUSE_REACH_M:
            number = house.number
        codes = (code.removeprefix(POSTCODE) for code in house.codes if code.startswith(POSTCODE))
        postcode = postcode or next(codes, "").upper() or None
        if postcode and (number or ways.distance_m[n] > HOUSE_REACH_M):
            break
    return number, postcode


def _districts(gazetteer: Gazetteer, position: Floats) -> dict[str, str]:
    """Return the districts and settlements around a position, smallest first; of each size the nearest middle wins."""
    objects = gazetteer.objects
    rows = _near(gazetteer, np.flatnonzero(gazetteer.is_area & objects.has_name & ~objects.has_kind), position, 0.0)
    ways = closest_points_from(gazetteer, rows, position, 1.0)
    inside = rows[ways.target[ways.distance_m == 0.0]]
    away_m = np.hypot(*(gazetteer.middles_m[inside] - position).T)
    reach_m, districts = gazetteer.reach_m[inside], dict[str, str]()
    for (name, low_m), high_m in zip(DISTRICTS, [low_m for _, low_m in DISTRICTS[1:]] + [np.inf], strict=True):
        of_size = np.flatnonzero((low_m <= reach_m) & (reach_m < high_m))
        if len(of_size):
            districts[name] = objects[int(inside[of_size[away_m[of_size].argmin()]])].names[0]
    return districts


def _near(gazetteer: Gazetteer, objects: Ints, position: Floats, apart_m: float) -> Ints:
    """Return those of some objects that may be within a distance of a position."""
    distance_m = np.hypot(*(gazetteer.middles_m[objects] - position).T)
    return objects[distance_m <= gazetteer.reach_m[objects] + apart_m]
