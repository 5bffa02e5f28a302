"""A localizer without a model: what a test needs to see what reached it, to hold it up and to make it fail."""

import threading
from dataclasses import replace

from index.answering.answers import (
    Answer,
    Candidate,
    CellDetail,
    CellInstance,
    CellSummary,
    Described,
    Estimate,
    Fact,
    IndexFacts,
    LatLon,
    LikelyPlace,
    ModelName,
    Radius,
)
from models.citymap.frame import Frame

MADE_IT, ANSWERED = ModelName("fake", "ab" * 32), ModelName("posterior/fake", "cd" * 32)
BOX_M = (-1000.0, -1000.0, 1000.0, 1000.0)
ADDRESS = {"house_number": "1", "road": "Main Street", "city": "Fakeville", "postcode": "00100"}
TRUE_FRAME = Frame("map", 60.17, 24.94)


class FakeLocalizer:
    """Answers with two cells. Words in the description steer it: "bad", "nan" and "nowhere"; unless it is `Steady`."""

    is_steered = True

    facts = IndexFacts(
        "v1", "2026-01-01T00:00:00+00:00", "fakeville", "© nobody", ModelName("fake", "ab" * 32), 2, 3, 8, 1, BOX_M
    )

    def __init__(self, frame=TRUE_FRAME, parts=()):
        self.parts = parts
        self.frame = frame
        self.batches = []  # queries of each call, in order
        self.threads = set()
        self.positions = []  # that were to be described, in order
        self.is_closed = False
        self.gate = threading.Event()  # cleared: localize and describe block
        self.gate.set()
        self.entered = threading.Semaphore(0)

    def localize(self, queries):
        self.batches.append(list(queries))
        self.threads.add(threading.current_thread().name)
        self.entered.release()
        assert self.gate.wait(60), "a test left the gate closed"
        for query in queries:
            if self._is_told("bad", query):
                raise RuntimeError("secret: " + query.description)
        return [replace(self._answer(query), language=query.language or "en") for query in queries]

    def describe(self, position_m, language=None):
        self.positions.append(position_m)
        self.threads.add(threading.current_thread().name)
        assert self.gate.wait(60), "a test left the gate closed"
        if max(map(abs, position_m)) > 1000:
            return None
        tree = Fact("A green tree is 3 m to my east.", "tree", None, "node/1", (3.0, 0.0), 3.0, 90.0)
        road = Fact("I stand on the road.", "road", "Main Street", "way/2", position_m, 0.0, None)
        text = f"{tree.text} {road.text}"
        place = "Main Streetillä" if language == "fi" else "on Main Street"
        return Described(text, (tree, road), place, position_m, self._wgs84(), "fakeville_00001", ADDRESS)

    def position_of(self, source_id):
        return {"node/1": (3.0, 0.0), "way/2": (0.0, 0.0), "way/3": (5000.0, 0.0)}.get(source_id)

    def cell(self, cell_id):
        if cell_id != "fakeville_00001":
            return None
        tree = CellInstance("tree", None, "node/1", "green", 12, (1.0, 2.0, 3.0), (2.0, 2.0, 6.0), (0.5, 1.0, 0.0))
        return CellDetail(cell_id, "fakeville", (0.0, 0.0, 1.0), (-15.0, -15.0, 15.0, 15.0), self._wgs84(), (tree,))

    def close(self):
        self.is_closed = True

    def cells(self, first, count):
        listed = [
            CellSummary(
                f"fakeville_0000{n}", "fakeville", (0.0, 0.0, 1.0), (-15.0, -15.0, 15.0, 15.0), self._wgs84(), n
            )
            for n in (1, 2)
        ]
        return listed[first : first + count]

    def scenery(self, number):
        return self.parts[number] if number < len(self.parts) else None

    def _is_told(self, word, query):
        return self.is_steered and word in query.description

    def _answer(self, query):
        timings = {"encode": 1.0, "search": 1.0, "estimate": 1.0}
        if self._is_told("nowhere", query):
            return Answer("no_match", ANSWERED, warnings=("nothing there",), timings_ms=timings)
        probability = float("nan") if self._is_told("nan", query) else 0.6
        box = (-15.0, -15.0, 15.0, 15.0)
        candidates = tuple(
            Candidate(rank, f"fakeville_0000{rank}", 0.9, p, (0.0, 0.0), box, (1.0, 2.0), self._wgs84())
            for rank, p in ((1, probability), (2, 0.3))
        )[: query.top_k]
        covariance = ((100.0, 0.0), (0.0, 100.0))
        estimate = Estimate(
            (0.0, 0.0),
            "cell_center",
            covariance,
            Radius(12.0, 21.0),
            {10: 0.4, 30: 0.9, 100: 0.95, 250: 0.98},
            probability,
            self._wgs84(),
        )
        places = tuple(
            LikelyPlace(p, (x, 0.0), self._wgs84(), 15.0, None, ("tree: 3 m to the east",), source_id=source_id)
            for x, p, source_id in ((0.0, 0.8, "node/1"), (90.0, 0.1, "bins.geojson/3"))
        )
        return Answer("ok", ANSWERED, estimate, candidates, 0.1, places, timings_ms=timings)

    def _wgs84(self):
        return LatLon(60.17, 24.94) if self.frame.is_georeferenced else None


class Steady(FakeLocalizer):
    """Answers whatever it is asked: who makes texts by chance makes "unanswered", too."""

    is_steered = False
