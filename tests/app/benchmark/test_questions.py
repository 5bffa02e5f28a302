"""Queries to a tiled city, and the scores of its answers."""

import json

import httpx
import numpy as np
import pytest
from pyproj import Geod

from app.benchmark import questions
from app.benchmark.questions import BenchmarkQuery, draw_queries, localize_all, split_questions
from models.sources.osm.city_copies import CopyGrid

BOX = 250_000_000, 600_000_000, 250_100_000, 600_050_000  # 0.01 by 0.005 degrees
BLOCK = CopyGrid(BOX, 4)
LAT, LON = 60.0025, 25.0050
FAR = 0.001  # degrees of latitude, some 111 m


@pytest.fixture
def benchmark_queries(monkeypatch) -> list[BenchmarkQuery]:
    monkeypatch.setattr(questions, "QUERIES_PER_KIND", 4)
    monkeypatch.setattr(questions, "WARM_UP", 1)
    return [BenchmarkQuery((f"hint {n}",), "High Road" if n % 2 else None, LAT, LON) for n in range(17)]


def ask(benchmark_queries, answer) -> tuple[dict, list[dict]]:
    """Run `localize_all` on a service that answers by `answer` (body -> estimate or status); return also the bodies."""
    bodies = []

    def respond(request: httpx.Request) -> httpx.Response:
        bodies.append(json.loads(request.content))
        figures = answer(bodies[-1])
        return httpx.Response(figures) if isinstance(figures, int) else httpx.Response(200, json={"estimate": figures})

    with httpx.Client(transport=httpx.MockTransport(respond), base_url="http://a") as client:
        return localize_all(client, benchmark_queries, BLOCK), bodies


def estimate_at(lat, lon) -> dict:
    return {"wgs84": {"lat": lat, "lon": lon}}


def test_a_right_place_in_another_copy_is_right_in_any_copy_alone(benchmark_queries) -> None:
    east, north = (units / 1e7 for units in BLOCK.shift(3))
    assert east > 0 or north > 0
    figures, _ = ask(
        benchmark_queries,
        lambda body: estimate_at(LAT + north, LON + east) if "within" not in body else estimate_at(LAT, LON),
    )
    free, boxed = figures["anywhere"], figures["within_1_percent"]
    assert free["accuracy"]["within_30_m"] == 0
    assert free["accuracy"]["median_m"] == pytest.approx(
        Geod(ellps="WGS84").inv(LON, LAT, LON + east, LAT + north)[2], 1e-3
    )
    assert free["accuracy_in_any_copy"] == {
        "queries": 4, "within_5_m": 1, "within_10_m": 1, "within_30_m": 1, "median_m": 0,
    }  # fmt: skip
    assert boxed["accuracy"] == boxed["accuracy_in_any_copy"] == free["accuracy_in_any_copy"]


def test_shares_and_median_are_of_all_that_was_asked(benchmark_queries) -> None:
    places = iter(
        [estimate_at(LAT, LON), estimate_at(LAT, LON), estimate_at(LAT + FAR / 5, LON), None, 503] + [429] * 100
    )
    figures, _ = ask(benchmark_queries, lambda body: next(places))
    free = figures["anywhere"]  # after one to warm up with
    assert free["unanswered"] == 1
    assert free["accuracy"] == {
        "queries": 4, "within_5_m": 0.25, "within_10_m": 0.25, "within_30_m": 0.5, "median_m": None,
    }  # fmt: skip
    boxed = figures["within_10_percent"]
    assert boxed["unanswered"] == 4
    assert boxed["p50"] is None


def test_no_text_is_sent_twice_but_with_its_street(benchmark_queries) -> None:
    _, bodies = ask(benchmark_queries, lambda body: estimate_at(LAT, LON))
    first, streets = bodies[:-4], bodies[-4:]
    assert len({tuple(body["hints"]) for body in first}) == len(first) == 17
    assert [body["hints"] for body in streets] == [["hint 1", "I am on High Road."], ["hint 2"],
                                                   ["hint 3", "I am on High Road."], ["hint 4"]]  # fmt: skip


def test_boxes_are_a_share_of_the_block_round_the_place_and_inside_it(benchmark_queries) -> None:
    _, bodies = ask(
        [*benchmark_queries[:-1], BenchmarkQuery(("corner",), None, BOX[1] / 1e7, BOX[0] / 1e7)],
        lambda body: estimate_at(LAT, LON),
    )
    west, south, east, north = BLOCK.bounds()
    shares = []
    for body in bodies:
        if "within" not in body:
            continue
        low_x, low_y, high_x, high_y = body["within"]["bbox"]
        assert body["crs"] == "wgs84"
        shares.append((high_x - low_x) * (high_y - low_y) / (east - west) / (north - south))
        place = (BOX[0] / 1e7, BOX[1] / 1e7) if body["hints"] == ["corner"] else (LON, LAT)
        assert low_x <= place[0] <= high_x
        assert low_y <= place[1] <= high_y
        assert west <= low_x < high_x <= east + 1e-9
        assert south <= low_y < high_y <= north + 1e-9
    assert shares == pytest.approx([0.001] * 4 + [0.01] * 4 + [0.1] * 4)


def test_questions_are_of_the_split_and_always_the_same(source, regions) -> None:
    one, two = draw_queries(regions[0]), draw_queries(regions[0])
    assert one == two
    assert len({question.hints for question in one}) > 0.9 * len(one)
    assert {question.street for question in one} <= {
        None, *(f"East Street {n}" for n in range(6)), *(f"North Path {n}" for n in range(6))
    }  # fmt: skip
    assert sum(question.street is not None for question in one) > 0.9 * len(one)
    queries = regions[0].queries()
    place = source.data.frame.from_wgs84(np.array(one[0].lat), np.array(one[0].lon))
    near = int(np.hypot(*(queries.positions_m - place).T).argmin())
    assert queries.positions_m[near] == pytest.approx(place, abs=1e-6)
    assert queries.sentences[near] == one[0].hints
    warm, sorts = split_questions(one)
    assert len(warm) == questions.WARM_UP
    assert len({len(kinds) for kinds in sorts}) == 1
