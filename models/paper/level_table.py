"""Vectors of the instance and relation levels of a gallery, one per instance, stored in a compact form."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt
from safetensors import SafetensorError

from models.citymap.cells import CELLS_PER_BLOCK
from models.citymap.points import Ints, ranges
from models.errors import IndexBroken
from models.files import map_arrays, save_safetensors
from models.paper.instance_encoder import CellFeatures
from models.paper.levels import Level, Levels, Matching
from models.paper.retriever import Retriever, Vectors

FILE: Final = "levels.safetensors"
TEXTS_PER_BATCH = 64  # compared with all cells at once; bounds the memory of the product
# Numbers of a compact vector. On Helsinki's validation strip, 32 rank as all 256 do (R@1 .550), and 16 triple the error
# of the relation level.
COMPACT_WIDTH: Final = 32
MAX_CODE: Final = 127  # of a number in 8 bits
Float32s = npt.NDArray[np.float32]
Bases = dict[Level, Float32s]


@dataclass(frozen=True, slots=True, eq=False)
class LevelTable:
    """The unit vectors of all instances of all cells, by level: exact, or `compact`."""

    starts: Ints  # [N + 1] cell n has the rows starts[n] to starts[n + 1]; no cell is empty
    # [R, D] float32 by level, without the global one; or int8 codes [R, K] of the bases
    vectors: dict[Level, npt.NDArray[Any]]
    # [D, K] by level: a vector is about basis @ code; none for exact vectors
    bases: Bases = field(default_factory=dict)

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
        return LevelTable(starts, {level: table[rows] for level, table in self.vectors.items()}, self.bases)

    def fit_bases(self) -> Bases:
        """Return the principal directions of exact vectors by level, scaled so that codes fill 8 bits."""
        bases: Bases = {}
        for level, vectors in self.vectors.items():
            moment = vectors.T.astype(np.float64) @ vectors
            directions = np.linalg.eigh(moment)[1][:, ::-1][:, :COMPACT_WIDTH].astype(np.float32)
            largest = np.abs(vectors @ directions).max(axis=0, initial=1e-6)
            bases[level] = directions * (largest / MAX_CODE)
        return bases

    def compact(self, bases: Bases) -> "LevelTable":
        """Return vectors, exact or of other bases, as codes of these bases, 8 bits per number."""
        codes: dict[Level, npt.NDArray[Any]] = {}
        for level, vectors in self.vectors.items():
            encode = bases[level] / (bases[level] ** 2).sum(axis=0)  # [D, K], because directions are orthogonal
            if level in self.bases:
                encode = self.bases[level].T @ encode
            codes[level] = np.rint(vectors @ encode).clip(-MAX_CODE, MAX_CODE).astype(np.int8)
        return LevelTable(self.starts, codes, bases)

    @classmethod
    def concatenate(cls, tables: Sequence["LevelTable"]) -> "LevelTable":
        """Concatenate the tables of one or more galleries, with the bases of the first.

        The bases differ between kinds of processors, which may have made the parts of an index.
        """
        first = tables[0]
        if first.is_empty:
            return EMPTY_LEVEL_TABLE
        if len(tables) == 1:
            return first
        sizes = np.concatenate([np.diff(table.starts) for table in tables])
        alike = [table if _are_equal(table.bases, first.bases) else table.compact(first.bases) for table in tables]
        vectors = {n: np.concatenate([table.vectors[n] for table in alike]) for n in first.vectors}
        return cls(np.concatenate([[0], np.cumsum(sizes)]), vectors, first.bases)

    @property
    def bytes_per_cell(self) -> float:
        """Mean size of a cell's vectors."""
        return sum(table.nbytes for table in self.vectors.values()) / max(1, len(self.starts) - 1)

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
                stacked = np.concatenate(hints)
                stacked = stacked @ self.bases[level] if level in self.bases else stacked
                cosine = stacked @ instances
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
        """Write a compact table to one file."""
        columns: dict[str, npt.NDArray[Any]] = {"starts": self.starts.astype(np.int64)}
        columns |= {level: np.ascontiguousarray(codes) for level, codes in self.vectors.items()}
        columns |= {f"{level}.basis": np.ascontiguousarray(basis) for level, basis in self.bases.items()}
        save_safetensors(columns, {"levels": " ".join(self.vectors)}, directory / FILE)

    @classmethod
    def load(cls, directory: Path, levels: Sequence[Level]) -> "LevelTable":
        """Map the file of `save` into memory; raise IndexBroken if a level is missing or the columns do not match."""
        names: list[Level] = [level for level in levels if level != "global"]
        try:
            columns, _ = map_arrays(directory / FILE)
            starts, vectors = columns["starts"], {name: columns[name] for name in names}
            bases = {name: columns[f"{name}.basis"] for name in names}
            if any(len(vectors[n]) != starts[-1] or vectors[n].shape[1] != bases[n].shape[1] for n in names):
                raise ValueError("its columns have different sizes")
        except (OSError, SafetensorError, KeyError, IndexError, ValueError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; rebuild it with 'hereabouts index'") from error
        return cls(starts, vectors, bases)


def _are_equal(one: Bases, other: Bases) -> bool:
    return one.keys() == other.keys() and all(np.array_equal(one[level], other[level]) for level in one)


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
