"""An index directory of two small versions, and places where it may be."""

import contextlib
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import fsspec
import pytest

from index.remote.copy import LocalCopy
from index.remote.place import Place
from tests.versions import write_index


@pytest.fixture
def index(tmp_path):
    return write_index(tmp_path / "index")


@pytest.fixture
def bucket():
    """What is in memory, as in a bucket: its file system and its URL."""
    files = fsspec.filesystem("memory")
    files.store.clear()
    yield files, "memory://bucket/town"
    files.store.clear()


@pytest.fixture
def web_server(index):
    """The index directory on a web server, which ends when it is told to: its URL, and what ends it."""

    class Quiet(SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    with contextlib.ExitStack() as stack:
        server = stack.enter_context(ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(index))))
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        stack.callback(thread.join)
        stack.callback(server.shutdown)
        yield f"http://127.0.0.1:{server.server_port}"


@pytest.fixture
def copy_of(tmp_path):
    """A local copy of what is behind a URL, and its directory."""

    def make(url):
        root = tmp_path / "copy"
        return LocalCopy(Place(url), root), root

    return make
