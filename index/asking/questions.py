"""The one question whose answer would narrow most where somebody is, and what the answers to such questions tell."""

from collections.abc import Sequence
from functools import cached_property
from typing import Final

import numpy as np

from index.answering.answers import Question
from index.answering.query import MOST_REPLIES, Reply
from index.asking.known_facts import Heard
from index.asking.open_questions import OpenQuestions
from index.asking.question_spec import LISTED, UNKNOWN, Asked
from models.citymap.cells import CellTable
from models.citymap.colours import Palette
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.errors import ReplyError
from models.language.lexicon.question_classes import load_question_classes
from models.posterior.distribution import Located, heaviest
from models.posterior.nearby_objects import Seen, Sights
from models.posterior.node_batch import colour_words
from models.posterior.places.landmarks import Landmarks
from models.posterior.questions import Answered, entropy, expected_entropy, expected_entropy_of_names, with_errors

LEAST_GAIN: Final = 0.1  # bits; what narrows no more is not worth asking
EFFORT: Final = {"address": 1.0}  # bits that it must narrow more than what a word answers, to be asked instead
PLACES: Final = 256  # cells that a question about things is chosen by
NAMED_PLACES: Final = 4096  # and one for a name, which may leave few of a city's
FAINT: Final = 0.03  # of the mass; what so little, or all but so little of it has is not asked about


def landmarks_of(gazetteer: Gazetteer, cells: CellTable) -> Landmarks:
    """What people around some cells can say when they are asked."""
    return Landmarks.build(gazetteer, cells.center_m[:, :2].astype(np.float64), load_question_classes().kinds)


