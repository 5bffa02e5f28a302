"""What the service answers: models that are made from the localizer's dataclasses and refuse NaN."""

from pydantic import BaseModel, ConfigDict, Field, JsonValue

from app.http.protocol import LocalizerLike
from index.answers import Answer, CellDetail, Method, Status
from models.city.frame import Frame

INDEX_NAME = "default"
EXAMPLE: JsonValue = {
    "request_id": "5f0c1f3f8d4e4a0f9d5c3f7a1b2c3d4e",
    "status": "ok",
    "estimate": {
        "position": [105.0, -35.0],
        "method": "posterior",
        "covariance": [[144.0, 0.0], [0.0, 144.0]],
        "radius_m": {"p50": 14.1, "p90": 25.8},
        "probability": 0.62,
        "wgs84": {"lat": 60.1699, "lon": 24.9384},
    },
    "candidates": [
        {
            "rank": 1,
            "cell_id": "helsinki_00042",
            "score": 0.81,
            "probability": 0.62,
            "center": [105.0, -35.0],
            "bbox": [90.0, -50.0, 120.0, -20.0],
            "position": [105.0, -35.0],
            "wgs84": {"lat": 60.1699, "lon": 24.9384},
        }
    ],
    "other_probability": 0.38,
    "evidence": [
        {
            "text": "building",
            "label": "building",
            "colour": "gray",
            "relation": "north",
            "distance_m": 6.0,
            "absent": False,
            "explained": 0.97,
            "instance": "building",
            "name": "Stockmann",
            "source_id": "way/1234",
            "away_m": 6.2,
        }
    ],
    "heat_map": {"spacing_m": 1.5, "points": [[105.0, -35.0, 0.08]]},
    "crs": {
        "frame_id": "map",
        "epsg": None,
        "origin": {"lat": 60.17, "lon": 24.94},
        "units": "m",
        "axes": "ENU",
    },
    "provenance": {
        "index": "default",
        "index_version": "20260101T120000Z-1a2b3c4d",
        "model": "retriever",
        "model_sha256": "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08",
        "map": "helsinki",
        "attribution": "© OpenStreetMap contributors",
    },
    "timings_ms": {"queue": 0.2, "encode": 9.1, "search": 0.4, "estimate": 0.1, "total": 10.3},
    "warnings": [],
}


class _Out(BaseModel):
    model_config = ConfigDict(from_attributes=True, allow_inf_nan=False)


class LatLon(_Out):
    """WGS84 degrees."""

    lat: float
    lon: float


class RadiusOut(_Out):
    """Metres around the estimate that hold the true position with probability .5 and .9."""

    p50: float
    p90: float


class EstimateOut(_Out):
    """Where the speaker is, how sure that is, and what made it."""

    position: tuple[float, float] = Field(description="x, y in metres, map frame")
    method: Method
    covariance: tuple[tuple[float, float], tuple[float, float]] = Field(description="square metres")
    radius_m: RadiusOut
    probability: float = Field(description="that the best candidate is the right cell")
    wgs84: LatLon | None


class CandidateOut(_Out):
    """A cell that may be the right one."""

    rank: int
    cell_id: str
    score: float = Field(description="comparable within one index only")
    probability: float = Field(description="calibrated")
    center: tuple[float, float]
    bbox: tuple[float, float, float, float] = Field(description="west, south, east, north in metres, map frame")
    position: tuple[float, float] = Field(description="the best position inside this cell")
    wgs84: LatLon | None


class EvidenceOut(_Out):
    """How one hint was understood, and what on the map explains it."""

    text: str = Field(description="the words for the thing")
    label: str | None = Field(description="the map's class that fits them best")
    colour: str | None
    relation: str = Field(description="where the speaker is, seen from the thing; near: no direction was said")
    distance_m: float | None = Field(description="as it was said")
    absent: bool = Field(description="the text says that there is none")
    explained: float = Field(description="probability that something on the map explains the hint")
    instance: str | None = Field(description="class of what explains it at the estimate")
    name: str | None
    source_id: str | None
    away_m: float | None = Field(description="from its closest point to the estimate")


class HeatMapOut(_Out):
    """The distribution behind an answer."""

    spacing_m: float = Field(description="edge of the square that each point stands for")
    points: list[tuple[float, float, float]] = Field(description="x, y, probability, likeliest first, map frame")


class CrsOut(_Out):
    """What the metres of an answer mean."""

    frame_id: str
    epsg: int | None
    origin: LatLon | None = Field(description="of the point (0, 0); null if the map has no georeference")
    units: str = "m"
    axes: str = "ENU"

    @classmethod
    def of(cls, frame: Frame) -> "CrsOut":
        """Of a map's frame."""
        lat, lon = frame.origin_lat, frame.origin_lon
        origin = None if lat is None or lon is None else LatLon(lat=lat, lon=lon)
        return cls(frame_id=frame.frame_id, epsg=frame.epsg, origin=origin)


