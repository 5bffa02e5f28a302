"""Run by test_batch.py: the command line with fake workers that take 5 ms a row. Arguments: those of `hereabouts`."""

import sys
import time
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import patch

sys.path.append(str(Path(__file__).parents[1]))

from fake_localizer import FakeLocalizer

from app.cli.main import app


class Slow(FakeLocalizer):
    def localize(self, queries):
        time.sleep(0.005)
        return super().localize(queries)


manifest = SimpleNamespace(version="v1", frame=SimpleNamespace(origin_lat=60.17))
with (
    patch("app.workers.remote.open_workers", lambda _spec, _count: [Slow(), Slow()]),
    patch("index.build.artifact.open_version", lambda index_dir: (index_dir, manifest)),
    patch("app.workers.launch.PRELOADED_MODULE", "string"),
):
    app()
