"""Aliases that move while many ask, over the network; SWITCHES sets how often."""

import os
import shutil
import threading
import time
from dataclasses import replace

import httpx
import pytest
from fake_localizer import FakeLocalizer

from app import main
from app.http import indexes
from app.main import create_app
from app.settings import Settings
from index.build.artifact import open_version, read_aliases, register, set_alias

CLIENTS, SWITCHES, VERSIONS = 64, int(os.environ.get("SWITCHES", "40")), ("v1", "v2", "v3")
COMPUTING_S = 0.03  # so that requests wait, are computed, and are answered while an alias moves; 64 take two seconds


class Versioned(FakeLocalizer):
    """Says which version answers."""

    def __init__(self, version):
        super().__init__()
        self.facts = replace(self.facts, version=version)

    def localize(self, queries):
        time.sleep(COMPUTING_S)
        assert not self.is_closed
        return [replace(answer, warnings=(self.facts.version,)) for answer in super().localize(queries)]


@pytest.fixture
def root(versions_dir, tmp_path):
    """An index directory with three versions, of which the first is served."""
    root = tmp_path / "index"
    for version in VERSIONS:
        shutil.copytree(versions_dir / "v1", root / version)
        manifest = root / version / "manifest.json"
        manifest.write_text(manifest.read_text().replace('"v1"', f'"{version}"'))
        register(root, version)
    set_alias(root, "default", "v1")
    return root


class Clients:
    """Threads that ask until they are told to end, and what they saw."""

    def __init__(self, client, root, version):
        self.client, self.root = client, root
        self.version = version  # that has to answer; None while that changes
        self.switches = 0
        self.versions_seen, self.errors = [], []
        self.ends = threading.Event()

    def ask(self):
        while not self.ends.is_set() and not self.errors:
            switches, version = self.switches, self.version
            try:
                response = self.client.post("/localize", json={"description": "a tree"})
                answer = response.raise_for_status().json()
            except httpx.HTTPError as error:
                self.errors.append(error)
                return
            index_version, answer_warnings = answer["provenance"]["index_version"], answer["warnings"]
            self.versions_seen.append(index_version)
            if answer_warnings != [index_version]:
                self.errors.append(f"{index_version} is said, {answer_warnings} answered")
            if version not in (index_version, None) and switches == self.switches:
                self.errors.append(f"{index_version} answered after GET /indexes named {version}")

    def switch(self, version, until):
        self.version = None
        self.switches += 1
        set_alias(self.root, "default", version)
        until(lambda: self.client.get("/indexes").json()["aliases"] == {"default": version})
        self.version = version


@pytest.mark.slow
def test_switches_under_64_clients_lose_nothing_and_no_answer_mixes_versions(root, in_a_thread, until, monkeypatch):
    opened = []

    def open_version_of(order, _count):
        opened.append(Versioned(open_version(order.index_dir)[1].version))
        return opened[-1:]

    monkeypatch.setattr(main, "open_workers", open_version_of)
    monkeypatch.setattr(indexes, "ALIAS_POLL_S", 0.01)
    every = httpx.Limits(max_connections=CLIENTS + 1, max_keepalive_connections=CLIENTS + 1)
    with (
        in_a_thread(create_app(Settings(index_dir=root, max_wait_ms=60_000))) as port,
        httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=60, limits=every) as client,
    ):
        clients = Clients(client, root, "v1")
        threads = [threading.Thread(target=clients.ask) for _ in range(CLIENTS)]
        for thread in threads:
            thread.start()
        try:
            for n in range(1, SWITCHES + 1):
                clients.switch(VERSIONS[n % 3], until)
        finally:
            clients.ends.set()
            for thread in threads:
                thread.join()
        assert clients.errors == []
        assert set(clients.versions_seen) == set(VERSIONS)
        until(lambda: sum(not fake.is_closed for fake in opened) == 1)
    assert all(fake.is_closed for fake in opened)
    assert len(opened) == SWITCHES + 1
    assert read_aliases(root).aliases == {"default": VERSIONS[SWITCHES % 3]}
