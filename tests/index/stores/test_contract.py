"""The contract of vector stores, compared with NumPy: FAISS, Milvus Lite and a Milvus server."""

from contextlib import ExitStack
from importlib.util import find_spec

import numpy as np
import pytest

from index.answering.query import Box
from index.stores import milvus_store
from index.stores.faiss_store import FaissStore
from index.stores.milvus_connection import URI, MilvusConnection
from index.stores.milvus_store import MilvusStore, collection_name
from models.errors import IndexBroken, StoreUnavailable

TOLERANCE = 1e-6  # of a score; a backend sums in an order of its own
SIZE, DIM, QUERIES = 2300, 32, 20  # more rows than a message takes, more queries than a call
GRID_M = 10.0


@pytest.fixture(scope="module")
def vectors():
    v = np.random.default_rng(0).normal(size=(SIZE, DIM)).astype(np.float32)
    return v / np.linalg.norm(v, axis=1, keepdims=True)


@pytest.fixture(scope="module")
def positions_m():
    rows = np.arange(SIZE)
    return np.stack([rows % 50 * GRID_M - 0.1, rows // 50 * GRID_M + 1 / 3], axis=1)


class Faiss:
    """Stores in files."""

    def __init__(self, directory):
        self.directory = directory

    def write(self, version, vectors, positions_m):
        FaissStore.from_vectors(vectors).save(self.directory / version)
        return self.open(version, vectors, positions_m)

    def open(self, version, vectors, positions_m):
        return FaissStore.load(self.directory / version, positions_m)


class Milvus:
    """Stores in a Milvus, which are dropped in the end."""

    def __init__(self, stack):
        self.stack = stack

    def write(self, version, vectors, positions_m):
        with MilvusStore.create(version, vectors, positions_m, ["town"] * len(vectors)) as store:
            self.stack.callback(store.close)
            self.stack.callback(store.drop)
            return store

    def open(self, version, vectors, positions_m):
        store = MilvusStore(collection_name(version), vectors.shape[1], len(vectors))
        self.stack.callback(store.close)
        return store


@pytest.fixture(
    scope="module",
    params=["faiss", "lite", pytest.param("server", marks=[pytest.mark.slow, pytest.mark.server("milvus")])],
)
def backend(request, tmp_path_factory):
    if request.param == "faiss":
        yield Faiss(tmp_path_factory.mktemp("faiss"))
        return
    with ExitStack() as stack, pytest.MonkeyPatch.context() as patch:
        patch.setenv(URI, _milvus_uri(request, tmp_path_factory))
        patch.setitem(MilvusConnection.call.__kwdefaults__, "timeout_s", 60.0)  # also where the machine is busy
        yield Milvus(stack)


def _milvus_uri(request, tmp_path_factory):
    if request.param == "server":
        return request.getfixturevalue("milvus_server").uri
    if find_spec("pymilvus") is None or find_spec("milvus_lite") is None:
        pytest.skip("pymilvus or milvus-lite not installed: pip install 'hereabouts[dev]'")
    return str(tmp_path_factory.mktemp("lite") / "milvus.db")


@pytest.fixture(scope="module")
def store(backend, vectors, positions_m):
    return backend.write("20261124T120000-v1", vectors, positions_m)


def assert_best(result, exact, k):
    """Check that results are the k best of exact scores [Q, N]; those within the tolerance may change places."""
    scores, rows = result
    assert scores.shape == rows.shape == (len(exact), k)
    assert (scores.dtype, rows.dtype) == (np.float32, np.int64)
    assert all(len(set(each)) == k for each in rows.tolist())
    assert (np.diff(scores, axis=1) <= 0).all()
    assert scores == pytest.approx(np.take_along_axis(exact, rows, axis=1), abs=TOLERANCE)
    assert scores == pytest.approx(-np.sort(-exact, axis=1)[:, :k], abs=TOLERANCE)


def test_search_is_exact(store, vectors) -> None:
    queries = vectors[:QUERIES]
    assert_best(store.search(queries, 7), queries @ vectors.T, 7)
    assert (len(store), store.dim) == (SIZE, DIM)


def test_a_query_finds_the_same_bits_alone_and_in_a_batch(store, vectors) -> None:
    scores, rows = store.search(vectors[:QUERIES], 10)
    for q in (0, QUERIES - 1):
        alone = store.search(vectors[q : q + 1], 10)
        assert np.array_equal(alone[0][0], scores[q])
        assert np.array_equal(alone[1][0], rows[q])


def test_more_than_there_is_gives_all(store, vectors) -> None:
    assert_best(store.search(vectors[:2], SIZE + 100), vectors[:2] @ vectors.T, SIZE)


@pytest.mark.parametrize(
    "box",
    [
        Box(99.9, 1 / 3, 199.9, 50 + 1 / 3),  # its edges go through cells
        Box(99.9 + 1e-9, 1 / 3 + 1e-9, 199.9 - 1e-9, 50),
        Box(-1e6, -1e6, 1e6, 1e6),
        Box(103.0, -1e6, 104.0, 1e6),  # between cells
    ],
)
def test_within_is_exact(store, vectors, positions_m, box) -> None:
    (x, y), queries = positions_m.T, vectors[:QUERIES]
    inside = np.flatnonzero((x >= box.west) & (x <= box.east) & (y >= box.south) & (y <= box.north))
    exact = np.full((QUERIES, SIZE), -np.inf, np.float32)
    exact[:, inside] = queries @ vectors[inside].T
    for k in (5, SIZE):
        assert_best(store.search(queries, k, box), exact, min(k, len(inside)))


def test_scores_and_vectors_of_some_rows(store, vectors) -> None:
    rows = np.array([5, 0, SIZE - 1, 5, 1000])
    assert np.array_equal(store.vectors(rows), vectors[rows])
    assert store.score(vectors[1], rows) == pytest.approx(vectors[rows] @ vectors[1], abs=TOLERANCE)
    assert store.vectors(np.arange(SIZE)[::-1]) == pytest.approx(vectors[::-1], abs=0)
    assert store.vectors(rows[:0]).shape == (0, DIM)


def test_equal_scores_come_by_row(backend, positions_m) -> None:
    same = np.ones((40, 4), dtype=np.float32) / 2
    same[7] = [1, 0, 0, 0]
    store = backend.write("ties", same, positions_m[:40])
    expected = [[*(r for r in range(40) if r != 7), 7]]
    assert store.search(same[:1], 40)[1].tolist() == expected
    best_rows = store.search(same[:1], 5)[1][0].tolist()
    assert best_rows == sorted(best_rows), "which of the equals is up to the store"
    assert 7 not in best_rows


def test_opened_again_it_finds_the_same(backend, store, vectors, positions_m) -> None:
    again = backend.open("20261124T120000-v1", vectors, positions_m)
    for result, known in zip(again.search(vectors[:3], 9), store.search(vectors[:3], 9), strict=True):
        assert np.array_equal(result, known)


def test_two_versions_side_by_side(backend, store, vectors, positions_m) -> None:
    other = backend.write("20261124T120000-v2", vectors[::-1], positions_m)
    assert store.search(vectors[:1], 1)[1].tolist() == [[0]]
    assert other.search(vectors[:1], 1)[1].tolist() == [[SIZE - 1]]


# What only a store elsewhere has to do.


@pytest.fixture
def in_milvus(backend):
    if isinstance(backend, Faiss):
        pytest.skip("FAISS has no collections")
    return backend


def test_more_than_milvus_gives_at_once_is_exact(in_milvus, store, vectors, monkeypatch) -> None:
    monkeypatch.setattr(milvus_store, "MAX_HITS_PER_SEARCH", 300)
    assert_best(store.search(vectors[:3], 1000), vectors[:3] @ vectors.T, 1000)


def test_a_collection_is_checked_and_dropped(in_milvus, vectors, positions_m) -> None:
    store = in_milvus.write("dropped", vectors[:50], positions_m[:50])
    store.check()
    with pytest.raises(IndexBroken, match=r"has 50 rows .* says 51"):
        in_milvus.open("dropped", vectors[:51], positions_m).check()
    with pytest.raises(StoreUnavailable, match="50 of 51 rows"):
        in_milvus.open("dropped", vectors[:51], positions_m).search(vectors[:1], 51)
    store.drop()
    with pytest.raises(IndexBroken, match="no collection hereabouts_dropped"):
        store.check()
    with pytest.raises(StoreUnavailable, match="cannot search"):
        store.search(vectors[:1], 1)
    store.drop()  # again: there is none


def test_what_fails_after_it_leaves_no_collection(in_milvus, vectors, positions_m) -> None:
    regions = ["town"] * 50
    with (
        pytest.raises(OSError, match="full"),
        MilvusStore.create("half", vectors[:50], positions_m[:50], regions),
    ):
        raise OSError("full")
    with pytest.raises(IndexBroken, match="no collection hereabouts_half"):
        in_milvus.open("half", vectors[:50], positions_m).check()


def test_the_alias_moves(in_milvus, vectors, positions_m) -> None:
    client = in_milvus.open("any", vectors, positions_m)._milvus
    for version in ("first", "second"):
        store = in_milvus.write(version, vectors[:50], positions_m[:50])
        store.move_alias("default")
        result = client.call("query", "hereabouts_default", filter="row == 3", output_fields=["version", "region", "x"])
        assert [dict(each) for each in result] == [
            {"row": 3, "version": version, "region": "town", "x": positions_m[3, 0]}
        ]
    client.call("drop_alias", "hereabouts_default")
