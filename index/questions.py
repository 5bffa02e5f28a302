"""The one question whose answer would narrow an ambiguous answer most, and what the answers to such questions tell."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.sparse import csr_array

from index.answers import Question, Reply
from index.asked import LISTED, OTHER, UNKNOWN, Asked
from models.city.cells import CellTable
from models.city.colours import Palette
from models.city.gazetteer.gazetteer import Gazetteer
from models.city.points import Ints
from models.city.types import Floats
from models.errors import ReplyError
from models.language.lexicon.asked import load_asked
from models.language.places.mentions import Mention
from models.localization.located import Located
from models.posterior.binding import LIKELY, TRUSTED
from models.posterior.likelihood import Reading
from models.posterior.node_batch import colour_words
from models.posterior.places.landmarks import Landmarks
from models.posterior.questions import Answered, entropy, expected_entropy, with_errors
from models.posterior.sights import Seen, Sights

LEAST_GAIN: Final = 0.1  # bits; what narrows no more is not worth asking
PLACES: Final = 256  # cells that a question is chosen by: the likeliest
MOST_NAMES: Final = 60
FAINT: Final = 0.03  # of the mass; what so little, or all but so little of it has is not asked about


@dataclass(frozen=True, slots=True)
class Heard:
    """What is known of a place already, and need not be asked.

    Attributes:
        labels: classes that the text names.
        winds: of these, those with a wind.
        colours: of these, those with a colour.
        names: of places.
        is_on_street: whether a street is named.
        has_winds: whether the speaker knows where north is, as far as the text tells.
    """

    labels: frozenset[str] = frozenset()
    winds: frozenset[str] = frozenset()
    colours: frozenset[str] = frozenset()
    names: frozenset[str] = frozenset()
    is_on_street: bool = False
    has_winds: bool = True

    @classmethod
    def of(
        cls, reading: Reading | None, mentions: Sequence[Mention], labels: Sequence[str], gazetteer: Gazetteer
    ) -> "Heard":
        """What a text says.

        Args:
            reading: of what is near; None if it tells of nothing near.
            mentions: of places.
            labels: the map's classes.
            gazetteer: the map's names.
        """
        labelled, with_wind, with_colour = set[str](), set[str](), set[str]()
        if reading is not None:
            trust, number = reading.label.max(dim=1)
            relation, colour = reading.relation[:, :-1].sum(dim=1), 1 - reading.colour[:, -1]
            for n in (trust >= TRUSTED).nonzero().flatten().tolist():
                label = labels[int(number[n])]
                labelled.add(label)
                with_wind |= {label} if relation[n] > LIKELY else set()
                with_colour |= {label} if colour[n] > LIKELY else set()
        labelled |= {kind.rsplit("/")[-1].replace("_", " ") for mention in mentions for kind in mention.kinds}
        named = (name for mention in mentions for n in mention.objects for name in gazetteer.words[int(n)].names[:1])
        return cls(
            labels=frozenset(labelled),
            winds=frozenset(with_wind),
            colours=frozenset(with_colour),
            names=frozenset(named),
            is_on_street=any(mention.form in {"street", "address", "corner", "span"} for mention in mentions),
            has_winds=not len(gazetteer) or bool(with_wind) or any(m.cue.wind is not None for m in mentions),
        )


class Questions:
    """The questions about one map.

    Args:
        sights: the things around its nodes.
        labels: their classes.
        palette: the map's colour words.
        gazetteer: its names; empty where nothing has one.
        cells: the gallery.
    """

    def __init__(
        self, sights: Sights, labels: Sequence[str], palette: Palette, gazetteer: Gazetteer, cells: CellTable
    ) -> None:
        asked, centers_m = load_asked(), cells.center_m[:, :2].astype(np.float64)
        self._sights, self._words = sights, tuple(colour_words(palette))
        self._landmarks = Landmarks(gazetteer, centers_m, asked.kinds) if len(gazetteer) else None
        self._things = {label: n for n, label in enumerate(labels) if label in asked.things}
        starts = sights.surroundings.cell_starts
        self._cell = np.repeat(np.arange(len(starts) - 1), np.diff(starts))  # that owns each node
        apart = np.hypot(*(sights.surroundings.nodes_m - centers_m[self._cell]).T)
        order = np.lexsort((apart, self._cell))
        self._owning = np.flatnonzero(np.diff(starts))  # cells that have nodes
        self._middle = order[starts[:-1][self._owning]]  # the node nearest to each one's centre

    def answered(self, replies: Sequence[Reply]) -> Answered | None:
        """What answers tell of positions; None if they tell nothing.

        Raises:
            ReplyError: an answer is not to a question about this map.
        """
        told = [(asked, column) for asked, column in map(self._read, range(len(replies)), replies) if column >= 0]
        if not told:
            return None

        classes = sorted({self._things[asked.names[0]] for asked, _ in told if asked.names[0] in self._things})

        def at(nodes: Ints) -> Floats:
            seen = self._sights.seen(nodes, classes)
            chances = [with_errors(self._true(asked, nodes, seen))[:, column] for asked, column in told]
            total: Floats = np.log(np.stack(chances)).sum(axis=0)
            return total

        cells = np.zeros(len(self._sights.surroundings.cell_starts) - 1)
        cells[self._owning] = at(self._middle)
        return Answered(cells, at)

    def ask(self, located: Located, heard: Heard, replies: Sequence[Reply]) -> Question | None:
        """The question whose answer leaves the least expected entropy over cells; None if none is worth it."""
        nodes, mass = self._places(located)
        seen = self._sights.seen(nodes, sorted(self._things.values()))
        before = [asked for reply in replies if (asked := Asked.parse(reply.question)) is not None]
        possible = [
            asked
            for asked in (*self._of_names(nodes, mass, heard, replies), *self._of_things(mass, seen, heard))
            if asked not in before
        ]
        if not possible:
            return None
        chance = np.zeros((len(possible), len(nodes), LISTED + 1))
        for n, asked in enumerate(possible):
            found = with_errors(self._true(asked, nodes, seen))
            chance[n, :, : found.shape[1]] = found
        gain = entropy(mass) - expected_entropy(mass, chance)
        best = int(gain.argmax())
        return possible[best].question() if gain[best] >= LEAST_GAIN else None

    def _places(self, located: Located) -> tuple[Ints, Floats]:
        """[C] the heaviest node of each of the likeliest cells, and their probabilities, made to add up to 1."""
        cell = self._cell[located.points]
        order = np.lexsort((-located.weight, cell))
        first = order[np.diff(cell[order], prepend=-1) != 0]
        mass = np.bincount(cell, located.weight)[cell[first]]
        kept = np.argsort(-mass, kind="stable")[:PLACES]
        return located.points[first[kept]], mass[kept] / max(mass[kept].sum(), 1e-300)

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

    def _of_names(self, nodes: Ints, mass: Floats, heard: Heard, replies: Sequence[Reply]) -> list[Asked]:
        """Streets and named places that can be asked about."""
        if self._landmarks is None:
            return []
        cells, found = self._cell[nodes], list[Asked]()
        told = [reply for reply in replies if reply.question.startswith("street:")]
        if not heard.is_on_street and all(reply.choice == OTHER for reply in told):
            left_out = {name for reply in told for name in reply.question.removeprefix("street:").split("|")}
            share = mass @ self._landmarks.on_street[cells]
            streets = [(share[n], name) for name, n in self._landmarks.streets.items() if name not in left_out]
            best = tuple(name for much, name in sorted(streets, reverse=True)[:LISTED] if much > 0 and "|" not in name)
            if len(best) > 1:
                found.append(Asked("street", best))
        share, names = mass @ self._landmarks.seen[cells], list(self._landmarks.names)
        some = np.argsort(-share, kind="stable")[:MOST_NAMES]
        return found + [Asked("name", (names[n],)) for n in some if share[n] >= FAINT and names[n] not in heard.names]

    def _true(self, asked: Asked, nodes: Ints, seen: Seen) -> Floats:
        """[M, K] chance that each answer is the right one at some nodes."""
        if asked.kind in ("street", "name"):
            table, numbers = self._table(asked)
            cells, which = np.unique(self._cell[nodes], return_inverse=True)
            some: Floats = table[cells][:, [numbers[name] for name in asked.names]].toarray()[which]
            return np.concatenate([some, 1 - some.sum(axis=1, keepdims=True)], axis=1).clip(0.0, 1.0)
        number = self._things[asked.names[0]]
        if asked.kind == "near":
            return seen.is_near(number)
        if asked.kind == "way":
            return seen.quarter(number)
        return seen.colour(number, np.array([self._words.index(word) for word in asked.names[1:]]))

    def _table(self, asked: Asked) -> tuple[csr_array, Mapping[str, int]]:
        """[N, columns] chance of each street or name, and the columns of the names."""
        assert self._landmarks is not None
        landmarks = self._landmarks
        return (landmarks.on_street, landmarks.streets) if asked.kind == "street" else (landmarks.seen, landmarks.names)

    def _read(self, number: int, reply: Reply) -> tuple[Asked, int]:
        """The question of an answer, and which of its values was chosen; -1 for unknown."""
        asked = Asked.parse(reply.question)
        if asked is None or not self._knows(asked):
            raise ReplyError(number, "question", "is no question about this map; send back the id of an answer's")
        if reply.choice == UNKNOWN:
            return asked, -1
        if reply.choice not in asked.values:
            raise ReplyError(number, "choice", "is no choice of this question; send the value of one of its choices")
        return asked, asked.values.index(reply.choice)

    def _knows(self, asked: Asked) -> bool:
        names = asked.names
        if asked.kind in ("street", "name"):
            if self._landmarks is None:
                return False
            return all(name in self._table(asked)[1] for name in names)
        if names[0] not in self._things:
            return False
        return set(names[1:]) <= set(self._words)
