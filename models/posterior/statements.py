"""The inverted list over statements: which cells a text may be about, of all cells of a map."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt
import torch
from safetensors import SafetensorError
from scipy.sparse import coo_array
from torch import Tensor

from models.citymap.cells import CELLS_PER_BLOCK
from models.citymap.hints import ON_TOP_M
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import HALVES, compiled
from models.errors import IndexBroken
from models.files import map_arrays, save_safetensors
from models.posterior.likelihood import Likelihood, Reading
from models.posterior.neighbours.neighbour_index import NeighbourIndex
from models.posterior.neighbours.neighbours import STEP_M
from models.posterior.node_batch import OFFSET, NodeBatch
from models.processes import map_forked
from models.spool import on_disk, spooled

FILE: Final = "statements.safetensors"
SECTORS: Final = 9  # of a statement: the eight winds and "on-top"
FLOOR: Final = 1e-4  # share of a cell's nodes where a hint is taken to hold by chance
FAINT: Final = 1e-4  # what no hint says
AT_ONCE: Final = 65_536  # cells: what is told of them stays near the processor


@dataclass(frozen=True, slots=True, eq=False)
class StatementRows:
    """How much of each of C cells' nodes every statement holds at, cell by cell.

    Attributes:
        starts: [C + 1] cell n has the entries starts[n] to starts[n + 1].
        statement: [Z] int32 number of each, see Statements.
        holds: [Z] float16.
        possible: how many statements there may be.
    """

    starts: Ints
    statement: Ints
    holds: npt.NDArray[np.float16]
    possible: int


@dataclass(frozen=True, slots=True, eq=False)
class Statements:
    """How much of each cell's nodes a statement (label, colour, sector) holds at.

    Attributes:
        cells: N.
        starts: [F + 1] statement f holds in the cells cell[starts[f]:starts[f + 1]].
        cell: [Z] int32.
        share: [Z] float16, of the cell's nodes.
        number: [F] (label * (words + 1) + word) * SECTORS + sector of each statement, ascending.
        label: [F] its class.
        word: [F] its colour; beyond the last word is an unknown one.
        sector: [F] where it is.
        words: how many colour words there are.
    """

    cells: int
    starts: Ints
    cell: Ints
    share: npt.NDArray[np.float16]
    number: Ints
    label: Tensor
    word: Tensor
    sector: Tensor
    words: int

    @classmethod
    def of(
        cls, likelihood: Likelihood, surroundings: NeighbourIndex, label: Tensor, rgb: Tensor, words: Tensor
    ) -> "Statements":
        """Those of a gallery; arguments as `statement_rows`."""
        return cls.joined([statement_rows(likelihood, surroundings, label, rgb, words)], words.shape[1])

    @classmethod
    def joined(cls, rows: Sequence["StatementRows"], words: int) -> "Statements":
        """Those of a gallery that was tabulated in parts.

        Args:
            rows: of `statement_rows`, part by part, at least one.
            words: how many colour words there are.
        """
        count = np.sum([_counted(some.statement, some.possible) for some in rows], axis=0)
        number = np.flatnonzero(count)  # of what holds anywhere: some thousands
        starts = np.concatenate([[0], np.cumsum(count[number])])
        cell, share = on_disk(int(starts[-1]), np.int32), on_disk(int(starts[-1]), np.float16)
        place = np.cumsum(count) - count  # of the next of each
        cells = 0
        for some in rows:
            _spread(cells, some.starts, some.statement, some.holds.view(np.uint16), place, cell, share.view(np.uint16))
            cells += len(some.starts) - 1
        return cls._of(cells, starts, cell, share, number, words)

    @classmethod
    def _of(
        cls, cells: int, starts: Ints, cell: Ints, share: npt.NDArray[np.float16], number: Ints, words: int
    ) -> "Statements":
        said = torch.from_numpy(number)
        pair = said // SECTORS
        return cls(cells, starts, cell, share, number, pair // (words + 1), pair % (words + 1), said % SECTORS, words)

    def save(self, directory: Path, fingerprint: str) -> None:
        """Write one file; the fingerprint is that of the model that they were made with."""
        columns = {
            "holds": self.share,
            "cell": self.cell,
            "starts": self.starts,
            "number": self.number,
        }
        facts = {"cells": str(self.cells), "words": str(self.words), "model": fingerprint}
        save_safetensors(columns, facts, directory / FILE)

    @classmethod
    def load(cls, directory: Path, fingerprint: str) -> "Statements | None":
        """Read what `save` wrote; None if another model made them.

        Raises:
            IndexBroken: the file is missing or holds something else.
        """
        try:
            columns, facts = map_arrays(directory / FILE)
            if facts["model"] != fingerprint:
                return None
            starts, cell, share, number = (columns[name] for name in ("starts", "cell", "holds", "number"))
            if len(starts) != len(number) + 1 or starts[-1] != len(cell) or len(cell) != len(share):
                raise ValueError("the columns are of different lengths")
            return cls._of(int(facts["cells"]), starts, cell, share, number, int(facts["words"]))
        except (OSError, SafetensorError, KeyError, TypeError, ValueError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; rebuild it with 'hereabouts index'") from error

    def scores(self, reading: Reading, some: range | None = None) -> Floats:
        """Return about log p(T | cell) of all cells, [N].

        Args:
            reading: the text.
            some: score only these cells, others get -inf; None for all.
        """
        words, some = self.words, range(self.cells) if some is None else some
        place = reading.relation @ _SECTOR_OF_RELATION  # [H, 9]
        colour = torch.cat(
            [reading.colour[:, :words] + reading.colour[:, words:], torch.ones(len(place), 1) * 0.3], dim=1
        )
        said = (of.numpy() for of in (reading.label, colour, place, self.label, self.word, self.sector))
        columns, weights = _told(*said)
        told_of = 1 - reading.absent.numpy()
        total = np.empty(self.cells, np.float32)
        total[: some.start] = total[some.stop :] = -np.inf
        at, ends = self.starts[columns], self.starts[columns + 1]
        _skip(some.start, self.cell, at, ends)
        for start in range(some.start, some.stop, AT_ONCE):
            held = np.full((len(weights), min(AT_ONCE, some.stop - start)), FLOOR, np.float32)
            _add(at, ends, self.cell, self.share.view(np.uint16), HALVES, weights, start, held)
            _sum(np.log(held, out=held), told_of, total[start : start + held.shape[1]])
        return total


@compiled
def _told(
    label: Floats, colour: Floats, place: Floats, label_of: Ints, word_of: Ints, sector_of: Ints
) -> tuple[Ints, Floats]:
    """(columns [F], weights [H, F]) of the statements that a hint tells of: few."""
    columns, weights, count = np.empty(len(label_of), np.int64), np.empty((len(label), len(label_of)), np.float32), 0
    for n in range(len(label_of)):
        most = np.float32(0.0)
        for hint in range(len(label)):
            told = label[hint, label_of[n]] * colour[hint, word_of[n]] * place[hint, sector_of[n]]
            weights[hint, count] = told
            most = max(most, told)
        if most > FAINT:
            columns[count] = n
            count += 1
    return columns[:count].copy(), weights[:, :count].copy()


@compiled
def _counted(statement: Ints, possible: int) -> Ints:
    """[possible] how often there is each; NumPy's has a copy of all of them twice the size."""
    count = np.zeros(possible, np.int64)
    for number in statement:
        count[number] += 1
    return count


