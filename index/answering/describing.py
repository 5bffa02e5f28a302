"""Description of a position, in words from which the position can be found again.

On a map with names, a description has the street, visible named objects, then nearby objects by class and colour, and
if these are few, named objects farther away. On other maps it has nearby objects only. Each sentence is about another
object. Rare objects come first, so that few sentences identify the place.
"""

import re
from collections import Counter
from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass
from itertools import islice
from typing import Final

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from index.answering.address import address_at
from index.answering.answers import Described, Fact, LatLon
from index.answering.place_text import (
    CORNER_REACH_M,
    closest_points_from,
    compass_direction,
    nearest_street,
    place_text,
    street_text,
)
from index.answering.result import pair
from models.citymap.colours import Palette
from models.citymap.frame import Frame
from models.citymap.gallery import Gallery
from models.citymap.gazetteer.gazetteer import ADDRESS_KIND, Gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND
from models.citymap.hints import BEST_CELL_REACH_M, direction_index, round_robin
from models.citymap.points import Ints
from models.citymap.templates import OPPOSITE
from models.citymap.types import DIRECTIONS, Floats, Hint
from models.language.languages.translation import replies_in, reply_language
from models.posterior.neighbours.neighbour_index import NeighbourIndex

MAX_FACTS: Final = 6
MAX_NAMED_FACTS: Final = 3
VISIBLE_M: Final = 40.0  # farther named objects may be hidden by a house
FAR_VISIBLE_M: Final = 150.0  # reach where there is little else, as in a park
STREET_HALF_WIDTH_M: Final = 15.0  # farther from its line, the speaker is beside the street
CROSSING_REACH_M: Final = 150.0  # people see the next corner of their street
SAME_PLACE_M: Final = 1.0  # closer objects have no direction
DISTANCE_OFFSET_M: Final = 4.0  # added to distances: very close objects tell no more
RARITY_BONUS_M: Final = 5.0  # an object rarer by a factor of e counts as this much closer
# Kinds that are invisible from a street: upstairs, underground, or a point on a track.
INVISIBLE_KINDS: Final = (
    ADDRESS_KIND,
    "amenity/parking/underground",
    "entrance",
    "office",
    "public_transport/platform/subway",
    "public_transport/stop_position",
)
PLURAL_LABELS: Final = frozenset(("bushes", "steps", "trees"))
LABELS_WITHOUT_ARTICLE: Final = PLURAL_LABELS | {"grass", "terrain", "vegetation", "water"}


@dataclass(frozen=True, slots=True, eq=False)
class VisibleObject:
    """An object that is visible from a position."""

    instance: str  # its class
    name: str | None
    source_id: str | None
    offset_m: Floats  # [2] offset from the position to its closest point

    @property
    def metres(self) -> float:
        """Return its distance."""
        return float(np.hypot(*self.offset_m))

    def fact(self, text: str, position: Floats) -> Fact:
        """Return the fact that a sentence states about it, at a position [2]."""
        away_m = round(self.metres, 1)
        bearing = round(float(np.degrees(np.arctan2(*self.offset_m))), 1) % 360 if away_m else None
        closest_m = pair(np.round(position + self.offset_m, 2))
        return Fact(text, self.instance, self.name, self.source_id, closest_m, away_m, bearing)


class Describer:
    """Describes the positions of one map. It only reads, so threads may share it."""

    def __init__(
        self, gallery: Gallery, palette: Palette, frame: Frame, surroundings: NeighbourIndex, gazetteer: Gazetteer
    ) -> None:
        self._frame, self._gazetteer, self._ids = frame, gazetteer, gallery.cells.ids
        self._cells = cKDTree(gallery.cells.center_m[:, :2])
        self._named, self._near = NamedFacts(gazetteer), NearFacts(gallery, palette, surroundings)

    def describe(self, position: Floats, language: str | None = None) -> Described | None:
        """Describe a position [2], metres, map frame; None off the map and where nothing is near.

        `place` is in the given language, everything else in English.
        """
        metres, cell = self._cells.query(position)
        if metres > BEST_CELL_REACH_M:
            return None
        named = self._named.facts(position, VISIBLE_M)[:MAX_NAMED_FACTS]
        # where few objects have names, crossing streets tell how far along the street the position is
        facts = street_facts(self._gazetteer, position, MAX_NAMED_FACTS - len(named))
        facts += sorted(named, key=lambda fact: fact.away_m)
        facts += self._near.facts(position, int(cell), _mentioned(facts), MAX_FACTS - len(facts))
        if len(facts) < MAX_FACTS:
            facts += self._far_facts(position, _mentioned(facts))[: MAX_FACTS - len(facts)]
        if not facts:
            return None
        with replies_in(language or reply_language()):
            place = place_text(self._gazetteer, position)
        return Described(
            description=" ".join(fact.text for fact in facts),
            hints=tuple(facts),
            place=place,
            position=pair(position),
            wgs84=LatLon.from_position(position, self._frame),
            cell_id=self._ids[int(cell)],
            address=address_at(self._gazetteer, position),
        )

    def _far_facts(self, position: Floats, mentioned: Set[str]) -> list[Fact]:
        """Return facts about farther named objects, alternating between sides because crossing directions tell most."""
        far = [
            fact for fact in self._named.facts(position, FAR_VISIBLE_M) if not {fact.name, fact.source_id} & mentioned
        ]
        ways_m = np.array([fact.at for fact in far]).reshape(-1, 2) - position
        return [far[n] for n in round_robin(direction_index(ways_m)).tolist()]


