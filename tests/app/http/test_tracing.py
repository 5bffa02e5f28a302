"""Spans for who asks for them: what they tell, and what they never do."""

import gzip
import json
import os
import subprocess
import sys
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
from fake_localizer import FakeLocalizer
from opentelemetry.proto.collector.trace.v1.trace_service_pb2 import ExportTraceServiceRequest
from opentelemetry.sdk.trace.export.in_memory_span_exporter import InMemorySpanExporter
from opentelemetry.trace import SpanKind, StatusCode
from structlog.contextvars import merge_contextvars
from structlog.testing import capture_logs

from app.main import create_app
from app.settings import Settings
from models.errors import HereaboutsError

SECRET = "quixotic"
TEXT = f"I am north of a gray building, {SECRET}. A black pole is to my west."
CALLER = "00-0af7651916cd43dd8448eb211c80319c-b7ad6b7169203331-01"
ROOT = Path(__file__).parents[3]


@pytest.fixture(autouse=True)
def _no_variables(monkeypatch):
    for name in [name for name in os.environ if name.startswith(("OTEL_", "FASTAPI_OTEL"))]:
        monkeypatch.delenv(name)


@pytest.fixture
def kept(monkeypatch):
    """Where spans go; they are complete when the service has ended."""
    kept = InMemorySpanExporter()
    monkeypatch.setenv("OTEL_TRACES_EXPORTER", "otlp")
    monkeypatch.setattr("app.http.tracing.OTLPSpanExporter", lambda: kept)
    return kept


def seen(kept):
    """The spans of all but health."""
    return [span for span in kept.get_finished_spans() if span.name != "GET /readyz"]


def test_a_request_is_a_span_and_its_answer_another_with_what_the_model_took(start, kept):
    with start(Settings(), FakeLocalizer()) as api:
        body = api.post("/localize", json={"description": TEXT}).json()
    answer, request = seen(kept)
    assert (request.name, request.kind, request.parent) == ("POST /localize", SpanKind.SERVER, None)
    assert request.attributes == {
        "http.request.method": "POST",
        "http.route": "/localize",
        "http.response.status_code": 200,
        "hereabouts.request_id": body["request_id"],
    }
    assert (answer.name, answer.parent.span_id) == ("localize", request.context.span_id)
    assert dict(answer.attributes) == {f"hereabouts.{name}_ms": took for name, took in body["timings_ms"].items()}
    assert {"hereabouts.queue_ms", "hereabouts.encode_ms", "hereabouts.search_ms", "hereabouts.estimate_ms"} < set(
        answer.attributes
    )
    assert request.start_time <= answer.start_time <= answer.end_time <= request.end_time
    assert request.resource.attributes["service.name"] == "hereabouts"


def test_each_item_of_a_batch_has_a_span_of_its_own(start, kept):
    with start(Settings(), FakeLocalizer()) as api:
        api.post("/localize/batch", json={"items": [{"description": TEXT}, {"description": 7}, {"hints": [TEXT]}]})
    assert [span.name for span in seen(kept)] == ["localize", "localize", "POST /localize/batch"]


def test_no_span_has_what_a_client_sent(start, kept):
    with start(Settings(), FakeLocalizer()) as api:
        for path in ("/localize", "/localize/batch", f"/{SECRET}", f"/evaluate/{SECRET}"):
            for text in (TEXT, f"nowhere {TEXT}", f"nan {TEXT}", f"bad {TEXT}", f"<{SECRET}>" * 999):
                api.post(f"{path}?{SECRET}={SECRET}", json={"description": text, "items": [{"description": text}]})
        for text in (TEXT, f"bad {TEXT}", SECRET * 999):
            api.get("/search", params={"q": text, "viewbox": SECRET})
            api.get("/search", params={"q": text}, headers={"User-Agent": SECRET})
            api.get("/search", params={"q": text}, headers={"traceparent": CALLER, "tracestate": f"a={SECRET}"})
        api.get(f"/cells/{SECRET}", headers={"traceparent": SECRET, "baggage": f"a={SECRET}", "Host": SECRET})
        api.request(SECRET.upper(), f"/{SECRET}")
        api.request(SECRET.upper(), "/localize")
    spans = seen(kept)
    assert {"GET /search", "GET /cells/{cell_id}", "POST", "other", "other /localize"} <= {span.name for span in spans}
    assert {500, 422, 404, 405} <= {span.attributes.get("http.response.status_code") for span in spans}
    for span in spans:
        assert SECRET not in (span.to_json() + str(span.context.trace_state)).lower()
        assert not span.events, "an event has what a fault said"


def test_a_fault_is_an_error_and_a_refusal_is_none(start, kept):
    with start(Settings(), FakeLocalizer()) as api:
        api.post("/localize", json={"description": "a bad tree"})
        api.post("/localize", json={"description": 7})
    assert [(span.attributes["http.response.status_code"], span.status.status_code) for span in seen(kept)] == [
        (500, StatusCode.ERROR),
        (422, StatusCode.UNSET),
    ]


def test_the_callers_trace_goes_on_and_is_in_the_log_lines(start, kept):
    with start(Settings(), FakeLocalizer()) as api, capture_logs([merge_contextvars]) as lines:
        for text in (TEXT, "a bad tree"):
            api.post("/localize", json={"description": text}, headers={"traceparent": CALLER})
        api.post("/localize", json={"description": TEXT}, headers={"traceparent": "none"})
        requests = [line for line in lines if line.get("route") == "/localize"]
        [fault] = [line for line in lines if line["event"] == "fault"]
    *continued, own = [span for span in seen(kept) if span.name == "POST /localize"]
    _, trace, caller, _ = CALLER.split("-")
    assert [f"{span.context.trace_id:032x}" for span in continued] == [trace, trace]
    assert [f"{span.parent.span_id:016x}" for span in continued] == [caller, caller]
    assert own.parent is None
    assert [line["trace_id"] for line in requests] == [trace, trace, f"{own.context.trace_id:032x}"]
    assert fault["trace_id"] == trace


