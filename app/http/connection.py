"""A client's connection: what it does not say in time, or says wrong, costs the others nothing."""

import asyncio
import json
import resource
import time
import uuid
from typing import Any, Final

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

from app.http.errors import PROBLEM_JSON, Code, Problem

HEAD_S: Final = 10.0  # for the head of a request, from the first moment or the last answer
SPARE: Final = 64  # descriptors for everything else: workers, files, who is just coming


class Connection(H11Protocol):
    """Closes connections that send no request, and the longest idle one when descriptors run short.

    uvicorn alone waits for the first request for ever, and answers what is not HTTP with plain text.
    """

    _head_timer: asyncio.TimerHandle | None = None
    _idle_since_s = 0.0

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Begin to wait for the first request."""
        super().connection_made(transport)
        self._await_head()
        if len(self.connections) > resource.getrlimit(resource.RLIMIT_NOFILE)[0] - SPARE:
            idle = [one for one in self.connections if isinstance(one, Connection) and one.is_idle]
            if idle:
                min(idle, key=lambda one: one._idle_since_s).close()

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait for nothing any more."""
        self._head_came()
        super().connection_lost(exc)

    @property
    def is_idle(self) -> bool:
        """Whether no request is answered on it."""
        return self._head_timer is not None

    def close(self) -> None:
        """Close it, without a word."""
        if not self.transport.is_closing():
            self.transport.close()

    def handle_events(self) -> None:
        """Note when the head of a request is complete."""
        before = self.cycle
        super().handle_events()
        if self.cycle is not before:
            self._head_came()

    def on_response_complete(self) -> None:
        """Begin to wait for the next request."""
        self._await_head()
        super().on_response_complete()

    def send_400_response(self, msg: str) -> None:
        """Refuse what is not HTTP, as everything else is refused."""
        problem = Problem(Code.INVALID_HTTP)
        body: dict[str, Any] = problem.body() | {"request_id": uuid.uuid4().hex}
        content = json.dumps(body).encode()
        headers = [
            ("content-type", PROBLEM_JSON),
            ("content-length", str(len(content))),
            ("x-request-id", body["request_id"]),
            ("x-content-type-options", "nosniff"),
            ("connection", "close"),
        ]
        try:
            response = h11.Response(status_code=400, headers=headers, reason=b"Bad Request")
            for event in (response, h11.Data(data=content), h11.EndOfMessage()):
                self.transport.write(self.conn.send(event) or b"")
        except h11.LocalProtocolError:  # in the middle of an answer
            pass
        self.transport.close()

    def _await_head(self) -> None:
        self._head_came()
        self._idle_since_s = time.monotonic()
        self._head_timer = self.loop.call_later(HEAD_S, self.close)

    def _head_came(self) -> None:
        if self._head_timer is not None:
            self._head_timer.cancel()
            self._head_timer = None
