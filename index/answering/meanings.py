"""A map's names and nouns by what they mean: "the makeup shop" is one for cosmetics, "the defence ministry" a name."""

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

LIKE: Final = 0.85  # cosine from which on words mean the same
VECTORS_FILE, PHRASES_FILE = "meanings.faiss", "meanings.json"
KEPT: Final = 4096  # what was said lately
TASK: Final = 256  # phrases, of like length
STORED_BITS: Final = 16  # of a number: of 3,000 phrases no cosine changed by more than a ten-thousandth
Embed = Callable[[Sequence[str]], Tensor]


def meanings_of(phrases: Sequence[str], embed: Embed) -> tuple[list[str], Floats]:
    """Phrases in another order, and unit vectors [P, W] of what they mean; some hundreds a second on each CPU."""
    ordered = sorted(phrases, key=len)
    parts = [ordered[start : start + TASK] for start in range(0, len(ordered), TASK)]
    vectors = map_forked(lambda some: embed(some).numpy(), parts)
    return ordered, np.concatenate([embed(["a"]).numpy()[:0], *vectors])


class Meanings:
    """Names and nouns of two words or more of a map, found by the cosine of the frozen text encoder's vectors.

    Args:
        phrases: P of them, in plain words.
        store: their unit vectors [P, W].
        embed: gives unit vectors [S, W] of S phrases.
    """

    def __init__(self, phrases: Sequence[str], store: FaissStore, embed: Embed) -> None:
        self._phrases, self._store, self._embed = phrases, store, embed
        self._lately: LRUCache[str, int] = LRUCache(KEPT)

    @classmethod
    def of(cls, phrases: Sequence[str], vectors: Floats, embed: Embed) -> "Meanings":
        """Those of what `meanings_of` gave."""
        return cls(phrases, FaissStore.of(vectors, bits=STORED_BITS), embed)

    def like(self, said: str) -> tuple[str, ...] | None:
        """The plain words of the name or noun that means what was said; None for single words, and if there is none."""
        words = [word for word in plain_words(said) if word not in EMPTY]
        if len(words) < 2 or not self._phrases:
            return None
        row = self._nearest(" ".join(words))
        return None if row < 0 else tuple(self._phrases[row].split())

    @cachedmethod(lambda meanings: meanings._lately)
    def _nearest(self, said: str) -> int:
        """The phrase that means what was said; -1 if none does."""
        cosine, row = self._store.search(self._embed([said]).numpy(), 1)
        return int(row[0, 0]) if cosine[0, 0] >= LIKE else -1

    def save(self, directory: Path) -> None:
        """Write two files."""
        self._store.save(directory / VECTORS_FILE)
        text = json.dumps(self._phrases, ensure_ascii=False, separators=(",", ":"))
        (directory / PHRASES_FILE).write_text(text, encoding="utf-8")

    @classmethod
    def load(cls, directory: Path, embed: Embed) -> "Meanings":
        """Read what `save` wrote.

        Raises:
            IndexBroken: the files do not hold it.
        """
        store = FaissStore.load(directory / VECTORS_FILE)
        try:
            phrases = json.loads((directory / PHRASES_FILE).read_text(encoding="utf-8"))
        except (OSError, ValueError) as error:
            raise IndexBroken(
                f"{directory / PHRASES_FILE} cannot be read; rebuild it with 'hereabouts index'"
            ) from error
        if len(store) != len(phrases):
            raise IndexBroken(f"the meanings in {directory} do not belong together; rebuild it with 'hereabouts index'")
        return cls(phrases, store, embed)