class Questions:
    """The questions about one map.

    Args:
        sights: the things around its nodes.
        labels: their classes.
        palette: the map's colour words.
        gazetteer: its names; empty where nothing has one.
        cells: the gallery.
        landmarks: of the gallery; None to make them when they are needed.
    """

    def __init__(
        self,
        sights: Sights,
        labels: Sequence[str],
        palette: Palette,
        gazetteer: Gazetteer,
        cells: CellTable,
        landmarks: Landmarks | None = None,
    ) -> None:
        asked = load_question_classes()
        self._sights, self._words = sights, tuple(colour_words(palette))
        self._gazetteer, self._cells, self._landmarks = gazetteer, cells, landmarks
        self._things = {label: n for n, label in enumerate(labels) if label in asked.things}
        self._owning = np.flatnonzero(np.diff(sights.surroundings.cell_starts))  # cells that have nodes

    @cached_property
    def _names(self) -> OpenQuestions:
        return OpenQuestions(self._landmarks or landmarks_of(self._gazetteer, self._cells))

    @cached_property
    def _middle(self) -> Ints:
        """A node in the middle of each cell that has any."""
        return self._sights.surroundings.middles(self._cells.center_m[:, :2].astype(np.float64))

    def answered(self, replies: Sequence[Reply]) -> Answered | None:
        """What answers tell of positions; None if they tell nothing.

        Raises:
            ReplyError: an answer is not to a question about this map.
        """
        if not replies:
            return None
        read = [self._read(number, reply) for number, reply in enumerate(replies)]
        told = [(asked, column) for asked, column in read if column >= 0]
        of_names = self._names.answered(replies)
        if not told and of_names is None:
            return None

        classes = sorted({self._things[asked.names[0]] for asked, _ in told})

        def at(nodes: Ints) -> Floats:
            seen = self._sights.seen(nodes, classes)
            chances = [with_errors(self._true(asked, seen))[:, column] for asked, column in told]
            total = np.zeros(len(nodes)) if of_names is None else of_names[self._owner(nodes)]
            for chance in chances:
                total = total + np.log(chance)
            return total

        cells = np.zeros(len(self._sights.surroundings.cell_starts) - 1)
        cells[self._owning] = at(self._middle)
        return Answered(cells, at)

    def _owner(self, nodes: Ints) -> Ints:
        return self._sights.surroundings.owner(nodes)

    @property
    def has_names(self) -> bool:
        """Whether the map has streets or places whose names can be asked for."""
        return self._names.has("street") or self._names.has("name")

    def ask(self, located: Located, heard: Heard, replies: Sequence[Reply]) -> Question | None:
        """The question whose answer narrows the cells most, by expected entropy; None if none is worth it."""
        return self._ask(*self._places(located), heard, replies)

    def ask_anywhere(self, log_prior: Floats, heard: Heard, replies: Sequence[Reply]) -> Question | None:
        """The same of a text that tells nothing.

        Args:
            log_prior: [N] of the cells, any constant; -inf where it cannot be.
            heard: what the text says nonetheless.
            replies: none of which tells anything.
        """
        log_p = log_prior[self._owning]
        if not (log_p > -np.inf).any():
            return None
        chance = np.exp(log_p - log_p.max())
        return self._ask(*_sampled(self._middle, chance / chance.sum(), NAMED_PLACES), heard, replies)

    def _ask(self, nodes: Ints, mass: Floats, heard: Heard, replies: Sequence[Reply]) -> Question | None:
        """The best question about where one of some nodes [C], each in a cell of its own, may be; their mass is 1."""
        if len(replies) >= MOST_REPLIES:
            return None
        gain = self._gain_of_things(*_sampled(nodes, mass, PLACES), heard, replies)
        named = [asked for asked in heard.open(replies) if self._names.has(asked.kind)]
        rows = {asked: self._names.rows(asked, self._owner(nodes), replies) for asked in named}
        before = entropy(mass)
        gain |= {asked: before - expected_entropy_of_names(mass, true, names) for asked, (true, names) in rows.items()}
        best = max(gain, key=lambda asked: gain[asked] - EFFORT.get(asked.kind, 0.0), default=None)
        if best is None or gain[best] < LEAST_GAIN:
            return None
        return best.question(self._names.likeliest(best, mass @ rows[best][0]) if best.is_open else ())

    def _places(self, located: Located) -> tuple[Ints, Floats]:
        """[C] the heaviest node of each cell that is listed, and their probabilities, made to add up to 1."""
        cell, weight = self._owner(located.points), located.weight
        best = heaviest(cell, weight)
        mass = np.add.reduceat(weight, np.flatnonzero(np.diff(cell, prepend=-1)))
        return located.points[best], mass / max(mass.sum(), 1e-300)

    def _gain_of_things(self, nodes: Ints, mass: Floats, heard: Heard, replies: Sequence[Reply]) -> dict[Asked, float]:
        """Bits that each closed question is expected to take away."""
        seen = self._sights.seen(nodes, sorted(self._things.values()))
        before = [asked for reply in replies if (asked := Asked.parse(reply.question)) is not None]
        closed = [asked for asked in self._of_things(mass, seen, heard) if asked not in before]
        chance = np.zeros((len(closed), len(nodes), LISTED + 1))
        for n, asked in enumerate(closed):
            found = with_errors(self._true(asked, seen))
            chance[n, :, : found.shape[1]] = found
        gain = entropy(mass) - expected_entropy(mass, chance)
        return dict(zip(closed, gain.tolist(), strict=True))

    def _of_things(self, mass: Floats, seen: Seen, heard: Heard) -> list[Asked]:
        """Classes that some of the likely places have around them."""
        found = []
        for label, number in self._things.items():
            has = seen.share(number, mass)
            if has < FAINT:
                continue
            if label not in heard.labels:
                found.append(Asked("near", (label,)))
            if label not in heard.winds and heard.has_winds:
                found.append(Asked("way", (label,)))
            if label not in heard.colours and has > 1 - FAINT:
                share = seen.colours(number, mass)
                colours = [self._words[n] for n in np.argsort(-share, kind="stable")[:LISTED] if share[n] >= FAINT]
                if len(colours) > 1:
                    found.append(Asked("colour", (label, *colours)))
        return found

    def _true(self, asked: Asked, seen: Seen) -> Floats:
        """[M, K] chance that each answer of a closed question is the right one at what was seen from some nodes."""
        number = self._things[asked.names[0]]
        if asked.kind == "near":
            return seen.is_near(number)
        if asked.kind == "way":
            return seen.quarter(number)
        return seen.colour(number, np.array([self._words.index(word) for word in asked.names[1:]]))

    def _read(self, number: int, reply: Reply) -> tuple[Asked, int]:
        """The question of an answer, and which of its values was chosen; -1 for unknown, and for names."""
        asked = Asked.parse(reply.question)
        if asked is None or not self._knows(asked):
            raise ReplyError(number, "question", "is no question about this map; send back the id of an answer's")
        if asked.is_open or reply.choice == UNKNOWN:
            return asked, -1
        if reply.choice not in asked.values:
            raise ReplyError(number, "choice", "is no choice of this question; send the value of one of its choices")
        return asked, asked.values.index(reply.choice)

    def _knows(self, asked: Asked) -> bool:
        if asked.is_open:
            return self._names.has(asked.kind)
        return asked.names[0] in self._things and set(asked.names[1:]) <= set(self._words)


def _sampled(nodes: Ints, mass: Floats, count: int) -> tuple[Ints, Floats]:
    """At most so many of some nodes [C], each for the same share of the mass but where it is all of them."""
    if len(nodes) <= count:
        return nodes, mass
    share = (np.arange(count) + 0.5) / count
    row, times = np.unique(np.searchsorted(mass.cumsum() / mass.sum(), share), return_counts=True)
    return nodes[row], times / count
