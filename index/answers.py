"""What a localizer is asked and what it answers, in plain dataclasses."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:  # so that the command line starts without NumPy
    from models.city.frame import Frame
    from models.city.types import Floats

Crs = Literal["map", "wgs84"]
Status = Literal["ok", "ambiguous", "no_match"]
Refine = Literal["none", "regressor", "posterior"]
Method = Literal["cell_center", "regressor", "matching", "posterior"]


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
class Query:
    """One description to localize.

    Attributes:
        hints: sentences, at least one, each not blank.
        top_k: candidates to list.
        within: filter, or None.
        prior: bias, or None.
        crs: what the coordinates of `within` and `prior` mean.
        refine: what finds positions inside the candidates; "none" leaves them at the centres; "posterior" ranks the
            candidates too, by the hint posterior.
        heat_map: whether the answer shall have the distribution behind it; the posterior alone has one.
    """

    hints: tuple[str, ...]
    top_k: int = 5
    within: Box | Circle | None = None
    prior: Prior | None = None
    crs: Crs = "map"
    refine: Refine = "none"
    heat_map: bool = False


@dataclass(frozen=True, slots=True)
class Wgs84:
    """Degrees."""

    lat: float
    lon: float

    @classmethod
    def of(cls, position_m: "Floats", frame: "Frame") -> "Wgs84 | None":
        """A position of the map; None if the map is not georeferenced."""
        if not frame.is_georeferenced:
            return None
        lat, lon = frame.to_wgs84(position_m[:2])
        return cls(round(float(lat), 7), round(float(lon), 7))


@dataclass(frozen=True, slots=True)
class Radius:
    """Metres around the estimate that hold the true position with probability .5 and .9."""

    p50: float
    p90: float


@dataclass(frozen=True, slots=True)
class Estimate:
    """Where the speaker is.

    Attributes:
        position: (x, y) metres, map frame.
        method: what made it; "cell_center" is the centre of the best cell, "posterior" the hint posterior, the others
            are models of the fine stage.
        covariance: 2 x 2, square metres, of the true position around `position`; finite, wide when unsure.
        radius_m: circles that hold the true position.
        probability: that the best candidate is the right cell.
        wgs84: None if the map has no georeference.
    """

    position: tuple[float, float]
    method: Method
    covariance: tuple[tuple[float, float], tuple[float, float]]
    radius_m: Radius
    probability: float
    wgs84: Wgs84 | None


@dataclass(frozen=True, slots=True)
class Candidate:
    """A cell that may be the right one.

    Attributes:
        rank: 1 is the best.
        cell_id: name of the cell.
        score: similarity of text and cell, -1..1, comparable within one index only.
        probability: calibrated on validation data.
        center: (x, y) metres of the cell's centre.
        bbox: (west, south, east, north) metres.
        position: (x, y) metres, the best position inside this cell.
        wgs84: of `position`.
    """

    rank: int
    cell_id: str
    score: float
    probability: float
    center: tuple[float, float]
    bbox: tuple[float, float, float, float]
    position: tuple[float, float]
    wgs84: Wgs84 | None


@dataclass(frozen=True, slots=True)
class Evidence:
    """How one hint was understood, and what explains it at the estimate.

    Attributes:
        text: the words for the thing.
        label: the map's label that fits best, None if none does.
        colour: word, None if none was said.
        relation: where the speaker is, seen from the thing; one of RELATIONS.
        distance_m: said distance, None if none was.
        absent: whether the text says that there is none.
        explained: probability that something on the map explains it.
        instance: its label, None if nothing explains it.
        name, source_id: of the instance, where the map has them.
        away_m: from the instance's closest point to the estimate.
    """

    text: str
    label: str | None
    colour: str | None
    relation: str
    distance_m: float | None
    absent: bool
    explained: float
    instance: str | None = None
    name: str | None = None
    source_id: str | None = None
    away_m: float | None = None


@dataclass(frozen=True, slots=True)
class HeatMap:
    """A distribution over positions.

    Attributes:
        spacing_m: edge of the square that each point stands for.
        points: (x, y, probability), likeliest first; metres, map frame.
    """

    spacing_m: float
    points: tuple[tuple[float, float, float], ...]


@dataclass(frozen=True, slots=True)
class Answer:
    """What the localizer found for one query.

    Attributes:
        status: "ok"; "ambiguous" when the text fits several places; "no_match" when `within` holds no cell, or nothing
            that is said is on the map.
        estimate: None only with "no_match".
        candidates: best first.
        other_probability: mass of all cells that are not listed.
        warnings: what the caller should know, in sentences.
        timings_ms: "encode", "search", "estimate".
        evidence: how each hint was understood, and what explains it; the posterior alone says.
        heat_map: if it was asked for.
    """

    status: Status
    estimate: Estimate | None
    candidates: tuple[Candidate, ...]
    other_probability: float
    warnings: tuple[str, ...] = ()
    timings_ms: dict[str, float] = field(default_factory=dict)
    evidence: tuple[Evidence, ...] = ()
    heat_map: HeatMap | None = None


@dataclass(frozen=True, slots=True)
class CellInstance:
    """One instance of a cell, as /cells/{id} shows it."""

    label: str
    name: str | None
    source_id: str | None
    colour: str | None
    points: int
    center: tuple[float, float, float]
    size: tuple[float, float, float]
    closest: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class CellDetail:
    """A cell and what is in it; metres, map frame."""

    cell_id: str
    scene: str
    center: tuple[float, float, float]
    bbox: tuple[float, float, float, float]
    wgs84: Wgs84 | None
    instances: tuple[CellInstance, ...]