@compiled
def _spread(first: int, starts: Ints, statement: Ints, holds: Ints, place: Ints, cell: Ints, share: Ints) -> None:
    """Put what holds in some cells, from one on, where each statement's next place is; these move on."""
    for n in range(len(starts) - 1):
        for k in range(starts[n], starts[n + 1]):
            at = place[statement[k]]
            cell[at], share[at] = first + n, holds[k]
            place[statement[k]] = at + 1


@compiled
def _add(
    at: Ints, ends: Ints, cell: Ints, share: Ints, halves: Floats, weight: Floats, start: int, held: Floats
) -> None:
    """Add what some columns [F] hold in the cells from one on, times weights [H, F] that are not faint, to [H, N].

    `share` is bits, `halves` what each of them means; `at`, where the columns go on, moves to what comes after.
    """
    hints, cells = held.shape
    for n in range(len(at)):
        begin, end = at[n], _up_to(start + cells, cell, at[n], ends[n])
        for hint in range(hints):
            told = weight[hint, n]
            if told > FAINT:
                for k in range(np.uint64(begin), np.uint64(end)):  # unsigned: none is counted from the end
                    held[hint, np.uint32(cell[k] - start)] += halves[share[k]] * told
        at[n] = end


@compiled
def _skip(first: int, cell: Ints, at: Ints, ends: Ints) -> None:
    """Move on where columns [F] begin to what is not before a cell."""
    for n in range(len(at)):
        at[n] = _up_to(first, cell, at[n], ends[n])


