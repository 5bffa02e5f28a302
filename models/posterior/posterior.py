"""Where a description was said: candidates, a distribution over their nodes, and what explains each hint."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import torch
from scipy.sparse import csc_array
from torch import Tensor

from models.city.cells import CellTable
from models.city.colours import Palette
from models.city.hints import ON_TOP_M
from models.city.points import Ints, ranges
from models.city.types import Floats
from models.posterior.likelihood import Likelihood, Reading
from models.posterior.node_batch import OFFSET, ranks_of, usual_statements, way_number
from models.posterior.places.field import Told
from models.posterior.questions import Answered
from models.posterior.sights import Sights
from models.posterior.surroundings import SPACING_M, STEP_M, Surroundings

CANDIDATES = 100  # cells whose nodes are looked at
SECTORS = 9  # of a statement: the eight winds and "on-top"
FLOOR = 1e-4  # share of a cell's nodes where a hint is taken to hold by chance
FAINT_STATEMENT = 1e-4  # what no hint says
LogPrior = Callable[[Floats], Floats]


@dataclass(frozen=True, slots=True, eq=False)
class Field:
    """A distribution over the nodes of some cells.

    Attributes:
        cells: [K] rows, as they were given.
        nodes: [M] rows of the surroundings' nodes.
        cell: [M] which of `cells` owns each.
        log_p: [M] log p(T | x) + log prior, not normalised.
    """

    cells: Ints
    nodes: Ints
    cell: Ints
    log_p: Floats


class HintPosterior:
    """The posterior of one gallery.

    Args:
        likelihood: fitted.
        surroundings: of the gallery.
        cells: the gallery.
        label: [R] label of each of the cells' parts, a number.
        palette: the map's colour words.
    """

    @torch.inference_mode()
    def __init__(
        self,
        likelihood: Likelihood,
        surroundings: Surroundings,
        cells: CellTable,
        label: npt.NDArray[np.int64],
        palette: Palette,
    ) -> None:
        self.likelihood, self.surroundings, self.cells = likelihood, surroundings, cells
        s = surroundings
        self._label = torch.from_numpy(label)
        rgb = torch.from_numpy(cells.parts.rgb.astype(np.float32))
        self._words = likelihood.words(rgb, palette)
        self.usual = usual_statements(self._label, rgb, palette)
        self._way = way_number(torch.from_numpy(s.way)).int()
        self._ways = likelihood.ways()
        self._share = self._shares()
        self._statements, said = self._tabulate()
        pair, self._sector_said = said // SECTORS, said % SECTORS
        self._label_said, self._word_said = pair // (self._words.shape[1] + 1), pair % (self._words.shape[1] + 1)
        self.nodes_m, self.extent_m = s.nodes_m.astype(np.float64), cells.extent_m
        self.coarse = (np.round(self.nodes_m / SPACING_M) % 2 == 0).all(axis=1)
        self.between = ~self.coarse
        self.sights = Sights(s, label, self._words.numpy())
        self._scratch = np.zeros(len(label), np.int64)  # by part; what is in it is overwritten before it is read

    def _shares(self) -> Tensor:
        """[R, 3] pi of each row, a block of nodes at a time."""
        s, blocks = self.surroundings, []
        for begin in range(0, len(s.nodes_m), 100_000):
            end = min(begin + 100_000, len(s.nodes_m))
            rows = slice(int(s.starts[begin]), int(s.starts[end]))
            node = torch.from_numpy(np.repeat(np.arange(end - begin), np.diff(s.starts[begin : end + 1])))
            way, part = self._way[rows].long(), torch.from_numpy(s.part[rows]).long()
            rank = ranks_of(node, way, self._label[part])
            whole = torch.from_numpy(s.whole[rows])
            blocks.append(self.likelihood.share_of(way, whole, rank, node, end - begin))
        return torch.cat(blocks)

    def _tabulate(self) -> tuple[csc_array, Tensor]:
        """[N, F] how much of each cell's nodes a statement (label, colour, sector) holds at, and the F statements."""
        s = self.surroundings
        sizes = np.diff(s.starts)
        cell = np.repeat(np.repeat(np.arange(len(self.cells)), np.diff(s.cell_starts)), sizes)
        sector = _sectors_of_ways()[self._way.numpy()]
        word = self._words.argmax(dim=1).numpy()
        known = (self.cells.parts.rgb == self.cells.parts.rgb).all(axis=1)
        word = np.where(known, word, self._words.shape[1])
        key = (self._label.numpy() * (self._words.shape[1] + 1) + word)[s.part] * SECTORS + sector
        number = np.flatnonzero(np.bincount(key))  # statements that hold anywhere; of some thousands that there are
        column = np.searchsorted(number, np.arange(key.max() + 1))[key] if len(key) else key
        value = self._share.mean(dim=1).numpy() / np.maximum(1, np.diff(s.cell_starts))[cell]
        table = csc_array((value, (cell, column)), shape=(len(self.cells), len(number)), dtype=np.float32)
        return table, torch.from_numpy(number)

    @torch.inference_mode()
    def cell_scores(self, reading: Reading) -> Floats:
        """[N] about log p(T | cell), of every cell of the gallery: the inverted list over statements."""
        words = self._words.shape[1]
        known = (reading.label.amax(dim=0) > FAINT_STATEMENT).index_select(0, self._label_said).nonzero().flatten()
        place = reading.relation @ _SECTOR_OF_RELATION  # [H, 9]
        colour = torch.cat(
            [reading.colour[:, :words] + reading.colour[:, words:], torch.ones(len(place), 1) * 0.3], dim=1
        )
        weight = reading.label.index_select(1, self._label_said.index_select(0, known))  # [H, F]
        weight = weight * colour.index_select(1, self._word_said.index_select(0, known))
        weight = weight * place.index_select(1, self._sector_said.index_select(0, known))
        told = (weight.amax(dim=0) > FAINT_STATEMENT).nonzero().flatten()  # few
        columns = known.index_select(0, told).numpy()
        holds = self._statements[:, columns] @ weight.index_select(1, told).T.numpy()
        scores: Floats = np.log(holds + FLOOR) @ (1 - reading.absent.numpy())
        return scores

    @torch.inference_mode()
    def field(
        self,
        reading: Reading | None,
        cells: Ints,
        log_prior: LogPrior | None = None,
        inside: Any = None,
        told: Told | None = None,
        answered: Answered | None = None,
    ) -> Field:
        """The posterior over the nodes of some cells.

        Args:
            reading: hints about what is near; None for none.
            cells: [K] rows.
            log_prior: log-density of positions [M, 2]; None for none.
            inside: [M of all] bool, False where it cannot be; None for everywhere.
            told: the places that were named, if any.
            answered: what answers to questions tell, if any.
        """
        s = self.surroundings
        begin, end = s.cell_starts[cells], s.cell_starts[cells + 1]
        nodes, cell = ranges(begin, end), np.repeat(np.arange(len(cells)), end - begin)
        if inside is not None:
            kept = inside[nodes]
            nodes, cell = nodes[kept], cell[kept]
        log_p = np.zeros(len(nodes)) if reading is None else self._log_p(reading, nodes)
        if told is not None:
            log_p = log_p + told.at(self.nodes_m[nodes], cell)
        if answered is not None:
            log_p = log_p + answered.at(nodes)
        if log_prior is not None:
            log_p = log_p + log_prior(self.nodes_m[nodes])
        return Field(cells, nodes, cell, log_p)

    def _log_p(self, reading: Reading, nodes: Ints) -> Floats:
        """[M] log p(hints | x) of some nodes."""
        rows, node, fits, part = self._rows(reading, nodes)
        model = self.likelihood
        pairs = model.pairs(reading, fits, part, self._ways, self._way.index_select(0, rows))
        share, eps = self._share.index_select(0, rows.index_select(0, pairs.row)), model.chance(reading, self.usual)
        log_p: Floats = model.combine(reading, node, len(nodes), pairs, share, eps).double().numpy()
        return log_p

    @torch.inference_mode()
    def explain(self, reading: Reading, node: int) -> list[tuple[int, float]]:
        """For each hint the row of the surroundings that explains it best at a node, and how likely one does.

        The row is -1 where nothing is around.
        """
        rows, _, fits, part = self._rows(reading, np.array([node]))
        share = self._share[rows].mean(dim=1, keepdim=True)
        terms = fits[part] * self.likelihood.places(reading, self._ways[self._way[rows].long()]) * share
        eps = self.likelihood.chance(reading, self.usual)
        if not len(rows):
            return [(-1, 0.0)] * len(reading.label)
        best, total = terms.argmax(dim=0), terms.sum(dim=0)
        parts = self.surroundings.part[rows[best].numpy()]
        # What fits only because a label may be wrong does not explain.
        label = reading.label[torch.arange(len(best)), self._label[torch.from_numpy(parts).long()]]
        trust = (2 * label).clamp(max=1.0)
        explained = (total / (total + eps) * trust).tolist()
        return list(zip(rows[best].tolist(), explained, strict=True))

    def _rows(self, reading: Reading, nodes: Ints) -> tuple[Tensor, Tensor, Tensor, Tensor]:
        """Rows of some nodes, the node of each, p(class) p(colour) [P, H] of the parts seen, and each row's part."""
        s = self.surroundings
        begin, end = s.starts[nodes], s.starts[nodes + 1]
        rows = torch.from_numpy(ranges(begin, end))
        node = torch.from_numpy(np.repeat(np.arange(len(nodes)), end - begin))
        part, number = s.part[rows.numpy()], self._scratch
        number[part] = count = np.arange(len(part))
        different = part[number[part] == count]  # each once
        number[different] = count[: len(different)]
        chosen = torch.from_numpy(different.astype(np.int64))
        label, words = (table.index_select(0, chosen) for table in (self._label, self._words))
        fits = self.likelihood.parts(reading, label, words)
        return rows, node, fits, torch.from_numpy(number[part])


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


_SECTOR_OF_RELATION = _sectors_of_relations()
