"""Cues: where a thing is from the speaker, according to the text."""

from dataclasses import dataclass
from typing import Final, Literal

from models.language.measures import Measure

Relation = Literal[
    "seen", "at", "outside", "beside", "near", "across", "inside", "past", "off", "on", "far", "block", "wind"
]


@dataclass(frozen=True, slots=True)
class Cue:
    """The relation, direction and distance of a thing; None where not stated.

    Attributes:
        relation: kind of nearness.
        angle: degrees clockwise from the heading.
        wind: degrees clockwise from north, from the speaker to the thing.
        measure: the distance.
        angles: possible angles with their probabilities, if uncertain.
    """

    relation: Relation = "seen"
    angle: float | None = None
    wind: float | None = None
    measure: Measure | None = None
    angles: tuple[tuple[float | None, float], ...] = ()

    @property
    def distance_m(self) -> float | None:
        """The stated distance; None without one."""
        return None if self.measure is None else self.measure.metres

    @property
    def is_loose(self) -> bool:
        """Whether the distance is vague, or in blocks, doors or minutes."""
        return self.measure is not None and self.measure.is_loose


SEEN: Final = Cue()
