"""The index directory and the service that `chaos` kills, with everything that writes there.

An operation is prepared, done, killed meanwhile or not, and checked once the service was started again.
"""

import os
import select
import shutil
import signal
import threading
import time
from contextlib import contextmanager, suppress

import httpx

from app.jobs.evaluation import Evaluation
from app.jobs.job import JobState
from index.build.artifact import ALIASES_FILE, Aliases, open_version, read_aliases
from index.build.manifest import MANIFEST
from models.files import TEMP_PREFIX, remove_abandoned, replace_file

SHORTER, LONGER = 0.95, 1.05
VERSIONS, JOBS = 6, 3  # that are there at once, or checking would take longer and longer


@contextmanager
def killing(pid, after_s):
    """Kill a process in a while, if that is not None and the process has not ended by then."""
    pidfd = os.pidfd_open(pid)

    def kill():
        with suppress(ProcessLookupError):
            signal.pidfd_send_signal(pidfd, signal.SIGKILL)

    timer = threading.Timer(after_s or 0, kill)
    if after_s is not None:
        timer.start()
    try:
        yield pidfd
    finally:
        if after_s is not None:
            timer.join()
        os.close(pidfd)


class Place:
    """An index directory and a service on it.

    Args:
        mould: builds and serves.
        root: the directory; the jobs are beside it.
    """

    def __init__(self, mould, root):
        self.mould, self.root, self.jobs = mould, root, root.with_name("jobs")
        self.pid, self.url = None, None

    def start(self):
        """Start the service, which has to answer from the version that its alias names, and to find all whole."""
        self.pid, self.url = self.mould.serve(self.root)
        remove_abandoned(self.root)  # as the next build does
        left = [path.name for top in (self.root, self.jobs) for path in top.rglob(f"{TEMP_PREFIX}*")]
        assert not left, f"left behind: {left}"
        known = read_aliases(self.root)
        whole = {open_version(self.root / version)[0].name for version in self.versions()}
        assert {*known.versions, *known.aliases.values()} <= whole, "an alias or a registration without its version"
        answer = self.mould.http.post(f"{self.url}/localize", json={"description": "a tree"})
        assert answer.is_success, f"the service answers {answer.text}"
        assert answer.json()["provenance"]["index_version"] == self.default(), "another version answers"

    def end(self):
        """Kill the service, if it still is."""
        with killing(self.pid, 0):
            self.mould.wait(self.pid)

    def post(self, path, body, kill_after_s):
        """Return the acknowledgement; None if the service was killed first."""
        try:
            with killing(self.pid, kill_after_s):
                answer = self.mould.http.post(self.url + path, json=body)
        except httpx.TransportError:
            assert kill_after_s is not None, "the service dies by itself"
            return None
        assert answer.is_success, f"{path} is answered {answer.text}"
        return answer.json()

    def versions(self):
        """The names of all directories that ought to be versions."""
        return {path.name for path in self.root.iterdir() if path.is_dir()}

    def default(self):
        return read_aliases(self.root).aliases["default"]

    def state_on_disk(self):
        """Return the names of all files and the aliases: any change shows here."""
        names = [*self.root.rglob("*"), *self.jobs.iterdir()]
        return set(map(str, names)), (self.root / ALIASES_FILE).read_bytes()

    def add(self, version):
        """Put a version there as an operator would, without registering it."""
        source = self.root / self.default()
        shutil.copytree(source, self.root / version, copy_function=os.link)
        manifest = (source / MANIFEST).read_text().replace(source.name, version)
        replace_file(self.root / version / MANIFEST, manifest.encode())

    def prune(self):
        """Remove versions that no alias names, but for a few."""
        known = read_aliases(self.root)
        for version in sorted(self.versions() - set(known.aliases.values()))[:-VERSIONS]:
            known.versions.pop(version, None)
            shutil.rmtree(self.root / version)
        replace_file(self.root / ALIASES_FILE, Aliases(**known.model_dump()).model_dump_json().encode())


