"""A position in words: "on West 25th Street, between 9th Avenue and 10th Avenue, 12 m west of Bottino"."""

from typing import Final

import numpy as np

from models.city.gazetteer.gazetteer import STREET, Gazetteer
from models.city.gazetteer.ways import Around, Ways, cut, ways_to
from models.city.points import Ints
from models.city.types import Floats
from models.language.parsed_hint import WINDS

ON_STREET_M: Final = 30.0
AT_CORNER_M: Final = 18.0
NAMED_M: Final = 60.0
LONGEST_BLOCK_M: Final = 400.0


def place_text(gazetteer: Gazetteer, position: Floats) -> str | None:
    """What is at a position [2], in words; None where nothing has a name."""
    parts = [part for part in (_street(gazetteer, position), _beside(gazetteer, position)) if part]
    return ", ".join(parts) or None


def _street(gazetteer: Gazetteer, position: Floats) -> str | None:
    streets = gazetteer.by_kind.get(STREET, np.zeros(0, np.int64))
    ways = _ways(gazetteer, streets, position, ON_STREET_M)
    if not len(ways.item):
        return None
    street = int(streets[ways.item[ways.metres.argmin()]])
    name = gazetteer.words[street].names[0]
    rows = np.flatnonzero((gazetteer.corner_streets == street).any(axis=1))
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
    named = gazetteer.named
    near = named[np.hypot(*(gazetteer.middles_m[named] - position).T) - gazetteer.reach_m[named] <= NAMED_M]
    ways = _ways(gazetteer, near, position, NAMED_M)
    if not len(ways.item):
        return None
    best = int(ways.metres.argmin())
    name, metres = gazetteer.words[int(near[ways.item[best]])].names[0], float(ways.metres[best])
    if metres < 1.0:
        return f"at {name}"
    east, north = -ways.way_m[best]
    wind = WINDS[round(float(np.degrees(np.arctan2(east, north))) / 45) % 8]
    return f"{metres:.0f} m {wind} of {name}"


def _ways(gazetteer: Gazetteer, objects: Ints, position: Floats, reach_m: float) -> Ways:
    return ways_to(Around.of(position[None], np.zeros(1, np.int64)), *cut(gazetteer, objects), reach_m)


def _other(gazetteer: Gazetteer, corner: int, street: int) -> str:
    one, two = gazetteer.corner_streets[corner]
    return gazetteer.words[int(two if one == street else one)].names[0]
