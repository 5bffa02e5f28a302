"""Responses: the localizer's dataclasses and the service's own fields. NaN is refused."""

from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from app import limits
from app.http.protocol import LocalizerLike
from app.http.schemas.examples import ANSWERED, DESCRIBED, MAP
from app.http.schemas.ros import PoseWithCovarianceStamped
from app.settings import Settings
from index.answering.answers import (
    Answer,
    Candidate,
    CellDetail,
    CellInstance,
    CellSummary,
    Described,
    Estimate,
    Evidence,
    Fact,
    HeatMap,
    LatLon,
    LikelyPlace,
    ModelName,
    Question,
    Status,
)
from index.build.artifact import DEFAULT_ALIAS
from models.citymap.frame import Frame
from models.citymap.summary import MapSummary


class _Out(BaseModel):
    # Without revalidation, a NaN inside an instance of a dataclass would pass.
    model_config = ConfigDict(allow_inf_nan=False, revalidate_instances="always")


class CrsOut(_Out):
    """The coordinate reference system of an answer."""

    frame_id: str
    epsg: int | None
    origin: LatLon | None = Field(description="position of the point (0, 0); null if the map has no georeference")
    units: str = "m"
    axes: str = "ENU"

    @classmethod
    def from_frame(cls, frame: Frame) -> "CrsOut":
        """Describe the frame of a map."""
        lat, lon = frame.origin_lat, frame.origin_lon
        origin = None if lat is None or lon is None else LatLon(lat, lon)
        return cls(frame_id=frame.frame_id, epsg=frame.epsg, origin=origin)


class Provenance(_Out):
    """The index, model and map behind an answer."""

    index: str
    index_version: str
    model: str = Field(description="the model that answered; for a cell or an index, the model of its vectors")
    model_sha256: str = Field(description="checksum of all its weights")
    map: str
    attribution: str

    @classmethod
    def build(
        cls, localizer: LocalizerLike, model: ModelName | None = None, index: str = DEFAULT_ALIAS
    ) -> "Provenance":
        """Return the provenance of an answer of `model`, by default the model of the index."""
        facts = localizer.facts
        model = model or facts.model
        return cls(
            index=index,
            index_version=facts.version,
            model=model.name,
            model_sha256=model.sha256,
            map=facts.map_name,
            attribution=facts.attribution,
        )


def _origin(
    localizer: LocalizerLike, model: ModelName | None = None, index: str = DEFAULT_ALIAS
) -> dict[str, CrsOut | Provenance]:
    """Return the fields of a response that say where it comes from."""
    return {"crs": CrsOut.from_frame(localizer.frame), "provenance": Provenance.build(localizer, model, index)}


def _common_fields(response: type[BaseModel], source: object) -> dict[str, Any]:
    return {name: getattr(source, name) for name in response.model_fields if hasattr(source, name)}


class LocalizeResponse(_Out):
    """The answer to one description."""

    model_config = ConfigDict(json_schema_extra={"examples": [ANSWERED]})

    request_id: str
    status: Status
    language: str = Field(description="of the texts of this answer")
    estimate: Estimate | None = Field(description="null only if status is no_match")
    places: tuple[LikelyPlace, ...] = Field(
        description="at most five distinct places, likeliest first; the first is that of the estimate"
    )
    candidates: tuple[Candidate, ...] = Field(description="the retrieved cells, best first")
    other_probability: float = Field(description="probability outside the listed candidates")
    evidence: tuple[Evidence, ...] = Field(description="one entry per hint; empty unless refine is posterior")
    heat_map: HeatMap | None = Field(description="only if requested")
    ros: PoseWithCovarianceStamped | None = Field(None, description="only if requested and there is an estimate")
    question: Question | None = Field(
        description="the question whose reply is expected to narrow the position most; send the reply in `answers`. "
        "Asked if status is ambiguous; if it is no_match on a map with names, for a text about a place inside "
        "`within` (the replies alone can then give an answer); and if it is ok after a reply, until radius_m.p50 is "
        "10 m. Otherwise, or if no question helps, null"
    )
    crs: CrsOut
    provenance: Provenance
    timings_ms: dict[str, float]
    warnings: tuple[str, ...]

    @classmethod
    def build(
        cls,
        answer: Answer,
        localizer: LocalizerLike,
        request_id: str,
        timings_ms: dict[str, float],
        index: str = DEFAULT_ALIAS,
    ) -> "LocalizeResponse":
        """Build the response from a localizer's answer; the service's timings are added to the localizer's."""
        values = _common_fields(cls, answer) | _origin(localizer, answer.model, index)
        return cls(**values | {"request_id": request_id, "timings_ms": {**answer.timings_ms, **timings_ms}})


