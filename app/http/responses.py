"""What the service answers: the localizer's dataclasses with what the service knows besides; NaN is refused."""

from dataclasses import fields

from pydantic import BaseModel, ConfigDict, Field, JsonValue

from app.http.protocol import LocalizerLike
from index.answers import (
    Answer,
    Candidate,
    CellDetail,
    CellInstance,
    Described,
    Estimate,
    Evidence,
    Fact,
    HeatMap,
    LatLon,
    ModelName,
    Question,
    Status,
)
from models.city.frame import Frame

INDEX_NAME = "default"
CRS_EXAMPLE: JsonValue = {
    "frame_id": "map",
    "epsg": None,
    "origin": {"lat": 60.17, "lon": 24.94},
    "units": "m",
    "axes": "ENU",
}
PROVENANCE_EXAMPLE: JsonValue = {
    "index": "default",
    "index_version": "20260101T120000Z-1a2b3c4d",
    "model": "posterior/minilm/192",
    "model_sha256": "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08",
    "map": "helsinki",
    "attribution": "© OpenStreetMap contributors",
}
EXAMPLE: JsonValue = {
    "request_id": "5f0c1f3f8d4e4a0f9d5c3f7a1b2c3d4e",
    "status": "ambiguous",
    "estimate": {
        "position": [105.0, -35.0],
        "method": "posterior",
        "covariance": [[1444.0, 0.0], [0.0, 1444.0]],
        "radius_m": {"p50": 44.1, "p90": 81.8},
        "probability": 0.22,
        "wgs84": {"lat": 60.1699, "lon": 24.9384},
        "place": "on Kaivokatu, between Keskuskatu and Mikonkatu, 14 m south of Ateneum",
        "heading": {"mean_deg": 271.0, "spread_deg": 18.0},
    },
    "candidates": [
        {
            "rank": 1,
            "cell_id": "helsinki_00042",
            "score": 0.81,
            "probability": 0.22,
            "center": [105.0, -35.0],
            "bbox": [90.0, -50.0, 120.0, -20.0],
            "position": [105.0, -35.0],
            "wgs84": {"lat": 60.1699, "lon": 24.9384},
        }
    ],
    "other_probability": 0.78,
    "evidence": [
        {
            "text": "building",
            "span": [16, 24],
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
            "at": [105.0, -41.2],
            "bearing_deg": None,
            "exact": None,
        },
        {
            "text": "Ateneum",
            "span": [45, 52],
            "label": "tourism/museum",
            "colour": None,
            "relation": "right",
            "distance_m": None,
            "absent": False,
            "explained": 0.98,
            "instance": "tourism/museum",
            "name": "Ateneum",
            "source_id": "way/5678",
            "away_m": 14.0,
            "at": [105.5, -21.0],
            "bearing_deg": 2.0,
            "exact": True,
        },
    ],
    "heat_map": {"spacing_m": 1.5, "points": [[105.0, -35.0, 0.08]]},
    "question": {
        "id": "street",
        "text": "Which street are you on?",
        "choices": [
            {"value": "Kaivokatu", "text": "Kaivokatu"},
            {"value": "Mikonkatu", "text": "Mikonkatu"},
            {"value": "unknown", "text": "I don't know"},
        ],
        "is_open": True,
    },
    "crs": CRS_EXAMPLE,
    "provenance": PROVENANCE_EXAMPLE,
    "timings_ms": {"queue": 0.2, "encode": 9.1, "search": 0.4, "estimate": 0.1, "total": 10.3},
    "warnings": [],
}
DESCRIBE_EXAMPLE: JsonValue = {
    "request_id": "5f0c1f3f8d4e4a0f9d5c3f7a1b2c3d4e",
    "description": "I am on Kaivokatu, between Keskuskatu and Mikonkatu. Ateneum is 14 m to my north. "
    "A street lamp is 4 m to my west.",
    "hints": [
        {
            "text": "I am on Kaivokatu, between Keskuskatu and Mikonkatu.",
            "instance": "street",
            "name": "Kaivokatu",
            "source_id": "way/1234",
            "at": [105.0, -41.2],
            "away_m": 6.2,
            "bearing_deg": 180.0,
        },
        {
            "text": "Ateneum is 14 m to my north.",
            "instance": "tourism/museum",
            "name": "Ateneum",
            "source_id": "way/5678",
            "at": [105.5, -21.0],
            "away_m": 14.0,
            "bearing_deg": 2.0,
        },
        {
            "text": "A street lamp is 4 m to my west.",
            "instance": "street lamp",
            "name": None,
            "source_id": "node/9012",
            "at": [101.5, -35.0],
            "away_m": 3.5,
            "bearing_deg": 270.0,
        },
    ],
    "place": "on Kaivokatu, between Keskuskatu and Mikonkatu, 14 m south of Ateneum",
    "position": [105.0, -35.0],
    "wgs84": {"lat": 60.1699, "lon": 24.9384},
    "cell_id": "helsinki_00042",
    "crs": CRS_EXAMPLE,
    "provenance": PROVENANCE_EXAMPLE,
    "timings_ms": {"total": 8.4},
}


