"""What a localizer is asked."""

from dataclasses import dataclass
from typing import Final, Literal

Crs = Literal["map", "wgs84"]
Refine = Literal["none", "matching", "regressor", "posterior"]
DEFAULT_REFINE: Final[Refine] = "posterior"
DEFAULT_TOP_K: Final = 5
MOST_REPLIES: Final = 8  # of a query; who has given so many is asked nothing more


@dataclass(frozen=True, slots=True)
class Box:
    """A filter: nothing outside is answered. `west, south, east, north`: map metres, or degrees of lon/lat."""

    west: float
    south: float
    east: float
    north: float


@dataclass(frozen=True, slots=True)
class Circle:
    """A filter: nothing outside is answered. `center`: (x, y) map metres, or (lon, lat) degrees."""

    center: tuple[float, float]
    radius_m: float


@dataclass(frozen=True, slots=True)
class Prior:
    """A bias, for example a poor GPS fix. `position`: (x, y) map metres, or (lon, lat) degrees."""

    position: tuple[float, float]
    sigma_m: float


@dataclass(frozen=True, slots=True)
class Reply:
    """What a person answered to a question: its id, and the value of one of its choices or, if it is open, a name."""

    question: str
    choice: str


@dataclass(frozen=True, slots=True)
class Query:
    """One description to localize.

    Attributes:
        description: any text with a word in it.
        top_k: candidates to list.
        within: filter, or None.
        prior: bias, or None.
        crs: what the coordinates of `within` and `prior` mean.
        refine: what finds positions inside the candidates; "none" leaves them at the centres; "posterior" ranks the
            candidates too, by the hint posterior.
        heat_map: whether the answer shall have the distribution behind it.
        replies: answers to questions of earlier answers; the posterior alone heeds them.
    """

    description: str
    top_k: int = DEFAULT_TOP_K
    within: Box | Circle | None = None
    prior: Prior | None = None
    crs: Crs = "map"
    refine: Refine = DEFAULT_REFINE
    heat_map: bool = False
    replies: tuple[Reply, ...] = ()
