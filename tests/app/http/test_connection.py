"""What uvicorn leaves open: connections that say nothing, or no HTTP, and clients that send all before they read."""

import asyncio
import json
import socket
import threading

import httpx
import pytest
from fake_localizer import FakeLocalizer

from app.main import create_app
from app.settings import Settings

POST = "POST /localize HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"


@pytest.fixture
def served(in_a_thread, monkeypatch):
    monkeypatch.setattr("app.http.connection.HEAD_S", 0.5)
    with in_a_thread(create_app(Settings(), FakeLocalizer)) as port:
        yield port


def connect(port):
    return socket.create_connection(("127.0.0.1", port), timeout=5)


def all_of(connection):
    """What the service says until it closes the connection."""
    said = b""
    while more := connection.recv(65536):
        said += more
    return said


def body_of(said):
    head, _, body = said.partition(b"\r\n\r\n")
    assert b"content-type: application/problem+json" in head.lower()
    assert b"x-request-id" in head.lower()
    return json.loads(body)


@pytest.mark.parametrize("begun", [b"", b"GET / HT", b"GET /healthz HTTP/1.1\r\nHost: x\r\nX-Slow: "])
def test_a_connection_without_a_request_is_closed(served, begun):
    with connect(served) as idle:
        idle.sendall(begun)
        assert all_of(idle) == b""


def test_a_head_that_drips_is_closed(served):
    def drip(slow):
        for letter in "GET /healthz HTTP/1.1\r\nHost: example.org\r\nX-Slow: " + "y" * 1000:
            slow.sendall(letter.encode())
            threading.Event().wait(0.02)

    with connect(served) as slow, pytest.raises((BrokenPipeError, ConnectionResetError)):
        drip(slow)


def test_a_connection_in_use_stays(served):
    with httpx.Client() as client:
        for _ in range(8):
            response = client.get(f"http://127.0.0.1:{served}/healthz")
            assert response.status_code == 200
            threading.Event().wait(0.1)
        assert not response.is_closed or response.http_version == "HTTP/1.1"


def test_a_slow_answer_is_waited_for(served):
    body = b'{"description": "a tree"}'
    with connect(served) as one:
        head = (
            f"POST /localize HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: {len(body)}\r\n"
        )
        one.sendall(head.encode() + b"Connection: close\r\n\r\n" + body[:5])
        threading.Event().wait(0.8)  # longer than a head may take
        one.sendall(body[5:])
        assert all_of(one).startswith(b"HTTP/1.1 200")


@pytest.mark.parametrize(
    "said",
    [
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n",
        b"hello\r\n\r\n",
        b"GET / HTTP/1.1\r\nHost: x\r\nContent-Length: x\r\n\r\n",
        b"POST /localize HTTP/1.1\r\nHost: x\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n{}",
        b"GET / HTTP/1.1\r\nHost : x\r\n\r\n",
    ],
)
def test_what_is_no_http_is_a_problem(served, said):
    with connect(served) as rude:
        rude.sendall(said)
        answer = all_of(rude)
        assert answer.startswith(b"HTTP/1.1 400 ")
        assert body_of(answer)["code"] == "invalid_http"


def test_idle_connections_lock_nobody_out(served, monkeypatch):
    monkeypatch.setattr("app.http.connection.HEAD_S", 60)
    monkeypatch.setattr("app.http.connection.resource.getrlimit", lambda _which: (74, 74))
    idle = [connect(served) for _ in range(40)]
    assert httpx.get(f"http://127.0.0.1:{served}/healthz").status_code == 200
    first, last = idle[0], idle[-1]
    assert first.recv(1) == b"", "the longest idle goes first"
    last.sendall(b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n")
    assert last.recv(15) == b"HTTP/1.1 200 OK"
    for connection in idle:
        connection.close()


@pytest.mark.parametrize("says_length", [True, False])
def test_a_client_that_sends_all_before_it_reads_gets_its_413(served, says_length):
    content = b'{"description": "' + b"a" * 5_000_000 + b'"}'
    with connect(served) as eager:
        if says_length:
            eager.sendall(f"{POST}Content-Length: {len(content)}\r\n\r\n".encode() + content)
        else:
            chunk = f"{len(content):x}\r\n".encode() + content + b"\r\n0\r\n\r\n"
            eager.sendall(f"{POST}Transfer-Encoding: chunked\r\n\r\n".encode() + chunk)
        answer = all_of(eager)
    assert answer.startswith(b"HTTP/1.1 413")
    assert body_of(answer)["code"] == "body_too_large"


def test_a_body_without_end_is_left(served, monkeypatch):
    monkeypatch.setattr("app.http.bodies.DISCARDED_BYTES", 1_000_000)

    async def send_for_ever():
        _, writer = await asyncio.open_connection("127.0.0.1", served)
        writer.write(f"{POST}Transfer-Encoding: chunked\r\n\r\n".encode())
        sent = 0
        try:
            while True:
                writer.write(b"10000\r\n" + b"a" * 65536 + b"\r\n")
                await writer.drain()
                sent += 65536
        except (ConnectionError, OSError):
            return sent
        finally:
            writer.close()

    assert asyncio.run(asyncio.wait_for(send_for_ever(), 20)) < 100_000_000