class _Out(BaseModel):
    # An instance of a dataclass would pass unchecked; checked again, a NaN in it is found.
    model_config = ConfigDict(allow_inf_nan=False, revalidate_instances="always")


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
        origin = None if lat is None or lon is None else LatLon(lat, lon)
        return cls(frame_id=frame.frame_id, epsg=frame.epsg, origin=origin)


class Provenance(_Out):
    """What made an answer."""

    index: str
    index_version: str
    model: str = Field(description="what answered; of a cell or an index, what made its vectors")
    model_sha256: str = Field(description="of all its weights")
    map: str
    attribution: str

    @classmethod
    def of(cls, localizer: LocalizerLike, model: ModelName | None = None) -> "Provenance":
        """Of what a localizer answers.

        Args:
            localizer: what answers.
            model: what it answered with; None for the one that made the index.
        """
        facts = localizer.facts
        model = model or facts.model
        return cls(
            index=INDEX_NAME,
            index_version=facts.version,
            model=model.name,
            model_sha256=model.sha256,
            map=facts.map_name,
            attribution=facts.attribution,
        )


class LocalizeResponse(_Out):
    """The answer to one description."""

    model_config = ConfigDict(json_schema_extra={"examples": [EXAMPLE]})

    request_id: str
    status: Status
    estimate: Estimate | None = Field(description="null only with status no_match")
    candidates: tuple[Candidate, ...] = Field(description="best first")
    other_probability: float = Field(description="mass outside the listed candidates")
    evidence: tuple[Evidence, ...] = Field(description="one a hint; empty unless refine is posterior")
    heat_map: HeatMap | None = Field(description="if it was asked for")
    question: Question | None = Field(
        description="what to ask the speaker, whose answer would narrow this most: send it in `answers`. With status "
        "ambiguous; with no_match on a map with names, if the text is in English and not of a place outside `within`: "
        "replies alone then make an answer; with ok once something was replied, until radius_m.p50 is 10 m. Else null, "
        "and where nothing is worth asking"
    )
    crs: CrsOut
    provenance: Provenance
    timings_ms: dict[str, float]
    warnings: tuple[str, ...]

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
        found = {f.name: getattr(answer, f.name) for f in fields(answer) if f.name != "model"}
        found["timings_ms"] = {**answer.timings_ms, **timings_ms}
        crs, provenance = CrsOut.of(localizer.frame), Provenance.of(localizer, answer.model)
        return cls(request_id=request_id, crs=crs, provenance=provenance, **found)


class DescribeResponse(_Out):
    """What the map says at a position; metres, map frame."""

    model_config = ConfigDict(json_schema_extra={"examples": [DESCRIBE_EXAMPLE]})

    request_id: str
    description: str = Field(description="the sentences of `hints`; POST /localize finds the position by it")
    hints: tuple[Fact, ...]
    place: str | None = Field(description="the position in words; null on a map without names")
    position: tuple[float, float]
    wgs84: LatLon | None = Field(description="null if the map has no georeference")
    cell_id: str = Field(description="the cell whose centre is nearest")
    crs: CrsOut
    provenance: Provenance
    timings_ms: dict[str, float]

    @classmethod
    def of(
        cls, described: Described, localizer: LocalizerLike, request_id: str, timings_ms: dict[str, float]
    ) -> "DescribeResponse":
        """Of what a localizer says of a position; the rest as `LocalizeResponse.of`."""
        said = {f.name: getattr(described, f.name) for f in fields(described)}
        crs, provenance = CrsOut.of(localizer.frame), Provenance.of(localizer)
        return cls(request_id=request_id, crs=crs, provenance=provenance, timings_ms=timings_ms, **said)


class CellResponse(_Out):
    """A cell and what is in it; metres, map frame."""

    cell_id: str
    scene: str
    center: tuple[float, float, float]
    bbox: tuple[float, float, float, float] = Field(description="west, south, east, north")
    wgs84: LatLon | None
    instances: tuple[CellInstance, ...]
    crs: CrsOut
    provenance: Provenance

    @classmethod
    def of(cls, cell: CellDetail, localizer: LocalizerLike) -> "CellResponse":
        """Of a localizer's cell."""
        shown = {f.name: getattr(cell, f.name) for f in fields(cell)}
        return cls(crs=CrsOut.of(localizer.frame), provenance=Provenance.of(localizer), **shown)


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
    scenery_parts: int = Field(description="of GET /maps/{map}/points")
    created: str
    crs: CrsOut
    provenance: Provenance

    @classmethod
    def of(cls, localizer: LocalizerLike) -> "IndexInfo":
        """Of what a localizer answers from."""
        facts = localizer.facts
        return cls(
            num_cells=facts.num_cells,
            num_instances=facts.num_instances,
            dim=facts.dim,
            scenery_parts=facts.scenery_parts,
            created=facts.created,
            crs=CrsOut.of(localizer.frame),
            provenance=Provenance.of(localizer),
        )


class InfoResponse(_Out):
    """The service, its limits, and what it serves."""

    service: str
    version: str
    key_required: bool = Field(description="whether all but this, the page and the checks of health needs the read key")
    limits: Limits
    index: IndexInfo | None = Field(description="null until it is loaded")
    data_sets: list[str] = Field(description="names that POST /evaluate takes as data")
