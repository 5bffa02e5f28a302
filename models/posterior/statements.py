"""The inverted list over statements (label, colour, sector), which scores all cells of a map."""

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
from models.compiled import FLOAT16_VALUES, compiled
from models.errors import IndexBroken
from models.files import map_arrays, save_safetensors
from models.posterior.likelihood import BoundHints, Likelihood
from models.posterior.neighbours.neighbour_index import NeighbourIndex
from models.posterior.neighbours.neighbours import STEP_M
from models.posterior.node_batch import OFFSET_STEPS, NodeBatch
from models.processes import map_forked
from models.spool import spooled, spooled_zeros

FILE: Final = "statements.safetensors"
SECTORS: Final = 9  # of a statement: the eight winds and "on-top"
MIN_HINT_SHARE: Final = 1e-4  # share of a cell's nodes where a hint holds by chance
MIN_STATEMENT_WEIGHT: Final = 1e-4  # statements that fit a hint less are skipped
UNKNOWN_COLOUR_WEIGHT: Final = 0.3  # of a hint's colour for objects of unknown colour; not measured
CELLS_PER_SLICE: Final = 65_536  # the sums of a slice stay in the processor's cache


@dataclass(frozen=True, slots=True, eq=False)
class StatementRows:
    """The statements of C cells, cell by cell."""

    starts: Ints  # [C + 1] cell n has the entries starts[n] to starts[n + 1]
    statement: Ints  # [Z] int32 number, see Statements
    holds: npt.NDArray[np.float16]  # [Z] share of the cell's nodes where it holds
    possible: int  # number of possible statements


