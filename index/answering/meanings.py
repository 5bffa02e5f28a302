"""Search of a map's names and nouns by meaning: "makeup shop" for cosmetics, "defence ministry" for a name."""

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Final

import numpy as np
from cachetools import LRUCache, cachedmethod
from torch import Tensor

from index.stores.faiss_store import FaissStore
from models.citymap.types import Floats
from models.errors import IndexBroken
from models.language.mentions.lookup import EMPTY
from models.language.mentions.names import plain_words
from models.processes import map_forked

MIN_COSINE: Final = 0.85  # phrases at least this similar mean the same
VECTORS_FILE, PHRASES_FILE = "meanings.faiss", "meanings.json"
CACHED_PHRASES: Final = 4096
PHRASES_PER_TASK: Final = 256  # of similar length, to save padding
STORED_BITS: Final = 16  # per number; measured: no cosine of 3,000 phrases changed by more than 0.0001
Embed = Callable[[Sequence[str]], Tensor]


def embed_phrases(phrases: Sequence[str], embed: Embed) -> tuple[list[str], Floats]:
    """Return phrases in the order of their vectors, and their unit vectors [P, W]; some hundreds per second and CPU."""
    ordered = sorted(phrases, key=len)
    parts = [ordered[start : start + PHRASES_PER_TASK] for start in range(0, len(ordered), PHRASES_PER_TASK)]
    vectors = map_forked(lambda phrases: embed(phrases).numpy(), parts)
    return ordered, np.concatenate([embed(["a"]).numpy()[:0], *vectors])


class Meanings:
    """P names and nouns of two or more words, searched by the cosine of the text encoder's unit vectors [P, W]."""

    def __init__(self, phrases: Sequence[str], store: FaissStore, embed: Embed) -> None:
        self._phrases, self._store, self._embed = phrases, store, embed
        self._cache: LRUCache[str, int] = LRUCache(CACHED_PHRASES)

    @classmethod
    def from_vectors(cls, phrases: Sequence[str], vectors: Floats, embed: Embed) -> "Meanings":
        """Build from the result of `embed_phrases`."""
        return cls(phrases, FaissStore.from_vectors(vectors, bits=STORED_BITS), embed)

    def like(self, phrase: str) -> tuple[str, ...] | None:
        """Return the plain words of the name or noun that means the same; None for single words and without match."""
        words = [word for word in plain_words(phrase) if word not in EMPTY]
        if len(words) < 2 or not self._phrases:
            return None
        row = self._nearest(" ".join(words))
        return None if row < 0 else tuple(self._phrases[row].split())

    @cachedmethod(lambda meanings: meanings._cache)
    def _nearest(self, phrase: str) -> int:
        cosine, row = self._store.search(self._embed([phrase]).numpy(), 1)
        return int(row[0, 0]) if cosine[0, 0] >= MIN_COSINE else -1

    def save(self, directory: Path) -> None:
        """Write the files that `load` reads."""
        self._store.save(directory / VECTORS_FILE)
        text = json.dumps(self._phrases, ensure_ascii=False, separators=(",", ":"))
        (directory / PHRASES_FILE).write_text(text, encoding="utf-8")

    @classmethod
    def load(cls, directory: Path, embed: Embed) -> "Meanings":
        """Read the files that `save` wrote; IndexBroken if they cannot be read."""
        store = FaissStore.load(directory / VECTORS_FILE)
        try:
            phrases = json.loads((directory / PHRASES_FILE).read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise IndexBroken(
                f"{directory / PHRASES_FILE} cannot be read; rebuild it with 'hereabouts index'"
            ) from error
        if len(store) != len(phrases):
            raise IndexBroken(f"the files of meanings in {directory} do not match; rebuild it with 'hereabouts index'")
        return cls(phrases, store, embed)