def _mentioned(facts: Sequence[Fact]) -> set[str]:
    return {word for fact in facts for word in (fact.name, fact.source_id) if word is not None}


def street_facts(gazetteer: Gazetteer, position: Floats, most_crossing: int) -> list[Fact]:
    """Return facts about the street at a position [2], with its corners or with crossing streets; empty without one."""
    nearest = nearest_street(gazetteer, position)
    if nearest is None:
        return []
    street, offset_m = nearest
    words = gazetteer.objects[street]
    name, sight = words.names[0], VisibleObject(STREET_KIND, words.names[0], words.source_id, offset_m)
    crossing = list(islice(_crossing_streets(gazetteer, street, position), most_crossing))
    if sight.metres > STREET_HALF_WIDTH_M:
        text = named_text(name, offset_m)
    else:
        text = f"I am on {name}." if crossing else f"I am {street_text(gazetteer, street, position)}."
    return [sight.fact(text, position), *crossing]


def _crossing_streets(gazetteer: Gazetteer, street: int, position: Floats) -> Iterator[Fact]:
    """Yield facts about the streets that cross a street, nearest first; none if the position [2] is at a corner."""
    pairs = gazetteer.corner_streets
    meeting = pairs[(pairs == street).any(axis=1)]
    others = np.unique(meeting[meeting != street])
    ways = closest_points_from(gazetteer, others, position, CROSSING_REACH_M)
    if len(ways.target) and ways.distance_m.min() <= CORNER_REACH_M:
        return
    for row in np.argsort(ways.distance_m, kind="stable").tolist():
        words, offset_m = gazetteer.objects[int(others[ways.target[row]])], ways.offset_m[row]
        name = words.names[0]
        yield VisibleObject(STREET_KIND, name, words.source_id, offset_m).fact(named_text(name, offset_m), position)


class NamedFacts:
    """Facts about named objects, other than streets, that are visible from a street."""

    def __init__(self, gazetteer: Gazetteer) -> None:
        self._gazetteer, words = gazetteer, gazetteer.objects
        streets = [name.casefold() for row in gazetteer.by_kind.get(STREET_KIND, ()) for name in words[row].names]
        # a bus stop "Broadway & West 25th Street" would be parsed as the corner
        street_pattern = re.compile(rf"\b(?:{'|'.join(map(re.escape, streets))})\b") if streets else None
        visible = [
            row
            for row in gazetteer.named.tolist()
            if not words[row].kinds[0].startswith(INVISIBLE_KINDS)
            and not (street_pattern and street_pattern.search(words[row].names[0].casefold()))
        ]
        names = [words[row].names[0].casefold() for row in visible]
        count = Counter(names)
        self._objects = np.array(visible, dtype=np.int64)
        self._namesakes = np.array([count[name] for name in names], dtype=np.int64)

    def facts(self, position: Floats, reach_m: float) -> list[Fact]:
        """Return a fact for each name within reach of a position [2], the most telling first."""
        gazetteer, objects = self._gazetteer, self._objects
        apart = np.hypot(*(gazetteer.middles_m[objects] - position).T) - gazetteer.reach_m[objects]
        near = np.flatnonzero(apart <= reach_m)
        ways = closest_points_from(gazetteer, objects[near], position, reach_m)
        rows = near[ways.target]
        # being inside a large park tells little
        size_m = np.where(ways.distance_m < SAME_PLACE_M, gazetteer.reach_m[objects[rows]], 0.0)
        cost = (ways.distance_m + DISTANCE_OFFSET_M + size_m) * np.sqrt(self._namesakes[rows])
        fact_by_name: dict[str, Fact] = {}
        for n in np.argsort(cost, kind="stable").tolist():
            words, offset_m = gazetteer.objects[int(objects[rows[n]])], ways.offset_m[n]
            name = words.names[0]
            if name.casefold() not in fact_by_name:
                sight = VisibleObject(words.kinds[0], name, words.source_id, offset_m)
                fact_by_name[name.casefold()] = sight.fact(named_text(name, offset_m), position)
        return list(fact_by_name.values())


