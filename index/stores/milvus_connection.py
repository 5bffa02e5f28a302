"""A connection to Milvus: one per process, with a time limit per call and one kind of error."""

import logging
import os
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Final

from models.errors import StoreUnavailable

if TYPE_CHECKING:
    from pymilvus import MilvusClient

URI: Final = "HEREABOUTS_MILVUS_URI"
TOKEN: Final = "HEREABOUTS_MILVUS_TOKEN"
CONNECT_TIMEOUT_S: Final = 2.0
CALL_TIMEOUT_S: Final = 3.0  # until then, pymilvus retries if the server is lost or busy


class MilvusConnection:
    """Calls to the Milvus server that HEREABOUTS_MILVUS_URI names (http://host:port/database), or StoreUnavailable.

    It connects at the first call. gRPC channels do not survive a fork, so a process must not call before it forks
    workers. After a failed call it reconnects, and so finds a restarted server.
    """

    def __init__(self) -> None:
        if find_spec("pymilvus") is None:
            raise StoreUnavailable("this index is in Milvus, which needs pymilvus: pip install 'hereabouts[milvus]'")
        if not os.environ.get(URI):
            raise StoreUnavailable(f"this index is in Milvus; set {URI}=http://HOST:19530/DATABASE")
        self._client: MilvusClient | None = None
        self._pid = 0

    def call(self, method: str, *arguments: Any, timeout_s: float = CALL_TIMEOUT_S, **named: Any) -> Any:
        """Call a method of pymilvus's MilvusClient; StoreUnavailable if Milvus refuses or does not answer in time."""
        from grpc import RpcError  # noqa: PLC0415  # an extra, which few have
        from pymilvus import MilvusException  # noqa: PLC0415

        try:
            return getattr(self._connected(), method)(*arguments, timeout=timeout_s, **named)
        except (MilvusException, RpcError, ValueError) as error:  # ValueError: the channel was closed
            self.close()
            message = str(error).replace(os.environ[URI], "the address")  # may contain a password
            raise StoreUnavailable(f"Milvus cannot {method}: {message}; check the server that {URI} names") from error

    def _connected(self) -> "MilvusClient":
        if self._client is None or self._pid != os.getpid():
            from pymilvus import MilvusClient  # noqa: PLC0415

            logging.getLogger("pymilvus").setLevel(logging.CRITICAL)  # it logs every error that it raises
            uri, token = os.environ[URI], os.environ.get(TOKEN, "")
            self._client = MilvusClient(uri, token=token, timeout=CONNECT_TIMEOUT_S, dedicated=True)
            self._pid = os.getpid()
        return self._client

    def close(self) -> None:
        """Close the connection; the next call connects again."""
        if self._client is not None and self._pid == os.getpid():
            self._client.close()
        self._client = None
