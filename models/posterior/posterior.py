"""Where a description was said: candidates, a distribution over their nodes, and what explains each hint."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt
import torch
from torch import Tensor

from models.citymap.cells import CellTable
from models.citymap.colours import Palette
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats
from models.posterior.area_filter import Inside
from models.posterior.likelihood import Likelihood, Reading
from models.posterior.nearby_objects import Sights
from models.posterior.neighbours.neighbour_index import NeighbourIndex
from models.posterior.neighbours.nodes import is_coarse
from models.posterior.node_batch import NodeBatch, usual_statements
from models.posterior.places.field import PlaceEvidence
from models.posterior.questions import Answered
from models.posterior.statements import Statements

CANDIDATES = 100  # cells whose nodes are looked at
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


@dataclass(frozen=True, slots=True, eq=False)
class HintExplanation:
    """What explains a hint at a node.

    Attributes:
        probability: that something does.
        part: which of the surroundings' things; -1 for none.
        way_m: [2] the node minus the closest point of it.
    """

    probability: float
    part: int
    way_m: Floats


UNEXPLAINED: Final = HintExplanation(0.0, -1, np.zeros(2))


class HintPosterior:
    """The posterior of one gallery.

    Args:
        likelihood: fitted.
        surroundings: of the gallery.
        cells: the gallery.
        label: [P] label of each of the surroundings' things, a number.
        palette: the map's colour words.
        statements: of the gallery, if they are at hand.
    """

    @torch.inference_mode()
    def __init__(
        self,
        likelihood: Likelihood,
        surroundings: NeighbourIndex,
        cells: CellTable,
        label: npt.NDArray[np.int64],
        palette: Palette,
        statements: Statements | None = None,
    ) -> None:
        self.likelihood, self.surroundings, self.cells = likelihood, surroundings, cells
        self._label = torch.from_numpy(label)
        self._rgb = torch.from_numpy(surroundings.things.rgb.astype(np.float32))
        self._palette = palette
        self.usual = usual_statements(self._label, self._rgb, torch.from_numpy(surroundings.things.parts), palette)
        self._is_vague, self._tables = torch.from_numpy(surroundings.things.is_vague), likelihood.tables()
        self.statements = statements or Statements.of(
            likelihood, surroundings, self._label, self._rgb, likelihood.words(self._rgb, palette)
        )
        self.extent_m = cells.extent_m
        self.without_nodes = np.flatnonzero(np.diff(surroundings.cell_starts) == 0)  # cells
        self.sights = Sights(surroundings, label, lambda things: self._words(torch.from_numpy(things)).numpy())

    @torch.inference_mode()
    def cell_scores(self, reading: Reading, some: range | None = None) -> Floats:
        """[N] about log p(T | cell), of every cell of the gallery, or of some as `Statements.scores`."""
        return self.statements.scores(reading, some)

    @torch.inference_mode()
    def field(
        self,
        reading: Reading | None,
        cells: Ints,
        log_prior: LogPrior | None = None,
        inside: Inside | None = None,
        told: PlaceEvidence | None = None,
        answered: Answered | None = None,
        times: Ints | None = None,
        between: bool = False,
    ) -> Field:
        """The posterior over the nodes of some cells.

        Args:
            reading: hints about what is near; None for none.
            cells: [K] rows.
            log_prior: log-density of positions [M, 2]; None for none.
            inside: where alone it can be; None for everywhere.
            told: the places that were named, if any.
            answered: what answers to questions tell, if any.
            times: [K] of which cell those nodes alone that a grid so many times as coarse has; None for all.
            between: the others instead.
        """
        s = self.surroundings
        begin, end = s.cell_starts[cells], s.cell_starts[cells + 1]
        nodes, cell = ranges(begin, end), np.repeat(np.arange(len(cells)), end - begin)
        positions_m = s.positions_m(nodes)
        if inside is not None:
            kept = inside.holds(positions_m)
            nodes, cell, positions_m = nodes[kept], cell[kept], positions_m[kept]
        if times is not None:
            kept = is_coarse(positions_m, times[cell]) != between
            nodes, cell, positions_m = nodes[kept], cell[kept], positions_m[kept]
        log_p: Floats = np.zeros(len(nodes))
        if reading is not None:
            batch = NodeBatch.from_neighbours(s.around(nodes), len(nodes), self._label, self._rgb, self._is_vague)
            log_p = self.likelihood(reading, batch, self._palette, self.usual, self._tables).double().numpy()
        if told is not None:
            log_p = log_p + told.at(positions_m, cell)
        if answered is not None:
            log_p = log_p + answered.at(nodes)
        if log_prior is not None:
            log_p = log_p + log_prior(positions_m)
        return Field(cells, nodes, cell, log_p)

    @torch.inference_mode()
    def _words(self, things: Tensor) -> Tensor:
        """[n, W] chance of each colour word of some things [n]: a table of all would be the largest of a city."""
        return self.likelihood.words(self._rgb.index_select(0, things), self._palette)

    @torch.inference_mode()
    def explain(self, reading: Reading, node: int) -> list[HintExplanation]:
        """For each hint what explains it best at a node."""
        around = self.surroundings.around(np.array([node]))
        if not len(around.part):
            return [UNEXPLAINED] * len(reading.label)
        batch = NodeBatch.from_neighbours(around, 1, self._label, self._rgb, self._is_vague)
        best, probability = self.likelihood.explain(reading, batch, self._palette, self.usual, self._tables)
        way_m = around.way_m
        return [
            HintExplanation(p, int(around.part[row]), way_m[row])
            for row, p in zip(best.tolist(), probability.tolist(), strict=True)
        ]
