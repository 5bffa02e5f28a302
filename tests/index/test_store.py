import faiss
import numpy as np
import pytest

from index.store import FaissStore
from models.errors import IndexBroken


@pytest.fixture
def vectors():
    v = np.random.default_rng(0).normal(size=(300, 16)).astype(np.float32)
    return v / np.linalg.norm(v, axis=1, keepdims=True)


def test_search_is_exact(vectors) -> None:
    store = FaissStore.of(vectors)
    scores, rows = store.search(vectors[:40], 7)
    exact = vectors[:40] @ vectors.T
    assert np.array_equal(rows, np.argsort(-exact, axis=1)[:, :7])
    assert scores == pytest.approx(np.take_along_axis(exact, rows, axis=1), abs=1e-6)


def test_a_query_finds_the_same_bits_alone_and_in_a_batch(vectors) -> None:
    store = FaissStore.of(vectors)
    scores, rows = store.search(vectors, 10)
    for q in (0, 17, 299):
        alone = store.search(vectors[q : q + 1], 10)
        assert np.array_equal(alone[0][0], scores[q])
        assert np.array_equal(alone[1][0], rows[q])


def test_more_than_there_is(vectors) -> None:
    scores, rows = FaissStore.of(vectors[:3]).search(vectors[:1], 10)
    assert rows.shape == scores.shape == (1, 3)
    assert (rows >= 0).all()


def test_equal_scores_come_by_row() -> None:
    same = np.ones((5, 4), dtype=np.float32) / 2
    assert FaissStore.of(same).search(same[:1], 5)[1].tolist() == [[0, 1, 2, 3, 4]]


def test_scores_of_some_rows(vectors) -> None:
    rows = np.array([5, 0, 299])
    assert FaissStore.of(vectors).score(vectors[1], rows) == pytest.approx(vectors[rows] @ vectors[1], abs=1e-6)


def test_files(vectors, tmp_path) -> None:
    path = tmp_path / "v.faiss"
    FaissStore.of(vectors).save(path)
    assert np.array_equal(
        FaissStore.load(path).search(vectors[:5], 3)[1], FaissStore.of(vectors).search(vectors[:5], 3)[1]
    )
    path.write_bytes(b"junk")
    with pytest.raises(IndexBroken, match="cannot be read"):
        FaissStore.load(path)
    faiss.write_index(faiss.IndexFlatL2(16), str(path))
    with pytest.raises(IndexBroken, match="IndexFlatL2"):
        FaissStore.load(path)
