"""Shards make the bytes of the whole, whoever is killed, cut short or one too many at it."""

import json
import os
import shutil
import signal
from dataclasses import replace

import pytest
from safetensors.numpy import load_file

from index.build import build, shard_store
from index.build.artifact import open_version
from index.build.build import IndexJob
from index.build.shard import Shard
from index.build.shard_data import FILE, ShardData
from index.build.shard_store import SHARDS_DIR
from models.citymap.cells import CELLS_PER_BLOCK
from models.errors import DataError, IndexBroken
from models.files import TEMP_PREFIX
from models.paper import instance_encoder, level_table, retriever
from models.posterior import statements
from tests.index_facts import index_facts

FIRST, SECOND = Shard.all(2)
LEVELS = ("global", "instance", "relation")


@pytest.fixture
def job(deep_parts, deep_file, rich_dir, tmp_path):
    """A job whose two shards are made, but not merged."""
    shutil.copytree(deep_parts, tmp_path / "out")
    return IndexJob(deep_file, tmp_path / "out", rich_dir, levels=True)


@pytest.fixture
def unread(monkeypatch):
    """No map is opened."""
    monkeypatch.setattr(build, "open_source", lambda *_: pytest.fail("the map was opened"))


@pytest.fixture
def given(job, monkeypatch):
    """The part of the second shard is gone; who makes it anew has it at once."""
    backup = job.out_dir / "kept"
    part_of(job, SECOND).rename(backup)
    monkeypatch.setattr(
        ShardData, "build", lambda _encoder, _likelihood, source, *_: ShardData.load(backup, LEVELS, source.data.cells)
    )


def part_of(job, shard):
    [part_path] = job.out_dir.glob(f"{SHARDS_DIR}/*/{shard.name}")
    return part_path


def rows_of(job, shard):
    return json.loads((part_of(job, shard) / "manifest.json").read_text())["rows"]


def test_shards_give_the_bytes_of_the_whole(deep_index, job) -> None:
    assert rows_of(job, FIRST) == [0, CELLS_PER_BLOCK]
    assert rows_of(job, SECOND)[1] > rows_of(job, SECOND)[0] == CELLS_PER_BLOCK
    version = job.merge(2)
    whole = index_facts(deep_index)
    assert index_facts(job.out_dir) == whole
    assert {path.name for path in version.iterdir()} == {*whole["files"], "manifest.json"}
    assert {"levels.safetensors", "statements.safetensors"} <= whole["files"].keys()
    assert not (job.out_dir / SHARDS_DIR).exists()
    assert replace(job, keep_current=True).merge(2) == version


def test_a_shard_without_cells_is_a_part_too(job) -> None:
    none = Shard(1, 3)  # of two blocks
    path = job.make_shard(none)
    assert rows_of(job, none) == [0, 0]
    columns = load_file(path / FILE)
    assert len(columns["vectors"]) == 0
    assert not list(job.out_dir.glob(f"{TEMP_PREFIX}*"))


@pytest.mark.slow
def test_shards_of_a_scan_give_the_bytes_of_the_whole(streets, weights_dir, tmp_path, monkeypatch) -> None:
    for module in (retriever, instance_encoder, level_table, statements, build, shard_store):
        monkeypatch.setattr(module, "CELLS_PER_BLOCK", 8)
    whole, shared = (IndexJob(streets, tmp_path / name, weights_dir) for name in ("whole", "shared"))
    whole.build()
    count = 2
    for shard in Shard.all(count):
        shared.make_shard(shard)
    assert all(first < last for first, last in (rows_of(shared, shard) for shard in Shard.all(count)))
    shared.merge(count)
    assert "surroundings.safetensors" in index_facts(tmp_path / "whole")["files"]
    assert index_facts(tmp_path / "shared") == index_facts(tmp_path / "whole")


def test_a_good_part_is_not_made_again_and_a_damaged_one_is(job, unread, monkeypatch) -> None:
    path = part_of(job, FIRST)
    before = (path / "manifest.json").stat().st_ino
    assert job.make_shard(FIRST) == path
    assert (path / "manifest.json").stat().st_ino == before
    whole = (path / "part.safetensors").read_bytes()
    (path / "part.safetensors").write_bytes(whole[:-1])
    monkeypatch.undo()
    assert job.make_shard(FIRST) == path
    assert (path / "part.safetensors").read_bytes() == whole


