from pathlib import Path

import faiss
import numpy as np
import pytest

from index.answering.query import Box
from index.stores import faiss_store
from index.stores.faiss_store import FaissStore
from models import spool
from models.errors import IndexBroken
from models.spool import spooled


@pytest.fixture
def vectors():
    v = np.random.default_rng(1).normal(size=(3000, 64)).astype(np.float32)
    return v / np.linalg.norm(v, axis=1, keepdims=True)


def test_many_vectors_take_a_quarter_and_find_nearly_the_same(vectors, tmp_path, monkeypatch) -> None:
    exact = FaissStore.from_vectors(vectors)
    monkeypatch.setattr(faiss_store, "MAX_FLOAT_VECTORS", 2999)
    FaissStore.from_vectors(vectors).save(tmp_path / "small")
    exact.save(tmp_path / "exact")
    assert (tmp_path / "small").stat().st_size < 0.27 * (tmp_path / "exact").stat().st_size
    small = FaissStore.load(tmp_path / "small", positions_m=np.zeros((3000, 2)))
    assert (len(small), small.dim) == (3000, 64)
    (scores, rows), (true, best) = small.search(vectors[:50], 20), exact.search(vectors[:50], 20)
    assert scores == pytest.approx(true, abs=0.01)
    assert np.mean([len(np.intersect1d(a, b)) / 20 for a, b in zip(rows, best, strict=True)]) > 0.95
    assert small.vectors(rows[0]) == pytest.approx(vectors[rows[0]], abs=0.01)
    assert small.score(vectors[0], rows[0]) == pytest.approx(scores[0], abs=1e-5)
    assert small.vectors(rows[0][:0]).shape == (0, 64)
    assert small.search(vectors[:1], 5, Box(1, 1, 2, 2))[1].shape == (1, 0)


@pytest.fixture
def in_lists(monkeypatch):
    """Stores of more than 2,000 vectors have 16 lists, of which 4 are searched."""
    for name, value in {
        "MAX_FLOAT_VECTORS": 100,
        "MAX_FLAT_VECTORS": 2000,
        "IVF_LISTS": 16,
        "IVF_PROBES": 4,
        "MAX_PROBED_K": 50,
    }.items():
        monkeypatch.setattr(faiss_store, name, value)


def test_very_many_vectors_are_found_in_lists_of_like_ones(vectors, tmp_path, in_lists) -> None:
    alike = vectors[:100].repeat(30, axis=0) + 0.3 * vectors
    alike /= np.linalg.norm(alike, axis=1, keepdims=True)
    FaissStore.from_vectors(alike).save(tmp_path / "lists")
    positions_m = np.stack([np.arange(3000), np.zeros(3000)], axis=1)
    store = FaissStore.load(tmp_path / "lists", positions_m)
    assert (len(store), store.dim) == (3000, 64)
    assert store.vectors(np.arange(3000)) == pytest.approx(alike, abs=0.01)
    assert store.score(alike[5], np.array([5, 6])) == pytest.approx(alike[[5, 6]] @ alike[5], abs=0.02)
    exact = -np.sort(-(store.vectors(np.arange(3000)) @ alike[:60].T).T, axis=1)
    few, many = store.search(alike[:60], 20), store.search(alike[:60], 60)
    assert np.mean(few[0] >= exact[:, 19:20] - 1e-5) > 0.95, "nearly the best"
    assert many[0] == pytest.approx(exact[:, :60], abs=1e-5), "who wants many is given those of all lists"
    box = store.search(alike[:60], 20, Box(100, -1, 399, 1))
    inside = -np.sort(-(store.vectors(np.arange(100, 400)) @ alike[:60].T).T, axis=1)
    assert box[0] == pytest.approx(inside[:, :20], abs=1e-5), "within a box all are looked at"
    assert box[1].min() >= 100
    assert box[1].max() < 400


def test_lists_that_hold_too_few_are_not_all_that_is_looked_at(vectors, in_lists, monkeypatch) -> None:
    monkeypatch.setattr(faiss_store, "IVF_PROBES", 1)
    far = np.concatenate([vectors[:1].repeat(2990, axis=0), -vectors[:1].repeat(10, axis=0)])
    scores, rows = FaissStore.from_vectors(far).search(-vectors[:1], 40)
    assert (rows >= 0).all()
    assert len(set(rows[0].tolist())) == 40
    assert scores[0, 9] > 0.9 > scores[0, 10]


