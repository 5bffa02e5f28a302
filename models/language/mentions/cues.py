"""Where a thing is from the speaker, as the text says."""

from dataclasses import dataclass
from typing import Final, Literal

from models.language.measures import Measure

Relation = Literal[
    "seen", "at", "outside", "beside", "near", "across", "inside", "past", "off", "on", "far", "block", "wind"
]


@dataclass(frozen=True, slots=True)
class Cue:
    """What some words say of a thing.

    Attributes:
        relation: how near, and in which way.
        angle: degrees clockwise from where the speaker looks; None if not said.
        wind: degrees clockwise from north, from the speaker to the thing; None if not said.
        measure: the distance that is said; None if none is.
        angles: what the angle may be, with its probability, where that is not sure.
    """

    relation: Relation = "seen"
    angle: float | None = None
    wind: float | None = None
    measure: Measure | None = None
    angles: tuple[tuple[float | None, float], ...] = ()

    @property
    def distance_m(self) -> float | None:
        """The distance that is said; None if none is."""
        return None if self.measure is None else self.measure.metres

    @property
    def is_loose(self) -> bool:
        """Whether the distance is vague, or in blocks, doors or minutes."""
        return self.measure is not None and self.measure.is_loose


SEEN: Final = Cue()