class Provenance(_Out):
    """What made an answer."""

    index: str
    index_version: str
    model: str
    model_sha256: str
    map: str
    attribution: str

    @classmethod
    def of(cls, localizer: LocalizerLike) -> "Provenance":
        """Of what a localizer answers."""
        return cls(
            index=INDEX_NAME,
            index_version=localizer.index_version,
            model=localizer.model,
            model_sha256=localizer.model_sha256,
            map=localizer.map_name,
            attribution=localizer.attribution,
        )


class LocalizeResponse(_Out):
    """The answer to one description."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE]})

    request_id: str
    status: Status
    estimate: EstimateOut | None = Field(description="null only with status no_match")
    candidates: list[CandidateOut] = Field(description="best first")
    other_probability: float = Field(description="mass outside the listed candidates")
    evidence: list[EvidenceOut] = Field(description="one a hint; empty unless refine is posterior")
    heat_map: HeatMapOut | None = Field(description="if it was asked for")
    crs: CrsOut
    provenance: Provenance
    timings_ms: dict[str, float]
    warnings: list[str]

    @classmethod
    def of(
        cls, answer: Answer, localizer: LocalizerLike, request_id: str, timings_ms: dict[str, float]
    ) -> "LocalizeResponse":
        """Of a localizer's answer.

        Args:
            answer: what was found.
            localizer: what found it.
            request_id: of the request.
            timings_ms: the service's own, shown with the localizer's.
        """
        return cls(
            request_id=request_id,
            status=answer.status,
            estimate=None if answer.estimate is None else EstimateOut.model_validate(answer.estimate),
            candidates=[CandidateOut.model_validate(candidate) for candidate in answer.candidates],
            other_probability=answer.other_probability,
            evidence=[EvidenceOut.model_validate(hint) for hint in answer.evidence],
            heat_map=None if answer.heat_map is None else HeatMapOut.model_validate(answer.heat_map),
            crs=CrsOut.of(localizer.frame),
            provenance=Provenance.of(localizer),
            timings_ms={**answer.timings_ms, **timings_ms},
            warnings=list(answer.warnings),
        )


class CellInstanceOut(_Out):
    """One instance of a cell; metres, map frame."""

    label: str
    name: str | None
    source_id: str | None
    colour: str | None
    points: int
    center: tuple[float, float, float]
    size: tuple[float, float, float]
    closest: tuple[float, float, float] = Field(description="its point nearest to the cell's centre")


class CellResponse(_Out):
    """A cell and what is in it; metres, map frame."""

    cell_id: str
    scene: str
    center: tuple[float, float, float]
    bbox: tuple[float, float, float, float] = Field(description="west, south, east, north")
    wgs84: LatLon | None
    instances: list[CellInstanceOut]
    crs: CrsOut
    provenance: Provenance

    @classmethod
    def of(cls, cell: CellDetail, localizer: LocalizerLike) -> "CellResponse":
        """Of a localizer's cell."""
        return cls(
            cell_id=cell.cell_id,
            scene=cell.scene,
            center=cell.center,
            bbox=cell.bbox,
            wgs84=None if cell.wgs84 is None else LatLon.model_validate(cell.wgs84),
            instances=[CellInstanceOut.model_validate(instance) for instance in cell.instances],
            crs=CrsOut.of(localizer.frame),
            provenance=Provenance.of(localizer),
        )


class Health(_Out):
    """Whether the process runs, or the service is ready."""

    status: str


class Limits(_Out):
    """What a client can run into."""

    max_bytes: int = Field(description="of a body, but for the one of POST /evaluate")
    max_evaluate_bytes: int
    max_characters: int
    max_hints: int
    max_top_k: int
    max_queue: int
    max_batch: int
    max_queries: int = Field(description="of one evaluation")
    max_jobs: int = Field(description="evaluations that wait")
    deadline_ms: int = Field(description="of a request that names none")
    max_deadline_ms: int


class IndexInfo(_Out):
    """The index that is served."""

    num_cells: int
    num_instances: int
    dim: int
    created: str
    crs: CrsOut
    provenance: Provenance

    @classmethod
    def of(cls, localizer: LocalizerLike) -> "IndexInfo":
        """Of what a localizer answers from."""
        return cls(
            num_cells=localizer.num_cells,
            num_instances=localizer.num_instances,
            dim=localizer.dim,
            created=localizer.created,
            crs=CrsOut.of(localizer.frame),
            provenance=Provenance.of(localizer),
        )


class InfoResponse(_Out):
    """The service, its limits, and what it serves."""

    service: str
    version: str
    limits: Limits
    index: IndexInfo | None = Field(description="null until it is loaded")
    data_sets: list[str] = Field(description="names that POST /evaluate takes as data")