def test_what_is_missing_damaged_or_of_something_else_is_refused_by_name(
    job, unread, strip_file, weights_dir, monkeypatch
) -> None:
    path = part_of(job, SECOND)
    with pytest.raises(IndexBroken, match=r"lacks some of 3 parts: 1-of-3 is missing; 2-of-3 is missing; 3-of-3 is"):
        job.merge(3)
    faults = {
        "was made from another map": replace(job, map_path=strip_file),
        "was made with --levels": replace(job, levels=False),
        "was made by another model": replace(job, weights_dir=weights_dir, levels=False),
    }
    for fault, other in faults.items():
        with pytest.raises(IndexBroken, match=rf"1-of-2 is missing \(\S+ {fault}.*2-of-2 is missing.*--shard I/2"):
            other.merge(2)
    text = (path / "manifest.json").read_text()
    (path / "manifest.json").write_text(text.replace('"map_sha256": "', '"map_sha256": "0')[:-1])
    with pytest.raises(IndexBroken, match=r"parts: 2-of-2 is damaged: manifest.json"):
        job.merge(2)
    (path / "manifest.json").write_text(text)
    for name in ("part.safetensors", "levels.safetensors"):
        content = (path / name).read_bytes()
        (path / name).write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
        with pytest.raises(IndexBroken, match=rf"parts: 2-of-2 is damaged: {name} was changed"):
            job.merge(2)
        (path / name).unlink()
        with pytest.raises(IndexBroken, match=rf"parts: 2-of-2 is damaged: {name} cannot be read"):
            job.merge(2)
        (path / name).write_bytes(content)
    part_of(job, FIRST).rename(path.parent / "1-of-1")
    monkeypatch.undo()
    with pytest.raises(IndexBroken, match="1-of-1 has other cells than its shard"):
        job.merge(1)
    assert path.exists()
    with pytest.raises(IndexBroken):
        open_version(job.out_dir)


def test_who_is_killed_leaves_nothing_that_is_taken_for_a_part(job, given, monkeypatch) -> None:
    save = ShardData.save

    def killed(part, directory):
        save(part, directory)
        os.kill(os.getpid(), signal.SIGKILL)

    pid = os.fork()
    if not pid:
        try:
            ShardData.save = killed
            job.make_shard(SECOND)
        finally:  # or a fork of pytest goes on
            os._exit(1)
    assert os.waitpid(pid, 0)[1] == signal.SIGKILL
    directory = part_of(job, FIRST).parent
    assert len(list(directory.glob(f"{TEMP_PREFIX}*"))) == 1
    with pytest.raises(IndexBroken, match="parts: 2-of-2 is missing;"):
        job.merge(2)
    job.make_shard(SECOND)
    assert sorted(path.name for path in directory.iterdir()) == [FIRST.name, SECOND.name]


def test_of_two_who_make_one_part_the_first_is_kept(job, given, monkeypatch) -> None:
    save, made = ShardData.save, []

    def late(part, directory):
        monkeypatch.setattr(ShardData, "save", save)
        made.append(job.make_shard(SECOND))
        made.append((made[0] / "manifest.json").stat().st_ino)
        save(part, directory)

    monkeypatch.setattr(ShardData, "save", late)
    path = job.make_shard(SECOND)
    assert made == [path, (path / "manifest.json").stat().st_ino]
    assert sorted(one.name for one in path.parent.iterdir()) == [FIRST.name, SECOND.name]


def test_a_part_that_cannot_be_written_is_said_and_nothing_is_left(job, given, monkeypatch) -> None:
    def full(_part, directory):
        (directory / "part.safetensors").write_bytes(b"half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(ShardData, "save", full)
    with pytest.raises(DataError, match=r"out cannot be written: .*No space left.*; free some space"):
        job.make_shard(SECOND)
    assert [path.name for path in part_of(job, FIRST).parent.iterdir()] == [FIRST.name]


def test_that_nothing_can_be_written_is_found_before_the_work(deep_file, rich_dir, tmp_path, unread) -> None:
    (tmp_path / SHARDS_DIR).write_text("no directory")
    with pytest.raises(DataError, match="cannot be written"):
        IndexJob(deep_file, tmp_path, rich_dir).make_shard(FIRST)


@pytest.mark.parametrize("text", ["5/4", "0/4", "1/0", "x", "", "1", "1/2/3", "-1/4", " 1/4", "1/4\n", "1.0/4", "01/4"])
def test_what_is_no_shard_is_refused(text) -> None:
    with pytest.raises(ValueError, match=r"is not a shard; expected I/N with I from 1 to N"):
        Shard.parse(text)


@pytest.mark.parametrize("cells", [1, 9, 10, 11, 100, 1234])
@pytest.mark.parametrize("count", [1, 2, 3, 7, 200])
def test_shards_are_all_cells_in_whole_blocks(cells, count) -> None:
    rows = [shard.rows(cells, 10) for shard in Shard.all(count)]
    assert [row for one in rows for row in one] == list(range(cells))
    assert all(one.start % 10 == 0 for one in rows if one)
    sizes = [len(one) for one in rows]
    assert max(sizes) - min(sizes) < 20
    assert str(Shard.parse(f"{count}/{count}")) == f"{count}/{count}"
