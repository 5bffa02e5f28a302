"""A localizer without a model for test_workers.py; its answers name the worker."""

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
        text = queries[0].description
        if text == "die":
            os._exit(1)
        if text.startswith("die once ") and not os.path.exists(text[9:]):
            open(text[9:], "w").close()
            os.kill(os.getpid(), signal.SIGKILL)
        if text == "reply":
            raise ReplyError(2, "choice", "another one")
        if text == "fault":
            raise KeyError("what it was")
        if "quoted" in text:
            raise ValueError(f"cannot read {text!r}")
        if "deadly" in text:
            os._exit(1)
        if text == "slow":
            time.sleep(0.5)
        return [Answer("no_match", FakeLocalizer.facts.model, warnings=(str(os.getpid()), str(os.getppid())))]

    def describe(self, position_m, language=None):
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
