"""A real Milvus for tests: the wheel `milvus`, which has the server in it."""

import os
import signal
import socket
import subprocess
import sys
import time
from importlib.util import find_spec
from pathlib import Path

START_S = 120
MISSING = [name for name in ("pymilvus", "milvus") if find_spec(name) is None]
SKIPPED = f"{' and '.join(MISSING)} not installed: pip install 'hereabouts[dev]' on Linux, x86-64" if MISSING else ""


# Of the etcd in Milvus: by default it listens on ports of its own, so that a machine bears one Milvus alone.
ETCD = """\
listen-client-urls: {client}
advertise-client-urls: {client}
listen-peer-urls: {peer}
initial-advertise-peer-urls: {peer}
initial-cluster: default={peer}
"""


class MilvusServer:
    """A Milvus on data of its own, which can be killed and started again.

    `milvus-server` starts the server proper as a child, which does not heed SIGTERM: all of its session is killed.
    """

    def __init__(self, data: Path) -> None:
        self.data, self.port = data, free_port()
        self.uri = f"http://127.0.0.1:{self.port}"
        self._etcd = data / "etcd.yaml"
        client, peer = (f"http://127.0.0.1:{free_port()}" for _ in range(2))
        self._etcd.write_text(ETCD.format(client=client, peer=peer))
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        from pymilvus import MilvusClient, MilvusException

        self._process = subprocess.Popen(
            self._command(),
            cwd=self.data,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env=self._environment(),
            start_new_session=True,
        )
        end_s = time.monotonic() + START_S
        while True:
            assert self._process.poll() is None, f"Milvus ended; its log is in {self.data}/logs"
            try:
                client = MilvusClient(self.uri, timeout=2, dedicated=True)
                client.list_collections(timeout=5)
                client.close()
                return
            except MilvusException:
                assert time.monotonic() < end_s, f"Milvus does not answer; its log is in {self.data}/logs"
                time.sleep(0.2)

    def _command(self) -> list[str]:
        """`milvus-server` unpacks the server, and would take another port where connections of a killed one linger."""
        if (self.data / "configs").exists():
            return [str(self.data / "bin" / "milvus"), "run", "standalone"]
        starter = Path(sys.executable).with_name("milvus-server")
        return [str(starter), "--data", str(self.data), "--proxy-port", str(self.port)]

    def _environment(self) -> dict[str, str]:
        return {
            **os.environ,
            "ETCD_CONFIG_PATH": str(self._etcd),
            "DEPLOY_MODE": "STANDALONE",
            "METRICS_PORT": str(free_port()),
            "COMMON_SESSION_TTL": "10",  # seconds that a killed server holds its place, before the next one's work
            "DATACOORD_SEGMENT_ASSIGNMENTEXPIRATION": "200",  # ms that every flush waits for
            "MILVUS_RUN_DIR": str(self.data / "run"),
            "LD_LIBRARY_PATH": str(self.data / "bin"),
        }

    def kill(self) -> None:
        if self._process is not None:
            os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()
            self._process = None


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