@dataclass(frozen=True, slots=True, eq=False)
class Statements:
    """The share of each of N cells' nodes where each of F statements holds, by statement."""

    cells: int  # N
    starts: Ints  # [F + 1] statement f holds in the cells cell[starts[f]:starts[f + 1]]
    cell: Ints  # [Z] int32
    share: npt.NDArray[np.float16]  # [Z]
    number: Ints  # [F] (label * (words + 1) + word) * SECTORS + sector, ascending
    label: Tensor  # [F]
    word: Tensor  # [F] colour word; `words` for an unknown colour
    sector: Tensor  # [F]
    words: int  # number of colour words

    @classmethod
    def from_gallery(
        cls, likelihood: Likelihood, surroundings: NeighbourIndex, label: Tensor, rgb: Tensor, colour_word_p: Tensor
    ) -> "Statements":
        """Compute the statements of a gallery; arguments as `statement_rows`."""
        rows = statement_rows(likelihood, surroundings, label, rgb, colour_word_p)
        return cls.concatenate([rows], colour_word_p.shape[1])

    @classmethod
    def concatenate(cls, rows: Sequence["StatementRows"], words: int) -> "Statements":
        """Invert the rows of consecutive parts (at least one) of a gallery, with a number of colour words."""
        count = np.sum([_count(part.statement, part.possible) for part in rows], axis=0)
        number = np.flatnonzero(count)  # some thousands
        starts = np.concatenate([[0], np.cumsum(count[number])])
        cell, share = spooled_zeros(int(starts[-1]), np.int32), spooled_zeros(int(starts[-1]), np.float16)
        free = np.cumsum(count) - count  # next free entry of each statement
        cells = 0
        for part in rows:
            _spread(cells, part.starts, part.statement, part.holds.view(np.uint16), free, cell, share.view(np.uint16))
            cells += len(part.starts) - 1
        return cls._from_columns(cells, starts, cell, share, number, words)

    @classmethod
    def _from_columns(
        cls, cells: int, starts: Ints, cell: Ints, share: npt.NDArray[np.float16], number: Ints, words: int
    ) -> "Statements":
        numbers = torch.from_numpy(number)
        pair, sector = numbers // SECTORS, numbers % SECTORS
        return cls(cells, starts, cell, share, number, pair // (words + 1), pair % (words + 1), sector, words)

    def save(self, directory: Path, fingerprint: str) -> None:
        """Write one file; the fingerprint is that of the model that computed the statements."""
        columns = {"holds": self.share, "cell": self.cell, "starts": self.starts, "number": self.number}
        facts = {"cells": str(self.cells), "words": str(self.words), "model": fingerprint}
        save_safetensors(columns, facts, directory / FILE)

    @classmethod
    def load(cls, directory: Path, fingerprint: str) -> "Statements | None":
        """Read what `save` wrote; None if another model computed it.

        Raises:
            IndexBroken: the file is missing or damaged.
        """
        try:
            columns, facts = map_arrays(directory / FILE)
            if facts["model"] != fingerprint:
                return None
            starts, cell, share, number = (columns[name] for name in ("starts", "cell", "holds", "number"))
            if len(starts) != len(number) + 1 or starts[-1] != len(cell) or len(cell) != len(share):
                raise ValueError("the columns are of different lengths")
            return cls._from_columns(int(facts["cells"]), starts, cell, share, number, int(facts["words"]))
        except (OSError, SafetensorError, KeyError, TypeError, ValueError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; rebuild it with 'hereabouts index'") from error

    def scores(self, hints: BoundHints, cells: range | None = None) -> Floats:
        """Return about log p(T | cell) [N]; -inf outside `cells`."""
        words, cells = self.words, range(self.cells) if cells is None else cells
        sector = hints.relation @ _SECTOR_OF_RELATION  # [H, 9]
        unknown = torch.ones(len(sector), 1) * UNKNOWN_COLOUR_WEIGHT
        colour = torch.cat([hints.colour[:, :words] + hints.colour[:, words:], unknown], dim=1)
        factors = (column.numpy() for column in (hints.label, colour, sector, self.label, self.word, self.sector))
        columns, weights = _fitting_statements(*factors)
        presence = 1 - hints.absent.numpy()
        total = np.empty(self.cells, np.float32)
        total[: cells.start] = total[cells.stop :] = -np.inf
        position, ends = self.starts[columns], self.starts[columns + 1]
        _skip(cells.start, self.cell, position, ends)
        for start in range(cells.start, cells.stop, CELLS_PER_SLICE):
            shape = len(weights), min(CELLS_PER_SLICE, cells.stop - start)
            hint_share = np.full(shape, MIN_HINT_SHARE, np.float32)
            _add(position, ends, self.cell, self.share.view(np.uint16), FLOAT16_VALUES, weights, start, hint_share)
            _sum(np.log(hint_share, out=hint_share), presence, total[start : start + shape[1]])
        return total


@compiled
def _fitting_statements(
    label: Floats, colour: Floats, sector: Floats, label_of: Ints, word_of: Ints, sector_of: Ints
) -> tuple[Ints, Floats]:
    """Return the few statements [F] that fit any hint, and their weights [H, F]."""
    columns, weights, count = np.empty(len(label_of), np.int64), np.empty((len(label), len(label_of)), np.float32), 0
    for n in range(len(label_of)):
        highest = np.float32(0.0)
        for hint in range(len(label)):
            weight = label[hint, label_of[n]] * colour[hint, word_of[n]] * sector[hint, sector_of[n]]
            weights[hint, count] = weight
            highest = max(highest, weight)
        if highest > MIN_STATEMENT_WEIGHT:
            columns[count] = n
            count += 1
    return columns[:count].copy(), weights[:, :count].copy()


@compiled
def _count(statement: Ints, possible: int) -> Ints:
    """Return the number [possible] of entries of each statement; NumPy's `bincount` would make a large copy."""
    count = np.zeros(possible, np.int64)
    for number in statement:
        count[number] += 1
    return count


@compiled
def _spread(first: int, starts: Ints, statement: Ints, holds: Ints, free: Ints, cell: Ints, share: Ints) -> None:
    """Write the entries of consecutive cells to the next free entries of their statements; advance these."""
    for n in range(len(starts) - 1):
        for k in range(starts[n], starts[n + 1]):
            entry = free[statement[k]]
            cell[entry], share[entry] = first + n, holds[k]
            free[statement[k]] = entry + 1


@compiled
def _add(
    position: Ints, ends: Ints, cell: Ints, share: Ints, halves: Floats, weights: Floats, start: int, total: Floats
) -> None:
    """Add the shares of statements [F] in a slice of cells, times weights [H, F], to [H, n]; advance the positions.

    `share` is bits of float16, `halves` their values.
    """
    hints, cells = total.shape
    for n in range(len(position)):
        begin, end = position[n], _first_entry(start + cells, cell, position[n], ends[n])
        for hint in range(hints):
            weight = weights[hint, n]
            if weight > MIN_STATEMENT_WEIGHT:
                for k in range(np.uint64(begin), np.uint64(end)):  # unsigned indices need no check for negative ones
                    total[hint, np.uint32(cell[k] - start)] += halves[share[k]] * weight
        position[n] = end


@compiled
def _skip(first: int, cell: Ints, position: Ints, ends: Ints) -> None:
    """Advance the positions of statements [F] to their entries from a cell on."""
    for n in range(len(position)):
        position[n] = _first_entry(first, cell, position[n], ends[n])


@compiled
def _first_entry(first: int, cell: Ints, low: int, high: int) -> int:
    """Return the first of the entries low..high from a cell on; fast if it is close to low."""
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
def _sum(hint_log_p: Floats, weights: Floats, total: Floats) -> None:
    """Write the sum over hints of [H, n], times weights [H], to [n]."""
    for n in range(len(total)):
        total[n] = 0.0
    for hint in range(len(hint_log_p)):
        weight = weights[hint]
        for n in range(len(total)):
            total[n] += hint_log_p[hint, n] * weight


def statement_rows(
    likelihood: Likelihood, surroundings: NeighbourIndex, label: Tensor, rgb: Tensor, colour_word_p: Tensor
) -> StatementRows:
    """Compute the statements of all cells, in several processes for many; a row does not depend on other blocks.

    Objects have labels [P], colours [P, 3], NaN where unknown, and the probability [P, W] of each colour word.
    """
    unknown, count = rgb.isnan().any(dim=1), colour_word_p.shape[1] + 1
    pair = (label * count + torch.where(unknown, count - 1, colour_word_p.argmax(dim=1))).numpy()
    columns = (int(pair.max(initial=-1)) + 1) * SECTORS
    starts, is_vague = surroundings.cell_starts, torch.from_numpy(surroundings.objects.is_vague)

    def tabulate(first: int) -> dict[str, npt.NDArray[Any]]:
        """Return the columns of the block that begins with a cell."""
        last = min(first + CELLS_PER_BLOCK, len(starts) - 1)
        size = np.diff(starts[first : last + 1])
        around = surroundings.around(np.arange(starts[first], starts[last]))
        batch = NodeBatch.from_neighbours(around, int(size.sum()), label, rgb, is_vague)
        with torch.inference_mode():
            share = likelihood.mention_share(batch, likelihood.log_pi()).mean(dim=1)
        cell = np.repeat(np.arange(last - first), size)[around.node]
        statement = pair[around.part] * SECTORS + _SECTOR_OF_OFFSET[batch.offset_code.numpy()]
        value = share.numpy() / np.maximum(1, size)[cell]
        rows = coo_array((value, (cell, statement)), (last - first, columns)).tocsr()
        holds = rows.data.astype(np.float32).astype(np.float16)
        return {"size": np.diff(rows.indptr), "statement": rows.indices.astype(np.int32), "holds": holds}

    types: dict[str, npt.DTypeLike] = {"size": np.int32, "statement": np.int32, "holds": np.float16}
    empty = {name: np.zeros(0, dtype) for name, dtype in types.items()}
    spool = spooled(chain([empty], map_forked(tabulate, range(0, len(starts) - 1, CELLS_PER_BLOCK))))
    sizes = spool.pop("size")
    return StatementRows(np.concatenate([[0], np.cumsum(sizes)]), **spool, possible=columns)


def _sectors_of_offsets() -> Ints:
    """Return the sector of each offset code [65536]: an eighth of the compass, or 8 for "on-top"."""
    steps = np.arange(256, dtype=np.float32) - OFFSET_STEPS
    east, north = np.meshgrid(steps, steps, indexing="ij")
    sector = np.round(np.arctan2(east, north) / (np.pi / 4)).astype(np.int64) % 8
    return np.where(np.hypot(east, north) * STEP_M < ON_TOP_M, 8, sector).ravel()


def _sectors_of_relations() -> Tensor:
    """Return the share [10, 9] of each sector in each relation."""
    table = torch.zeros(10, SECTORS)
    for wind in range(8):
        table[wind, wind] = 1.0
        if wind % 2 == 0:  # "north" means a quarter
            table[wind, [(wind + 1) % 8, (wind - 1) % 8]] = 0.5
    table[8, 8] = 1.0
    table[9] = 1.0
    return table


_SECTOR_OF_OFFSET = _sectors_of_offsets()
_SECTOR_OF_RELATION = _sectors_of_relations()
