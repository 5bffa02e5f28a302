"""Cues: where a thing is from the speaker, according to the text."""

from dataclasses import dataclass
from typing import Final, Literal

from models.language.measures import Measure

Form = Literal["thing", "street", "corner", "span", "address", "unknown"]  # of a mention
Relation = Literal[
    "seen", "at", "outside", "beside", "near", "across", "inside", "past", "off", "on", "far", "block", "wind"
]


@dataclass(frozen=True, slots=True)
class Cue:
    """The relation, direction and distance of a thing; None where not stated."""

    relation: Relation = "seen"
    angle: float | None = None  # degrees clockwise from the heading
    wind: float | None = None  # degrees clockwise from north, from the speaker to the thing
    measure: Measure | None = None
    angles: tuple[tuple[float | None, float], ...] = ()  # possible angles with their probabilities, if uncertain

    @property
    def distance_m(self) -> float | None:
        """The stated distance; None without one."""
        return None if self.measure is None else self.measure.metres

    @property
    def is_loose(self) -> bool:
        """Whether the distance is vague, or in blocks, doors or minutes."""
        return self.measure is not None and self.measure.is_loose


NO_CUE: Final = Cue()
