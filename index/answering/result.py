"""What a localizer finds for a query, and the one function that makes an answer of it."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from index.answering.answers import (
    Answer,
    Candidate,
    Estimate,
    Evidence,
    Heading,
    HeatMap,
    LatLon,
    Method,
    ModelName,
    Question,
    Radius,
)
from index.answering.query import Query
from models.citymap.cells import CellTable
from models.citymap.frame import Frame
from models.citymap.types import Floats
from models.posterior.distribution import Located

HEAT_POINTS, HEAT_HELD = 500, 0.95  # squares of a heat map, and what they hold of the distribution at least


@dataclass(frozen=True, slots=True, eq=False)
class Finding:
    """What was found for one query.

    Attributes:
        located: the distribution; None if there is nothing to tell it from, or nowhere to look.
        refusal: why there is no match, and what to do; None if there is one.
        evidence: one a hint, where the localizer knows.
        timings_ms: "encode", "search", "estimate".
        place: the position in words.
        heading: where the speaker looks.
        warnings: what the caller should know.
        question: what to ask if that is ambiguous, or refused.
    """

    located: Located | None
    refusal: str | None = None
    evidence: tuple[Evidence, ...] = ()
    timings_ms: dict[str, float] = field(default_factory=dict)
    place: str | None = None
    heading: Heading | None = None
    warnings: tuple[str, ...] = ()
    question: Question | None = None


class CellLocalizer(Protocol):
    """One way to localize on one gallery."""

    @property
    def method(self) -> Method:
        """How positions are found."""
        ...

    @property
    def model(self) -> ModelName:
        """The model that positions come from."""
        ...

    def find(self, queries: Sequence[Query]) -> list[Finding]:
        """One finding a query, in order; several texts go through a model together."""
        ...


def to_answer(query: Query, finding: Finding, localizer: CellLocalizer, cells: CellTable, frame: Frame) -> Answer:
    """The answer to a query.

    Args:
        query: what was asked.
        finding: what was found.
        localizer: what found it.
        cells: the gallery.
        frame: of the map.
    """
    located = finding.located
    if located is None or finding.refusal is not None:
        return Answer(
            "no_match",
            localizer.model,
            warnings=(*((finding.refusal,) if finding.refusal else ()), *finding.warnings),
            timings_ms=finding.timings_ms,
            evidence=finding.evidence,
            question=finding.question,
        )
    p50, p90 = located.radii_m(0.5, 0.9)
    covariance = located.covariance_m2()
    estimate = Estimate(
        position=pair(located.positions[0]),
        method=localizer.method,
        covariance=(pair(covariance[0]), pair(covariance[1])),
        radius_m=Radius(p50, p90),
        probability=float(located.probability[0]),
        wgs84=LatLon.of(located.positions[0], frame),
        place=finding.place,
        heading=finding.heading,
    )
    listed = range(min(query.top_k, len(located.rows)))
    candidates = tuple(_candidate(located, n, cells, frame) for n in listed)
    return Answer(
        status="ambiguous" if is_ambiguous(p50, cells) else "ok",
        model=localizer.model,
        estimate=estimate,
        candidates=candidates,
        other_probability=max(0.0, 1.0 - sum(candidate.probability for candidate in candidates)),
        warnings=finding.warnings,
        timings_ms=finding.timings_ms,
        evidence=finding.evidence,
        heat_map=_heat_map(located) if query.heat_map else None,
        question=finding.question,
    )


def is_ambiguous(p50: float, cells: CellTable) -> bool:
    """Whether a text with this radius of 50 %, metres, fits several places."""
    return p50 > cells.size_m


def _candidate(located: Located, n: int, cells: CellTable, frame: Frame) -> Candidate:
    row = int(located.rows[n])
    x, y = pair(cells.center_m[row])
    half = cells.size_m / 2
    return Candidate(
        rank=n + 1,
        cell_id=cells.ids[row],
        score=float(located.score[n]),
        probability=float(located.probability[n]),
        center=(x, y),
        bbox=(x - half, y - half, x + half, y + half),
        position=pair(located.positions[n]),
        wgs84=LatLon.of(located.positions[n], frame),
    )


def _heat_map(located: Located) -> HeatMap:
    """Squares as fine as they can be for a few of them to hold what is known of the distribution."""
    spacing_m, points_m, weight = located.spacing_m, located.points_m, located.weight
    order = np.argsort(-weight, kind="stable")[:HEAT_POINTS]
    while weight[order].sum() < HEAT_HELD * weight.sum():
        spacing_m *= 2
        squares, square = np.unique(np.floor(located.points_m / spacing_m), axis=0, return_inverse=True)
        points_m, weight = (squares + 0.5) * spacing_m, np.bincount(square.ravel(), located.weight).astype(np.float64)
        order = np.argsort(-weight, kind="stable")[:HEAT_POINTS]
    rows = np.column_stack([points_m[order], weight[order]])
    return HeatMap(spacing_m, tuple((round(x, 2), round(y, 2), p) for x, y, p in rows.tolist()))


def pair(values: Floats) -> tuple[float, float]:
    """The first two numbers."""
    return float(values[0]), float(values[1])
