import json
import signal
import socket
import subprocess
import sys
import threading
from contextlib import suppress
from pathlib import Path

import httpx
import pytest

SCRIPT = Path(__file__).parent / "serve_fake.py"


class Served:
    """A service in its own process."""

    def __init__(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.url = f"http://127.0.0.1:{self.port}"
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "stdin": subprocess.PIPE, "text": True}
        self.process = subprocess.Popen([sys.executable, SCRIPT, str(self.port)], **pipes)

    def is_ready(self):
        assert self.process.poll() is None, self.process.stderr.read()
        try:
            return httpx.get(f"{self.url}/readyz").status_code == 200
        except httpx.TransportError:
            return False

    def localize(self, text):
        return httpx.post(f"{self.url}/localize", json={"description": text})

    def waiting(self):
        return httpx.get(f"{self.url}/waiting").json()

    def release(self):
        self.process.stdin.write("\n")
        self.process.stdin.flush()

    def terminate(self):
        self.process.send_signal(signal.SIGTERM)

    def outcome(self):
        out, err = self.process.communicate(timeout=10)
        return self.process.returncode, out.splitlines(), [json.loads(line) for line in err.splitlines()]


@pytest.fixture
def served(until):
    served = Served()
    try:
        until(served.is_ready, 30)
        yield served
    finally:
        served.process.kill()
        served.process.communicate()


def test_sigterm_finishes_what_waits_and_exits_with_0(served, problem, until):
    answers = []
    threads = [
        threading.Thread(target=lambda word=word: answers.append(served.localize(word))) for word in ("held", "queued")
    ]
    threads[0].start()
    assert served.process.stdout.readline() == "held\n"
    threads[1].start()
    until(lambda: served.waiting() == 1)
    served.terminate()
    until(lambda: httpx.get(f"{served.url}/readyz").status_code == 503)
    problem(httpx.get(f"{served.url}/readyz"), 503, "draining")
    problem(served.localize("refused"), 503, "draining")
    served.release()
    for thread in threads:
        thread.join(10)
    assert [answer.status_code for answer in answers] == [200, 200]
    code, computed, lines = served.outcome()
    assert code == 0
    assert computed == ["queued"]
    requests = [line for line in lines if line["event"] == "request"]
    assert {line["route"] for line in requests} == {"/readyz", "/localize", "/waiting"}
    assert all(line["level"] == "info" and line["timestamp"] for line in requests)
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
    busy.join(10)
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
    until(lambda: httpx.get(f"{served.url}/readyz").status_code == 503)
    served.terminate()
    with pytest.raises(httpx.TransportError):
        until(lambda: httpx.get(f"{served.url}/readyz").status_code == 200)
    served.release()
    assert served.process.wait(10) == -signal.SIGTERM
    for thread in threads:
        thread.join(10)
