"""Measuring questions: people who say little and answer what they are asked, made up from what the map has there."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Final

import numpy as np
from scipy.spatial import cKDTree

from index.answers import Answer, Query, Question, Reply
from index.asked import OTHER, UNKNOWN, Asked
from index.evaluation.report import Table
from index.localizer import Localizer
from models.city.colours import Palette
from models.city.gallery import Bodies, Gallery
from models.city.gazetteer.gazetteer import STREET, Gazetteer
from models.city.gazetteer.ways import Around, cut, ways_to
from models.city.queries import Queries
from models.city.source import Source
from models.city.templates import render_hint
from models.city.types import Floats, Progress
from models.errors import DataError
from models.posterior.sights import QUARTERS

QUESTIONS: Final = 3  # the most that are asked
HINTS: Final = 2
WITHIN_M: Final = 10.0
WRONG, DO_NOT_KNOW = 0.1, 0.2  # of the answers; of those that are known, so many are wrong
TEN_M, REACH_M, SIGN_M = 10.0, 15.0, 30.0  # what people take for near, for the nearest one, and read a sign at
IDEAS: Final = 0.25  # how far people's ideas of these differ: log-normal
TURN: Final = 10.0  # degrees that they are off by: normal
STREET_M: Final = 40.0


class Truth:
    """What a map has at a position, by its geometry: of all points of its instances, and of its names.

    Args:
        bodies: what stands in the map.
        gallery: its cells, for the classes and colours of these.
        palette: its colour words.
        gazetteer: its names.
    """

    def __init__(self, bodies: Bodies, gallery: Gallery, palette: Palette, gazetteer: Gazetteer) -> None:
        self._bodies, self._palette, self._gazetteer = bodies, palette, gazetteer
        parts = gallery.cells.parts
        instance, first = np.unique(bodies.part_instance, return_index=True)
        self._rgb = dict(zip(instance.tolist(), parts.rgb[first], strict=True))
        label = {int(i): gallery.labels[parts.instance[row]] for i, row in zip(instance, first, strict=True)}
        owners: dict[tuple[int, str], list[int]] = {}
        for number, name in label.items():
            owners.setdefault((int(bodies.scene[number]), name), []).append(number)
        self._owners, self._trees = owners, dict[tuple[int, str], tuple[cKDTree, Any]]()

    def nearest(self, scene: int, position: Floats, label: str) -> tuple[float, float, int] | None:
        """Metres, degrees clockwise from north, and instance of the nearest of a class; None if the scene has none."""
        key = scene, label
        if key not in self._owners:
            return None
        if key not in self._trees:
            some = self._owners[key]
            spans = [slice(int(self._bodies.starts[n]), int(self._bodies.starts[n + 1])) for n in some]
            points = np.concatenate([self._bodies.xyz[span, :2] for span in spans]).astype(np.float64)
            owner = np.repeat(some, [span.stop - span.start for span in spans])
            self._trees[key] = cKDTree(points), owner
        tree, owner = self._trees[key]
        metres, row = tree.query(position)
        east, north = tree.data[row] - position
        return float(metres), float(np.degrees(np.arctan2(east, north))), int(owner[row])

    def colour(self, instance: int) -> str | None:
        """The word for an instance's colour; None if the map does not know it."""
        return self._palette.word(self._rgb[instance])

    def streets(self, position: Floats) -> list[tuple[float, str]]:
        """Metres and names of the streets near a position, nearest first."""
        objects = self._gazetteer.by_kind.get(STREET, np.zeros(0, np.int64))
        ways = ways_to(Around.of(position[None], np.zeros(1, np.int64)), *cut(self._gazetteer, objects), STREET_M)
        items = objects[ways.item].tolist()
        return sorted(zip(ways.metres.tolist(), (self._gazetteer.words[n].names[0] for n in items), strict=True))

    def metres_to(self, position: Floats, name: str) -> float:
        """How far the nearest place of a name is."""
        objects = np.array([n for n in self._gazetteer.named if self._gazetteer.words[n].names[0] == name], np.int64)
        ways = ways_to(Around.of(position[None], np.zeros(1, np.int64)), *cut(self._gazetteer, objects), 10 * SIGN_M)
        return float(ways.metres.min(initial=np.inf))


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
        values = [choice.value for choice in question.choices if choice.value != UNKNOWN]
        right = self._right(question)
        if self.rng.random() < DO_NOT_KNOW or right is None:
            return Reply(question.id, UNKNOWN)
        if self.rng.random() < WRONG:
            right = str(self.rng.choice([value for value in values if value != right]))
        return Reply(question.id, right if right in values else OTHER)

    def _right(self, question: Question) -> str | None:
        """What is true, as they see it; None if the map does not say."""
        asked = Asked.parse(question.id)
        assert asked is not None
        if asked.kind == "street":
            return self._street()
        if asked.kind == "name":
            return self._yes(self.truth.metres_to(self.position_m, asked.names[0]), SIGN_M)
        found = self.truth.nearest(self.scene, self.position_m, asked.names[0])
        if asked.kind == "near":
            return self._yes(np.inf if found is None else found[0], TEN_M)
        if asked.kind == "colour":
            return None if found is None else self.truth.colour(found[2])
        if found is None or found[0] > REACH_M * self._idea():
            return "none"
        return QUARTERS[round((found[1] + self.rng.normal(0, TURN)) / 90) % 4]

    def _street(self) -> str:
        near = self.truth.streets(self.position_m)
        if not near:
            return OTHER
        alike = [name for metres, name in near if metres <= near[0][0] + 3.0]  # at a corner either is right
        return alike[int(self.rng.integers(len(alike)))]

    def _yes(self, metres: float, reach_m: float) -> str:
        return "yes" if metres <= reach_m * self._idea() else "no"

    def _idea(self) -> float:
        return float(np.exp(self.rng.normal(0, IDEAS)))