class NearFacts:
    """Facts about the objects around the nodes of a map, by class and colour."""

    def __init__(self, gallery: Gallery, palette: Palette, surroundings: NeighbourIndex) -> None:
        self._gallery, self._words, self._surroundings = gallery, palette.words, surroundings
        objects = surroundings.objects
        self._colour = palette.word_index(objects.rgb)
        label = objects.labels(gallery)[1]
        self._kind = label * (len(palette.words) + 1) + self._colour + 1  # a class in a colour
        count = np.bincount(self._kind, objects.parts, int(self._kind.max(initial=0)) + 1)
        self._log_share = np.log(np.maximum(count, 1) / max(1, objects.parts.sum()))

    def facts(self, position: Floats, cell: int, mentioned: Set[str], most: int) -> list[Fact]:
        """Return at most `most` facts about objects near a position [2] that earlier facts have not mentioned."""
        facts: list[Fact] = []
        for hint, is_ground, sight in self._visible_objects(position, cell, mentioned):
            if len(facts) == most:
                break
            facts.append(sight.fact(hint_text(hint, sight.metres, is_ground=is_ground, turn=len(facts)), position))
        return facts

    def _visible_objects(
        self, position: Floats, cell: int, mentioned: Set[str]
    ) -> Iterator[tuple[Hint, bool, VisibleObject]]:
        """Yield objects to mention, alternating between sides, each object and each hint once."""
        part, offset_m, whole = self._around(position, cell)
        direction, gallery, objects = direction_index(offset_m), self._gallery, self._surroundings.objects
        cost = np.hypot(*offset_m.T) + RARITY_BONUS_M * self._log_share[self._kind[part]]
        order = np.lexsort((cost, ~whole))
        used = set[tuple[int, int] | int]()
        for n in order[round_robin(direction[order])].tolist():
            row, side = int(part[n]), int(direction[n])
            instance = int(objects.instance[row])
            name, source_id = gallery.names[instance], gallery.sources[instance]
            if {name, source_id} & mentioned or {instance, (int(self._kind[row]), side)} & used:
                continue
            used |= {instance, (int(self._kind[row]), side)}
            colour = self._words[self._colour[row]] if self._colour[row] >= 0 else None
            hint = Hint(DIRECTIONS[side], gallery.labels[instance], colour, instance)
            yield hint, bool(objects.is_flat[row]), VisibleObject(hint.label, name, source_id, -offset_m[n])

    def _around(self, position: Floats, cell: int) -> tuple[Ints, Floats, npt.NDArray[np.bool_]]:
        """Return parts [K] around a position [2], offsets [K, 2] from their closest points, and which are whole."""
        s = self._surroundings
        first, last = int(s.cell_starts[cell]), int(s.cell_starts[cell + 1])
        if first == last:
            return np.zeros(0, np.int64), np.zeros((0, 2)), np.zeros(0, np.bool_)
        nodes_m = s.positions_m(np.arange(first, last))
        nearest = int(((nodes_m - position) ** 2).sum(axis=1).argmin())
        around = s.around(np.array([first + nearest]))
        return around.part, around.offset_m + (position - nodes_m[nearest]), around.whole


def named_text(name: str, offset_m: Floats) -> str:
    """Return the sentence about a named object at an offset [2] from the speaker."""
    metres = float(np.hypot(*offset_m))
    return (
        f"I am at {name}."
        if metres < SAME_PLACE_M
        else f"{name} is {metres:.0f} m to my {compass_direction(offset_m)}."
    )


def hint_text(hint: Hint, metres: float, *, is_ground: bool, turn: int) -> str:
    """Return the sentence of a hint: one of two templates in turn, with natural articles and the distance."""
    noun = f"{hint.colour} {hint.label}" if hint.colour else hint.label
    article = "" if hint.label in LABELS_WITHOUT_ARTICLE else "an " if noun[0] in "aeiou" else "a "
    verb, wind = "are" if hint.label in PLURAL_LABELS else "is", OPPOSITE[hint.direction]
    first = f"{article}{noun}"
    first = first[0].upper() + first[1:]
    if hint.direction == "on-top":
        return f"I stand on the {noun}." if is_ground else f"{first} {verb} right beside me."
    if turn % 2:
        return f"There {verb} {article}{noun} {metres:.0f} m {wind} of me."
    return f"{first} {verb} {metres:.0f} m to my {wind}."
