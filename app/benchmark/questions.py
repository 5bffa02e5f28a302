"""Queries of the growth benchmark: descriptions of places in copy 0, the same for every size, and their accuracy."""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TYPE_CHECKING, Any, Final

import httpx
import numpy as np

from app.benchmark.service import percentiles
from models.errors import MapError
from models.sources.osm.city_copies import CopyGrid

if TYPE_CHECKING:  # so that the command line starts without torch
    from models.sources.source import Source

QUERIES_PER_KIND = 200
WARM_UP = 10  # requests that are not measured
WITHIN: Final = {"within_0.1_percent": 0.001, "within_1_percent": 0.01, "within_10_percent": 0.1}  # shares of the area
RADII_M: Final = (5, 10, 30)


@dataclass(frozen=True, slots=True)
class BenchmarkQuery:
    """A description and its true position in degrees, with the name of the street there, if any."""

    hints: tuple[str, ...]
    street: str | None
    lat: float
    lon: float


@dataclass(frozen=True, slots=True)
class BenchmarkAnswers:
    """The seconds of answered queries, and [Q] (lat, lon) of the estimates, None without an estimate."""

    seconds: list[float]
    places: list[tuple[float, float] | None]

    def figures(self, queries: Sequence[BenchmarkQuery], block: CopyGrid) -> dict[str, Any]:
        """Return percentiles of latency in ms, the number of unanswered requests, and the accuracy."""
        seconds = percentiles(self.seconds) if self.seconds else {"p50": None, "p99": None}
        folded = [place and block.to_first_copy(*place) for place in self.places]
        return seconds | {
            "unanswered": len(queries) - len(self.seconds),
            "accuracy": _accuracy(queries, self.places),
            "accuracy_in_any_copy": _accuracy(queries, folded),
        }


def draw_queries(source: "Source") -> list[BenchmarkQuery]:
    """Draw the queries of `localize_all`, template descriptions without replacement, with a fixed seed."""
    from index.answering.place_text import nearest_street  # noqa: PLC0415 - heavy

    queries, gazetteer, rng = source.queries(), source.gazetteer(), np.random.default_rng(0)
    rows = rng.permutation(len(queries))[: WARM_UP + (1 + len(WITHIN)) * QUERIES_PER_KIND]
    lat, lon = source.data.frame.to_wgs84(queries.positions_m[rows])
    drawn = []
    for row, *place in zip(rows, lat.tolist(), lon.tolist(), strict=True):
        street = nearest_street(gazetteer, queries.positions_m[row])
        drawn.append(BenchmarkQuery(queries.sentences[row], street and gazetteer.objects[street[0]].names[0], *place))
    return drawn


def split_questions(
    questions: Sequence[BenchmarkQuery],
) -> tuple[Sequence[BenchmarkQuery], list[Sequence[BenchmarkQuery]]]:
    """Split queries into those for warm-up and an equal number for each kind of request, without repetition."""
    kinds = 1 + len(WITHIN)
    each = (len(questions) - WARM_UP) // kinds
    if each < 1:
        raise MapError(f"only {len(questions)} places of this map can be described; give a larger one as --map")
    rest = questions[WARM_UP:]
    return questions[:WARM_UP], [rest[n * each : (n + 1) * each] for n in range(kinds)]


def localize_all(client: httpx.Client, questions: Sequence[BenchmarkQuery], block: CopyGrid) -> dict[str, Any]:
    """Send all queries to the service of a tiled city, one after another; return the figures by kind of request.

    "with_street" adds the name of the street to the queries of "anywhere"; it has no latencies because hints are
    cached.
    """
    warm, (free, *boxed) = split_questions(questions)
    for question in warm:
        _ask(client, [question], [{}])
    figures = {"anywhere": _ask(client, free, [{}] * len(free)).figures(free, block)}
    for (name, share), group in zip(WITHIN.items(), boxed, strict=True):
        boxes = [{"within": {"bbox": _box(block, share, q)}, "crs": "wgs84"} for q in group]
        figures[name] = _ask(client, group, boxes).figures(group, block)
    streets = [{"hints": [*q.hints, f"I am on {q.street}."] if q.street else q.hints} for q in free]
    with_street = _ask(client, free, streets).figures(free, block)
    figures["with_street"] = {key: value for key, value in with_street.items() if key not in ("p50", "p99")}
    return figures


def _ask(
    client: httpx.Client, questions: Sequence[BenchmarkQuery], fields: Sequence[dict[str, Any]]
) -> BenchmarkAnswers:
    """Send queries, each with further fields of the request; failed requests have no answer."""
    answers = BenchmarkAnswers([], [])
    for question, extra_fields in zip(questions, fields, strict=True):
        start = time.perf_counter()
        try:
            answer = client.post("/localize", json={"hints": question.hints} | extra_fields)
            answer.raise_for_status()
        except httpx.HTTPError:
            answers.places.append(None)
            continue
        answers.seconds.append(time.perf_counter() - start)
        place = (answer.json()["estimate"] or {}).get("wgs84")
        answers.places.append(place and (place["lat"], place["lon"]))
    return answers


def _box(block: CopyGrid, share: float, question: BenchmarkQuery) -> list[float]:
    """Return west, south, east, north of a box around a place, inside the block and with a share of its area."""
    west, south, east, north = block.bounds()
    low, high = [], []
    for center, first, last in ((question.lon, west, east), (question.lat, south, north)):
        size = (last - first) * share**0.5
        begin = min(max(center - size / 2, first), last - size)
        low.append(begin)
        high.append(begin + size)
    return list(chain(low, high))


def _accuracy(queries: Sequence[BenchmarkQuery], places: Sequence[tuple[float, float] | None]) -> dict[str, Any]:
    """Return the shares of errors within each radius and the median error; None if most have no answer."""
    from pyproj import Geod  # noqa: PLC0415 - heavy

    earth = Geod(ellps="WGS84")
    errors = np.array(
        [
            np.inf if place is None else earth.inv(q.lon, q.lat, place[1], place[0])[2]
            for q, place in zip(queries, places, strict=True)
        ]
    )
    median = float(np.median(errors))
    shares = {f"within_{radius}_m": round(float((errors <= radius).mean()), 3) for radius in RADII_M}
    return {"queries": len(queries), **shares, "median_m": round(median, 1) if np.isfinite(median) else None}
