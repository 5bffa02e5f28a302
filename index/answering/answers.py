"""What a localizer answers: plain dataclasses, whose descriptions are those of the HTTP API."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

if TYPE_CHECKING:  # so that the command line starts without NumPy
    from models.citymap.frame import Frame
    from models.citymap.types import Floats

Status = Literal["ok", "ambiguous", "no_match"]
Method = Literal["cell_center", "regressor", "matching", "posterior"]


@dataclass(frozen=True, slots=True)
class ModelName:
    """A model, and the sha256 of all its weights."""

    name: str
    sha256: str


@dataclass(frozen=True, slots=True)
class LatLon:
    """WGS84 degrees."""

    lat: float
    lon: float

    @classmethod
    def of(cls, position_m: "Floats", frame: "Frame") -> "LatLon | None":
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
class Heading:
    """Where the speaker looks, as the text tells it by left, right, ahead and behind."""

    mean_deg: Annotated[float, Field(description="clockwise from north")]
    spread_deg: Annotated[float, Field(description="circular standard deviation")]


@dataclass(frozen=True, slots=True)
class Estimate:
    """Where the speaker is, how sure that is, and what made it."""

    position: Annotated[tuple[float, float], Field(description="x, y in metres, map frame")]
    method: Annotated[
        Method,
        Field(
            description="posterior: the hint posterior; cell_center: the centre of the best cell; the others are "
            "models of the fine stage"
        ),
    ]
    covariance: Annotated[
        tuple[tuple[float, float], tuple[float, float]],
        Field(description="square metres, of the true position around `position`; wide when unsure"),
    ]
    radius_m: Radius
    probability: Annotated[float, Field(description="that the best candidate is the right cell")]
    wgs84: Annotated[LatLon | None, Field(description="null if the map has no georeference")]
    place: Annotated[str | None, Field(description="the position in words; null on a map without names")] = None
    heading: Annotated[Heading | None, Field(description="null where the text tells none")] = None


@dataclass(frozen=True, slots=True)
class Candidate:
    """A cell that may be the right one."""

    rank: Annotated[int, Field(description="1 is the best")]
    cell_id: str
    score: Annotated[
        float,
        Field(
            description="what cells are ranked by, before any prior; with posterior the logarithm of the likelihood "
            "summed over the part of the map that the cell owns, comparable within one answer; with any other refine "
            "the similarity of text and cell (a cosine, or the weighted sum of one a level), comparable within one "
            "index"
        ),
    ]
    probability: Annotated[float, Field(description="calibrated")]
    center: tuple[float, float]
    bbox: Annotated[
        tuple[float, float, float, float], Field(description="west, south, east, north in metres, map frame")
    ]
    position: Annotated[tuple[float, float], Field(description="the best position inside this cell")]
    wgs84: Annotated[LatLon | None, Field(description="of `position`")]


@dataclass(frozen=True, slots=True)
class Evidence:
    """How one hint was understood, and what on the map explains it."""

    text: Annotated[str, Field(description="the words for the thing")]
    span: Annotated[
        tuple[int, int] | None,
        Field(description="the characters of the description in which they stand, from the first to before the last"),
    ]
    label: Annotated[str | None, Field(description="the map's class that fits them best")]
    colour: str | None
    relation: Annotated[
        str,
        Field(
            description="where the speaker is, seen from the thing; near: no direction was said. Of places also "
            "what was said: at, across, left, ahead right, corner ..."
        ),
    ]
    distance_m: Annotated[float | None, Field(description="as it was said")]
    absent: Annotated[bool, Field(description="the text says that there is none")]
    explained: Annotated[float, Field(description="probability that something on the map explains the hint")]
    instance: Annotated[str | None, Field(description="class of what explains it at the estimate")] = None
    name: str | None = None
    source_id: str | None = None
    away_m: Annotated[float | None, Field(description="from its closest point to the estimate")] = None
    at: Annotated[tuple[float, float] | None, Field(description="that point: x, y in metres, map frame")] = None
    bearing_deg: Annotated[
        float | None, Field(description="of places: from the estimate to it, clockwise from north")
    ] = None
    exact: Annotated[
        bool | None,
        Field(
            description="of places: whether this is a name of it on the map, or another of its chain; null for what is "
            "near"
        ),
    ] = None


@dataclass(frozen=True, slots=True)
class HeatMap:
    """The distribution behind an answer."""

    spacing_m: Annotated[
        float,
        Field(description="edge of the square round each point; as fine as a few that hold the distribution can be"),
    ]
    points: Annotated[
        tuple[tuple[float, float, float], ...], Field(description="x, y, probability, likeliest first, map frame")
    ]


@dataclass(frozen=True, slots=True)
class Choice:
    """An answer that a question can be given."""

    value: Annotated[str, Field(description="what to send back")]
    text: Annotated[str, Field(description="what to show")]


@dataclass(frozen=True, slots=True)
class Question:
    """The one thing whose answer would narrow most where the speaker is."""

    id: Annotated[str, Field(description="what to send back; it says all that the service needs to know")]
    text: Annotated[str, Field(description="the question, in English")]
    choices: Annotated[
        tuple[Choice, ...],
        Field(description='the last is "unknown": the question is not asked again, and nothing else changes'),
    ]
    is_open: Annotated[
        bool,
        Field(
            description="a name that is not listed may be sent as choice as well; it is compared without case and "
            "accents"
        ),
    ] = False


@dataclass(frozen=True, slots=True)
class Answer:
    """What the localizer found for one query.

    Attributes:
        status: "ok"; "ambiguous" when what is said and replied fits several places; "no_match" when `within` holds no
            cell, or nothing that is said is on the map and no reply tells anything.
        model: what answered.
        estimate: None only with "no_match".
        candidates: best first.
        other_probability: mass of all cells that are not listed.
        warnings: what the caller should know, in sentences.
        timings_ms: "encode", "search", "estimate"; what a batch shares counts for each of it.
        evidence: one a hint; the posterior alone says.
        heat_map: if it was asked for; the posterior alone has one.
        question: what to ask; None unless something would narrow the answer. With "ambiguous"; with "no_match" on a map
            with names, of a text in English: its replies are an answer also where the text tells nothing; with "ok"
            once something was replied, until half of the probability is within 10 m. The posterior alone has one.
    """

    status: Status
    model: ModelName
    estimate: Estimate | None = None
    candidates: tuple[Candidate, ...] = ()
    other_probability: float = 1.0
    warnings: tuple[str, ...] = ()
    timings_ms: dict[str, float] = field(default_factory=dict)
    evidence: tuple[Evidence, ...] = ()
    heat_map: HeatMap | None = None
    question: Question | None = None


@dataclass(frozen=True, slots=True)
class CellInstance:
    """One instance of a cell; metres, map frame."""

    label: str
    name: str | None
    source_id: str | None
    colour: str | None
    points: int
    center: tuple[float, float, float]
    size: tuple[float, float, float]
    closest: Annotated[tuple[float, float, float], Field(description="its point nearest to the cell's centre")]


@dataclass(frozen=True, slots=True)
class CellDetail:
    """A cell and what is in it; metres, map frame."""

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
    instances: Annotated[int, Field(description="how many are in it; GET /cells/{cell_id} has them")]


@dataclass(frozen=True, slots=True)
class Fact:
    """A sentence that is true at a position, and what on the map it tells of."""

    text: Annotated[str, Field(description="the sentence")]
    instance: Annotated[str, Field(description="class of what it tells of")]
    name: Annotated[str | None, Field(description="null where it has none")]
    source_id: str | None
    at: Annotated[
        tuple[float, float], Field(description="its point nearest to the position: x, y in metres, map frame")
    ]
    away_m: Annotated[float, Field(description="from the position to that point")]
    bearing_deg: Annotated[
        float | None, Field(description="from the position to that point, clockwise from north; null where it is there")
    ]


@dataclass(frozen=True, slots=True)
class Described:
    """What the map says at a position; metres, map frame."""

    description: Annotated[str, Field(description="the sentences of `hints`; POST /localize finds the position by it")]
    hints: tuple[Fact, ...]
    place: Annotated[str | None, Field(description="the position in words; null on a map without names")]
    position: Annotated[tuple[float, float], Field(description="x, y in metres, map frame")]
    wgs84: Annotated[LatLon | None, Field(description="null if the map has no georeference")]
    cell_id: Annotated[str, Field(description="the cell whose centre is nearest")]


@dataclass(frozen=True, slots=True)
class IndexFacts:
    """What an index says of itself.

    Attributes:
        version: the index directory that is served.
        created: when it was built, ISO 8601.
        map_name: the map.
        attribution: what the map data's licence asks to show.
        model: what made its vectors.
        num_cells, num_instances: of the map.
        dim: width of the vectors.
        scenery_parts: in how many parts what the map looks like is kept.
    """

    version: str
    created: str
    map_name: str
    attribution: str
    model: ModelName
    num_cells: int
    num_instances: int
    dim: int
    scenery_parts: int
