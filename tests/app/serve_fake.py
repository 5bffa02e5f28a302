"""Run by test_server.py: the service's own server in a process, with a fake localizer that tells what it computes
and, for a hint with the word "held", waits for a line on stdin."""

import sys
from pathlib import Path

from fake_localizer import FakeLocalizer

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
app = create_app(settings, TellingLocalizer)
app.state.jobs._command = (sys.executable, Path(__file__).parent / "jobs/fake_worker.py")
app.add_api_route("/waiting", lambda: len(app.state.queue._jobs))
serve(app, settings)
