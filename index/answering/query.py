"""Queries to a localizer."""

from dataclasses import dataclass
from typing import Final, Literal

Crs = Literal["map", "wgs84"]
Refine = Literal["none", "matching", "regressor", "posterior"]
Rerank = Literal["parc"]  # how the first cells are ranked again
DEFAULT_REFINE: Final[Refine] = "posterior"
DEFAULT_TOP_K: Final = 5
MAX_REPLIES: Final = 8  # per query; after that no further question is asked


@dataclass(frozen=True, slots=True)
class Box:
    """A filter: positions outside are excluded. `west, south, east, north`: map metres, or degrees of lon/lat."""

    west: float
    south: float
    east: float
    north: float


@dataclass(frozen=True, slots=True)
class Circle:
    """A filter: positions outside are excluded. `center`: (x, y) map metres, or (lon, lat) degrees."""

    center: tuple[float, float]
    radius_m: float


@dataclass(frozen=True, slots=True)
class Polygons:
    """A filter: positions outside are excluded. Vertices: (x, y) map metres, or (lon, lat) degrees."""

    polygons: tuple[
        tuple[tuple[tuple[float, float], ...], ...], ...
    ]  # each has an outer ring, then its holes; may overlap


@dataclass(frozen=True, slots=True)
class Prior:
    """A bias, for example a poor GPS fix: a Gaussian. `position`: (x, y) map metres, or (lon, lat) degrees."""

    position: tuple[float, float]
    sigma_m: float  # along the major axis
    minor_sigma_m: float | None = None  # None: as along the major axis
    orientation_deg: float = 0.0  # of the major axis, clockwise from the map's north


@dataclass(frozen=True, slots=True)
class Reply:
    """A reply to a question: its id, and the value of a choice or, for an open question, a name."""

    question: str
    choice: str


@dataclass(frozen=True, slots=True)
class Query:
    """One description to localize."""

    description: str  # with at least one word
    top_k: int = DEFAULT_TOP_K
    within: Box | Circle | Polygons | None = None
    prior: Prior | None = None
    # Position of who is spoken to: the text then describes where to meet, and "north of you" is from there.
    listener: tuple[float, float] | None = None
    crs: Crs = "map"  # coordinate system of `within`, `prior` and `listener`
    # How positions are found: "none" keeps the centres of cells; "posterior" also ranks the candidates.
    refine: Refine = DEFAULT_REFINE
    heat_map: bool = False  # whether to include the distribution in the answer
    replies: tuple[Reply, ...] = ()  # replies to questions of earlier answers; only the posterior uses them
    language: str | None = None  # of the texts in the answer, one of `REPLY_LANGUAGES`; None for the description's
