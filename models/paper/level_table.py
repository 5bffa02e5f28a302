"""Vectors of the instance and relation levels of a gallery, one per instance, stored in float16."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from models.citymap.cells import CELLS_PER_BLOCK
from models.citymap.points import Ints, ranges
from models.errors import IndexBroken
from models.paper.instance_encoder import CellFeatures
from models.paper.levels import Level, Levels, Matching
from models.paper.retriever import Retriever, Vectors

STARTS_FILE = "levels.starts.npy"
TEXTS_PER_BATCH = 64  # compared with all cells at once; bounds the memory of the product
Float32s = npt.NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class LevelTable:
    """The unit vectors of all instances of all cells, by level."""

    starts: Ints  # [N + 1] cell n has the rows starts[n] to starts[n + 1]; no cell is empty
    # [R, D] by level, without the global one; float32 when computed, float16 when loaded
    vectors: dict[Level, npt.NDArray[np.floating[Any]]]

    @property
    def is_empty(self) -> bool:
        """Whether there is only the global level."""
        return not self.vectors

    def take(self, cells: Ints) -> "LevelTable":
        """Return the rows of some cells, in the given order."""
        if not self.vectors:
            return self
        begin, end = self.starts[cells], self.starts[cells + 1]
        rows = ranges(begin, end)
        starts = np.concatenate([[0], np.cumsum(end - begin)])
        return LevelTable(starts, {level: table[rows] for level, table in self.vectors.items()})

    @classmethod
    def concatenate(cls, tables: Sequence["LevelTable"]) -> "LevelTable":
        """Concatenate the tables of one or more galleries."""
        if tables[0].is_empty:
            return EMPTY_LEVEL_TABLE
        if len(tables) == 1:
            return tables[0]
        sizes = np.concatenate([np.diff(table.starts) for table in tables])
        vectors = {n: np.concatenate([table.vectors[n] for table in tables]) for n in tables[0].vectors}
        return cls(np.concatenate([[0], np.cumsum(sizes)]), vectors)

    @property
    def bytes_per_cell(self) -> float:
        """Mean size of a cell's vectors on disk."""
        return sum(2 * table.size for table in self.vectors.values()) / max(1, len(self.starts) - 1)

    def scores(self, texts: Sequence[Levels], cells: Ints, matching: Matching = "hints") -> dict[Level, Float32s]:
        """Return the similarities [Q, C] of descriptions (each B = 1) with cells [C] by level, as `set_similarity`."""
        begin, end = self.starts[cells], self.starts[cells + 1]
        rows = ranges(begin, end)
        segments = np.concatenate([[0], np.cumsum(end - begin)[:-1]])
        scores: dict[Level, Float32s] = {}
        for level, table in self.vectors.items():
            instances = table[rows].astype(np.float32, copy=False).T
            scores[level] = np.empty((len(texts), len(cells)), np.float32)
            for start in range(0, len(texts), TEXTS_PER_BATCH):
                hints = [text.vectors(level)[0].cpu().numpy() for text in texts[start : start + TEXTS_PER_BATCH]]
                cosine = np.concatenate(hints) @ instances
                sizes = [len(vectors) for vectors in hints]
                first = np.concatenate([[0], np.cumsum(sizes)[:-1]])
                sums = np.add.reduceat(np.maximum.reduceat(cosine, segments, axis=1), first, axis=0)
                similarity = sums / np.array(sizes)[:, None]
                if matching == "both":
                    sums = np.add.reduceat(np.maximum.reduceat(cosine, first, axis=0), segments, axis=1)
                    similarity = (similarity + sums / (end - begin)) / 2
                scores[level][start : start + len(hints)] = similarity
        return scores

    def save(self, directory: Path) -> None:
        """Write one file per level, and the row starts of the cells."""
        np.save(directory / STARTS_FILE, self.starts)
        for level, vectors in self.vectors.items():
            np.save(directory / f"levels.{level}.npy", vectors.astype(np.float16))

    @classmethod
    def load(cls, directory: Path, levels: Sequence[Level]) -> "LevelTable":
        """Map the files of `save` into memory; raise IndexBroken if a level is missing or the files do not match."""
        names: list[Level] = [level for level in levels if level != "global"]
        advice = "rebuild it with 'hereabouts index'"
        try:
            starts = np.load(directory / STARTS_FILE, allow_pickle=False)
            vectors = {n: np.load(directory / f"levels.{n}.npy", mmap_mode="r", allow_pickle=False) for n in names}
        except (OSError, ValueError, EOFError) as error:
            raise IndexBroken(f"the levels in {directory} cannot be read; {advice}") from error
        if any(len(table) != starts[-1] for table in vectors.values()):
            raise IndexBroken(f"the levels in {directory} have different sizes; {advice}")
        return cls(starts, dict(vectors))


EMPTY_LEVEL_TABLE = LevelTable(np.zeros(1, np.int64), {})


def encode_gallery(
    retriever: Retriever, cells: CellFeatures, map_blocks: Callable[..., Iterable[Any]] = map
) -> tuple[Vectors, LevelTable]:
    """Return the vectors [N, D] of the global level, and the table of the other levels.

    `cells` are of `Retriever.with_point_features`; `map_blocks` is `map` or `map_forked`.
    """
    width = retriever.config.width
    names: list[Level] = [level for level in retriever.levels if level != "global"]
    global_vectors = np.empty((len(cells), width), np.float32)
    others: dict[Level, npt.NDArray[np.floating[Any]]] = {
        n: np.empty((len(cells.label), width), np.float32) for n in names
    }
    labels = retriever.text_encoder.embed(cells.labels)

    def encode_block(first: int) -> list[tuple[Ints, Vectors, dict[Level, Vectors]]]:
        """Return (rows, global level, other levels) of each batch of a block."""
        return [
            (
                rows,
                levels.global_vectors.cpu().numpy(),
                {n: levels.vectors(n)[levels.mask].cpu().numpy() for n in names},
            )
            for rows, levels in retriever.encode_cells(cells, labels, first)
        ]

    for batch in chain.from_iterable(map_blocks(encode_block, range(0, len(cells), CELLS_PER_BLOCK))):
        cell_rows, vectors, by_level = batch
        global_vectors[cell_rows] = vectors
        rows = ranges(cells.starts[cell_rows], cells.starts[cell_rows + 1])
        for level in names:
            others[level][rows] = by_level[level]
    return global_vectors, LevelTable(np.asarray(cells.starts), others)
