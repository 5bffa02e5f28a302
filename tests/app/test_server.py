import asyncio
import json
import os
import signal
import socket
import subprocess
import sys
import threading
from contextlib import suppress
from pathlib import Path

import httpx
import pytest
import uvicorn
from structlog.testing import capture_logs

from app.http.errors import Code, Problem
from app.http.indexes import Indexes
from app.jobs.runner import EvaluationJobs
from app.main import create_app
from app.server import DrainingServer, page_url, serve
from app.settings import Settings

IN_FLIGHT = 64  # requests when a signal comes
WAIT_S = 60  # for what takes a second on an idle machine
SCRIPT = Path(__file__).parent / "serve_fake.py"

pytestmark = pytest.mark.slow  # processes of their own


class Served:
    """A service in its own process."""

    def __init__(self, scratch):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.url = f"http://127.0.0.1:{self.port}"
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "stdin": subprocess.PIPE, "text": True}
        environ = os.environ | {"HEREABOUTS_MAX_WAIT_MS": "60000"}  # what is held makes the wait seem long
        environ |= {"TMPDIR": str(scratch)}  # a service that is killed leaves its files there
        self.process = subprocess.Popen([sys.executable, SCRIPT, str(self.port)], env=environ, **pipes)
        # Every request has a connection of its own, as requests of as many users have.
        self.http = httpx.Client(
            base_url=self.url,
            timeout=WAIT_S,
            headers={"Connection": "close"},
            limits=httpx.Limits(max_connections=None),
        )

    def is_ready(self):
        assert self.process.poll() is None, self.process.stderr.read()
        try:
            return self.http.get("/readyz").status_code == 200
        except httpx.TransportError:
            return False

    def localize(self, text):
        return self.http.post("/localize", json={"description": text})

    def evaluate(self, until):
        """Status URL and process id of an evaluation that does not end by itself."""
        body = {"queries": [{"hints": ["held"], "position": [1, 2]}]}
        url = self.http.post("/evaluate", json=body).headers["location"]
        until(lambda: self.http.get(url).json()["progress"]["stage"] == "ask", WAIT_S)
        children = Path(f"/proc/{self.process.pid}/task/{self.process.pid}/children").read_text()
        return url, int(children)

    def waiting(self):
        return self.http.get("/waiting").json()

    def release(self):
        self.process.stdin.write("\n")
        self.process.stdin.flush()

    def terminate(self):
        self.process.send_signal(signal.SIGTERM)

    def outcome(self):
        out, err = self.process.communicate(timeout=WAIT_S)
        return self.process.returncode, out.splitlines(), [json.loads(line) for line in err.splitlines()]


@pytest.fixture
def served(until, tmp_path):
    served = Served(tmp_path)
    try:
        until(served.is_ready, WAIT_S)
        yield served
    finally:
        served.process.kill()
        served.process.communicate()
        served.http.close()


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT], ids=lambda number: number.name)
def test_a_signal_finishes_what_waits_and_exits_with_0(served, problem, until, number):
    answers, words = [], ["held", *["queued"] * (IN_FLIGHT - 1)]
    threads = [threading.Thread(target=lambda word=word: answers.append(served.localize(word))) for word in words]
    threads[0].start()
    assert served.process.stdout.readline() == "held\n"
    for thread in threads[1:]:
        thread.start()
    until(lambda: served.waiting() == IN_FLIGHT - 1)
    served.process.send_signal(number)
    until(lambda: served.http.get("/readyz").status_code == 503)
    problem(served.http.get("/readyz"), 503, "draining")
    problem(served.localize("refused"), 503, "draining")
    served.release()
    for thread in threads:
        thread.join(WAIT_S)
    assert [answer.status_code for answer in answers] == [200] * IN_FLIGHT
    code, computed, lines = served.outcome()
    assert code == 0
    assert computed == words[1:]
    requests = [line for line in lines if line["event"] == "request"]
    assert {line["route"] for line in requests} == {"/readyz", "/localize", "/waiting"}
    assert all(line["level"] == "info" and line["timestamp"] for line in requests)
    assert [line["url"] for line in lines if line["event"] == "page"] == [f"{served.url}/"]
    assert not any(text in str(lines) for text in ("held", "queued", "refused"))


