"""Prometheus metrics: requests and their time by route, queues by index. Labels are route templates, never input."""

from collections.abc import Iterator
from typing import Final

from prometheus_client import CONTENT_TYPE_LATEST, CollectorRegistry, Counter, Histogram, generate_latest
from prometheus_client.core import GaugeMetricFamily
from prometheus_client.registry import Collector
from starlette.responses import Response

from app.http.indexes import Indexes

BUCKETS: Final = (0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0)
OTHER: Final = "other"  # label of unknown routes and unusual methods
METHODS: Final = frozenset({"GET", "HEAD", "POST", "DELETE", "OPTIONS"})


def known_method(method: str) -> str:
    """Return a method as a label; a client may send any word as a method."""
    return method if method in METHODS else OTHER


class Metrics:
    """The metrics of one application; the queues of its indexes are read at each scrape."""

    def __init__(self, indexes: Indexes) -> None:
        self._registry = CollectorRegistry()
        self._requests = Counter(
            "hereabouts_requests", "answered requests", ("method", "route", "status"), registry=self._registry
        )
        self._seconds = Histogram(
            "hereabouts_request_seconds", "seconds to answer", ("route",), buckets=BUCKETS, registry=self._registry
        )
        self._registry.register(_Queues(indexes))

    def record(self, method: str, route: str, status: int, seconds: float) -> None:
        """Count a request."""
        self._requests.labels(known_method(method), route, str(status)).inc()
        self._seconds.labels(route).observe(seconds)

    def response(self) -> Response:
        """Return all metrics in the text format of Prometheus."""
        return Response(generate_latest(self._registry), media_type=CONTENT_TYPE_LATEST)


class _Queues(Collector):
    def __init__(self, indexes: Indexes) -> None:
        self._indexes = indexes

    def collect(self) -> Iterator[GaugeMetricFamily]:
        """Yield the gauges of all indexes (interface of prometheus_client)."""
        waiting = GaugeMetricFamily("hereabouts_waiting", "waiting queries", labels=("index",))
        workers = GaugeMetricFamily("hereabouts_workers", "workers that answer; 0 if not ready", labels=("index",))
        served = GaugeMetricFamily("hereabouts_index", "1 for the served version", labels=("index", "version"))
        for name in self._indexes.names():
            queue = self._indexes.queue(name)
            waiting.add_metric((name,), queue.num_waiting)
            workers.add_metric((name,), queue.num_workers)
            if queue.num_workers:
                served.add_metric((name, queue.localizer.facts.version), 1)
        yield from (waiting, workers, served)
