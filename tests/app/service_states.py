"""Services without a model in all the states in which a client can find one."""

import threading

from fake_localizer import FakeLocalizer
from local_client import local_client

from app.main import create_app
from app.settings import Settings
from models.errors import IndexBroken


class Services:
    """Services in all the states that a status comes from, each started when a test first asks for it."""

    def __init__(self, stack, until, root, part):
        self._stack, self._until, self.root = stack, until, root
        self._started, self._ends = {}, threading.Event()
        self.fake = FakeLocalizer(parts=[part])

    def open(self):
        return self.fake

    def __call__(self, name="usual", opens=None, is_ready=True, **settings):
        key = name, *sorted(settings.items())
        if key not in self._started:
            app = create_app(Settings(**{"index_dir": self.root, **settings}), opens or self._opened)
            api = self._started[key] = self._stack.enter_context(local_client(app))
            self._stack.callback(self._ends.set)  # before it is closed, which waits for what is being opened
            if is_ready:
                self._until(lambda: api.get("/readyz").status_code == 200)
        return self._started[key]

    def _opened(self):
        return self.open()  # or what a test has put in its place meanwhile

    def loading(self):
        return self("loading", lambda: self._ends.wait(60) and self.fake, is_ready=False)

    def failed(self):
        api = self("failed", raises(IndexBroken), is_ready=False)
        self._until(lambda: api.get("/readyz").json()["code"] == "load_failed")
        return api

    def draining(self):
        api = self("draining")
        api.app.state.indexes.drain()
        return api


def raises(error):
    def fails(*_arguments, **_more):
        raise error

    return fails