def test_the_bits_of_a_vector_are_the_same_in_lists_and_without(vectors, in_lists, monkeypatch) -> None:
    lists = FaissStore.from_vectors(vectors)
    monkeypatch.setattr(faiss_store, "MAX_FLAT_VECTORS", 3000)
    rows = np.arange(3000)
    np.testing.assert_array_equal(lists.vectors(rows), FaissStore.from_vectors(vectors).vectors(rows))


@pytest.mark.parametrize("bits", [32, 16, 8])
@pytest.mark.parametrize("many", [2000, 5000])
def test_however_many_vectors_are_looked_at_together_the_file_is_the_same(
    vectors, tmp_path, in_lists, monkeypatch, bits, many
) -> None:
    monkeypatch.setattr(faiss_store, "MAX_FLAT_VECTORS", many)

    def written():
        FaissStore.from_vectors(vectors, bits=bits).save(tmp_path / "vectors")
        return (tmp_path / "vectors").read_bytes()

    at_once = written()
    monkeypatch.setattr(faiss_store, "VECTORS_PER_BLOCK", 700)
    assert written() == at_once


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="only Linux tells what of a file is in memory")
def test_of_vectors_in_a_file_none_stay_in_memory(vectors, in_lists, monkeypatch) -> None:
    monkeypatch.setattr(spool, "MAX_BYTES_IN_MEMORY", 1000)
    stored = spooled([{"vectors": vectors}])["vectors"]
    address = f"{stored.ctypes.data:x}-"

    def in_memory_kb() -> int:
        mapping = Path("/proc/self/smaps").read_text().partition(f"\n{address}")[2]
        return int(mapping.partition("\nRss:")[2].split()[0])

    assert stored.sum() == pytest.approx(vectors.sum())
    assert in_memory_kb() > 500
    FaissStore.from_vectors(stored)
    assert in_memory_kb() == 0


def test_a_store_of_sixteen_bits_takes_half_and_scores_alike(vectors, tmp_path) -> None:
    exact = FaissStore.from_vectors(vectors)
    FaissStore.from_vectors(vectors, bits=16).save(tmp_path / "half")
    exact.save(tmp_path / "exact")
    assert (tmp_path / "half").stat().st_size < 0.52 * (tmp_path / "exact").stat().st_size
    half = FaissStore.load(tmp_path / "half")
    assert half.search(vectors[:50], 20)[0] == pytest.approx(exact.search(vectors[:50], 20)[0], abs=1e-3)
    assert len(FaissStore.from_vectors(vectors[:0], bits=16)) == 0


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="only Linux tells which files are mapped")
@pytest.mark.parametrize("bits", [32, 16, 8])
def test_a_file_is_mapped_not_read(vectors, tmp_path, bits) -> None:
    path = tmp_path / "vectors.faiss"
    FaissStore.from_vectors(vectors, bits=bits).save(path)
    store = FaissStore.load(path)
    assert str(path) in Path("/proc/self/maps").read_text()
    path.unlink()  # as when a version is removed while it is served
    assert store.search(vectors[:1], 1)[1].tolist() == [[0]]


@pytest.mark.parametrize("bits", [32, 8])
def test_a_file_that_was_cut_short_is_refused(vectors, tmp_path, bits) -> None:
    path = tmp_path / "vectors.faiss"
    FaissStore.from_vectors(vectors, bits=bits).save(path)
    content = path.read_bytes()
    for size in (0, 3, 100, len(content) // 2, len(content) - 1):
        path.write_bytes(content[:size])
        with pytest.raises(IndexBroken, match="hereabouts index"):
            FaissStore.load(path)


def test_another_kind_of_index_is_refused(vectors, tmp_path) -> None:
    graph = faiss.IndexHNSWFlat(64, 8)
    graph.add(vectors[:50])
    faiss.write_index(graph, str(tmp_path / "graph"))
    with pytest.raises(IndexBroken, match="hereabouts index"):
        FaissStore.load(tmp_path / "graph")
