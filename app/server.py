"""Running the service and shutting it down without dropping requests."""

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

CLOSING_S: Final = 5  # to close connections after the longest deadline
KEEP_ALIVE_S: Final = 10
MAX_HEAD_BYTES: Final = 65_536  # of the request line and headers
CONNECTION_OPTIONS: Final[dict[str, Any]] = {  # of uvicorn; leave slow clients to a reverse proxy
    "http": "h11",
    "timeout_keep_alive": KEEP_ALIVE_S,
    "limit_concurrency": MAX_CONNECTIONS,
    "h11_max_incomplete_event_size": MAX_HEAD_BYTES,
    "proxy_headers": False,  # app/http/keys.py needs the address of the connecting client
    "server_header": False,
}

log = structlog.get_logger()


class DrainingServer(uvicorn.Server):
    """A server that, on the first signal, answers the waiting queries (readyz is 503) and then exits with 0.

    uvicorn itself closes the port at once and exits with the signal. Evaluations are cancelled before connections are
    closed; otherwise clients that follow one would block the shutdown.
    """

    def __init__(self, config: uvicorn.Config, indexes: Indexes, jobs: EvaluationJobs) -> None:
        super().__init__(config)
        self._indexes = indexes
        self._jobs = jobs
        self._is_ending = False

    async def startup(self, sockets: list[socket] | None = None) -> None:
        """Start listening, and log the address of the page."""
        if threading.current_thread() is threading.main_thread():
            signal.signal(signal.SIGHUP, self.handle_exit)  # a closed terminal shuts the service down gracefully too
        await super().startup(sockets)
        if self.started:
            port = self.servers[0].sockets[0].getsockname()[1]  # the actual port if the setting is 0
            log.info("page", url=page_url(self.config.host, port))

    def handle_exit(self, sig: int, frame: FrameType | None) -> None:
        """Start draining; a second signal stops at once."""
        if self._is_ending:
            super().handle_exit(sig, frame)
        self._is_ending = True
        self._indexes.drain()

    async def on_tick(self, counter: int) -> bool:
        """Return whether to shut down; called ten times a second."""
        if self._is_ending:
            self._indexes.drain()  # again, because a signal may arrive before the queue starts
        return await super().on_tick(counter) or (self._is_ending and self._indexes.is_idle)

    async def shutdown(self, sockets: list[socket] | None = None) -> None:
        """Cancel evaluations, then close connections."""
        await self._jobs.close()
        await super().shutdown(sockets)


def serve(app: FastAPI, settings: Settings) -> None:
    """Serve an application until a signal stops it."""
    if settings.read_key is None and not is_local(settings.host):
        log.warning(
            "no key",
            host=settings.host,
            remedy="anyone who can reach this host can use the service; set HEREABOUTS_READ_KEY",
        )
    if settings.log_descriptions:
        log.warning(
            "descriptions are logged", remedy="the log contains users' texts; unset HEREABOUTS_LOG_DESCRIPTIONS"
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
    """Return the URL of the page for a browser on this machine; an unspecified host ("0.0.0.0") becomes localhost."""
    address = address_of(host)
    if not host or (address and address.is_unspecified):
        host = "localhost"
    elif isinstance(address, IPv6Address):
        host = f"[{host}]"
    return f"http://{host}:{port}/"
