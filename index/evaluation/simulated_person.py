"""Simulated people who answer questions from the map around them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from index.answering.answers import Question
from index.answering.query import Reply
from index.asking.question_spec import OTHER, UNKNOWN, QuestionSpec
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

# Assumed errors of people; docs/results.md has the figures that they lead to.
UNKNOWN_SHARE, WRONG_SHARE = 0.2, 0.1  # of all replies "I don't know"; of the others wrong
NEAR_M, NEAREST_REACH_M, SIGN_REACH_M = 10.0, 15.0, 30.0  # perceived as near, as the nearest one, as a readable sign
DISTANCE_LOG_SIGMA: Final = 0.25  # log-normal error of these distances
BEARING_SIGMA_DEG: Final = 10.0  # normal error of directions
STREET_REACH_M: Final = 40.0
TIE_M: Final = 3.0  # objects within this of the nearest count as equally near
SIGN_HALF_WEIGHT_M: Final = 5.0  # a sign this far is mentioned half as often as one at the door
WRONG_NAME_REACH_M: Final = 150.0  # nearby wrong names come from within


class MapTruth:
    """The true answers of a map at a position, from its geometry and names."""

    def __init__(
        self, bodies: PointClouds | PieceGeometry, gallery: Gallery, palette: Palette, gazetteer: Gazetteer
    ) -> None:
        self._bodies, self._palette, self._gazetteer = bodies, palette, gazetteer
        kinds, objects = load_question_classes().kinds, gazetteer.objects
        self._objects = {  # that people know by name, by kind of question
            "street": gazetteer.by_kind.get(STREET_KIND, np.zeros(0, np.int64)),
            "name": np.array([n for n in gazetteer.named if objects[n].kinds[0].startswith(kinds)], np.int64),
            "address": np.array([n for n, w in enumerate(objects) if w.street and w.numbers], np.int64),
        }
        parts = gallery.cells.parts
        instance, first = np.unique(bodies.instances_of_parts(gallery.cells), return_index=True)
        self._rgb = dict(zip(instance.tolist(), parts.rgb[first], strict=True))
        label = {int(i): gallery.labels[parts.instance[row]] for i, row in zip(instance, first, strict=True)}
        owners: dict[tuple[int, str], list[int]] = {}
        for number, name in label.items():
            owners.setdefault((int(bodies.scene[number]), name), []).append(number)
        self._owners, self._finders = owners, dict[tuple[int, str], NearestFinder]()

    def nearest(self, scene: int, position: Floats, label: str) -> tuple[float, float, int] | None:
        """Return distance, bearing in degrees and instance of the nearest object of a class; None without one."""
        key = scene, label
        if key not in self._owners:
            return None
        if key not in self._finders:
            self._finders[key] = self._bodies.nearest_finder(self._owners[key])
        (east, north), instance = self._finders[key](position)
        return float(np.hypot(east, north)), float(np.degrees(np.arctan2(east, north))), instance

    def colour(self, instance: int) -> str | None:
        """Return the word for an instance's colour; None if unknown."""
        return self._palette.word(self._rgb[instance])

    def names(self, kind: str) -> list[str]:
        """Return all names of a kind: "street", "name" (of a well-known place) or "address"."""
        return [self._name(kind, n) for n in self._objects[kind].tolist()]

    def names_near(self, kind: str, position: Floats, reach_m: float) -> list[tuple[float, str]]:
        """Return distances and names of a kind near a position, nearest first."""
        ways = self._ways(position, self._objects[kind], reach_m)
        names = [self._name(kind, n) for n in self._objects[kind][ways.target].tolist()]
        return sorted(zip(ways.distance_m.tolist(), names, strict=True))

    def crossing(self, position: Floats, street: str) -> list[tuple[float, str]]:
        """Return distances along a street to its cross streets, and their names, nearest first."""
        one = np.array([n for n in self._objects["street"] if self._gazetteer.objects[n].names[0] == street], np.int64)
        foot = position + self._ways(position, one, STREET_REACH_M).offset_m[0]
        crossings = []
        for pair, corner_m in zip(self._gazetteer.corner_streets, self._gazetteer.corners_m, strict=True):
            if one[0] in pair:
                other = int(pair[0] if pair[1] == one[0] else pair[1])
                crossings.append((float(np.hypot(*(corner_m - foot))), self._gazetteer.objects[other].names[0]))
        return sorted(crossings)

    def _name(self, kind: str, number: int) -> str:
        words = self._gazetteer.objects[number]
        return f"{words.numbers[0]} {words.street}" if kind == "address" else words.names[0]

    def _ways(self, position: Floats, objects: Ints, reach_m: float) -> ClosestPoints:
        return find_closest_points(
            PointGroups.from_groups(position[None], np.zeros(1, np.int64)),
            *select_objects(self._gazetteer, objects),
            reach_m,
        )


