"""Answers of a localizer: plain dataclasses, whose descriptions appear in the HTTP API."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from models.citymap.summary import MapSummary

if TYPE_CHECKING:  # so that the command line starts without NumPy
    from models.citymap.frame import Frame
    from models.citymap.types import Floats

Status = Literal["ok", "ambiguous", "no_match"]
Method = Literal["cell_center", "regressor", "matching", "posterior"]


@dataclass(frozen=True, slots=True)
class ModelName:
    """A model and the sha256 of all its weights."""

    name: str
    sha256: str


@dataclass(frozen=True, slots=True)
class LatLon:
    """WGS84 degrees."""

    lat: float
    lon: float

    @classmethod
    def from_position(cls, position_m: "Floats", frame: "Frame") -> "LatLon | None":
        """Convert a position of the map; None if the map is not georeferenced."""
        if not frame.is_georeferenced:
            return None
        lat, lon = frame.to_wgs84(position_m[:2])
        return cls(round(float(lat), 7), round(float(lon), 7))


@dataclass(frozen=True, slots=True)
class Radius:
    """Radii in metres around the estimate that contain the true position with probability 0.5 and 0.9."""

    p50: float
    p90: float


@dataclass(frozen=True, slots=True)
class Heading:
    """Where the speaker looks, if the text uses left, right, ahead or behind."""

    mean_deg: Annotated[float, Field(description="clockwise from north")]
    spread_deg: Annotated[float, Field(description="circular standard deviation")]


@dataclass(frozen=True, slots=True)
class Estimate:
    """The estimated position of the speaker and its uncertainty."""

    position: Annotated[tuple[float, float], Field(description="x, y in metres, map frame")]
    method: Annotated[
        Method,
        Field(
            description="posterior: the hint posterior; cell_center: the centre of the best cell; regressor, matching: "
            "models of the fine stage"
        ),
    ]
    covariance: Annotated[
        tuple[tuple[float, float], tuple[float, float]],
        Field(description="covariance of the true position around `position`, square metres"),
    ]
    radius_m: Radius
    within_m: Annotated[
        dict[int, float],
        Field(description="calibrated probabilities that the speaker is within 10, 30, 100 and 250 m of `position`"),
    ]
    probability: Annotated[
        float, Field(description="probability that the best candidate is the right cell; small cells make it small")
    ]
    wgs84: Annotated[LatLon | None, Field(description="null if the map has no georeference")]
    place: Annotated[str | None, Field(description="the position in words; null on a map without names")] = None
    heading: Annotated[Heading | None, Field(description="null if the text does not tell")] = None


@dataclass(frozen=True, slots=True)
class Candidate:
    """A cell that may contain the speaker."""

    rank: Annotated[int, Field(description="1 is the best")]
    cell_id: str
    score: Annotated[
        float,
        Field(
            description="score before any prior; with posterior the log likelihood summed over the area of the cell, "
            "comparable within one answer; with any other refine the similarity of text and cell (a cosine, or a "
            "weighted sum of one per level), comparable within one index"
        ),
    ]
    probability: Annotated[float, Field(description="calibrated probability that this is the right cell")]
    center: tuple[float, float]
    bbox: Annotated[
        tuple[float, float, float, float], Field(description="west, south, east, north in metres, map frame")
    ]
    position: Annotated[tuple[float, float], Field(description="the best position inside this cell")]
    wgs84: Annotated[LatLon | None, Field(description="of `position`")]


@dataclass(frozen=True, slots=True)
class Evidence:
    """How one hint was understood, and which object of the map explains it."""

    text: Annotated[str, Field(description="the words for the object")]
    span: Annotated[
        tuple[int, int] | None,
        Field(description="the characters of the description that contain them: start and end (exclusive)"),
    ]
    label: Annotated[str | None, Field(description="the best matching class of the map")]
    colour: str | None
    relation: Annotated[
        str,
        Field(
            description="direction from the object to the speaker; near if the text gives none. For named places also "
            "other relations: at, across, left, ahead right, corner ..."
        ),
    ]
    distance_m: Annotated[float | None, Field(description="the distance in the text")]
    absent: Annotated[bool, Field(description="the text says that there is no such object")]
    explained: Annotated[float, Field(description="probability that an object of the map explains the hint")]
    instance: Annotated[str | None, Field(description="class of the object that explains it at the estimate")] = None
    name: str | None = None
    source_id: str | None = None
    away_m: Annotated[float | None, Field(description="distance from the estimate to its closest point, metres")] = None
    at: Annotated[tuple[float, float] | None, Field(description="its closest point: x, y in metres, map frame")] = None
    bearing_deg: Annotated[
        float | None, Field(description="named places only: direction from the estimate, clockwise from north")
    ] = None
    exact: Annotated[
        bool | None,
        Field(
            description="named places only: whether the text has a name of it, rather than of another branch of its "
            "chain; null for nearby objects"
        ),
    ] = None
    fit: Annotated[str, Field(description="how it fits the estimate, in words")] = ""


@dataclass(frozen=True, slots=True)
class LikelyPlace:
    """A place where the speaker may be, with all positions that are nearest to it."""

    probability: Annotated[
        float, Field(description="probability that this is the right place; what is missing to 1 lies elsewhere")
    ]
    position: Annotated[tuple[float, float], Field(description="x, y in metres, map frame")]
    wgs84: Annotated[LatLon | None, Field(description="null if the map has no georeference")]
    radius_m: Annotated[
        float, Field(description="radius that contains the speaker with probability 0.9 if this is the right place")
    ]
    place: Annotated[str | None, Field(description="the position in words; null on a map without names")] = None
    supports: Annotated[tuple[str, ...], Field(description="what speaks for it: the `fit` of the evidence there")] = ()
    contradicts: Annotated[tuple[str, ...], Field(description="what speaks against it")] = ()
    source_id: Annotated[
        str | None, Field(description="the named place that speaks most for it; null if none does")
    ] = None


@dataclass(frozen=True, slots=True)
class HeatMap:
    """The probability distribution of the position."""

    spacing_m: Annotated[float, Field(description="edge of the square around each point, metres")]
    points: Annotated[
        tuple[tuple[float, float, float], ...], Field(description="x, y, probability; likeliest first; map frame")
    ]


@dataclass(frozen=True, slots=True)
class Choice:
    """A reply that a question offers."""

    value: Annotated[str, Field(description="the value to send back")]
    text: Annotated[str, Field(description="the text to show")]


@dataclass(frozen=True, slots=True)
class Question:
    """The follow-up question that narrows the position most."""

    id: Annotated[str, Field(description="the id to send back; the service keeps no other state")]
    text: Annotated[str, Field(description="the question, in the language of the reply")]
    choices: Annotated[
        tuple[Choice, ...],
        Field(description='the last one is "unknown": the question is not asked again and the answer does not change'),
    ]
    is_open: Annotated[
        bool,
        Field(description="names that are not listed may be sent as well; case and accents do not matter"),
    ] = False


@dataclass(frozen=True, slots=True)
class Answer:
    """The answer to one query. `evidence`, `heat_map` and `question` are given by the posterior only."""

    status: Status
    model: ModelName
    estimate: Estimate | None = None
    candidates: tuple[Candidate, ...] = ()
    other_probability: float = 1.0
    places: tuple[LikelyPlace, ...] = ()
    warnings: tuple[str, ...] = ()
    timings_ms: dict[str, float] = field(default_factory=dict)
    evidence: tuple[Evidence, ...] = ()
    heat_map: HeatMap | None = None
    question: Question | None = None
    language: str = "en"  # of its texts


@dataclass(frozen=True, slots=True)
class CellInstance:
    """An instance in a cell; metres, map frame."""

    label: str
    name: str | None
    source_id: str | None
    colour: str | None
    points: int
    center: tuple[float, float, float]
    size: tuple[float, float, float]
    closest: Annotated[tuple[float, float, float], Field(description="its closest point to the cell's centre")]


@dataclass(frozen=True, slots=True)
class CellDetail:
    """A cell and its instances; metres, map frame."""

    cell_id: str
    scene: str
    center: tuple[float, float, float]
    bbox: Annotated[tuple[float, float, float, float], Field(description="west, south, east, north")]
    wgs84: LatLon | None
    instances: tuple[CellInstance, ...]


@dataclass(frozen=True, slots=True)
class CellSummary:
    """A cell in a list; metres, map frame."""

    cell_id: str
    scene: str
    center: tuple[float, float, float]
    bbox: Annotated[tuple[float, float, float, float], Field(description="west, south, east, north")]
    wgs84: LatLon | None
    instances: Annotated[int, Field(description="number of instances; GET /cells/{cell_id} lists them")]


@dataclass(frozen=True, slots=True)
class Fact:
    """A true sentence about a position, and the object it is about."""

    text: Annotated[str, Field(description="the sentence")]
    instance: Annotated[str, Field(description="class of the object")]
    name: Annotated[str | None, Field(description="null if it has none")]
    source_id: str | None
    at: Annotated[
        tuple[float, float], Field(description="its closest point to the position: x, y in metres, map frame")
    ]
    away_m: Annotated[float, Field(description="distance from the position to that point, metres")]
    bearing_deg: Annotated[
        float | None,
        Field(description="direction from the position to that point, clockwise from north; null at distance 0"),
    ]


@dataclass(frozen=True, slots=True)
class Described:
    """A description of a position; metres, map frame."""

    description: Annotated[str, Field(description="the sentences of `hints`, which POST /localize can localize")]
    hints: tuple[Fact, ...]
    place: Annotated[str | None, Field(description="the position in words; null on a map without names")]
    position: Annotated[tuple[float, float], Field(description="x, y in metres, map frame")]
    wgs84: Annotated[LatLon | None, Field(description="null if the map has no georeference")]
    cell_id: Annotated[str, Field(description="the cell whose centre is nearest")]
    address: dict[str, str] = field(default_factory=dict)  # its parts, by Nominatim's names


@dataclass(frozen=True, slots=True)
class IndexFacts:
    """Facts about an index."""

    version: str
    created: str
    map_name: str
    attribution: str  # the text that the map's licence requires to be shown
    model: ModelName  # the model of its vectors
    num_cells: int
    num_instances: int
    dim: int
    scenery_parts: int  # files of the drawing of the map
    box_m: tuple[float, float, float, float]  # west, south, east and north of its cells
    summary: MapSummary | None = None  # None for a data set