class DescribeResponse(_Out):
    """A position in words; metres, map frame."""

    model_config = ConfigDict(json_schema_extra={"examples": [DESCRIBED]})

    request_id: str
    description: str = Field(description="the sentences of `hints`; POST /localize can find the position from it")
    hints: tuple[Fact, ...]
    place: str | None = Field(description="the position in words; null on a map without names")
    position: tuple[float, float]
    wgs84: LatLon | None = Field(description="null if the map has no georeference")
    cell_id: str = Field(description="the cell with the nearest centre")
    crs: CrsOut
    provenance: Provenance
    timings_ms: dict[str, float]

    @classmethod
    def build(
        cls,
        described: Described,
        localizer: LocalizerLike,
        request_id: str,
        timings_ms: dict[str, float],
        index: str = DEFAULT_ALIAS,
    ) -> "DescribeResponse":
        """Build the response from a described position; the other arguments are those of `LocalizeResponse.build`."""
        values = _common_fields(cls, described) | _origin(localizer, index=index)
        return cls(request_id=request_id, timings_ms=timings_ms, **values)


class CellResponse(_Out):
    """A cell and its instances; metres, map frame."""

    cell_id: str
    scene: str
    center: tuple[float, float, float]
    bbox: tuple[float, float, float, float] = Field(description="west, south, east, north")
    wgs84: LatLon | None
    instances: tuple[CellInstance, ...]
    crs: CrsOut
    provenance: Provenance

    @classmethod
    def build(cls, cell: CellDetail, localizer: LocalizerLike) -> "CellResponse":
        """Build the response from a localizer's cell."""
        return cls(**_common_fields(cls, cell), **_origin(localizer))


class CellsResponse(_Out):
    """A page of the map's cells, in the map's order."""

    cells: tuple[CellSummary, ...]
    total: int = Field(description="number of cells of the map")
    next: str | None = Field(description="path of the next page; null on the last one")
    crs: CrsOut
    provenance: Provenance


class Health(_Out):
    """The state of the process or the service."""

    status: str


class Limits(_Out):
    """The limits of the service."""

    max_bytes: int = Field(description="size of a body; POST /localize/batch accepts four times as much")
    max_evaluate_bytes: int
    max_characters: int
    max_hints: int
    max_items: int = Field(description="items of one POST /localize/batch")
    max_rows: int = Field(description="rows of one POST /localize/batch with a CSV table")
    max_top_k: int
    max_vertices: int = Field(description="vertices of the polygons of one `within`")
    max_queue: int
    max_wait_ms: int = Field(description="longest expected wait for a worker; a longer one is refused with 429")
    max_queries: int = Field(description="queries of one evaluation")
    max_jobs: int = Field(description="waiting evaluations")
    deadline_ms: int = Field(description="deadline of a request that sends none")
    max_deadline_ms: int

    @classmethod
    def from_settings(cls, settings: Settings) -> "Limits":
        """Return the limits of a service with these settings."""
        return cls(
            max_bytes=limits.MAX_BODY_BYTES,
            max_evaluate_bytes=limits.MAX_EVALUATE_BODY_BYTES,
            max_characters=limits.MAX_DESCRIPTION_CHARACTERS,
            max_hints=limits.MAX_HINTS,
            max_items=limits.MAX_BATCH_ITEMS,
            max_rows=limits.MAX_BATCH_ROWS,
            max_top_k=limits.MAX_TOP_K,
            max_vertices=limits.MAX_VERTICES,
            max_queue=limits.MAX_WAITING_QUERIES,
            max_wait_ms=settings.max_wait_ms,
            max_queries=limits.MAX_EVALUATE_QUERIES,
            max_jobs=limits.MAX_WAITING_JOBS,
            deadline_ms=limits.DEFAULT_DEADLINE_MS,
            max_deadline_ms=limits.MAX_DEADLINE_MS,
        )


class IndexInfo(_Out):
    """A served index."""

    num_cells: int
    num_instances: int
    dim: int
    scenery_parts: int = Field(description="number of parts of GET /maps/{map}/points")
    created: str
    crs: CrsOut
    provenance: Provenance

    @classmethod
    def build(cls, localizer: LocalizerLike) -> "IndexInfo":
        """Describe the index of a localizer."""
        return cls(**_common_fields(cls, localizer.facts), **_origin(localizer))


class MapResponse(_Out):
    """A served map."""

    model_config = ConfigDict(json_schema_extra={"examples": [MAP]})

    name: str
    num_cells: int
    num_instances: int
    summary: MapSummary | None = Field(description="null for a data set, which has no names")
    crs: CrsOut
    provenance: Provenance

    @classmethod
    def build(cls, localizer: LocalizerLike) -> "MapResponse":
        """Describe the map of a localizer."""
        return cls(name=localizer.facts.map_name, **_common_fields(cls, localizer.facts), **_origin(localizer))


class InfoResponse(_Out):
    """The service, its limits, its indexes and its data sets."""

    service: str
    version: str
    key_required: bool = Field(
        description="whether all paths except this one, the page, /healthz, /readyz and /metrics need the read key"
    )
    limits: Limits
    index: IndexInfo | None = Field(description="the default index; null until it is loaded")
    indexes: list[str] = Field(description="values of `index` in requests")
    data_sets: list[str] = Field(description="values of `data` in POST /evaluate")
    corrections: bool = Field(description="whether POST /corrections stores corrections of the default index")
