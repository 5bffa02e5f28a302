"""A newer file of a map: what has not changed keeps its vectors, and the rest is as if all were built anew."""

import shutil

import numpy as np
import pytest

from index.build.artifact import open_version
from index.build.build import IndexJob
from index.build.manifest import write_manifest
from index.build.previous_version import BYTES, FILE, Earlier, save_digests
from index.stores.faiss_store import FaissStore
from models.errors import DataError, IndexBroken, IndexMismatch
from models.files import file_records
from models.paper import level_table
from models.paper.levels import LEVELS
from tests.index_facts import told

HOUSE = '<tag k="building" v="yes"/>'


@pytest.fixture(scope="session")
def newer_file(osm_file, made_once):
    """The same town, of which a house was torn down."""
    town = osm_file.read_text()
    assert town.count(HOUSE) > 10
    return made_once("newer", lambda out: (out / osm_file.name).write_text(town.replace(HOUSE, "", 1))) / osm_file.name


@pytest.fixture
def out(index_dir, tmp_path):
    shutil.copytree(index_dir, tmp_path / "out")
    return tmp_path / "out"


@pytest.fixture
def encoded(monkeypatch):
    """How many cells are encoded, each time."""
    counts = []
    encode = level_table.encode_gallery
    monkeypatch.setattr(
        "index.build.shard_data.encode_gallery",
        lambda model, cells, *rest: counts.append(len(cells)) or encode(model, cells, *rest),
    )
    return counts


def vectors_of(root):
    directory, manifest = open_version(root)
    return FaissStore.load(directory / "vectors.faiss").vectors(np.arange(manifest.cells))


def test_what_changed_alone_is_encoded_and_all_is_as_built_anew(
    out, newer_file, weights_dir, encoded, tmp_path
) -> None:
    before, said = open_version(out)[1], []
    IndexJob(newer_file, out, weights_dir, update=True).build(lambda stage, *_: said.append(stage))
    cells = open_version(out)[1].cells
    assert 0 < encoded[0] < cells / 4
    assert f"{cells - encoded[0]} cells kept" in said
    IndexJob(newer_file, tmp_path / "anew", weights_dir).build()
    np.testing.assert_allclose(vectors_of(out), vectors_of(tmp_path / "anew"), atol=1e-6)
    updated, anew = told(out), told(tmp_path / "anew")
    assert before.map_sha256 != updated["map_sha256"]
    del updated["files"]["vectors.faiss"], anew["files"]["vectors.faiss"]  # equal but for last bits
    assert updated == anew


def test_a_map_that_has_not_changed_keeps_every_byte(out, osm_file, weights_dir, encoded) -> None:
    before = told(out)
    IndexJob(osm_file, out, weights_dir, update=True).build()
    assert encoded == [0]
    assert told(out) == before


def test_vectors_of_8_bits_are_rounded_once_more_at_most(
    newer_file, osm_file, weights_dir, tmp_path, monkeypatch
) -> None:
    monkeypatch.setattr("index.stores.faiss_store.EXACT", 100)
    out = tmp_path / "out"
    IndexJob(osm_file, out, weights_dir).build()
    before, digests = vectors_of(out), np.load(open_version(out)[0] / FILE)
    IndexJob(newer_file, out, weights_dir, update=True).build()
    after, now = vectors_of(out), np.load(open_version(out)[0] / FILE)
    row = {bytes(digest): n for n, digest in enumerate(digests)}
    kept = [n for n, digest in enumerate(now) if bytes(digest) in row]
    assert 0 < len(kept) < len(now)
    step = np.ptp(after, axis=0).max() / 255
    of_kept = before[[row[bytes(digest)] for digest in now[kept]]]
    np.testing.assert_allclose(after[kept], of_kept, atol=step / 2 + 1e-6)
    IndexJob(newer_file, tmp_path / "anew", weights_dir).build()
    np.testing.assert_allclose(after, vectors_of(tmp_path / "anew"), atol=1.5 * step)
    held = told(out)
    IndexJob(newer_file, out, weights_dir, update=True).build()
    assert told(out) == held


