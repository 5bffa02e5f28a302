"""What test_workers.py has its workers open: no model, an answer that says who gave it."""

import os
import signal
import sys
import time

from fake_localizer import FakeLocalizer

from index.answering.answers import Answer
from models.errors import IndexBroken, ReplyError


class Fake:
    facts, frame = FakeLocalizer.facts, FakeLocalizer().frame

    def localize(self, queries):
        said = queries[0].description
        if said == "die":
            os._exit(1)
        if said.startswith("die once ") and not os.path.exists(said[9:]):
            open(said[9:], "w").close()
            os.kill(os.getpid(), signal.SIGKILL)
        if said == "reply":
            raise ReplyError(2, "choice", "another one")
        if said == "fault":
            raise KeyError("what it was")
        if "quoted" in said:
            raise ValueError(f"cannot read {said!r}")
        if "deadly" in said:
            os._exit(1)
        if said == "slow":
            time.sleep(0.5)
        return [Answer("no_match", FakeLocalizer.facts.model, warnings=(str(os.getpid()), str(os.getppid())))]

    def describe(self, position_m):
        return os.getpid(), position_m

    def cell(self, cell_id):
        return "imported" if cell_id in sys.modules else os.environ.get(cell_id)

    def scenery(self, number):
        os._exit(1)


class Order:
    def open(self):
        return Fake()


class Broken:
    def open(self):
        raise IndexBroken("cut short")