def test_client_that_left_is_not_computed(served, until):
    busy = threading.Thread(target=served.localize, args=("held",))
    busy.start()
    assert served.process.stdout.readline() == "held\n"
    body = b'{"description": "gone"}'
    head = (
        f"POST /localize HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: {len(body)}\r\n\r\n"
    )
    with socket.create_connection(("127.0.0.1", served.port)) as leaver:
        leaver.sendall(head.encode() + body)
        until(lambda: served.waiting() == 1)
    until(lambda: served.waiting() == 0)
    served.release()
    busy.join(WAIT_S)
    assert served.localize("stays").status_code == 200
    served.terminate()
    code, computed, lines = served.outcome()
    assert (code, computed) == (0, ["stays"])
    assert 499 in [line.get("status") for line in lines]


def test_second_signal_does_not_wait_for_the_queue(served, until):
    def ask(word):
        with suppress(httpx.TransportError):
            served.localize(word)

    threads = [threading.Thread(target=ask, args=(word,)) for word in ("held", "queued")]
    threads[0].start()
    assert served.process.stdout.readline() == "held\n"
    threads[1].start()
    until(lambda: served.waiting() == 1)
    served.terminate()
    until(lambda: served.http.get("/readyz").status_code == 503)
    served.terminate()
    with pytest.raises(httpx.TransportError):
        until(lambda: served.http.get("/readyz").status_code == 200)
    served.release()
    assert served.process.wait(WAIT_S) == -signal.SIGTERM
    for thread in threads:
        thread.join(WAIT_S)


def test_sigterm_ends_an_evaluation_and_tells_who_follows_it(served, until):
    url, worker = served.evaluate(until)
    with served.http.stream("GET", f"{url}/events") as stream:
        lines = stream.iter_lines()
        assert next(lines) == "event: progress"  # so it is followed before the service is told to end
        served.terminate()
        assert "event: cancelled" in list(lines)
    assert served.outcome()[0] == 0
    assert not Path(f"/proc/{worker}").exists()


def test_worker_dies_with_a_service_that_is_killed(served, until):
    _, worker = served.evaluate(until)
    served.process.kill()
    until(lambda: not is_running(worker))


def test_client_that_leaves_the_events_cancels_nothing(served, until):
    url, worker = served.evaluate(until)
    with served.http.stream("GET", f"{url}/events") as stream:
        assert next(stream.iter_lines()) == "event: progress"
    assert served.http.get(url).json()["status"] == "running"
    assert is_running(worker)
    assert served.http.delete(url).json()["status"] == "cancelled"


def is_running(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def test_a_signal_that_comes_before_the_queue_is_started_is_not_lost(fake):
    indexes, jobs = Indexes(lambda _alias, _version: [fake], dict, max_wait_s=1.0), EvaluationJobs()
    server = DrainingServer(uvicorn.Config(None), indexes, jobs)
    server.handle_exit(signal.SIGTERM, None)

    async def start_and_end():
        await indexes.start()  # as the application does when it starts
        while not await server.on_tick(1):
            await asyncio.sleep(0.01)
        with pytest.raises(Problem) as refused:
            indexes.check_accepting()
        await indexes.close()
        return refused.value.code

    assert asyncio.run(asyncio.wait_for(start_and_end(), WAIT_S)) is Code.DRAINING


@pytest.mark.parametrize(
    ("host", "url"),
    [
        ("127.0.0.1", "http://127.0.0.1:80/"),
        ("::1", "http://[::1]:80/"),
        ("town.example", "http://town.example:80/"),
        *((host, "http://localhost:80/") for host in ("0.0.0.0", "::", "")),
    ],
)
def test_page_has_an_address_that_one_can_go_to(host, url):
    assert page_url(host, 80) == url


@pytest.mark.parametrize(
    ("host", "key", "warns"),
    [
        *((host, None, False) for host in ("127.0.0.1", "127.0.0.9", "::1", "localhost")),
        *((host, None, True) for host in ("0.0.0.0", "::", "", "192.0.2.1", "town.example")),
        ("0.0.0.0", "long-enough", False),
    ],
)
def test_a_service_that_others_reach_without_a_key_warns_once(monkeypatch, host, key, warns):
    monkeypatch.setattr(DrainingServer, "run", lambda self: None)
    settings = Settings(host=host, read_key=key)
    with capture_logs() as lines:
        serve(create_app(settings), settings)
    assert [line["event"] for line in lines if line["log_level"] == "warning"] == ["no key"] * warns
    assert all("HEREABOUTS_READ_KEY" in line["remedy"] for line in lines)
