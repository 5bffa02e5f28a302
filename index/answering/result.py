"""The result of a localizer, and the one function that turns it into an answer."""

import time
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
    LikelyPlace,
    Method,
    ModelName,
    Question,
    Radius,
)
from index.answering.evidence import calibrated_evidence
from index.answering.evidence_text import speaks_for
from index.answering.query import Query
from models.citymap.cells import CellTable
from models.citymap.frame import Frame
from models.citymap.gazetteer.name_columns import STREET_KIND
from models.citymap.types import Floats
from models.posterior.distribution import PositionDistribution

SURE_WITHIN = ((30.0, 0.5), (100.0, 0.9))  # metres, and the probability of being within them that "ok" needs
WITHIN_M = (10, 30, 100, 250)  # of `Estimate.within_m`
MAX_HEAT_POINTS, HEAT_MASS = 500, 0.95  # points of a heat map, and the mass they hold at least


@dataclass(frozen=True, slots=True, eq=False)
class PlaceView:
    """A place as a localizer explains it."""

    place: str | None = None  # its position in words
    evidence: tuple[Evidence, ...] = ()  # one entry per hint, if the localizer gives any


@dataclass(frozen=True, slots=True, eq=False)
class LocalizerResult:
    """The result of one query."""

    located: PositionDistribution | None  # None without usable text or without cells to search
    refusal: str | None = None  # why there is no match, and what to do about it; None if there is one
    views: tuple[PlaceView, ...] = ()  # one per mode, if the localizer explains them
    timings_ms: dict[str, float] = field(default_factory=dict)
    heading: Heading | None = None
    warnings: tuple[str, ...] = ()  # sentences for the caller
    question: Question | None = None  # the follow-up question of an ambiguous or refused text
    language: str = "en"  # of its texts


class CellLocalizer(Protocol):
    """A way to localize in one gallery."""

    @property
    def method(self) -> Method:
        """Return the method that finds positions."""

    @property
    def model(self) -> ModelName:
        """Return the model behind the positions."""

    def find(self, queries: Sequence[Query]) -> list[LocalizerResult]:
        """Return one result per query, in order; texts are encoded in batches."""


def to_answer(
    query: Query, result: LocalizerResult, localizer: CellLocalizer, cells: CellTable, frame: Frame
) -> Answer:
    """Turn a localizer's result into an answer."""
    located = result.located
    view = result.views[0] if result.views else PlaceView()
    evidence = view.evidence if located is None else calibrated_evidence(view.evidence, located)
    if located is None or result.refusal is not None:
        return Answer(
            "no_match",
            localizer.model,
            warnings=(*((result.refusal,) if result.refusal else ()), *result.warnings),
            timings_ms=result.timings_ms,
            evidence=evidence,
            question=result.question,
            language=result.language,
        )
    p50, p90 = located.radii_m(0.5, 0.9)
    covariance = located.covariance_m2()
    estimate = Estimate(
        position=pair(located.positions[0]),
        method=localizer.method,
        covariance=(pair(covariance[0]), pair(covariance[1])),
        radius_m=Radius(p50, p90),
        within_m={metres: round(located.probability_within(metres), 4) for metres in WITHIN_M},
        probability=float(located.probability[0]),
        wgs84=LatLon.from_position(located.positions[0], frame),
        place=view.place,
        heading=result.heading,
    )
    listed = range(min(query.top_k, len(located.rows)))
    candidates = tuple(_candidate(located, n, cells, frame) for n in listed)
    return Answer(
        status="ambiguous" if is_ambiguous(located) else "ok",
        model=localizer.model,
        estimate=estimate,
        candidates=candidates,
        other_probability=max(0.0, 1.0 - sum(candidate.probability for candidate in candidates)),
        places=_places(located, result.views, frame),
        warnings=result.warnings,
        timings_ms=result.timings_ms,
        evidence=evidence,
        heat_map=_heat_map(located) if query.heat_map else None,
        question=result.question,
        language=result.language,
    )


def is_ambiguous(located: PositionDistribution) -> bool:
    """Return whether the speaker may well be elsewhere than at the estimate (docs/method.md, status)."""
    return any(located.probability_within(metres) < probability for metres, probability in SURE_WITHIN)


def _places(located: PositionDistribution, views: Sequence[PlaceView], frame: Frame) -> tuple[LikelyPlace, ...]:
    """Return the modes of a distribution with what speaks for and against each."""
    views = views or [PlaceView()] * len(located.modes)
    return tuple(
        LikelyPlace(
            probability=mode.probability,
            position=pair(mode.position_m),
            wgs84=LatLon.from_position(mode.position_m, frame),
            radius_m=min(mode.radius_m, located.extent_m),
            place=view.place,
            supports=tuple(one.fit for one in view.evidence if speaks_for(one)),
            contradicts=tuple(one.fit for one in view.evidence if not speaks_for(one)),
            source_id=_best_named_place(view.evidence),
        )
        for mode, view in zip(located.modes, views, strict=True)
    )


def _best_named_place(evidence: Sequence[Evidence]) -> str | None:
    """Return the source of the named place that speaks most for a position; rather no street, and no district."""
    named = [one for one in evidence if one.exact is not None and one.source_id and not one.absent and speaks_for(one)]
    named.sort(key=lambda one: (one.instance is not None, one.instance != STREET_KIND, one.exact, one.explained))
    return named[-1].source_id if named else None


def _candidate(located: PositionDistribution, n: int, cells: CellTable, frame: Frame) -> Candidate:
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
        wgs84=LatLon.from_position(located.positions[n], frame),
    )


def _heat_map(located: PositionDistribution) -> HeatMap:
    """Return the finest squares of which a few hold most of the distribution."""
    spacing_m, points_m, weight = located.spacing_m, located.points_m, located.weight
    order = np.argsort(-weight, kind="stable")[:MAX_HEAT_POINTS]
    while weight[order].sum() < HEAT_MASS * weight.sum():
        spacing_m *= 2
        squares, square = np.unique(np.floor(located.points_m / spacing_m), axis=0, return_inverse=True)
        points_m, weight = (squares + 0.5) * spacing_m, np.bincount(square.ravel(), located.weight).astype(np.float64)
        order = np.argsort(-weight, kind="stable")[:MAX_HEAT_POINTS]
    rows = np.column_stack([points_m[order], weight[order]])
    return HeatMap(spacing_m, tuple((round(x, 2), round(y, 2), p) for x, y, p in rows.tolist()))


def elapsed_ms(start_s: float) -> float:
    """Return the milliseconds since a `time.perf_counter()`."""
    return (time.perf_counter() - start_s) * 1000


def pair(values: Floats) -> tuple[float, float]:
    """Return the first two numbers."""
    return float(values[0]), float(values[1])