@dataclass(frozen=True, slots=True, eq=False)
class SimulatedPerson:
    """A simulated person at a position [2] in a numbered scene."""

    truth: MapTruth
    scene: int
    position_m: Floats
    rng: np.random.Generator

    def reply(self, question: Question) -> Reply:
        """Reply to a question."""
        spec = QuestionSpec.parse(question.id)
        assert spec is not None
        right = self._right(spec)
        if self.rng.random() < UNKNOWN_SHARE or right is None:
            return Reply(question.id, UNKNOWN)
        if self.rng.random() < WRONG_SHARE:
            right = self._wrong(spec, right)
        return Reply(question.id, right if spec.is_open or right in spec.values else OTHER)

    def _right(self, spec: QuestionSpec) -> str | None:
        """Return the true reply as the person perceives it; None if the map does not tell."""
        if spec.is_open:
            open_ones = {"street": self._street, "name": self._place, "corner": self._corner, "address": self._house}
            return open_ones[spec.kind]()
        nearest = self.truth.nearest(self.scene, self.position_m, spec.names[0])
        if spec.kind == "near":
            return "no" if nearest is None or nearest[0] > NEAR_M * self._idea() else "yes"
        if spec.kind == "colour":
            return None if nearest is None else self.truth.colour(nearest[2])
        if nearest is None or nearest[0] > NEAREST_REACH_M * self._idea():
            return "none"
        return QUARTERS[round((nearest[1] + self.rng.normal(0, BEARING_SIGMA_DEG)) / 90) % 4]

    def _wrong(self, spec: QuestionSpec, right: str) -> str:
        """Return a wrong reply; half of the wrong names are from nearby, the others from anywhere."""
        values: Sequence[str] = spec.values
        if spec.is_open:
            kind = "street" if spec.kind == "corner" else spec.kind
            near = self.truth.names_near(kind, self.position_m, WRONG_NAME_REACH_M)
            nearby = [name for _, name in near if name != right]
            values = nearby if nearby and self.rng.random() < 0.5 else self.truth.names(kind)
        others = [value for value in values if value != right]
        return str(self.rng.choice(others)) if others else right

    def _street(self) -> str | None:
        return self._nearest(self.truth.names_near("street", self.position_m, STREET_REACH_M))

    def _place(self) -> str | None:
        """Return a name that the person can read, preferring near signs."""
        visible = self.truth.names_near("name", self.position_m, SIGN_REACH_M * self._idea())
        if not visible:
            return None
        weight = np.array([1 / (metres + SIGN_HALF_WEIGHT_M) for metres, _ in visible])
        return visible[int(self.rng.choice(len(visible), p=weight / weight.sum()))][1]

    def _house(self) -> str | None:
        visible = [
            (metres * self._idea(), name)
            for metres, name in self.truth.names_near("address", self.position_m, SIGN_REACH_M * self._idea())
        ]
        return min(visible)[1] if visible else None

    def _corner(self) -> str | None:
        street = self._street()
        return None if street is None else self._nearest(self.truth.crossing(self.position_m, street))

    def _nearest(self, near: Sequence[tuple[float, str]]) -> str | None:
        """Return the nearest name; of several at the same distance, as at a corner, a random one."""
        ties = [name for metres, name in near if metres <= near[0][0] + TIE_M]
        return ties[int(self.rng.integers(len(ties)))] if ties else None

    def _idea(self) -> float:
        return float(np.exp(self.rng.normal(0, DISTANCE_LOG_SIGMA)))
