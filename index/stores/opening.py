"""Opening the vector store of an index version."""

from pathlib import Path
from typing import Final

from index.build.manifest import Manifest
from index.stores.faiss_store import FaissStore
from index.stores.milvus_store import MilvusStore
from index.stores.store import VectorStore
from models.citymap.types import Floats

VECTORS_FILE: Final = "vectors.faiss"


def open_store(directory: Path, manifest: Manifest, center_m: Floats) -> VectorStore:
    """Open the store that a version's manifest names, without connecting to Milvus."""
    if manifest.collection is not None:
        return MilvusStore(manifest.collection, manifest.dim, manifest.cells)
    return FaissStore.load(directory / VECTORS_FILE, center_m[:, :2])
