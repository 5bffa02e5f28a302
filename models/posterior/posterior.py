"""The posterior of a gallery: densities at the nodes of cells, and what explains each hint (docs/method.md, M22)."""

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
from models.posterior.area_filter import AreaFilter
from models.posterior.likelihood import BoundHints, Likelihood
from models.posterior.nearby_objects import NearbyObjects
from models.posterior.neighbours.neighbour_index import NeighbourIndex
from models.posterior.neighbours.nodes import is_coarse
from models.posterior.node_batch import NodeBatch, mean_statements
from models.posterior.places.field import PlaceEvidence
from models.posterior.questions import ReplyEvidence
from models.posterior.statements import Statements

CANDIDATE_CELLS: Final = 100  # cells whose nodes are evaluated
LogPrior = Callable[[Floats], Floats]


@dataclass(frozen=True, slots=True, eq=False)
class PositionEvidence:
    """Everything that is known about a position; None for nothing of a kind."""

    hints: BoundHints | None = None
    places: PlaceEvidence | None = None
    replies: ReplyEvidence | None = None
    log_prior: LogPrior | None = None  # log density of positions [M, 2], up to a constant
    area: AreaFilter | None = None

    @property
    def is_hints_only(self) -> bool:
        """Whether nothing but hints is known."""
        others = self.places, self.replies, self.log_prior, self.area
        return self.hints is not None and all(part is None for part in others)


@dataclass(frozen=True, slots=True, eq=False)
class Field:
    """Unnormalised log densities at the nodes of K cells."""

    cells: Ints  # [K]
    nodes: Ints  # [M]
    cell: Ints  # [M] index into `cells` of the owner of each node
    log_p: Floats  # [M] log p(T | x) + log prior


@dataclass(frozen=True, slots=True, eq=False)
class HintExplanation:
    """The explanation of a hint at a node."""

    probability: float  # that an object explains the hint
    part: int  # index of the object; -1 for none
    offset_m: Floats  # [2] the node minus the object's closest point


UNEXPLAINED: Final = HintExplanation(0.0, -1, np.zeros(2))


class HintPosterior:
    """The posterior of one gallery; `label` [P] numbers the labels of the objects of `surroundings`.

    Statements are computed if there are none.
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
        objects = surroundings.objects
        self._label, self._palette = torch.from_numpy(label), palette
        self._rgb = torch.from_numpy(objects.rgb.astype(np.float32))
        self.mean_statements = mean_statements(self._label, self._rgb, torch.from_numpy(objects.parts), palette)
        self._is_vague, self._tables = torch.from_numpy(objects.is_vague), likelihood.tables()
        self.statements = statements or Statements.from_gallery(
            likelihood, surroundings, self._label, self._rgb, likelihood.colour_word_p(self._rgb, palette)
        )
        self.extent_m = cells.extent_m
        self.cells_without_nodes = np.flatnonzero(np.diff(surroundings.cell_starts) == 0)
        self.nearby_objects = NearbyObjects(
            surroundings, label, lambda parts: self._colour_word_p(torch.from_numpy(parts)).numpy()
        )

    @torch.inference_mode()
    def cell_scores(self, hints: BoundHints, cells: range | None = None) -> Floats:
        """Return about log p(T | cell) [N] of the gallery; -inf outside `cells`."""
        return self.statements.scores(hints, cells)

    @torch.inference_mode()
    def field(
        self, evidence: PositionEvidence, cells: Ints, coarsening: Ints | None = None, *, is_rest: bool = False
    ) -> Field:
        """Return the posterior over the nodes of cells [K].

        Args:
            evidence: about the position.
            cells: rows of the gallery.
            coarsening: [K] factor of the grid of each cell whose nodes are evaluated; None for all nodes.
            is_rest: evaluate only the nodes that the coarser grid lacks.
        """
        s = self.surroundings
        begin, end = s.cell_starts[cells], s.cell_starts[cells + 1]
        nodes, cell = ranges(begin, end), np.repeat(np.arange(len(cells)), end - begin)
        positions_m = s.positions_m(nodes)
        if evidence.area is not None:
            chosen = evidence.area.contains(positions_m)
            nodes, cell, positions_m = nodes[chosen], cell[chosen], positions_m[chosen]
        if coarsening is not None:
            chosen = is_coarse(positions_m, coarsening[cell]) != is_rest
            nodes, cell, positions_m = nodes[chosen], cell[chosen], positions_m[chosen]
        log_p: Floats = np.zeros(len(nodes))
        if evidence.hints is not None:
            batch = NodeBatch.from_neighbours(s.around(nodes), len(nodes), self._label, self._rgb, self._is_vague)
            near = self.likelihood(evidence.hints, batch, self._palette, self.mean_statements, self._tables)
            log_p = near.double().numpy()
        if evidence.places is not None:
            log_p = log_p + evidence.places.log_p(positions_m, cell)
        if evidence.replies is not None:
            log_p = log_p + evidence.replies.log_p(nodes)
        if evidence.log_prior is not None:
            log_p = log_p + evidence.log_prior(positions_m)
        return Field(cells, nodes, cell, log_p)

    @torch.inference_mode()
    def _colour_word_p(self, parts: Tensor) -> Tensor:
        """Return the probability [n, W] of each colour word; a table of all objects of a city would be too large."""
        return self.likelihood.colour_word_p(self._rgb.index_select(0, parts), self._palette)

    @torch.inference_mode()
    def explain(self, hints: BoundHints, node: int) -> list[HintExplanation]:
        """Return the best explanation of each hint at a node."""
        around = self.surroundings.around(np.array([node]))
        if not len(around.part):
            return [UNEXPLAINED] * len(hints.label)
        batch = NodeBatch.from_neighbours(around, 1, self._label, self._rgb, self._is_vague)
        best, probability = self.likelihood.explain(hints, batch, self._palette, self.mean_statements, self._tables)
        offset_m = around.offset_m
        return [
            HintExplanation(p, int(around.part[row]), offset_m[row])
            for row, p in zip(best.tolist(), probability.tolist(), strict=True)
        ]
