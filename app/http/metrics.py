"""Counts for Prometheus: requests by route, their time, what waits. Route templates only, never what a client sent."""

from collections.abc import Iterator
from typing import Final

from prometheus_client import CONTENT_TYPE_LATEST, CollectorRegistry, Counter, Histogram, generate_latest
from prometheus_client.core import GaugeMetricFamily
from prometheus_client.registry import Collector
from starlette.responses import Response

from app.http.indexes import Indexes

BUCKETS: Final = (0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0)
OTHER: Final = "other"  # route, of what no route takes; method, of what is no usual one
METHODS: Final = frozenset({"GET", "HEAD", "POST", "DELETE", "OPTIONS"})


def known(method: str) -> str:
    """A method as it may be shown: a client may send any word as one."""
    return method if method in METHODS else OTHER


class Metrics:
    """What is counted of one application.

    Args:
        indexes: whose queues are looked at whenever somebody asks.
    """

    def __init__(self, indexes: Indexes) -> None:
        self._registry = CollectorRegistry()
        self._requests = Counter(
            "hereabouts_requests", "requests answered", ("method", "route", "status"), registry=self._registry
        )
        self._seconds = Histogram(
            "hereabouts_request_seconds", "seconds to answer", ("route",), buckets=BUCKETS, registry=self._registry
        )
        self._registry.register(_Queues(indexes))

    def note(self, method: str, route: str, status: int, seconds: float) -> None:
        """Count a request."""
        self._requests.labels(known(method), route, str(status)).inc()
        self._seconds.labels(route).observe(seconds)

    def response(self) -> Response:
        """All counts, as Prometheus reads them."""
        return Response(generate_latest(self._registry), media_type=CONTENT_TYPE_LATEST)


class _Queues(Collector):
    """What waits before each index, and which version it is."""

    def __init__(self, indexes: Indexes) -> None:
        self._indexes = indexes

    def collect(self) -> Iterator[GaugeMetricFamily]:
        """See prometheus_client."""
        waiting = GaugeMetricFamily("hereabouts_waiting", "queries that wait", labels=("index",))
        workers = GaugeMetricFamily("hereabouts_workers", "workers that answer; 0: not ready", labels=("index",))
        served = GaugeMetricFamily("hereabouts_index", "1 for the version served", labels=("index", "version"))
        for name in self._indexes.names():
            queue = self._indexes.queue(name)
            waiting.add_metric((name,), queue.num_waiting)
            workers.add_metric((name,), queue.num_workers)
            if queue.num_workers:
                served.add_metric((name, queue.localizer.facts.version), 1)
        yield from (waiting, workers, served)
