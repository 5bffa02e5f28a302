"""The instance and relation level of a gallery: a vector an instance, in half precision on disk."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from models.citymap.cells import BLOCK
from models.citymap.points import Ints, ranges
from models.errors import IndexBroken
from models.paper.instance_encoder import CellFeatures
from models.paper.levels import Level, Levels
from models.paper.retriever import Retriever, Vectors

STARTS_FILE = "levels.starts.npy"
TEXTS_AT_ONCE = 64
Singles = npt.NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class LevelTable:
    """Unit vectors of every instance of every cell, by level.

    Attributes:
        starts: [N + 1] cell n has the rows starts[n] to starts[n + 1]; no cell is empty.
        vectors: for each level but the global one, [R, D], float32 as made, float16 as read.
    """

    starts: Ints
    vectors: dict[Level, npt.NDArray[np.floating[Any]]]

    @property
    def is_empty(self) -> bool:
        """Whether there is the global level alone."""
        return not self.vectors

    def take(self, cells: Ints) -> "LevelTable":
        """The rows of some cells, in the given order."""
        if not self.vectors:
            return self
        begin, end = self.starts[cells], self.starts[cells + 1]
        rows = ranges(begin, end)
        starts = np.concatenate([[0], np.cumsum(end - begin)])
        return LevelTable(starts, {level: table[rows] for level, table in self.vectors.items()})

    @classmethod
    def joined(cls, tables: Sequence["LevelTable"]) -> "LevelTable":
        """The table of some galleries, one after the other; at least one."""
        if tables[0].is_empty:
            return NO_LEVELS
        if len(tables) == 1:
            return tables[0]
        sizes = np.concatenate([np.diff(table.starts) for table in tables])
        vectors = {n: np.concatenate([table.vectors[n] for table in tables]) for n in tables[0].vectors}
        return cls(np.concatenate([[0], np.cumsum(sizes)]), vectors)

    @property
    def bytes_a_cell(self) -> float:
        """What the levels cost on disk, on average."""
        return sum(2 * table.size for table in self.vectors.values()) / max(1, len(self.starts) - 1)

    def scores(self, texts: Sequence[Levels], cells: Ints) -> dict[Level, Singles]:
        """Similarity of descriptions with some cells at each level (`models.paper.levels.set_similarity`).

        Args:
            texts: Q descriptions, each with B = 1.
            cells: [C] rows.

        Returns:
            [Q, C] by level.
        """
        begin, end = self.starts[cells], self.starts[cells + 1]
        rows = ranges(begin, end)
        segments = np.concatenate([[0], np.cumsum(end - begin)[:-1]])
        found: dict[Level, Singles] = {}
        for level, table in self.vectors.items():
            instances = table[rows].astype(np.float32, copy=False).T
            found[level] = np.empty((len(texts), len(cells)), np.float32)
            for start in range(0, len(texts), TEXTS_AT_ONCE):
                hints = [text.of(level)[0].cpu().numpy() for text in texts[start : start + TEXTS_AT_ONCE]]
                best = np.maximum.reduceat(np.concatenate(hints) @ instances, segments, axis=1)
                sizes = [len(said) for said in hints]
                sums = np.add.reduceat(best, np.concatenate([[0], np.cumsum(sizes)[:-1]]), axis=0)
                found[level][start : start + len(hints)] = sums / np.array(sizes)[:, None]
        return found

    def save(self, directory: Path) -> None:
        """Write a file a level, and the rows of the cells."""
        np.save(directory / STARTS_FILE, self.starts)
        for level, vectors in self.vectors.items():
            np.save(directory / f"levels.{level}.npy", vectors.astype(np.float16))

    @classmethod
    def load(cls, directory: Path, levels: Sequence[Level]) -> "LevelTable":
        """Map what `save` wrote into memory.

        Raises:
            IndexBroken: a level is missing, or the files do not belong together.
        """
        names: list[Level] = [level for level in levels if level != "global"]
        advice = "rebuild it with 'hereabouts index'"
        try:
            starts = np.load(directory / STARTS_FILE, allow_pickle=False)
            vectors = {n: np.load(directory / f"levels.{n}.npy", mmap_mode="r", allow_pickle=False) for n in names}
        except (OSError, ValueError, EOFError) as error:
            raise IndexBroken(f"the levels in {directory} cannot be read; {advice}") from error
        if any(len(table) != starts[-1] for table in vectors.values()):
            raise IndexBroken(f"the levels in {directory} are of different sizes; {advice}")
        return cls(starts, dict(vectors))


NO_LEVELS = LevelTable(np.zeros(1, np.int64), {})


def encode_gallery(
    retriever: Retriever, cells: CellFeatures, share: Callable[..., Iterable[Any]] = map
) -> tuple[Vectors, LevelTable]:
    """A gallery as a retriever sees it, in one pass.

    Args:
        retriever: the model.
        cells: of `Retriever.seen`.
        share: `map`, or what shares blocks of cells out to other processes (`map_forked`).

    Returns:
        [N, D] float32 unit vectors of the global level, and the table of the others.
    """
    width = retriever.config.width
    names: list[Level] = [level for level in retriever.levels if level != "global"]
    whole = np.empty((len(cells), width), np.float32)
    others: dict[Level, npt.NDArray[np.floating[Any]]] = {
        n: np.empty((len(cells.label), width), np.float32) for n in names
    }
    labels = retriever.text_encoder.embed(cells.labels)

    def encoded(first: int) -> list[tuple[Ints, Vectors, dict[Level, Vectors]]]:
        """(rows, global level, others) of the batches of a block."""
        return [
            (rows, levels.whole.cpu().numpy(), {n: levels.of(n)[levels.mask].cpu().numpy() for n in names})
            for rows, levels in retriever.encode_cells(cells, labels, first)
        ]

    for batch in chain.from_iterable(share(encoded, range(0, len(cells), BLOCK))):
        chosen, vectors, by_level = batch
        whole[chosen] = vectors
        rows = ranges(cells.starts[chosen], cells.starts[chosen + 1])
        for level in names:
            others[level][rows] = by_level[level]
    return whole, LevelTable(np.asarray(cells.starts), others)
