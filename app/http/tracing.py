"""Spans for OpenTelemetry: one a request, one an answer of the model. Route templates, never what a client sent.

Imported only where an operator asks for spans, as all of OpenTelemetry's SDK.
"""

from collections.abc import Mapping
from importlib.metadata import version
from threading import Timer
from typing import Final

from asgi_correlation_id import correlation_id
from opentelemetry.exporter.otlp.proto.http.trace_exporter import OTLPSpanExporter
from opentelemetry.sdk.resources import OTELResourceDetector, Resource
from opentelemetry.sdk.trace import TracerProvider
from opentelemetry.sdk.trace.export import BatchSpanProcessor, SpanExporter
from opentelemetry.trace import Span, SpanKind, StatusCode, Tracer, set_span_in_context
from opentelemetry.trace.propagation.tracecontext import TraceContextTextMapPropagator
from starlette.datastructures import Headers
from starlette.types import ASGIApp, Message, Receive, Scope, Send
from structlog.contextvars import bound_contextvars

from app.http.metrics import known
from app.http.request_notes import Timed, notes_of
from models.errors import HereaboutsError

LAST_S: Final = 3.0  # to send what is left when the service ends, though nobody may listen
NAME: Final = "hereabouts"
_W3C: Final = TraceContextTextMapPropagator()


class Traces:
    """Makes spans and sends them, in a thread of its own.

    Args:
        exporter: sends them.
    """

    def __init__(self, exporter: SpanExporter) -> None:
        own = Resource.create({"service.name": NAME, "service.version": version(NAME)})
        self._provider = TracerProvider(resource=own.merge(OTELResourceDetector().detect()), shutdown_on_exit=False)
        self._provider.add_span_processor(BatchSpanProcessor(exporter))
        self._exporter = exporter

    def around(self, app: ASGIApp) -> "Tracing":
        """An application whose requests have spans."""
        return Tracing(app, self._provider.get_tracer(NAME))

    def close(self) -> None:
        """Send what is left."""
        giving_up = Timer(LAST_S, self._exporter.shutdown)
        giving_up.start()
        self._provider.shutdown()
        giving_up.cancel()


def open_traces(environ: Mapping[str, str]) -> Traces:
    """Traces to where the variables of OpenTelemetry say; most of them are read by its SDK.

    Raises:
        HereaboutsError: they ask for what is not there.
    """
    exporter = environ.get("OTEL_TRACES_EXPORTER") or "otlp"
    if exporter != "otlp":
        raise HereaboutsError(f"OTEL_TRACES_EXPORTER: {exporter!r} is not known; set otlp, or none")
    for name in ("OTEL_EXPORTER_OTLP_TRACES_PROTOCOL", "OTEL_EXPORTER_OTLP_PROTOCOL"):
        if environ.get(name, "http/protobuf") != "http/protobuf":
            raise HereaboutsError(f"{name}: {environ[name]!r} is not spoken; set http/protobuf")
    return Traces(OTLPSpanExporter())


class Tracing:
    """A span a request, child of the caller's (W3C traceparent); lines logged meanwhile have its `trace_id`."""

    def __init__(self, app: ASGIApp, tracer: Tracer) -> None:
        self.app = app
        self._tracer = tracer

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        method = known(scope["method"])
        span = self._begin(method, scope)
        notes = notes_of(scope)

        async def note_status(message: Message) -> None:
            if message["type"] == "http.response.start":
                span.set_attribute("http.response.status_code", message["status"])
                if message["status"] >= 500:
                    span.set_status(StatusCode.ERROR)
            await send(message)

        try:
            with bound_contextvars(trace_id=f"{span.get_span_context().trace_id:032x}"):
                await self.app(scope, receive, note_status)
        except Exception:
            span.set_status(StatusCode.ERROR)
            raise
        finally:
            route = getattr(scope.get("route"), "path", None)
            if route is not None:
                span.set_attribute("http.route", route)
                span.update_name(f"{method} {route}")
            for timed in notes.timed:
                self._add(span, timed)
            span.end()

    def _begin(self, method: str, scope: Scope) -> Span:
        """The span of a request, called by its method until its route is found."""
        caller = _W3C.extract({"traceparent": Headers(scope=scope).get("traceparent", "")})
        known = {"http.request.method": method, "hereabouts.request_id": correlation_id.get() or ""}
        return self._tracer.start_span(method, caller, SpanKind.SERVER, known)

    def _add(self, span: Span, timed: Timed) -> None:
        """What an answer took, as a span of its own: a request may have several."""
        began_ns = timed.done_ns - int(timed.timings_ms["total"] * 1e6)
        took = {f"hereabouts.{name}_ms": value for name, value in timed.timings_ms.items()}
        answer = self._tracer.start_span("localize", set_span_in_context(span), attributes=took, start_time=began_ns)
        answer.end(timed.done_ns)