@compiled
def _up_to(first: int, cell: Ints, low: int, high: int) -> int:
    """Which of the entries low..high is the first that is of one cell or of a later one; it is not far from low."""
    step = 1
    while low + step < high and cell[low + step] < first:
        low, step = low + step, 2 * step
    high = min(low + step, high)
    while low < high:
        middle = (low + high) // 2
        if cell[middle] < first:
            low = middle + 1
        else:
            high = middle
    return low


@compiled
def _sum(of_hints: Floats, told_of: Floats, total: Floats) -> None:
    """[N] the sum of [H, N], times weights [H]."""
    for n in range(len(total)):
        total[n] = 0.0
    for hint in range(len(of_hints)):
        told = told_of[hint]
        for n in range(len(total)):
            total[n] += of_hints[hint, n] * told


def statement_rows(
    likelihood: Likelihood, surroundings: NeighbourIndex, label: Tensor, rgb: Tensor, words: Tensor
) -> StatementRows:
    """How much of each cell's nodes every possible statement holds at.

    In several processes when there is much to do. A row depends on no cell of another block.

    Args:
        likelihood: says how much of what is around a node is told of.
        surroundings: of C cells.
        label: [P] of each thing.
        rgb: [P, 3] colour of each, NaN where unknown.
        words: [P, W] chance of each colour word.
    """
    unknown, count = rgb.isnan().any(dim=1), words.shape[1] + 1
    pair = (label * count + torch.where(unknown, count - 1, words.argmax(dim=1))).numpy()
    columns = (int(pair.max(initial=-1)) + 1) * SECTORS
    starts, is_vague = surroundings.cell_starts, torch.from_numpy(surroundings.things.is_vague)

    def tabulated(first: int) -> dict[str, npt.NDArray[Any]]:
        """How many, statements, how much they hold in the cells from one on."""
        last = min(first + CELLS_PER_BLOCK, len(starts) - 1)
        size = np.diff(starts[first : last + 1])
        around = surroundings.around(np.arange(starts[first], starts[last]))
        batch = NodeBatch.from_neighbours(around, int(size.sum()), label, rgb, is_vague)
        with torch.inference_mode():
            share = likelihood.share_of(batch, likelihood.log_pi()).mean(dim=1)
        cell = np.repeat(np.arange(last - first), size)[around.node]
        said = pair[around.part] * SECTORS + _SECTOR_OF_WAY[batch.way.numpy()]
        value = share.numpy() / np.maximum(1, size)[cell]
        rows = coo_array((value, (cell, said)), (last - first, columns)).tocsr()
        holds = rows.data.astype(np.float32).astype(np.float16)
        return {"size": np.diff(rows.indptr), "statement": rows.indices.astype(np.int32), "holds": holds}

    types: dict[str, npt.DTypeLike] = {"size": np.int32, "statement": np.int32, "holds": np.float16}
    none = {name: np.zeros(0, dtype) for name, dtype in types.items()}
    found = spooled(chain([none], map_forked(tabulated, range(0, len(starts) - 1, CELLS_PER_BLOCK))))
    sizes = found.pop("size")
    return StatementRows(np.concatenate([[0], np.cumsum(sizes)]), **found, possible=columns)


def _sectors_of_ways() -> Ints:
    """[65536] the eighth of the compass, or "on-top" (8), of each way of `way_number`."""
    steps = np.arange(256, dtype=np.float32) - OFFSET
    east, north = np.meshgrid(steps, steps, indexing="ij")
    sector = np.round(np.arctan2(east, north) / (np.pi / 4)).astype(np.int64) % 8
    return np.where(np.hypot(east, north) * STEP_M < ON_TOP_M, 8, sector).ravel()


def _sectors_of_relations() -> Tensor:
    """[10, 9] how much of each relation a sector (a wind's eighth, or "on-top") is."""
    table = torch.zeros(10, SECTORS)
    for wind in range(8):
        table[wind, wind] = 1.0
        if wind % 2 == 0:  # "north" is said of a quarter
            table[wind, [(wind + 1) % 8, (wind - 1) % 8]] = 0.5
    table[8, 8] = 1.0
    table[9] = 1.0
    return table


_SECTOR_OF_WAY = _sectors_of_ways()
_SECTOR_OF_RELATION = _sectors_of_relations()