@dataclass(slots=True)
class Talk:
    """What was found for one text after each question; what was found last stands where none was asked.

    Attributes:
        error_m: of the estimate, infinite in another scene or without one.
        probability: of the best cell.
        hit: whether it is the right one.
        kinds: of the questions.
    """

    error_m: list[float] = field(default_factory=list)
    probability: list[float] = field(default_factory=list)
    is_ok: list[bool] = field(default_factory=list)
    kinds: list[str] = field(default_factory=list)


def talk(localizer: Localizer, text: str, person: Person, scene: str) -> Talk:
    """Ask about a text as long as the service has a question, at most QUESTIONS."""
    query, found = Query(text), Talk()
    scenes = dict(zip(localizer.gallery.cells.ids, localizer.gallery.cells.scenes, strict=True))
    while True:
        [answer] = localizer.localize([query])
        error = _error(answer, person.position_m)
        is_there = bool(answer.candidates) and scenes[answer.candidates[0].cell_id] == scene
        found.error_m.append(error if is_there else np.inf)
        found.probability.append(answer.estimate.probability if answer.estimate else 0.0)
        found.is_ok.append(answer.status == "ok")
        if answer.question is None or len(query.replies) == QUESTIONS:
            return found
        found.kinds.append(answer.question.id.split(":")[0])
        query = replace(query, replies=(*query.replies, person.reply(answer.question)))


def _error(answer: Answer, position_m: Floats) -> float:
    return float(np.hypot(*(answer.estimate.position - position_m))) if answer.estimate else np.inf


def vague_texts(queries: Queries, rows: Sequence[int], rng: np.random.Generator, *, is_plain: bool) -> list[str]:
    """Texts of two hints of some queries: in template words, or in plain ones without wind and colour."""
    assert queries.hints is not None
    texts = []
    for row in rows:
        hints = queries.hints[row]
        some = [hints[n] for n in rng.permutation(len(hints))[:HINTS]]
        if is_plain:
            texts.append(f"There is a {some[0].label} near me, and a {some[-1].label}.")
        else:
            texts.append(" ".join(render_hint(hint) for hint in some))
    return texts


def evaluate_questions(
    localizer: Localizer, source: Source, texts: int, seed: int, progress: Progress, *, is_plain: bool = False
) -> dict[str, Any]:
    """Say two hints of random positions and answer what is asked.

    Args:
        localizer: of an index of the data.
        source: the data, which tells what is true.
        texts: how many.
        seed: of positions, hints and answers.
        progress: called as the work goes on.
        is_plain: whether the hints name classes alone, without winds and colours.

    Returns:
        "data", "texts", "seed", "after" (of 0 to QUESTIONS questions: "asked", "within_10_m", "median_m",
        "probability", "ok") and "kinds" (how many of each were asked).

    Raises:
        DataError: the index is not of the data.
    """
    if localizer.gallery.cells.ids != source.data.cells.ids:
        raise DataError("the index has other cells than the data; index it with the same --split")
    rng, gazetteer = np.random.default_rng(seed), source.gazetteer()
    queries = source.queries(seed)
    rows = rng.permutation(len(queries))[:texts]
    said = vague_texts(queries, rows.tolist(), rng, is_plain=is_plain)
    truth = Truth(source.bodies(), source.data.gallery, source.data.palette, gazetteer)
    scenes = {scene: n for n, scene in enumerate(sorted(set(source.data.cells.scenes)))}
    talks = []
    for n, (row, text) in enumerate(zip(rows.tolist(), said, strict=True)):
        progress("ask", n, len(rows))
        scene = queries.scenes[row]
        person = Person(truth, scenes[scene], queries.positions_m[row], rng)
        talks.append(talk(localizer, text, person, scene))
    progress("ask", len(rows), len(rows))
    return {"data": source.data.name, "texts": len(talks), "seed": seed, **_figures(talks)}


def _figures(talks: Sequence[Talk]) -> dict[str, Any]:
    after = []
    for count in range(QUESTIONS + 1):
        last = [min(count, len(one.error_m) - 1) for one in talks]
        error = np.array([one.error_m[n] for one, n in zip(talks, last, strict=True)])
        median = float(np.median(error))
        after.append({
            "questions": count,
            "asked": sum(len(one.kinds) >= count for one in talks) if count else 0,
            "within_10_m": float((error <= WITHIN_M).mean()),
            "median_m": median if np.isfinite(median) else None,
            "probability": float(np.mean([one.probability[n] for one, n in zip(talks, last, strict=True)])),
            "ok": float(np.mean([one.is_ok[n] for one, n in zip(talks, last, strict=True)])),
        })  # fmt: skip
    kinds = [kind for one in talks for kind in one.kinds]
    return {"after": after, "kinds": {kind: kinds.count(kind) for kind in sorted(set(kinds))}}


def questions_table(report: dict[str, Any]) -> Table:
    """The report as a table."""
    head: tuple[str, ...] = ("questions", "asked", "within 10 m", "median", "probability", "ok")
    rows: list[tuple[str, ...]] = [
        (
            f"{row['questions']}",
            f"{row['asked']}",
            f"{row['within_10_m']:.3f}",
            "-" if row["median_m"] is None else f"{row['median_m']:.0f} m",
            f"{row['probability']:.3f}",
            f"{row['ok']:.3f}",
        )
        for row in report["after"]
    ]
    return head, rows
