"""The log: one JSON object per line, without people's texts unless the settings ask for them."""

import json
import logging
import socket
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager

import httpx
import pytest
from fake_localizer import FakeLocalizer
from structlog.testing import capture_logs
from typer.testing import CliRunner

from app import limits, logs, server
from app.cli.main import app as cli
from app.main import create_app
from app.server import DrainingServer, serve
from app.settings import Settings

SECRET = "quixotic"
TEXT = f"I am north of a gray building, {SECRET}. A black pole is to my west."


@pytest.mark.parametrize("level", ["debug", "info", "warning", "error"])
def test_faiss_tells_which_build_it_loads_when_debugging_alone(level, logged) -> None:
    read_log = logged(level)
    loader = logging.getLogger("faiss.loader")
    loader.info("Loading faiss with AVX2 support.")
    assert ("AVX2" in read_log()) == (level == "debug")
    loader.warning("it is broken")
    assert ("broken" in read_log()) == (level != "error")
    logging.getLogger("app").info("ours")
    assert ("ours" in read_log()) == (level in ("debug", "info"))


@contextmanager
def client(in_a_thread, settings, fake):
    """A client of a service of its own."""
    with (
        in_a_thread(create_app(settings, lambda: fake)) as port,
        httpx.Client(base_url=f"http://127.0.0.1:{port}") as here,
    ):
        yield here


def asked_well_and_wrongly(here):
    """The statuses of requests that are answered, refused and failed."""
    json_type = {"Content-Type": "application/json"}
    body = {"description": TEXT}
    yield here.post("/localize", json=body)
    yield here.post("/localize", json={"hints": [TEXT]}, headers={"Accept": "application/geo+json"})
    yield here.get("/search", params={"q": TEXT})
    for broken in (f"nowhere {TEXT}", f"nan {TEXT}", f"bad {TEXT}", TEXT * 100, f"{SECRET}\ud800"):
        yield here.post("/localize", content=json.dumps({"description": broken}), headers=json_type)
        yield here.post("/localize/batch", json={"items": [body, {"description": broken.replace("\ud800", "")}]})
        yield here.get("/search", params={"q": broken.replace("\ud800", "")})
    for more in ({SECRET: SECRET}, {"top_k": SECRET}, {"index": SECRET}, {"index": "quixotic-1"}):
        yield here.post("/localize", json=body | more)
        yield here.post("/localize/batch", json={"items": [body | more]})
    yield here.post("/localize", json=body | {"answers": [{"question": SECRET, "choice": SECRET}]})
    yield here.post("/localize", json=body, headers={"Accept": f"image/{SECRET}", "X-Request-ID": f"<{SECRET}>"})
    yield here.post("/localize", content=f'{{"description": "{SECRET}', headers=json_type)
    yield here.post("/localize", content=f'{{"description": "{SECRET}"}}', headers={"Content-Type": f"text/{SECRET}"})
    yield here.post("/localize", json={"description": TEXT * 9000})
    yield here.post("/describe", json={"position": SECRET})
    yield here.post("/evaluate", json={"queries": [{"description": f"bad {TEXT}", "position": SECRET}]})
    yield here.request(SECRET, f"/{SECRET}")
    yield here.get(f"/cells/{SECRET}")


def asked_too_much(here, fake, until):
    """The statuses of requests that come while the model is busy: too late, gone, refused, late after all."""
    body = {"description": TEXT}
    content = json.dumps(body)
    head = "POST /localize HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
    head += f"Content-Length: {len(content)}\r\n\r\n"

    def waiting(count):
        until(lambda: f'hereabouts_waiting{{index="default"}} {count}.0' in here.get("/metrics").text)

    with ThreadPoolExecutor() as pool:
        fake.gate.clear()
        first = pool.submit(here.post, "/localize", json=body)
        fake.entered.acquire()
        yield here.post("/localize", json=body | {"deadline_ms": 50})
        with socket.create_connection((here.base_url.host, here.base_url.port)) as leaver:
            leaver.sendall((head + content).encode())
            waiting(1)
        waiting(0)
        waits = pool.submit(here.post, "/localize", json=body)
        waiting(1)
        yield here.post("/localize", json=body)
        fake.gate.set()
        yield from (first.result(), waits.result())


