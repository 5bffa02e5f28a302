"""Raw requests with bytes changed, cut, repeated and mixed: never a 5xx. FUZZ_MUTATIONS sets how many."""

import os
import random
import socket
from contextlib import suppress
from functools import partial

import pytest
from fake_localizer import Steady

from app import main
from app.jobs.runner import EvaluationJobs
from app.main import create_app
from app.settings import Settings

MUTATIONS = int(os.environ.get("FUZZ_MUTATIONS", "300"))
WAIT_S = 0.2
GOOD_WAIT_S = 20.0  # for what is answered, however busy the machine
GOOD = b'{"description": "I am north of a gray building. A black pole is to my west.", "top_k": 2}'
BODIES = (
    ("/localize", GOOD),
    ("/localize/batch", b'{"items": [{"hints": ["a tree"], "within": {"bbox": [1.5, 2, 3, 4]}}]}'),
    ("/describe", b'{"position": [24.94, 60.17], "crs": "wgs84"}'),
    ("/evaluate", b'{"queries": [{"description": "a tree", "position": [1, -2.5e1]}], "grow": [100]}'),
)
HEADS = (
    b"GET /search?q=a+tree&viewbox=24.9,60.1,25.0,60.2&limit=3 HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n",
    b"GET /cells/fakeville_00001?index=default HTTP/1.1\r\nHost: x\r\nIf-None-Match: *\r\nAccept: */*\r\n\r\n",
    b"GET /reverse?lat=60.17&lon=24.94 HTTP/1.1\r\nHost: x\r\nAuthorization: Bearer x\r\nX-Request-ID: a\r\n\r\n",
)
PIECES = (
    b"\x00", b"\xff\xfe", b"\r\n", b"\r\n\r\n", b"{", b"[" * 50, b'"', b"99999999999999999999999999", b"1e999", b"-0",
    b"NaN", b"null", b"true", b"\\ud800", b"%00", b"%ff", b"../", b"Content-Length: 5\r\n", b"Expect: 100-continue\r\n",
    b"Transfer-Encoding: chunked\r\n", "é🌳".encode(), b"A" * 3000,
)  # fmt: skip


def request(path, body):
    head = f"POST {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Type: application/json\r\n"
    return f"{head}Content-Length: {len(body)}\r\n\r\n".encode() + body


def mutated(draw):
    """A request with some of its bytes changed; half of the time in the body alone, whose length is then told right."""
    path, body = draw.choice(BODIES)
    if draw.random() < 0.5:
        return request(path, changed(body, draw))
    return changed(draw.choice((*HEADS, request(path, body))), draw)


def changed(raw, draw):
    for _ in range(draw.randint(1, 4)):
        start, end = sorted(draw.randrange(len(raw) + 1) for _ in range(2))
        kind = draw.randrange(5)
        if kind == 0:
            raw = raw[:start] + bytes([draw.randrange(256)]) + raw[start + 1 :]
        elif kind == 1:
            raw = raw[:start] + raw[min(end, start + 20) :]
        elif kind == 2:
            raw = raw[:start] + draw.choice(PIECES) + raw[start:]
        elif kind == 3:
            raw = raw[:end] + raw[start:end] + raw[end:]
        else:
            raw = raw[:start]
        raw = raw or b"\r\n"
    return raw


def answers_to(port, raw, wait_s=WAIT_S):
    """Status codes of all answers to what is sent, until the connection ends or nothing more comes."""
    with socket.create_connection(("127.0.0.1", port), timeout=wait_s) as connection:
        received = b""
        with suppress(ConnectionError, TimeoutError):
            connection.sendall(raw)
            while more := connection.recv(65536):
                received += more
    return [int(part[:3]) for part in received.split(b"HTTP/1.1 ")[1:]]


@pytest.mark.slow
def test_no_bytes_break_the_service(in_a_thread, tmp_path, monkeypatch):
    draw = random.Random("mutations 1")
    monkeypatch.setattr(main, "EvaluationJobs", partial(EvaluationJobs, max_waiting=2))
    with in_a_thread(create_app(Settings(index_dir=tmp_path), Steady)) as port:
        good = request("/localize", GOOD)
        assert answers_to(port, good, GOOD_WAIT_S) == [200]
        for number in range(MUTATIONS):
            raw = mutated(draw)
            codes = answers_to(port, raw)
            assert all(code < 500 for code in codes), (number, codes, raw)
            if number % 100 == 0:
                assert answers_to(port, good, GOOD_WAIT_S) == [200]
        assert answers_to(port, good, GOOD_WAIT_S) == [200]