class Collector(BaseHTTPRequestHandler):
    """Keeps what is posted to it, by path."""

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        zipped = self.headers.get("Content-Encoding") == "gzip"
        self.server.got.append((self.path, gzip.decompress(body) if zipped else body))
        self.send_response(200)
        self.end_headers()

    def log_message(self, *_arguments):
        pass


@pytest.fixture
def collector():
    server = ThreadingHTTPServer(("127.0.0.1", 0), Collector)
    server.got = []
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    yield server
    server.shutdown()
    thread.join()
    server.server_close()


def test_a_collector_gets_the_spans_and_nothing_else(monkeypatch, collector, start):
    monkeypatch.setenv("OTEL_EXPORTER_OTLP_ENDPOINT", f"http://127.0.0.1:{collector.server_port}")
    monkeypatch.setenv("OTEL_SERVICE_NAME", "here-2")
    monkeypatch.setenv("FASTAPI_OTEL_AUTO_CONFIGURE", "true")  # FastAPI's own spans have the query string
    with start(Settings(), FakeLocalizer()) as api:
        api.get("/search", params={"q": TEXT})
        api.post("/localize", json={"description": SECRET, "top_k": SECRET})
    assert {path for path, _ in collector.got} == {"/v1/traces"}
    assert not any(SECRET.encode() in body for _, body in collector.got)
    sent = [ExportTraceServiceRequest.FromString(body) for _, body in collector.got]
    of = {
        span.name: {each.key: each.value.string_value for each in resource.resource.attributes}
        for request in sent
        for resource in request.resource_spans
        for scope in resource.scope_spans
        for span in scope.spans
    }
    assert set(of) == {"GET /readyz", "GET /search", "localize", "POST /localize"}
    assert of["GET /search"]["service.name"] == "here-2"


def test_a_collector_that_is_not_there_keeps_no_service_from_answering_and_ending(monkeypatch, start):
    given_up, heeded = threading.Event(), []

    class Stuck(InMemorySpanExporter):
        def export(self, spans):
            heeded.append(given_up.wait(20))

        def shutdown(self):
            given_up.set()

    monkeypatch.setenv("OTEL_TRACES_EXPORTER", "otlp")
    monkeypatch.setattr("app.http.tracing.OTLPSpanExporter", Stuck)
    monkeypatch.setattr("app.http.tracing.LAST_S", 0.1)
    with start(Settings(), FakeLocalizer()) as api:
        assert api.post("/localize", json={"description": TEXT}).status_code == 200
    assert heeded == [True]


@pytest.mark.parametrize(
    ("variables", "says"),
    [
        ({"OTEL_TRACES_EXPORTER": "zipkin"}, "OTEL_TRACES_EXPORTER: 'zipkin'"),
        (
            {"OTEL_EXPORTER_OTLP_ENDPOINT": "http://127.0.0.1:1", "OTEL_EXPORTER_OTLP_PROTOCOL": "grpc"},
            "OTEL_EXPORTER_OTLP_PROTOCOL: 'grpc'",
        ),
    ],
)
def test_what_is_not_spoken_is_refused(monkeypatch, variables, says):
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    with pytest.raises(HereaboutsError, match=says):
        create_app(Settings())


SDK = ("opentelemetry.sdk", "opentelemetry.exporter", "opentelemetry.proto", "app.http.tracing")  # the API is FastAPI's
LOADED = f"""
import json, sys
from app.main import create_app
from app.settings import Settings
create_app(Settings())
print(json.dumps([name for name in sys.modules if name.startswith({SDK!r})]))
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("variables", "is_on"),
    [
        ({}, False),
        ({"OTEL_EXPORTER_OTLP_ENDPOINT": ""}, False),
        ({"OTEL_EXPORTER_OTLP_ENDPOINT": "http://127.0.0.1:1", "OTEL_TRACES_EXPORTER": "none"}, False),
        ({"OTEL_EXPORTER_OTLP_ENDPOINT": "http://127.0.0.1:1", "OTEL_SDK_DISABLED": "true"}, False),
        ({"OTEL_EXPORTER_OTLP_TRACES_ENDPOINT": "http://127.0.0.1:1/v1/traces"}, True),
        ({"OTEL_TRACES_EXPORTER": "otlp"}, True),
    ],
)
def test_nothing_of_it_is_imported_unless_it_is_asked_for(variables, is_on):
    command = [sys.executable, "-c", LOADED]
    done = subprocess.run(command, env=os.environ | variables, cwd=ROOT, check=True, capture_output=True, text=True)
    assert bool(json.loads(done.stdout)) == is_on


@pytest.mark.slow
def test_who_has_not_installed_it_is_told_how(tmp_path):
    code = "import sys; sys.modules['opentelemetry.sdk'] = None; from app.cli.main import app; app()"
    environ = os.environ | {"OTEL_EXPORTER_OTLP_ENDPOINT": "http://127.0.0.1:1"}
    command = [sys.executable, "-c", code, "serve", "--index", str(tmp_path)]
    done = subprocess.run(command, env=environ, cwd=ROOT, check=False, capture_output=True, text=True)
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    assert done.stderr.startswith("OTEL_EXPORTER_OTLP_ENDPOINT asks for spans")
    assert "pip install 'hereabouts[otel]'" in done.stderr