def test_all_levels_of_what_has_not_changed_are_kept(newer_file, osm_file, rich_dir, encoded, tmp_path) -> None:
    rich, anew = tmp_path / "rich", tmp_path / "anew"
    IndexJob(osm_file, rich, rich_dir).build()
    with pytest.raises(IndexBroken, match="was made without --levels; give --map in place of --update"):
        IndexJob(newer_file, rich, rich_dir, levels=True, update=True).build()
    IndexJob(osm_file, rich, rich_dir, levels=True).build()
    IndexJob(newer_file, anew, rich_dir, levels=True).build()
    encoded.clear()
    IndexJob(newer_file, rich, rich_dir, levels=True, update=True).build()
    assert 0 < encoded[0] < open_version(rich)[1].cells / 4
    made, expected = (level_table.LevelTable.load(open_version(root)[0], LEVELS) for root in (rich, anew))
    assert (made.starts == expected.starts).all()
    assert set(made.vectors) == set(LEVELS) - {"global"}
    for level, vectors in made.vectors.items():
        np.testing.assert_allclose(vectors, expected.vectors[level], atol=3e-4)
        assert np.ptp(vectors, axis=0).max() > 0.01, "rows differ by more"
    IndexJob(newer_file, rich, rich_dir, levels=True, update=True).build()
    assert encoded[-1] == 0


def without_digests(directory, manifest):
    (directory / FILE).unlink()
    return {"files": {name: record for name, record in manifest.files.items() if name != FILE}}


def with_levels(directory, manifest):
    shutil.copy(directory / FILE, directory / "levels.starts.npy")
    return {"files": manifest.files | {"levels.starts.npy": manifest.files[FILE]}}


def in_milvus(_directory, _manifest):
    return {"store": "milvus", "collection": "hereabouts"}


def of_another_model(_directory, _manifest):
    return {"model_fingerprint": "0" * 64}


@pytest.mark.parametrize(
    ("change", "error", "said"),
    [
        (without_digests, IndexBroken, "does not say what they were made of; give --map in place of --update"),
        (with_levels, IndexBroken, "was made with --levels; give that too"),
        (in_milvus, IndexBroken, "are in Milvus; give --map in place of --update"),
        (of_another_model, IndexMismatch, "rebuild the index"),
    ],
)
def test_an_index_of_which_nothing_can_be_kept_is_refused(
    out, osm_file, weights_dir, change, error, said, monkeypatch
) -> None:
    monkeypatch.setattr("index.build.build.open_source", lambda *_: pytest.fail("the map was opened"))
    directory, manifest = open_version(out)
    (out / "aliases.json").write_text(f'{{"default": "{directory.name}"}}')  # of which nothing was registered
    write_manifest(directory, manifest.model_copy(update=change(directory, manifest)))
    with pytest.raises(error, match=said):
        IndexJob(osm_file, out, weights_dir, update=True).build()
    with pytest.raises(IndexBroken, match="no index in"):
        IndexJob(osm_file, out / "elsewhere", weights_dir, update=True).build()


def test_a_map_that_is_not_there_is_said(out, weights_dir) -> None:
    with pytest.raises(DataError, match=r"away.osm.pbf: no such file or directory; give the path of a map"):
        IndexJob(out / "away.osm.pbf", out, weights_dir, update=True).build()


def test_cells_whose_digests_are_cut_to_the_same_bytes_are_encoded_anew(out, weights_dir, model) -> None:
    directory, manifest = open_version(out)
    digests = np.arange(1, manifest.cells + 1, dtype=np.uint64) << np.uint64(8)
    digests[1] = digests[0]  # cells that are the same
    digests[3] = digests[2] + np.uint64(1 << 8 * BYTES)  # and that are not
    save_digests(directory, digests)
    (out / "aliases.json").write_text(f'{{"default": "{directory.name}"}}')
    write_manifest(
        directory, manifest.model_copy(update={"files": manifest.files | {FILE: file_records(directory)[FILE]}})
    )
    known = Earlier.open(out, model.fingerprint, ["global"]).known(digests)
    assert known[:5].tolist() == [0, 0, -1, -1, 4]
    assert known[4:].tolist() == list(range(4, manifest.cells))
    assert not (Earlier.open(out, model.fingerprint, ["global"]).known(digests + np.uint64(1)) >= 0).any()
