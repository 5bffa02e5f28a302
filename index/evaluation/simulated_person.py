"""Made-up people who answer questions, by what a map has where they stand."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from index.answering.answers import Question
from index.answering.query import Reply
from index.asking.question_spec import OTHER, UNKNOWN, Asked
from models.citymap.colours import Palette
from models.citymap.gallery import Gallery, NearestFinder, PointClouds
from models.citymap.gazetteer.closest_points import ClosestPoints, PointGroups, find_closest_points, select_objects
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND
from models.citymap.map_geometry import PieceGeometry
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.language.lexicon.question_classes import load_question_classes
from models.posterior.nearby_objects import QUARTERS

WRONG, DO_NOT_KNOW = 0.1, 0.2  # of the answers; of those that are known, so many are wrong
TEN_M, REACH_M, SIGN_M = 10.0, 15.0, 30.0  # what people take for near, for the nearest one, and read a sign at
IDEAS: Final = 0.25  # how far people's ideas of these differ: log-normal
TURN: Final = 10.0  # degrees that they are off by: normal
STREET_M: Final = 40.0
ALIKE_M: Final = 3.0  # as near as the nearest
SIGHT_M: Final = 5.0  # a sign this near is said half as often as one at the door
NEARBY_M: Final = 150.0  # from where wrong names are taken


class Truth:
    """What a map has at a position, by its geometry: of all its instances, and of its names.

    Args:
        bodies: what stands in the map.
        gallery: its cells, for the classes and colours of these.
        palette: its colour words.
        gazetteer: its names.
    """

    def __init__(
        self, bodies: PointClouds | PieceGeometry, gallery: Gallery, palette: Palette, gazetteer: Gazetteer
    ) -> None:
        self._bodies, self._palette, self._gazetteer = bodies, palette, gazetteer
        self._streets = gazetteer.by_kind.get(STREET_KIND, np.zeros(0, np.int64))
        kinds = load_question_classes().kinds
        known = [n for n in gazetteer.named if gazetteer.objects[n].kinds[0].startswith(kinds)]
        self._places = np.array(known, np.int64)
        self._houses = np.array([n for n, w in enumerate(gazetteer.objects) if w.street and w.numbers], np.int64)
        parts = gallery.cells.parts
        instance, first = np.unique(bodies.instances_of_parts(gallery.cells), return_index=True)
        self._rgb = dict(zip(instance.tolist(), parts.rgb[first], strict=True))
        label = {int(i): gallery.labels[parts.instance[row]] for i, row in zip(instance, first, strict=True)}
        owners: dict[tuple[int, str], list[int]] = {}
        for number, name in label.items():
            owners.setdefault((int(bodies.scene[number]), name), []).append(number)
        self._owners, self._finders = owners, dict[tuple[int, str], NearestFinder]()

    def nearest(self, scene: int, position: Floats, label: str) -> tuple[float, float, int] | None:
        """Metres, degrees clockwise from north, and instance of the nearest of a class; None if the scene has none."""
        key = scene, label
        if key not in self._owners:
            return None
        if key not in self._finders:
            self._finders[key] = self._bodies.nearest_finder(self._owners[key])
        (east, north), instance = self._finders[key](position)
        return float(np.hypot(east, north)), float(np.degrees(np.arctan2(east, north))), instance

    def colour(self, instance: int) -> str | None:
        """The word for an instance's colour; None if the map does not know it."""
        return self._palette.word(self._rgb[instance])

    @property
    def street_names(self) -> Sequence[str]:
        """Of all streets."""
        return [self._name(n) for n in self._streets.tolist()]

    @property
    def place_names(self) -> Sequence[str]:
        """Of all places that people know by their names."""
        return [self._name(n) for n in self._places.tolist()]

    @property
    def house_names(self) -> Sequence[str]:
        """Numbers and streets of all houses."""
        return [self._address(n) for n in self._houses.tolist()]

    def houses(self, position: Floats, reach_m: float) -> list[tuple[float, str]]:
        """Metres to the houses near a position that have a number, and number and street, nearest first."""
        return self._near(position, self._houses, reach_m, self._address)

    def streets(self, position: Floats, reach_m: float) -> list[tuple[float, str]]:
        """Metres and names of the streets near a position, nearest first."""
        return self._near(position, self._streets, reach_m)

    def places(self, position: Floats, reach_m: float) -> list[tuple[float, str]]:
        """Metres and names of the places near a position that people know by their names, nearest first."""
        return self._near(position, self._places, reach_m)

    def crossing(self, position: Floats, street: str) -> list[tuple[float, str]]:
        """Metres from where a position is on a street to the streets that cross it, and their names, nearest first."""
        one = np.array([n for n in self._streets if self._gazetteer.objects[n].names[0] == street], np.int64)
        foot = position + self._ways(position, one, STREET_M).offset_m[0]
        found = []
        for pair, at in zip(self._gazetteer.corner_streets, self._gazetteer.corners_m, strict=True):
            if one[0] in pair:
                other = int(pair[0] if pair[1] == one[0] else pair[1])
                found.append((float(np.hypot(*(at - foot))), self._gazetteer.objects[other].names[0]))
        return sorted(found)

    def _near(
        self, position: Floats, objects: Ints, reach_m: float, called: Callable[[int], str] | None = None
    ) -> list[tuple[float, str]]:
        ways = self._ways(position, objects, reach_m)
        items = objects[ways.target].tolist()
        return sorted(zip(ways.distance_m.tolist(), map(called or self._name, items), strict=True))

    def _name(self, number: int) -> str:
        return self._gazetteer.objects[number].names[0]

    def _address(self, number: int) -> str:
        words = self._gazetteer.objects[number]
        return f"{words.numbers[0]} {words.street}"

    def _ways(self, position: Floats, objects: Ints, reach_m: float) -> ClosestPoints:
        return find_closest_points(
            PointGroups.from_groups(position[None], np.zeros(1, np.int64)),
            *select_objects(self._gazetteer, objects),
            reach_m,
        )


