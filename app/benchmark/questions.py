"""What a growing city is asked, descriptions of places of its copy 0, the same at every size; how well it answers."""

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
    from models.citymap.gazetteer.gazetteer import Gazetteer
    from models.sources.source import Source

QUERIES = 200  # of each sort
WARM_UP = 10  # requests that are not counted
WITHIN: Final = {"within_0.1_percent": 0.001, "within_1_percent": 0.01, "within_10_percent": 0.1}  # shares of the area
RADII_M: Final = (5, 10, 30)


@dataclass(frozen=True, slots=True)
class Question:
    """A description and where it was said.

    Attributes:
        hints: its sentences.
        street: on which street that is; None where none is near.
        lat, lon: degrees.
    """

    hints: tuple[str, ...]
    street: str | None
    lat: float
    lon: float


@dataclass(frozen=True, slots=True)
class Answers:
    """What became of Q questions.

    Attributes:
        seconds: of each one that was answered.
        places: [Q] (lat, lon) of the estimates; None where there is none.
    """

    seconds: list[float]
    places: list[tuple[float, float] | None]

    def figures(self, asked: Sequence[Question], block: CopyGrid) -> dict[str, Any]:
        """Latencies, and how near the estimates are.

        Returns:
            "p50" and "p99" in milliseconds (None without an answer), "unanswered" requests, "accuracy" and
            "accuracy_in_any_copy": by this a place counts as right in whichever copy it is.
        """
        seconds = percentiles(self.seconds) if self.seconds else {"p50": None, "p99": None}
        folded = [place and block.to_first_copy(*place) for place in self.places]
        return seconds | {
            "unanswered": len(asked) - len(self.seconds),
            "accuracy": _accuracy(asked, self.places),
            "accuracy_in_any_copy": _accuracy(asked, folded),
        }


def take_questions(source: "Source") -> list[Question]:
    """Questions in the benchmark's words about places of a map, drawn without replacement, always the same.

    Args:
        source: of the map, or of a split of it.

    Returns:
        As many as `ask_all` takes, or fewer where the map has fewer.
    """
    from index.answering.place_text import nearest_street  # noqa: PLC0415 - heavy

    queries, gazetteer, rng = source.queries(), source.gazetteer(), np.random.default_rng(0)
    rows = rng.permutation(len(queries))[: WARM_UP + (1 + len(WITHIN)) * QUERIES]
    lat, lon = source.data.frame.to_wgs84(queries.positions_m[rows])
    found = []
    for row, *place in zip(rows, lat.tolist(), lon.tolist(), strict=True):
        street = nearest_street(gazetteer, queries.positions_m[row])
        found.append(Question(queries.sentences[row], street and _name(gazetteer, street[0]), *place))
    return found


def _name(gazetteer: "Gazetteer", number: int) -> str:
    return gazetteer.objects[number].names[0]


def shared_out(questions: Sequence[Question]) -> tuple[Sequence[Question], list[Sequence[Question]]]:
    """Questions to warm up with, and as many for each sort of request, so that none comes twice.

    Raises:
        MapError: there are too few.
    """
    sorts = 1 + len(WITHIN)
    each = (len(questions) - WARM_UP) // sorts
    if each < 1:
        raise MapError(f"only {len(questions)} places of this map can be described; give a larger one as --map")
    rest = questions[WARM_UP:]
    return questions[:WARM_UP], [rest[n * each : (n + 1) * each] for n in range(sorts)]


def ask_all(client: httpx.Client, questions: Sequence[Question], block: CopyGrid) -> dict[str, Any]:
    """Ask a service of a tiled city, one request after another.

    Args:
        client: of the service.
        questions: as `take_questions` gives them.
        block: how the copies of the city lie.

    Returns:
        By sort of request ("anywhere", "within_..._percent" of the block's area, "with_street" for those of
        "anywhere" again with the name of the street, without latencies since the hints are not new) what
        `Answers.figures` says.
    """
    warm, (free, *boxed) = shared_out(questions)
    for question in warm:
        _ask(client, [question], [{}])
    found = {"anywhere": _ask(client, free, [{}] * len(free)).figures(free, block)}
    for (name, share), some in zip(WITHIN.items(), boxed, strict=True):
        boxes = [{"within": {"bbox": _box(block, share, q)}, "crs": "wgs84"} for q in some]
        found[name] = _ask(client, some, boxes).figures(some, block)
    streets = [{"hints": [*q.hints, f"I am on {q.street}."] if q.street else q.hints} for q in free]
    told = _ask(client, free, streets).figures(free, block)
    found["with_street"] = {key: value for key, value in told.items() if key not in ("p50", "p99")}
    return found


def _ask(client: httpx.Client, questions: Sequence[Question], fields: Sequence[dict[str, Any]]) -> Answers:
    """The answers to questions, each with more fields of its request; one that fails has none."""
    answers = Answers([], [])
    for question, more in zip(questions, fields, strict=True):
        start = time.perf_counter()
        try:
            answer = client.post("/localize", json={"hints": question.hints} | more)
            answer.raise_for_status()
        except httpx.HTTPError:
            answers.places.append(None)
            continue
        answers.seconds.append(time.perf_counter() - start)
        place = (answer.json()["estimate"] or {}).get("wgs84")
        answers.places.append(place and (place["lat"], place["lon"]))
    return answers


def _box(block: CopyGrid, share: float, question: Question) -> list[float]:
    """West, south, east, north: a share of a block's area round a place, all of it inside the block."""
    west, south, east, north = block.bounds()
    low, high = [], []
    for at, first, last in ((question.lon, west, east), (question.lat, south, north)):
        size = (last - first) * share**0.5
        begin = min(max(at - size / 2, first), last - size)
        low.append(begin)
        high.append(begin + size)
    return list(chain(low, high))


def _accuracy(asked: Sequence[Question], places: Sequence[tuple[float, float] | None]) -> dict[str, Any]:
    """Shares within some metres, and the median error; None where most have no answer."""
    from pyproj import Geod  # noqa: PLC0415 - heavy

    earth = Geod(ellps="WGS84")
    errors = np.array(
        [
            np.inf if place is None else earth.inv(q.lon, q.lat, place[1], place[0])[2]
            for q, place in zip(asked, places, strict=True)
        ]
    )
    median = float(np.median(errors))
    shares = {f"within_{radius}_m": round(float((errors <= radius).mean()), 3) for radius in RADII_M}
    return {"queries": len(asked), **shares, "median_m": round(median, 1) if np.isfinite(median) else None}
