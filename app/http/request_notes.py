"""What a route knows of its request, for the log line and the spans that are written around it."""

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from starlette.types import Scope

_NOTES: Final = "hereabouts.notes"


@dataclass(frozen=True, slots=True)
class Timed:
    """An answer of the model: when it was there (nanoseconds since 1970), and what it took."""

    done_ns: int
    timings_ms: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Notes:
    """Of one request: what was said, which goes nowhere but into a log that is to have it, and its answers."""

    said: list[str] = field(default_factory=list)
    timed: list[Timed] = field(default_factory=list)

    def answered(self, timings_ms: Mapping[str, float]) -> None:
        """Note an answer that is there now."""
        self.timed.append(Timed(time.time_ns(), timings_ms))


def notes_of(scope: Scope) -> Notes:
    """The notes of a request; whoever comes first makes them."""
    notes: Notes = scope.setdefault(_NOTES, Notes())
    return notes
