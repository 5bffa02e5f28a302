"""Open questions, answered by a name: a street, a place, the nearest cross street or house number."""

from collections.abc import Container, Sequence
from itertools import islice
from typing import Final

import numpy as np
from scipy.sparse import csr_array

from index.answering.query import Reply
from index.asking.question_spec import MAX_CHOICES, OPEN_QUESTIONS, UNKNOWN, QuestionSpec
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.errors import ReplyError
from models.posterior.places.addresses import Addresses
from models.posterior.places.landmarks import Landmarks, NameProbabilityTable
from models.posterior.places.name_index import NameIndex
from models.posterior.questions import name_with_errors

_NO_COLUMNS: Final = np.zeros(0, np.int64)
MIN_NAME_SHARE: Final = 0.01  # of the mass; a single house number of a city has less
_ANSWER_NOUNS: Final = {"name": "place that people know by its name", "address": "house number and street"}


class OpenQuestions:
    """The open questions about one map, from the names around its cells."""

    def __init__(self, landmarks: Landmarks) -> None:
        self._landmarks = landmarks

    def has(self, kind: str) -> bool:
        """Return whether the map has names for a kind of question."""
        return self._landmarks.has_corners if kind == "corner" else len(self._name_index(kind)) > 0

    def log_p(self, replies: Sequence[Reply]) -> Floats | None:
        """Return log p(replied names | cell) of cells [N]; None without a name, ReplyError if the map lacks one."""
        total, street = None, self._street_columns(replies)
        for number, reply in enumerate(replies):
            names = self._named_columns(number, reply)
            if not len(names):
                continue
            true = self._truth(reply.question, names, street)
            log_p = np.log(name_with_errors(true, len(self._name_index(reply.question)), len(names)))
            total = log_p if total is None else total + log_p
        return total

    def rows(self, spec: QuestionSpec, cells: Ints, replies: Sequence[Reply]) -> tuple[csr_array, int]:
        """Return the chance [C, K] of each of K names as true answer in cells [C], and K."""
        landmarks, names = self._landmarks, len(self._name_index(spec.kind))
        if spec.kind == "corner":
            return landmarks.crossings.rows(cells, self._street_columns(replies)), names
        return self._table(spec.kind).rows(cells), names

    def likeliest_names(self, spec: QuestionSpec, share: Floats, known: Container[str] = ()) -> list[str]:
        """Return at most MAX_CHOICES names to offer, but no known ones, by the share [K] of each."""
        shown = self._name_index(spec.kind).shown
        likely = (shown[n] for n in np.argsort(-share, kind="stable").tolist() if share[n] >= MIN_NAME_SHARE)
        return list(islice((name for name in likely if name not in known), MAX_CHOICES))

    def _name_index(self, kind: str) -> NameIndex | Addresses:
        if kind == "address":
            return self._landmarks.addresses
        return self._landmarks.names if kind == "name" else self._landmarks.streets

    def _table(self, kind: str) -> NameProbabilityTable:
        """Return the table of true names by cell; corners have their own table."""
        if kind == "address":
            return self._landmarks.address_table
        return self._landmarks.name_table if kind == "name" else self._landmarks.street_table

    def _truth(self, kind: str, names: Ints, street: Ints) -> Floats:
        """Return the chance [N] that one of some names is true in each cell, given the street the speaker may be on."""
        if kind == "corner":
            return self._landmarks.crossings.probability(names, street)
        return self._table(kind).probability(names)

    def _named_columns(self, number: int, reply: Reply) -> Ints:
        """Return the columns [k] of the names that a reply may mean; none for other questions and for unknown."""
        if reply.question not in OPEN_QUESTIONS or reply.choice == UNKNOWN:
            return _NO_COLUMNS
        names = self._name_index(reply.question).find(reply.choice)
        if not len(names):
            what = _ANSWER_NOUNS.get(reply.question, "street")
            advice = f'is not a {what} on this map; add it to the description instead, or send "{UNKNOWN}"'
            raise ReplyError(number, "choice", advice)
        return names

    def _street_columns(self, replies: Sequence[Reply]) -> Ints:
        return next(
            (self._named_columns(n, reply) for n, reply in enumerate(replies) if reply.question == "street"),
            _NO_COLUMNS,
        )
