import faiss
import numpy as np
import pytest

from index.stores.faiss_store import FaissStore
from models.errors import IndexBroken


def test_files_that_are_no_store_are_refused(tmp_path) -> None:
    path = tmp_path / "v.faiss"
    path.write_bytes(b"junk")
    with pytest.raises(IndexBroken, match="cannot be read"):
        FaissStore.load(path)
    faiss.write_index(faiss.IndexFlatL2(16), str(path))
    with pytest.raises(IndexBroken, match="IndexFlatL2"):
        FaissStore.load(path)


def test_a_store_without_positions_says_so() -> None:
    from index.query import Box

    with pytest.raises(AssertionError, match="without positions"):
        FaissStore.of(np.eye(3, dtype=np.float32)).search(np.eye(3, dtype=np.float32), 1, Box(0, 0, 1, 1))