@dataclass(frozen=True, slots=True, eq=False)
class Person:
    """Somebody at a position.

    Attributes:
        truth: of the map.
        scene: number of the scene.
        position_m: [2].
        rng: draws errors.
    """

    truth: Truth
    scene: int
    position_m: Floats
    rng: np.random.Generator

    def reply(self, question: Question) -> Reply:
        """What they answer."""
        asked = Asked.parse(question.id)
        assert asked is not None
        right = self._right(asked)
        if self.rng.random() < DO_NOT_KNOW or right is None:
            return Reply(question.id, UNKNOWN)
        if self.rng.random() < WRONG:
            right = self._wrong(asked, right)
        return Reply(question.id, right if asked.is_open or right in asked.values else OTHER)

    def _right(self, asked: Asked) -> str | None:
        """What is true, as they see it; None if the map does not say."""
        if asked.is_open:
            open_ones = {"street": self._street, "name": self._place, "corner": self._corner, "address": self._house}
            return open_ones[asked.kind]()
        found = self.truth.nearest(self.scene, self.position_m, asked.names[0])
        if asked.kind == "near":
            return "no" if found is None or found[0] > TEN_M * self._idea() else "yes"
        if asked.kind == "colour":
            return None if found is None else self.truth.colour(found[2])
        if found is None or found[0] > REACH_M * self._idea():
            return "none"
        return QUARTERS[round((found[1] + self.rng.normal(0, TURN)) / 90) % 4]

    def _wrong(self, asked: Asked, right: str) -> str:
        """Another answer; half of the wrong names are of somewhere near, the others of anywhere."""
        values: Sequence[str] = asked.values
        if asked.is_open:
            near, values = self.truth.streets, self.truth.street_names
            if asked.kind == "name":
                near, values = self.truth.places, self.truth.place_names
            elif asked.kind == "address":
                near, values = self.truth.houses, self.truth.house_names
            some = [name for _, name in near(self.position_m, NEARBY_M) if name != right]
            values = some if some and self.rng.random() < 0.5 else values
        others = [value for value in values if value != right]
        return str(self.rng.choice(others)) if others else right

    def _street(self) -> str | None:
        return self._one_of_alike(self.truth.streets(self.position_m, STREET_M))

    def _place(self) -> str | None:
        """A name that they read, of what is near rather than of what is farther."""
        seen = self.truth.places(self.position_m, SIGN_M * self._idea())
        if not seen:
            return None
        weight = np.array([1 / (metres + SIGHT_M) for metres, _ in seen])
        return seen[int(self.rng.choice(len(seen), p=weight / weight.sum()))][1]

    def _house(self) -> str | None:
        """The one that seems nearest, as far as numbers are read."""
        seen = [
            (metres * self._idea(), name) for metres, name in self.truth.houses(self.position_m, SIGN_M * self._idea())
        ]
        return min(seen)[1] if seen else None

    def _corner(self) -> str | None:
        street = self._street()
        return None if street is None else self._one_of_alike(self.truth.crossing(self.position_m, street))

    def _one_of_alike(self, near: Sequence[tuple[float, str]]) -> str | None:
        """The nearest; of several that are as near, as at a corner, any is right."""
        alike = [name for metres, name in near if metres <= near[0][0] + ALIKE_M]
        return alike[int(self.rng.integers(len(alike)))] if alike else None

    def _idea(self) -> float:
        return float(np.exp(self.rng.normal(0, IDEAS)))
