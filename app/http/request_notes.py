"""Notes that a route adds to the log line of its request."""

from dataclasses import dataclass, field
from typing import Final

from starlette.types import Scope

_NOTES: Final = "hereabouts.notes"


@dataclass(frozen=True, slots=True)
class RequestNotes:
    """The descriptions of one request; they are logged only where the settings say so."""

    descriptions: list[str] = field(default_factory=list)


def get_notes(scope: Scope) -> RequestNotes:
    """Return the notes of a request; the first caller creates them."""
    notes: RequestNotes = scope.setdefault(_NOTES, RequestNotes())
    return notes
