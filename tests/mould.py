"""A process that has torch and a small made town, and forks others which index it or serve: an import takes seconds.

Versions are served by fakes that say which they are, and evaluations are fake. Run by `Mould`; an order is a line of
JSON on stdin, its answer one on stdout.
"""

import ctypes
import json
import os
import resource
import signal
import socket
import subprocess
import sys
import time
import traceback
from dataclasses import replace
from functools import partial
from pathlib import Path
from unittest.mock import patch

import httpx

from app import main
from app.jobs import runner
from app.threads import THREAD_VARIABLES

ROOT = Path(__file__).parents[1]
SIZE_M = 60  # of the town
WORKER = (sys.executable, str(ROOT / "tests/app/jobs/fake_worker.py"))
CAPSET_VERSION = 0x20080522
START_S = 60


class Mould:
    """The process, from outside.

    Args:
        scratch: a directory for the town, the weights, logs, and `index` with a version of the town.
    """

    def __init__(self, scratch):
        self.scratch = scratch
        self._log = scratch / "mould.log"
        with self._log.open("wb") as log:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "tests.mould", str(scratch)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
                cwd=ROOT,
                # What is forked would wait for threads that it has not; what is killed leaves its temporary files.
                env=os.environ | dict.fromkeys(THREAD_VARIABLES, "1") | {"TMPDIR": str(scratch)},
                text=True,
            )
        self.http = httpx.Client(timeout=START_S)
        self._read()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.http.close()
        self._process.communicate()

    def build(self, out, **limits):
        """Begin to index the town as `hereabouts index` does; the process."""
        return self._ask(do="build", out=str(out), **limits)

    def set_alias(self, root, alias, version, **limits):
        """Begin `hereabouts alias set` on an index directory; the process."""
        return self._ask(do="set_alias", root=str(root), alias=alias, version=version, **limits)

    def serve(self, root, jobs="jobs", **limits):
        """Start a service on an index directory; its process, and where it answers, once it does.

        Args:
            root: the index directory.
            jobs: the name of a directory beside it.
            limits: file_bytes, beyond which no file grows; is_bound, if permissions are to bind it, though it be root.
        """
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        pid = self._ask(do="serve", root=str(root), jobs=str(root.with_name(jobs)), port=port, **limits)
        url, end = f"http://127.0.0.1:{port}", time.monotonic() + START_S
        while not self._is_ready(url):
            assert time.monotonic() < end, self.wait(pid)
            time.sleep(0.01)
        return pid, url

    def _is_ready(self, url):
        try:
            return self.http.get(f"{url}/readyz").is_success
        except httpx.TransportError:
            return False

    def wait(self, pid):
        """How a process ended, as `subprocess.Popen.returncode`, and what it printed unless it was killed."""
        return self._ask(do="wait", pid=pid)

    def _ask(self, **order):
        print(json.dumps(order), file=self._process.stdin, flush=True)
        return self._read()

    def _read(self):
        line = self._process.stdout.readline()
        assert line, self._log.read_text()
        return json.loads(line)


class _Forks:
    """Inside: forks what is ordered."""

    def __init__(self, scratch):
        import app.server  # noqa: F401  # once for all that are forked
        import index.build.build  # noqa: F401
        from models.language.text_encoder import load_text_encoder
        from models.paper.checkpoint import save_retriever
        from models.paper.mncl import Mncl, MnclConfig
        from tests import conftest

        self._map, self._weights, self._log = scratch / "town.osm", scratch / "weights", scratch / "service.log"
        self._pipes = {}  # by process, where to read what it prints
        with patch.object(conftest, "SIZE_M", SIZE_M):
            self._map.write_text(conftest.tiny_osm())
        save_retriever(Mncl(load_text_encoder(), MnclConfig(width=32, levels=("global",))), self._weights, {})
        status, output = self.wait(self.fork(self.build, {"out": str(scratch / "index")}))
        assert status == 0, output

    def answer(self, do, pid=None, **order):
        return self.wait(pid) if do == "wait" else self.fork(getattr(self, do), order)

    def wait(self, pid):
        status = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
        with open(self._pipes.pop(pid), errors="replace") as output:
            return status, "" if status < 0 else output.read()

    def end(self):
        for pid in self._pipes:
            os.kill(pid, signal.SIGKILL)

    def fork(self, do, order):
        reads, writes = os.pipe()
        pid = os.fork()
        if pid:
            os.close(writes)
            self._pipes[pid] = reads
            return pid
        try:
            os.dup2(writes, 1)
            os.dup2(writes, 2)
            do(**order)
        except SystemExit as end:
            os._exit(end.code or 0)
        except Exception:
            traceback.print_exc()
        finally:
            os._exit(1)

    def build(self, out, **limits):
        from app.cli.main import app

        os.environ["HEREABOUTS_WEIGHTS_DIR"] = str(self._weights)
        _limit(**limits)
        app(["index", "--map", str(self._map), "--out", out])

    def set_alias(self, root, alias, version, **limits):
        from app.cli.main import app

        _limit(**limits)
        app(["alias", "set", alias, version, "--index", root])

    def serve(self, root, jobs, port, **limits):
        from app.jobs.runner import EvaluationJobs
        from app.logs import configure_logging
        from app.main import create_app
        from app.server import serve
        from app.settings import Settings

        log = os.open(self._log, os.O_WRONLY | os.O_CREAT | os.O_APPEND)
        os.dup2(log, 1)
        os.dup2(log, 2)
        configure_logging("warning")
        settings = Settings(index_dir=root, jobs_dir=jobs, port=port)
        with (
            patch.object(main, "open_workers", _open_fakes),
            patch.object(main, "EvaluationJobs", partial(EvaluationJobs, command=WORKER, max_waiting=1000)),
            patch.object(runner, "MAX_FINISHED_JOBS", 1000),
        ):
            _limit(**limits)
            serve(create_app(settings), settings)


def _open_fakes(order, _count):
    """Open a fake localizer on a complete version."""
    from index.build.artifact import open_version
    from tests.app.fake_localizer import FakeLocalizer

    fake = FakeLocalizer()
    fake.facts = replace(fake.facts, version=open_version(order.index_dir)[1].version)
    return [fake]


def _limit(file_bytes=None, is_bound=False):
    if file_bytes is not None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (file_bytes, resource.RLIM_INFINITY))
    if is_bound:
        header, nothing = (ctypes.c_uint32 * 2)(CAPSET_VERSION, 0), (ctypes.c_uint32 * 6)()
        libc = ctypes.CDLL(None, use_errno=True)
        assert libc.capset(header, nothing) == 0, os.strerror(ctypes.get_errno())


if __name__ == "__main__":
    forks = _Forks(Path(sys.argv[1]))
    print("true", flush=True)
    for line in sys.stdin:
        print(json.dumps(forks.answer(**json.loads(line))), flush=True)
    forks.end()
