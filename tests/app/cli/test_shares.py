"""`hereabouts index` in shares: what it asks for, and what does not go together."""

import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from typer.testing import CliRunner

from app.cli import maps
from app.cli.main import app
from app.threads import THREAD_VARIABLES
from index.build.shard import Shard

OPTIONS = ("index", "--map", "a.osm", "--out", "o")


@pytest.fixture(autouse=True)
def calls(monkeypatch):
    """The requested calls; nothing is done."""
    for name in THREAD_VARIABLES:
        monkeypatch.setenv(name, "1")
    made = []

    class Job:
        def __init__(self, map_path, out_dir, _weights_dir, _split, keep_current, levels, store, _region, _extras):
            self.given = map_path, out_dir, keep_current, levels, store

        def make_shard(self, shard, _show):
            made.append((*self.given, shard))
            return Path("o/.parts/x/2-of-4")

        def merge(self, count, _show):
            made.append((*self.given, count))
            return Path("o/v1")

    def build_on_ray(job, count, address, _show):
        made.append((*job.given, count, address))
        return Path("o/v2")

    monkeypatch.setattr(maps, "print_index_summary", lambda _path: None)
    monkeypatch.setitem(sys.modules, "index.build.build", SimpleNamespace(IndexJob=Job))
    monkeypatch.setitem(sys.modules, "index.build.ray_shards", SimpleNamespace(build_on_ray=build_on_ray))
    return made


def run(*arguments):
    return CliRunner().invoke(app, [*OPTIONS, *arguments], env={"COLUMNS": "200", "TERM": "dumb", "NO_COLOR": "1"})


def test_a_shard_is_made_and_what_comes_next_is_said(calls) -> None:
    result = run("--shard", "2/4", "--no-levels")
    assert result.stdout == (
        "shard 2/4 is in o/.parts/x/2-of-4; once all 4 are built, run this with --merge 4 instead of --shard 2/4\n"
    )
    assert calls == [(Path("a.osm"), Path("o"), False, False, "faiss", Shard(2, 4))]


def test_shards_are_merged_here_or_made_in_a_cluster(calls) -> None:
    result = run("--merge", "4", "--keep-current", "--store", "milvus")
    assert result.stdout == "index v1 is in o/v1; serve it with: hereabouts serve --index o\n"
    result = run("--engine", "ray", "--address", "head:6379", "--merge", "3")
    assert result.stdout == "index v2 is in o/v2; serve it with: hereabouts serve --index o\n"
    assert run("--engine", "ray").exit_code == 0
    given = Path("a.osm"), Path("o")
    assert calls == [
        (*given, True, True, "milvus", 4),
        (*given, False, True, "faiss", 3, "head:6379"),
        (*given, False, True, "faiss", None, None),
    ]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        *((("--shard", text), "is not a shard; expected") for text in ("5/4", "0/4", "x", "", "4")),
        (("--merge", "0"), "Invalid value for '--merge'"),
        (("--engine", "spark"), "Invalid value for '--engine'"),
        (("--shard", "1/2", "--merge", "2"), "give one of them"),
        (("--shard", "1/2", "--engine", "ray"), "give one of them"),
        (("--shard", "1/2", "--keep-current"), "leave it out with --shard"),
        (("--address", "head:6379"), "give --engine ray with it"),
    ],
)
def test_what_cannot_be_meant_is_a_usage_error(calls, arguments, message) -> None:
    result = run(*arguments)
    assert result.exit_code == 2
    assert message in " ".join(result.stderr.split())
    assert not calls
