"""What the service answers: the localizer's dataclasses with what the service knows besides; NaN is refused."""

from dataclasses import fields

from pydantic import BaseModel, ConfigDict, Field

from app import limits
from app.http.protocol import LocalizerLike
from app.http.schemas.examples import ANSWERED, DESCRIBED
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
    ModelName,
    Question,
    Status,
)
from index.build.artifact import DEFAULT_ALIAS
from models.citymap.frame import Frame


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
    def of(cls, localizer: LocalizerLike, model: ModelName | None = None, index: str = DEFAULT_ALIAS) -> "Provenance":
        """Of what a localizer answers.

        Args:
            localizer: what answers.
            model: what it answered with; None for the one that made the index.
            index: the name by which it was asked.
        """
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


class LocalizeResponse(_Out):
    """The answer to one description."""

    model_config = ConfigDict(json_schema_extra={"examples": [ANSWERED]})

    request_id: str
    status: Status
    estimate: Estimate | None = Field(description="null only with status no_match")
    candidates: tuple[Candidate, ...] = Field(description="best first")
    other_probability: float = Field(description="mass outside the listed candidates")
    evidence: tuple[Evidence, ...] = Field(description="one a hint; empty unless refine is posterior")
    heat_map: HeatMap | None = Field(description="if it was asked for")
    ros: PoseWithCovarianceStamped | None = Field(None, description="if it was asked for, and there is an estimate")
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
        cls,
        answer: Answer,
        localizer: LocalizerLike,
        request_id: str,
        timings_ms: dict[str, float],
        index: str = DEFAULT_ALIAS,
    ) -> "LocalizeResponse":
        """Of a localizer's answer.

        Args:
            answer: what was found.
            localizer: what found it.
            request_id: of the request.
            timings_ms: the service's own, shown with the localizer's.
            index: the name by which it was asked.
        """
        found = {f.name: getattr(answer, f.name) for f in fields(answer) if f.name != "model"}
        found["timings_ms"] = {**answer.timings_ms, **timings_ms}
        crs, provenance = CrsOut.of(localizer.frame), Provenance.of(localizer, answer.model, index)
        return cls(request_id=request_id, crs=crs, provenance=provenance, **found)


class DescribeResponse(_Out):
    """What the map says at a position; metres, map frame."""

    model_config = ConfigDict(json_schema_extra={"examples": [DESCRIBED]})

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
        cls,
        described: Described,
        localizer: LocalizerLike,
        request_id: str,
        timings_ms: dict[str, float],
        index: str = DEFAULT_ALIAS,
    ) -> "DescribeResponse":
        """Of what a localizer says of a position; the rest as `LocalizeResponse.of`."""
        said = {f.name: getattr(described, f.name) for f in fields(described)}
        crs, provenance = CrsOut.of(localizer.frame), Provenance.of(localizer, index=index)
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


class CellsResponse(_Out):
    """Some of the map's cells, in its order."""

    cells: tuple[CellSummary, ...]
    total: int = Field(description="of the map")
    next: str | None = Field(description="the path of those that follow; null at the end")
    crs: CrsOut
    provenance: Provenance


class Health(_Out):
    """Whether the process runs, or the service is ready."""

    status: str


class Limits(_Out):
    """What a client can run into."""

    max_bytes: int = Field(description="of a body; POST /localize/batch takes four times as many")
    max_evaluate_bytes: int
    max_characters: int
    max_hints: int
    max_items: int = Field(description="of one POST /localize/batch")
    max_top_k: int
    max_queue: int
    max_wait_ms: int = Field(description="that a request may be expected to wait for the model")
    max_queries: int = Field(description="of one evaluation")
    max_jobs: int = Field(description="evaluations that wait")
    deadline_ms: int = Field(description="of a request that names none")
    max_deadline_ms: int

    @classmethod
    def of(cls, settings: Settings) -> "Limits":
        """Return the limits of a service with these settings."""
        return cls(
            max_bytes=limits.MAX_BODY_BYTES,
            max_evaluate_bytes=limits.MAX_EVALUATE_BODY_BYTES,
            max_characters=limits.MAX_DESCRIPTION_CHARACTERS,
            max_hints=limits.MAX_HINTS,
            max_items=limits.MAX_BATCH_ITEMS,
            max_top_k=limits.MAX_TOP_K,
            max_queue=limits.MAX_WAITING_QUERIES,
            max_wait_ms=settings.max_wait_ms,
            max_queries=limits.MAX_EVALUATE_QUERIES,
            max_jobs=limits.MAX_WAITING_JOBS,
            deadline_ms=limits.DEFAULT_DEADLINE_MS,
            max_deadline_ms=limits.MAX_DEADLINE_MS,
        )


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
    index: IndexInfo | None = Field(description="the one that is asked by default; null until it is loaded")
    indexes: list[str] = Field(description="names that requests take as index")
    data_sets: list[str] = Field(description="names that POST /evaluate takes as data")
