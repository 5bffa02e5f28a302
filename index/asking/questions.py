"""The choice of the follow-up question by expected entropy, and the likelihood of replies."""

from collections.abc import Sequence
from functools import cached_property
from typing import Final

import numpy as np

from index.answering.answers import Question
from index.answering.query import MAX_REPLIES, Reply
from index.asking.known_facts import KnownFacts
from index.asking.open_questions import OpenQuestions
from index.asking.question_spec import MAX_CHOICES, UNKNOWN, QuestionSpec
from models.citymap.cells import CellTable
from models.citymap.colours import Palette
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.errors import ReplyError
from models.language.lexicon.question_classes import load_question_classes
from models.posterior.distribution import PositionDistribution, heaviest
from models.posterior.nearby_objects import NearbyObjects, ObjectsAround
from models.posterior.node_batch import colour_words
from models.posterior.places.landmarks import Landmarks
from models.posterior.questions import ReplyEvidence, entropy, expected_entropy, expected_entropy_of_names, with_errors

MIN_GAIN_BITS: Final = 0.1  # a question that narrows less is not asked
EFFORT_BITS: Final = {"address": 1.0}  # extra gain that an address must bring, because it takes longer to find out
MAX_NODES_OF_OBJECTS: Final = 256  # bounds the time to choose a question about objects
MAX_NODES_OF_NAMES: Final = 4096  # names may split a whole city, so more nodes count
MIN_SHARE: Final = 0.03  # of the mass; facts true for less, or for all but so little, are not asked about


def build_landmarks(gazetteer: Gazetteer, cells: CellTable) -> Landmarks:
    """Return the names that people around each cell can read off signs."""
    return Landmarks.build(gazetteer, cells.center_m[:, :2].astype(np.float64), load_question_classes().kinds)