class Operation:
    """Something that writes.

    Args:
        place: where.
    """

    def __init__(self, place):
        self.place = place
        self.count = 0
        self.takes_s = 0.0  # as measured, then a little less after a kill that came too late, or more

    def prepare(self):
        self.count += 1
        self.place.prune()
        self.before = self.place.versions(), read_aliases(self.place.root)

    def do(self, share=None):
        """Return the acknowledgement; None if the service was killed first.

        Args:
            share: of the time that it takes, after which it is killed; None: it is not.
        """
        started_s = time.monotonic()
        acknowledged = self.place.post(*self.request(), share and share * self.takes_s)
        if share is None:
            self.takes_s = time.monotonic() - started_s
        self.takes_s *= SHORTER if acknowledged else LONGER
        return acknowledged


class Build(Operation):
    """Every other time it is killed after a share of the time that it writes, which is the last part of a build."""

    def __init__(self, place):
        super().__init__(place)
        self.writes_s = 0.0

    def do(self, share=None):
        """Whether it was acknowledged, by exit status 0; then there is nothing left to kill."""
        started_s = time.monotonic()
        pid = self.place.mould.build(self.place.root)
        length_s = self.takes_s
        if share is None or self.count % 2:
            self._wait_until_it_writes(pid)
            length_s, begun_s = self.writes_s, time.monotonic()
        with killing(pid, share and share * length_s):
            status, output = self.place.mould.wait(pid)
        assert status in (0, -signal.SIGKILL), output
        if share is None:
            self.takes_s, self.writes_s = time.monotonic() - started_s, time.monotonic() - begun_s
        return status == 0

    def _wait_until_it_writes(self, pid):
        with killing(pid, None) as ended:
            while not any(self.place.root.glob(f"{TEMP_PREFIX}*")) and not select.select([ended], [], [], 0.001)[0]:
                continue

    def check(self, acknowledged):
        built = self.place.versions() - self.before[0]
        assert len(built) == 1 if acknowledged else len(built) <= 1, f"it built {built}"
        named = built if acknowledged else built | {self.before[1].aliases["default"]}
        assert self.place.default() in named, "default names another version"


class Switch(Operation):
    """`hereabouts alias set` of a version that was copied there, which registers it and lets the default name it."""

    def prepare(self):
        super().prepare()
        self.version = f"copied-{self.count}"
        self.place.add(self.version)

    def do(self, share=None):
        """Whether it was acknowledged, by exit status 0."""
        started_s = time.monotonic()
        pid = self.place.mould.set_alias(self.place.root, "default", self.version)
        with killing(pid, share and share * self.takes_s):
            status, output = self.place.mould.wait(pid)
        assert status in (0, -signal.SIGKILL), output
        if share is None:
            self.takes_s = time.monotonic() - started_s
        self.takes_s *= SHORTER if status == 0 else LONGER
        return status == 0

    def check(self, acknowledged):
        now, (_, before) = read_aliases(self.place.root), self.before
        previous = before.aliases["default"]
        assert self.place.default() in ({self.version} if acknowledged else {self.version, previous}), "wrong default"
        assert self.version in now.versions or not acknowledged, "it is not registered"
        assert now.versions.keys() - {self.version} == before.versions.keys(), "other registrations changed"


class Evaluate(Operation):
    def __init__(self, place):
        super().__init__(place)
        self.acknowledged = []

    def prepare(self):
        super().prepare()
        while len(self.acknowledged) > JOBS:
            job = f"{self.place.url}/evaluate/{self.acknowledged.pop(0)}"
            while self.place.mould.http.delete(job).is_success:  # the first may cancel it, the next forgets it
                continue
        self.there = set(self.place.jobs.iterdir())

    def request(self):
        return "/evaluate", {"queries": [{"hints": ["a tree"], "position": [1, 2]}]}

    def check(self, acknowledged):
        added = {path.name for path in set(self.place.jobs.iterdir()) - self.there}
        assert len(added) <= 1, f"jobs that nobody sent: {added}"
        if acknowledged:
            self.acknowledged.append(acknowledged["job"])
        for job in {*self.acknowledged, *added}:
            answer = self.place.mould.http.get(f"{self.place.url}/evaluate/{job}")
            assert answer.is_success, f"job {job} is unknown"
            JobState.model_validate(answer.json())
            Evaluation.model_validate_json((self.place.jobs / job / "evaluation.json").read_bytes())


OPERATIONS = (Build, Switch, Evaluate)
