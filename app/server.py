"""Running the service in one process, and ending it without dropping a request."""

import signal
import threading
from ipaddress import IPv6Address
from socket import socket
from types import FrameType
from typing import Any, Final

import structlog
import uvicorn
from fastapi import FastAPI

from app.http.indexes import Indexes
from app.jobs.runner import EvaluationJobs
from app.limits import MAX_CONNECTIONS, MAX_DEADLINE_MS
from app.settings import Settings, address_of, is_local

CLOSING_S = 5
KEEP_ALIVE_S: Final = 10
MAX_HEAD_BYTES: Final = 65_536  # of a request's line and headers
CONNECTION_OPTIONS: Final[dict[str, Any]] = {  # of uvicorn; a reverse proxy guards against slow clients
    "http": "h11",
    "timeout_keep_alive": KEEP_ALIVE_S,
    "limit_concurrency": MAX_CONNECTIONS,
    "h11_max_incomplete_event_size": MAX_HEAD_BYTES,
    "proxy_headers": False,  # the client is whoever connects: app/http/keys.py decides by it
    "server_header": False,
}

log = structlog.get_logger()


class DrainingServer(uvicorn.Server):
    """On the first signal, stays reachable (readyz 503) until the waiting queries are answered, then exits with 0.

    uvicorn alone closes the port at once, and kills itself with the signal when done. Evaluations are cancelled
    before connections are closed, else those who follow one would keep the service from ending.
    """

    def __init__(self, config: uvicorn.Config, indexes: Indexes, jobs: EvaluationJobs) -> None:
        super().__init__(config)
        self._indexes = indexes
        self._jobs = jobs
        self._is_ending = False

    async def startup(self, sockets: list[socket] | None = None) -> None:
        """Listen, and say where the page is."""
        if threading.current_thread() is threading.main_thread():
            signal.signal(signal.SIGHUP, self.handle_exit)  # a terminal that closes ends it as others do
        await super().startup(sockets)
        if self.started:
            port = self.servers[0].sockets[0].getsockname()[1]  # the one that was free, if the settings say 0
            log.info("page", url=page_url(self.config.host, port))

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        """Drain; a second signal does not wait for that."""
        if self._is_ending:
            super().handle_exit(sig, frame)
        self._is_ending = True
        self._indexes.drain()

    async def on_tick(self, counter: int) -> bool:
        """Whether to leave, asked ten times a second."""
        if self._is_ending:
            self._indexes.drain()  # again: a signal may have come before the queue was started
        return await super().on_tick(counter) or (self._is_ending and self._indexes.is_idle)

    async def shutdown(self, sockets: list[socket] | None = None) -> None:
        """Leave."""
        await self._jobs.close()
        await super().shutdown(sockets)


def serve(app: FastAPI, settings: Settings) -> None:
    """Serve an application until a signal ends it."""
    if settings.read_key is None and not is_local(settings.host):
        log.warning("no key", host=settings.host, remedy="whoever reaches this host can ask: set HEREABOUTS_READ_KEY")
    if settings.log_descriptions:
        log.warning(
            "descriptions are logged", remedy="the log holds what users write: unset HEREABOUTS_LOG_DESCRIPTIONS"
        )
    config = uvicorn.Config(
        app,
        host=settings.host,
        port=settings.port,
        access_log=False,
        log_config=None,
        timeout_graceful_shutdown=MAX_DEADLINE_MS // 1000 + CLOSING_S,
        **CONNECTION_OPTIONS,
    )
    DrainingServer(config, app.state.indexes, app.state.jobs).run()


def page_url(host: str, port: int) -> str:
    """Where a browser on this machine finds the page.

    Args:
        host: what the service listens on; all of a machine's addresses ("0.0.0.0") are none to go to.
        port: of it.
    """
    address = address_of(host)
    if not host or (address and address.is_unspecified):
        host = "localhost"
    elif isinstance(address, IPv6Address):
        host = f"[{host}]"
    return f"http://{host}:{port}/"
