"""Run by test_server.py and test_kept.py: the service's own server in a process, with a fake localizer that tells what
it computes and, for a hint with the word "held", waits for a line on stdin. Arguments: the port; the jobs' command."""

import sys
from functools import partial
from pathlib import Path
from unittest.mock import patch

from fake_localizer import FakeLocalizer

from app import main
from app.jobs.runner import EvaluationJobs
from app.logs import configure_logging
from app.main import create_app
from app.server import serve
from app.settings import load_settings


class TellingLocalizer(FakeLocalizer):
    def localize(self, queries):
        print(*(query.description for query in queries), sep="\n", flush=True)
        if "held" in queries[0].description:
            sys.stdin.readline()
        return super().localize(queries)


settings = load_settings(port=int(sys.argv[1]))
configure_logging("info")
worker = sys.argv[2:] or (sys.executable, Path(__file__).parent / "jobs/fake_worker.py")
with patch.object(main, "EvaluationJobs", partial(EvaluationJobs, command=worker)):
    app = create_app(settings, TellingLocalizer)
app.add_api_route("/waiting", lambda: len(app.state.indexes.queue()._pending))
serve(app, settings)
