"""Questions whose reply people read off a sign: a street, a place, the nearest cross street or house number."""

from collections.abc import Sequence
from typing import Final

import numpy as np
from scipy.sparse import csr_array

from index.answering.query import Reply
from index.asking.question_spec import LISTED, OPEN, UNKNOWN, Asked
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.errors import ReplyError
from models.posterior.places.addresses import Addresses
from models.posterior.places.landmarks import Landmarks, Table
from models.posterior.places.name_index import NameIndex
from models.posterior.questions import said_with_errors

_NONE: Final = np.zeros(0, np.int64)
LIKELY_ENOUGH: Final = 0.01  # of the mass: one house number of a city is not
_WHAT: Final = {"name": "place that people know by its name", "address": "house number and street"}


class OpenQuestions:
    """The open questions about one map.

    Args:
        landmarks: its names, around its cells.
    """

    def __init__(self, landmarks: Landmarks) -> None:
        self._landmarks = landmarks

    def has(self, kind: str) -> bool:
        """Whether the map has names that a question asks for."""
        return self._landmarks.has_corners if kind == "corner" else len(self._spelt(kind)) > 0

    def answered(self, replies: Sequence[Reply]) -> Floats | None:
        """[N] log p(names that were said | cell); None if none was.

        Raises:
            ReplyError: the map has not got a name.
        """
        total, street = None, self._street(replies)
        for number, reply in enumerate(replies):
            names = self._said(number, reply)
            if not len(names):
                continue
            true = self._true(reply.question, names, street)
            log_p = np.log(said_with_errors(true, len(self._spelt(reply.question)), len(names)))
            total = log_p if total is None else total + log_p
        return total

    def rows(self, asked: Asked, cells: Ints, replies: Sequence[Reply]) -> tuple[csr_array, int]:
        """What is true in some cells [C]: [C, K] chance of each name that a question may bring, and K."""
        landmarks, names = self._landmarks, len(self._spelt(asked.kind))
        if asked.kind == "corner":
            return landmarks.crossings.rows(cells, self._street(replies)), names
        return self._table(asked.kind).rows(cells), names

    def likeliest(self, asked: Asked, share: Floats) -> list[str]:
        """At most LISTED names that are worth a button, likeliest first, of [K] the share of each."""
        best = np.argsort(-share, kind="stable")[:LISTED]
        return [self._spelt(asked.kind).shown[n] for n in best.tolist() if share[n] >= LIKELY_ENOUGH]

    def _spelt(self, kind: str) -> NameIndex | Addresses:
        if kind == "address":
            return self._landmarks.addresses
        return self._landmarks.names if kind == "name" else self._landmarks.streets

    def _table(self, kind: str) -> Table:
        """What is true of each name; but of corners, which ask for the street that one is on."""
        if kind == "address":
            return self._landmarks.numbered
        return self._landmarks.said if kind == "name" else self._landmarks.on_street

    def _true(self, kind: str, names: Ints, street: Ints) -> Floats:
        """[N] chance that one of some names is the right one in each cell, of who may have said to be on a street."""
        if kind == "corner":
            return self._landmarks.crossings.of(names, street)
        return self._table(kind).of(names)

    def _said(self, number: int, reply: Reply) -> Ints:
        """[k] the columns of the names that a reply may mean; none unless it is to an open question, and known."""
        if reply.question not in OPEN or reply.choice == UNKNOWN:
            return _NONE
        names = self._spelt(reply.question).find(reply.choice)
        if not len(names):
            what = _WHAT.get(reply.question, "street")
            advice = f'is no {what} on this map; say it in the description instead, or send "{UNKNOWN}"'
            raise ReplyError(number, "choice", advice)
        return names

    def _street(self, replies: Sequence[Reply]) -> Ints:
        """The streets that somebody may have said to be on."""
        return next((self._said(n, reply) for n, reply in enumerate(replies) if reply.question == "street"), _NONE)
