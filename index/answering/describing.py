"""What a map says at a position, in words by which the position is found again.

On a map with names a description is the street, what has a name and can be seen from there, then what is near, by class
and colour, and where these are few, what has a name farther away; on any other map what is near alone. Each sentence
tells of another thing; what is rare comes first, so that few sentences single a place out.
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

from index.answering.answers import Described, Fact, LatLon
from index.answering.place_text import AT_CORNER_M, nearest_street, place_text, street_text, ways_from, wind_of
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
from models.posterior.neighbours.neighbour_index import NeighbourIndex

MOST_FACTS: Final = 6
MOST_NAMED: Final = 3
SEEN_M: Final = 40.0  # what has a name and is farther away may be behind a house
OPEN_M: Final = 150.0  # as far where little else can be told, as in a park or between railway tracks
ON_STREET_M: Final = 15.0  # from the middle of a street; who is farther away is beside it
CROSSING_M: Final = 150.0  # down a street one sees the next corner
AT_M: Final = 1.0  # nearer than this there is no wind to tell
NEAR_M: Final = 4.0  # added to distances: what is nearer is no more telling
RARE_M: Final = 5.0  # as much nearer counts what is rarer by a factor of e
# Kinds that nobody sees from a street: upstairs, underground, or a mere point of a track.
UNSEEN: Final = (
    ADDRESS_KIND,
    "amenity/parking/underground",
    "entrance",
    "office",
    "public_transport/platform/subway",
    "public_transport/stop_position",
)
PLURALS: Final = frozenset(("bushes", "steps", "trees"))
WITHOUT_ARTICLE: Final = PLURALS | {"grass", "terrain", "vegetation", "water"}


@dataclass(frozen=True, slots=True, eq=False)
class Sight:
    """Something that can be seen from a position.

    Attributes:
        instance: its class.
        name, source_id: None where it has none.
        way_m: [2] from the position to the point of it that is nearest.
    """

    instance: str
    name: str | None
    source_id: str | None
    way_m: Floats

    @property
    def metres(self) -> float:
        """How far away it is."""
        return float(np.hypot(*self.way_m))

    def fact(self, text: str, position: Floats) -> Fact:
        """What a sentence tells of it, at a position [2]."""
        away_m = round(self.metres, 1)
        bearing = round(float(np.degrees(np.arctan2(*self.way_m))), 1) % 360 if away_m else None
        at = pair(np.round(position + self.way_m, 2))
        return Fact(text, self.instance, self.name, self.source_id, at, away_m, bearing)


class Describer:
    """Says what is at the positions of one map. Only reads, so that several threads may share it.

    Args:
        gallery: the cells, with labels and names.
        palette: the map's colour words.
        frame: of the map.
        surroundings: of the gallery.
        gazetteer: of the map; empty where nothing has a name.
    """

    def __init__(
        self, gallery: Gallery, palette: Palette, frame: Frame, surroundings: NeighbourIndex, gazetteer: Gazetteer
    ) -> None:
        self._frame, self._gazetteer, self._ids = frame, gazetteer, gallery.cells.ids
        self._cells = cKDTree(gallery.cells.center_m[:, :2])
        self._named, self._near = NamedSights(gazetteer), NearSights(gallery, palette, surroundings)

    def describe(self, position: Floats) -> Described | None:
        """What is at a position [2], metres, map frame; None off the map, and where nothing is near."""
        metres, cell = self._cells.query(position)
        if metres > BEST_CELL_REACH_M:
            return None
        named = self._named.facts(position, SEEN_M)[:MOST_NAMED]
        # where little has a name, crossing streets tell how far along its street the position is
        facts = street_facts(self._gazetteer, position, MOST_NAMED - len(named))
        facts += sorted(named, key=lambda fact: fact.away_m)
        facts += self._near.facts(position, int(cell), _told(facts), MOST_FACTS - len(facts))
        if len(facts) < MOST_FACTS:
            facts += self._far_facts(position, _told(facts))[: MOST_FACTS - len(facts)]
        if not facts:
            return None
        return Described(
            description=" ".join(fact.text for fact in facts),
            hints=tuple(facts),
            place=place_text(self._gazetteer, position),
            position=pair(position),
            wgs84=LatLon.of(position, self._frame),
            cell_id=self._ids[int(cell)],
        )

    def _far_facts(self, position: Floats, told: Set[str]) -> list[Fact]:
        """What else has a name around a position [2], from one side after the other: two ways that cross tell most."""
        far = [fact for fact in self._named.facts(position, OPEN_M) if not {fact.name, fact.source_id} & told]
        ways_m = np.array([fact.at for fact in far]).reshape(-1, 2) - position
        return [far[n] for n in round_robin(direction_index(ways_m)).tolist()]


def _told(facts: Sequence[Fact]) -> set[str]:
    """Names and sources of what sentences tell of."""
    return {word for fact in facts for word in (fact.name, fact.source_id) if word is not None}


def street_facts(gazetteer: Gazetteer, position: Floats, most_crossing: int) -> list[Fact]:
    """The street at a position [2], with its corners or with so many crossing streets; none where there is none."""
    found = nearest_street(gazetteer, position)
    if found is None:
        return []
    street, way_m = found
    words = gazetteer.objects[street]
    name, sight = words.names[0], Sight(STREET_KIND, words.names[0], words.source_id, way_m)
    crossing = list(islice(_crossing(gazetteer, street, position), most_crossing))
    if sight.metres > ON_STREET_M:
        text = named_text(name, way_m)
    else:
        text = f"I am on {name}." if crossing else f"I am {street_text(gazetteer, street, position)}."
    return [sight.fact(text, position), *crossing]


def _crossing(gazetteer: Gazetteer, street: int, position: Floats) -> Iterator[Fact]:
    """The streets that meet a street, nearest first, seen from a position [2] that is at no corner."""
    pairs = gazetteer.corner_streets
    meeting = pairs[(pairs == street).any(axis=1)]
    others = np.unique(meeting[meeting != street])
    ways = ways_from(gazetteer, others, position, CROSSING_M)
    if len(ways.target) and ways.distance_m.min() <= AT_CORNER_M:
        return
    for row in np.argsort(ways.distance_m, kind="stable").tolist():
        words, way_m = gazetteer.objects[int(others[ways.target[row]])], ways.offset_m[row]
        name = words.names[0]
        yield Sight(STREET_KIND, name, words.source_id, way_m).fact(named_text(name, way_m), position)


class NamedSights:
    """What has a name on a map, is no street, and can be seen from one.

    Args:
        gazetteer: of the map.
    """

    def __init__(self, gazetteer: Gazetteer) -> None:
        self._gazetteer, words = gazetteer, gazetteer.objects
        streets = [name.casefold() for row in gazetteer.by_kind.get(STREET_KIND, ()) for name in words[row].names]
        # "Broadway & West 25th Street", a bus stop, would be read as the corner
        of_streets = re.compile(rf"\b(?:{'|'.join(map(re.escape, streets))})\b") if streets else None
        seen = [
            row
            for row in gazetteer.named.tolist()
            if not words[row].kinds[0].startswith(UNSEEN)
            and not (of_streets and of_streets.search(words[row].names[0].casefold()))
        ]
        names = [words[row].names[0].casefold() for row in seen]
        count = Counter(names)
        self._objects = np.array(seen, dtype=np.int64)
        self._namesakes = np.array([count[name] for name in names], dtype=np.int64)

    def facts(self, position: Floats, reach_m: float) -> list[Fact]:
        """A sentence for each name within reach of a position [2], the most telling first."""
        gazetteer, objects = self._gazetteer, self._objects
        apart = np.hypot(*(gazetteer.middles_m[objects] - position).T) - gazetteer.reach_m[objects]
        near = np.flatnonzero(apart <= reach_m)
        ways = ways_from(gazetteer, objects[near], position, reach_m)
        rows = near[ways.target]
        # who is somewhere in a large park knows little more
        size_m = np.where(ways.distance_m < AT_M, gazetteer.reach_m[objects[rows]], 0.0)
        cost = (ways.distance_m + NEAR_M + size_m) * np.sqrt(self._namesakes[rows])
        found: dict[str, Fact] = {}
        for n in np.argsort(cost, kind="stable").tolist():
            words, way_m = gazetteer.objects[int(objects[rows[n]])], ways.offset_m[n]
            name = words.names[0]
            if name.casefold() not in found:
                sight = Sight(words.kinds[0], name, words.source_id, way_m)
                found[name.casefold()] = sight.fact(named_text(name, way_m), position)
        return list(found.values())


class NearSights:
    """What is around the nodes of a map, by class and colour.

    Args:
        gallery: the cells.
        palette: the map's colour words.
        surroundings: of the gallery.
    """

    def __init__(self, gallery: Gallery, palette: Palette, surroundings: NeighbourIndex) -> None:
        self._gallery, self._words, self._surroundings = gallery, palette.words, surroundings
        things = surroundings.things
        self._colour = palette.word_index(things.rgb)
        label = things.labels(gallery)[1]
        self._kind = label * (len(palette.words) + 1) + self._colour + 1  # a class in a colour
        count = np.bincount(self._kind, things.parts, int(self._kind.max(initial=0)) + 1)
        self._log_share = np.log(np.maximum(count, 1) / max(1, things.parts.sum()))

    def facts(self, position: Floats, cell: int, told: Set[str], most: int) -> list[Fact]:
        """Sentences about what is near a position [2].

        Args:
            position: where, metres, map frame.
            cell: whose centre is nearest.
            told: names and sources of what has been told of.
            most: sentences.
        """
        found: list[Fact] = []
        for hint, is_ground, sight in self._sights(position, cell, told):
            if len(found) == most:
                break
            found.append(sight.fact(hint_text(hint, sight.metres, is_ground=is_ground, turn=len(found)), position))
        return found

    def _sights(self, position: Floats, cell: int, told: Set[str]) -> Iterator[tuple[Hint, bool, Sight]]:
        """What can be told of, from one side after the other, each thing and each hint once."""
        part, offset_m, whole = self._around(position, cell)
        direction, gallery, things = direction_index(offset_m), self._gallery, self._surroundings.things
        cost = np.hypot(*offset_m.T) + RARE_M * self._log_share[self._kind[part]]
        order = np.lexsort((cost, ~whole))
        said = set[tuple[int, int] | int]()
        for n in order[round_robin(direction[order])].tolist():
            row, side = int(part[n]), int(direction[n])
            instance = int(things.instance[row])
            name, source_id = gallery.names[instance], gallery.sources[instance]
            if {name, source_id} & told or {instance, (int(self._kind[row]), side)} & said:
                continue
            said |= {instance, (int(self._kind[row]), side)}
            colour = self._words[self._colour[row]] if self._colour[row] >= 0 else None
            hint = Hint(DIRECTIONS[side], gallery.labels[instance], colour, instance)
            yield hint, bool(things.is_flat[row]), Sight(hint.label, name, source_id, -offset_m[n])

    def _around(self, position: Floats, cell: int) -> tuple[Ints, Floats, npt.NDArray[np.bool_]]:
        """Parts [K] around a position [2], the position minus the closest point of each [K, 2], and which are whole."""
        s = self._surroundings
        first, last = int(s.cell_starts[cell]), int(s.cell_starts[cell + 1])
        if first == last:
            return np.zeros(0, np.int64), np.zeros((0, 2)), np.zeros(0, np.bool_)
        nodes_m = s.positions_m(np.arange(first, last))
        nearest = int(((nodes_m - position) ** 2).sum(axis=1).argmin())
        around = s.around(np.array([first + nearest]))
        return around.part, around.way_m + (position - nodes_m[nearest]), around.whole


def named_text(name: str, way_m: Floats) -> str:
    """Where something with a name is: a way [2] from the speaker."""
    metres = float(np.hypot(*way_m))
    return f"I am at {name}." if metres < AT_M else f"{name} is {metres:.0f} m to my {wind_of(way_m)}."


def hint_text(hint: Hint, metres: float, *, is_ground: bool, turn: int) -> str:
    """A hint in the words of one of two templates in turn, with the articles that people use, and how far it is."""
    noun = f"{hint.colour} {hint.label}" if hint.colour else hint.label
    article = "" if hint.label in WITHOUT_ARTICLE else "an " if noun[0] in "aeiou" else "a "
    verb, wind = "are" if hint.label in PLURALS else "is", OPPOSITE[hint.direction]
    first = f"{article}{noun}"
    first = first[0].upper() + first[1:]
    if hint.direction == "on-top":
        return f"I stand on the {noun}." if is_ground else f"{first} {verb} right beside me."
    if turn % 2:
        return f"There {verb} {article}{noun} {metres:.0f} m {wind} of me."
    return f"{first} {verb} {metres:.0f} m to my {wind}."