def requests(lines):
    """The lines of requests, but for those that look how it goes."""
    entries = [json.loads(line) for line in lines.splitlines()]
    looks = ("/readyz", "/metrics")
    return [line for line in entries if line["event"] == "request" and line["route"] not in looks]


def test_no_line_has_what_was_said_however_the_request_ends(logged, in_a_thread, until, monkeypatch):
    read_log, fake = logged(), FakeLocalizer()
    with client(in_a_thread, Settings(), FakeLocalizer()) as here:
        statuses = {response.status_code for response in asked_well_and_wrongly(here)}
    monkeypatch.setattr(limits, "MAX_WAITING_QUERIES", 1)
    with client(in_a_thread, Settings(), fake) as here:
        statuses |= {response.status_code for response in asked_too_much(here, fake, until)}
    with client(in_a_thread, Settings(read_key="long-enough"), fake) as here:
        assert here.post("/localize", json={"description": TEXT}, headers={"X-API-Key": SECRET}).status_code == 401
    lines = read_log()
    assert statuses == {200, 400, 404, 406, 413, 415, 422, 429, 500, 504}
    assert {line["status"] for line in requests(lines)} == statuses | {401, 499}
    faults = {
        json.loads(line)["exception"].splitlines()[-1] for line in lines.splitlines() if '"internal error"' in line
    }
    assert faults == {"RuntimeError", "ValidationError", "ExceptionGroup"}, "and not what they say"
    assert SECRET not in lines.lower()


def test_lines_have_what_was_said_where_the_operator_wants_it(logged, in_a_thread):
    read_log = logged(with_messages=True)
    with client(in_a_thread, Settings(log_descriptions=True), FakeLocalizer()) as here:
        here.post("/localize", json={"description": f'{TEXT}\n{{"event": "forged"}}'})
        here.post("/localize", json={"hints": ["A tree.", "A bench."]})
        here.get("/search", params={"q": TEXT})
        here.post("/localize/batch", json={"items": [{"description": "A tree."}, {"description": TEXT}]})
        here.post("/localize", json={"description": f"bad {TEXT}"})
        here.post("/describe", json={"position": [0, 0]})
    lines = read_log()
    assert [line.get("descriptions") for line in requests(lines)] == [
        [f'{TEXT}\n{{"event": "forged"}}'], ["A tree.\nA bench."], [TEXT], ["A tree.", TEXT], [f"bad {TEXT}"], None,
    ]  # fmt: skip
    [fault] = [json.loads(line) for line in lines.splitlines() if '"internal error"' in line]
    assert fault["exception"].endswith(f"RuntimeError: secret: bad {TEXT}")


def test_fastapi_sends_no_telemetry_of_its_own_whatever_its_variables_say(monkeypatch):
    """Its spans would hold query strings, so what people type into /search."""
    monkeypatch.setenv("FASTAPI_OTEL_AUTO_CONFIGURE", "true")
    telemetry = create_app(Settings())._telemetry
    assert not any(telemetry[kind] for kind in ("tracing", "metrics", "logs", "auto_configure"))


@pytest.mark.parametrize("is_wanted", [True, False])
def test_a_service_that_logs_what_is_said_warns(monkeypatch, is_wanted):
    monkeypatch.setattr(DrainingServer, "run", lambda self: None)
    settings = Settings(log_descriptions=is_wanted)
    with capture_logs() as lines:
        serve(create_app(settings), settings)
    warnings = [line for line in lines if line["log_level"] == "warning"]
    assert [line["event"] for line in warnings] == ["descriptions are logged"] * is_wanted
    assert all("HEREABOUTS_LOG_DESCRIPTIONS" in line["remedy"] for line in warnings)


def test_the_command_logs_as_its_settings_say(monkeypatch, tmp_path):
    begun = []
    monkeypatch.setattr(logs, "configure_logging", lambda *given: begun.append(given))
    monkeypatch.setattr(server, "serve", lambda _app, _settings: None)
    for wanted in ("false", "true"):
        environ = {"HEREABOUTS_LOG_DESCRIPTIONS": wanted, "OMP_NUM_THREADS": "1"}
        assert CliRunner().invoke(cli, ["serve", "--index", str(tmp_path)], env=environ).exit_code == 0
    assert begun == [("info", False), ("info", True)]