class Questions:
    """The questions about one map; landmarks are built on demand unless they are given."""

    def __init__(
        self,
        nearby_objects: NearbyObjects,
        labels: Sequence[str],
        palette: Palette,
        gazetteer: Gazetteer,
        cells: CellTable,
        landmarks: Landmarks | None = None,
    ) -> None:
        question_classes = load_question_classes()
        self._nearby_objects, self._words = nearby_objects, tuple(colour_words(palette))
        self._gazetteer, self._cells, self._landmarks = gazetteer, cells, landmarks
        self._object_classes = {label: n for n, label in enumerate(labels) if label in question_classes.things}
        self._owning = np.flatnonzero(np.diff(nearby_objects.surroundings.cell_starts))  # cells that have nodes

    @cached_property
    def _names(self) -> OpenQuestions:
        return OpenQuestions(self._landmarks or build_landmarks(self._gazetteer, self._cells))

    @cached_property
    def _middle_nodes(self) -> Ints:
        return self._nearby_objects.surroundings.middles(self._cells.center_m[:, :2].astype(np.float64))

    def reply_evidence(self, replies: Sequence[Reply]) -> ReplyEvidence | None:
        """Return the likelihood of the replies; None if they add nothing, ReplyError if one does not fit this map."""
        if not replies:
            return None
        read = [self._read(number, reply) for number, reply in enumerate(replies)]
        closed = [(spec, column) for spec, column in read if column >= 0]
        name_log_p = self._names.log_p(replies)
        if not closed and name_log_p is None:
            return None

        classes = sorted({self._object_classes[spec.names[0]] for spec, _ in closed})

        def log_likelihood(nodes: Ints) -> Floats:
            objects = self._nearby_objects.around(nodes, classes)
            chances = [with_errors(self._truth(spec, objects))[:, column] for spec, column in closed]
            total = np.zeros(len(nodes)) if name_log_p is None else name_log_p[self._owner(nodes)]
            for chance in chances:
                total = total + np.log(chance)
            return total

        cells = np.zeros(len(self._nearby_objects.surroundings.cell_starts) - 1)
        cells[self._owning] = log_likelihood(self._middle_nodes)
        return ReplyEvidence(cells, log_likelihood)

    def _owner(self, nodes: Ints) -> Ints:
        return self._nearby_objects.surroundings.owner(nodes)

    @property
    def has_names(self) -> bool:
        """Return whether the map has streets or places with names."""
        return self._names.has("street") or self._names.has("name")

    def ask(self, located: PositionDistribution, known_facts: KnownFacts, replies: Sequence[Reply]) -> Question | None:
        """Return the question that narrows the distribution most; None if none is worth asking."""
        return self._ask(*self._likely_nodes(located), known_facts, replies)

    def ask_anywhere(self, log_prior: Floats, known_facts: KnownFacts, replies: Sequence[Reply]) -> Question | None:
        """Return the best question for a text that says nothing useful; the log prior [N] is -inf outside the area."""
        log_p = log_prior[self._owning]
        if not (log_p > -np.inf).any():
            return None
        chance = np.exp(log_p - log_p.max())
        return self._ask(
            *_sample_by_mass(self._middle_nodes, chance / chance.sum(), MAX_NODES_OF_NAMES), known_facts, replies
        )

    def _ask(self, nodes: Ints, mass: Floats, known_facts: KnownFacts, replies: Sequence[Reply]) -> Question | None:
        """Return the best question for nodes [C], each in a cell of its own, with masses [C] that sum to 1."""
        if len(replies) >= MAX_REPLIES:
            return None
        gain = self._object_question_gains(*_sample_by_mass(nodes, mass, MAX_NODES_OF_OBJECTS), known_facts, replies)
        named = [spec for spec in known_facts.open_questions(replies) if self._names.has(spec.kind)]
        rows = {spec: self._names.rows(spec, self._owner(nodes), replies) for spec in named}
        before = entropy(mass)
        gain |= {spec: before - expected_entropy_of_names(mass, true, names) for spec, (true, names) in rows.items()}
        best = max(gain, key=lambda spec: gain[spec] - EFFORT_BITS.get(spec.kind, 0.0), default=None)
        if best is None or gain[best] < MIN_GAIN_BITS:
            return None
        known = known_facts.names
        return best.question(self._names.likeliest_names(best, mass @ rows[best][0], known) if best.is_open else ())

    def _likely_nodes(self, located: PositionDistribution) -> tuple[Ints, Floats]:
        """Return the heaviest node [C] of each cell of the distribution, and the cells' normalized masses."""
        cell, weight = self._owner(located.points), located.weight
        best = heaviest(cell, weight)
        mass = np.add.reduceat(weight, np.flatnonzero(np.diff(cell, prepend=-1)))
        return located.points[best], mass / max(mass.sum(), 1e-300)

    def _object_question_gains(
        self, nodes: Ints, mass: Floats, known_facts: KnownFacts, replies: Sequence[Reply]
    ) -> dict[QuestionSpec, float]:
        objects = self._nearby_objects.around(nodes, sorted(self._object_classes.values()))
        before = [spec for reply in replies if (spec := QuestionSpec.parse(reply.question)) is not None]
        specs = [spec for spec in self._object_questions(mass, objects, known_facts) if spec not in before]
        chance = np.zeros((len(specs), len(nodes), MAX_CHOICES + 1))
        for n, spec in enumerate(specs):
            true = with_errors(self._truth(spec, objects))
            chance[n, :, : true.shape[1]] = true
        gain = entropy(mass) - expected_entropy(mass, chance)
        return dict(zip(specs, gain.tolist(), strict=True))

    def _object_questions(self, mass: Floats, objects: ObjectsAround, known_facts: KnownFacts) -> list[QuestionSpec]:
        specs = []
        for label, number in self._object_classes.items():
            has = objects.share(number, mass)
            if has < MIN_SHARE:
                continue
            if label not in known_facts.labels:
                specs.append(QuestionSpec("near", (label,)))
            if label not in known_facts.winds and known_facts.has_winds:
                specs.append(QuestionSpec("way", (label,)))
            if label not in known_facts.colours and has > 1 - MIN_SHARE:
                share = objects.colours(number, mass)
                colours = [
                    self._words[n] for n in np.argsort(-share, kind="stable")[:MAX_CHOICES] if share[n] >= MIN_SHARE
                ]
                if len(colours) > 1:
                    specs.append(QuestionSpec("colour", (label, *colours)))
        return specs

    def _truth(self, spec: QuestionSpec, objects: ObjectsAround) -> Floats:
        """Return the chance [M, K] that each reply to a closed question is true at the observed nodes [M]."""
        number = self._object_classes[spec.names[0]]
        if spec.kind == "near":
            return objects.is_near(number)
        if spec.kind == "way":
            return objects.quarter(number)
        return objects.colour(number, np.array([self._words.index(word) for word in spec.names[1:]]))

    def _read(self, number: int, reply: Reply) -> tuple[QuestionSpec, int]:
        """Return the question of a reply and the column of its choice; -1 for unknown and for names."""
        spec = QuestionSpec.parse(reply.question)
        if spec is None or not self._knows(spec):
            raise ReplyError(
                number, "question", "is not a question about this map; send back the id from the last answer"
            )
        if spec.is_open or reply.choice == UNKNOWN:
            return spec, -1
        if reply.choice not in spec.values:
            raise ReplyError(number, "choice", "is not a choice of this question; send the value of one of its choices")
        return spec, spec.values.index(reply.choice)

    def _knows(self, spec: QuestionSpec) -> bool:
        if spec.is_open:
            return self._names.has(spec.kind)
        return spec.names[0] in self._object_classes and set(spec.names[1:]) <= set(self._words)


def _sample_by_mass(nodes: Ints, mass: Floats, count: int) -> tuple[Ints, Floats]:
    """Reduce nodes [C] to at most `count`, each with the same share of the mass."""
    if len(nodes) <= count:
        return nodes, mass
    share = (np.arange(count) + 0.5) / count
    row, times = np.unique(np.searchsorted(mass.cumsum() / mass.sum(), share), return_counts=True)
    return nodes[row], times / count
