"""Connections to the served application: kept, closed and refused by uvicorn's options."""

import socket
import threading

import httpx
import pytest
from fake_localizer import FakeLocalizer

from app.main import create_app
from app.server import CONNECTION_OPTIONS
from app.settings import Settings

POST = "POST /localize HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
GET = b"GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n"


@pytest.fixture
def serve(in_a_thread):
    """A context manager: port of a service of its own."""
    return lambda: in_a_thread(create_app(Settings(), FakeLocalizer))


def connect(port):
    return socket.create_connection(("127.0.0.1", port), timeout=60)


def read_until_closed(connection):
    """Return what the service sends until it closes the connection."""
    received = b""
    while more := connection.recv(65536):
        received += more
    return received


def test_a_connection_is_kept_for_the_next_request_and_closed_when_none_comes(serve, monkeypatch):
    monkeypatch.setitem(CONNECTION_OPTIONS, "timeout_keep_alive", 0.5)
    with serve() as port, connect(port) as kept_alive:
        for _ in range(3):
            kept_alive.sendall(GET)
            received = b""
            while not received.endswith(b"}"):
                received += kept_alive.recv(65536)
            assert received.startswith(b"HTTP/1.1 200 OK")
        assert read_until_closed(kept_alive) == b""


def test_a_body_may_take_longer_than_a_connection_is_kept(serve, monkeypatch):
    monkeypatch.setitem(CONNECTION_OPTIONS, "timeout_keep_alive", 0.2)
    body = b'{"description": "a tree"}'
    with serve() as port, connect(port) as slow:
        slow.sendall(f"{POST}Content-Length: {len(body)}\r\nConnection: close\r\n\r\n".encode() + body[:5])
        threading.Event().wait(0.5)
        slow.sendall(body[5:])
        assert read_until_closed(slow).startswith(b"HTTP/1.1 200")


@pytest.mark.parametrize(
    "request_bytes",
    [
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03\r\n\r\n",
        b"hello\r\n\r\n",
        b"GET / HTTP/1.1\r\nHost: x\r\nContent-Length: x\r\n\r\n",
        b"POST /localize HTTP/1.1\r\nHost: x\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n{}",
        b"GET / HTTP/1.1\r\nHost : x\r\n\r\n",
        b"GET / HTTP/1.1\r\nHost: x\r\nX-Long: " + b"y" * 70_000,
    ],
    ids=lambda request_bytes: str(request_bytes[:30]),
)
def test_a_request_that_is_not_http_is_400_and_its_connection_closed(serve, request_bytes):
    with serve() as port, connect(port) as rude:
        rude.sendall(request_bytes)
        assert read_until_closed(rude).startswith(b"HTTP/1.1 400 ")


def test_one_connection_too_many_is_503_until_another_ends(serve, monkeypatch, until):
    monkeypatch.setitem(CONNECTION_OPTIONS, "limit_concurrency", 5)
    with serve() as port:
        idle = [connect(port) for _ in range(4)]
        assert httpx.get(f"http://127.0.0.1:{port}/healthz").status_code == 503
        idle.pop().close()
        until(lambda: httpx.get(f"http://127.0.0.1:{port}/healthz").status_code == 200)
        for connection in idle:
            connection.close()


@pytest.mark.parametrize("says_length", [True, False])
def test_a_client_that_sends_all_before_it_reads_gets_its_413(serve, problem, says_length):
    content = b'{"description": "' + b"a" * 5_000_000 + b'"}'
    with serve() as port, httpx.Client(base_url=f"http://127.0.0.1:{port}") as eager:
        sent = content if says_length else iter([content])
        response = eager.post("/localize", content=sent, headers={"Content-Type": "application/json"})
        problem(response, 413, "body_too_large")
        assert eager.get("/healthz").status_code == 200
