"""What is around the nodes of a map, as the likelihood takes it."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import torch
from torch import Tensor

from models.citymap.colours import Palette
from models.citymap.hints import ON_TOP_M
from models.citymap.points import Ints
from models.compiled import compiled
from models.posterior.neighbours.neighbours import STEP_M, Neighbours

RANKS: Final = (16, 4, 4)  # numbers beyond these are as their last
MOST: Final = tuple(size - 1 for size in RANKS)
SECTORS: Final = 5
OFFSET: Final = 128  # ways are int8; a pair of them numbers a row of the tables
WAYS: Final = (2 * OFFSET) ** 2


@dataclass(frozen=True, slots=True, eq=False)
class NodeBatch:
    """The surroundings of M nodes, as torch takes them.

    Attributes:
        node: [R] node of each row, ascending.
        way: [R] number of the way from the instance's closest point, see `way_number`.
        whole: [R] bool, see `models.posterior.neighbours.neighbours.Neighbours`.
        rank: [R, 5] how many nearer instances there are, and how many in all, see `ranks_of`.
        part: [R] row of the next three.
        label: [P] label of each.
        rgb: [P, 3] colour of each, 0..1, NaN where unknown.
        is_vague: [P] see `MapObjects`.
        nodes: M.
    """

    node: Tensor
    way: Tensor
    whole: Tensor
    rank: Tensor
    part: Tensor
    label: Tensor
    rgb: Tensor
    is_vague: Tensor
    nodes: int

    @property
    def towards(self) -> Tensor:
        """[R] row of `Likelihood.ways`."""
        return self.way + WAYS * self.is_vague.index_select(0, self.part)

    @classmethod
    def from_neighbours(
        cls, around: Neighbours, nodes: int, label: Tensor, rgb: Tensor, is_vague: Tensor
    ) -> "NodeBatch":
        """Return the neighbours of `nodes` nodes; label, rgb and is_vague are those of all the map's objects."""
        is_near = np.zeros(len(label), np.bool_)
        is_near[around.part] = True
        parts = np.flatnonzero(is_near)
        row = np.empty(len(label), np.int64)
        row[parts] = np.arange(len(parts))
        part = row[around.part]
        node, way = torch.from_numpy(around.node), way_number(torch.from_numpy(around.way))
        rank = ranks_of(node, way, label[torch.from_numpy(around.part)])
        chosen = torch.from_numpy(parts)
        looks = label[chosen], rgb[chosen], is_vague[chosen]
        return cls(node, way, torch.from_numpy(around.whole), rank, torch.from_numpy(part), *looks, nodes)


def way_number(way: Tensor) -> Tensor:
    """[R] int64 of ways [R, 2] int8."""
    shifted = way.long() + OFFSET
    return shifted[:, 0] * 256 + shifted[:, 1]


def ranks_of(node: Tensor, way: Tensor, label: Tensor) -> Tensor:
    """[R, 5] nearer instances of a node: in all, of the same class, in the same direction; then all of the last two.

    Args:
        node: [R] node of each row, ascending, nearest first.
        way: [R] of `way_number`.
        label: [R] label of each row.
    """
    ranks = np.empty((len(node), len(RANKS) + 2), np.int64)
    _count(node.numpy(), label.numpy(), SECTOR_OF_WAY[way].numpy(), ranks)
    return torch.from_numpy(ranks)


@compiled
def _count(node: Ints, label: Ints, sector: Ints, ranks: Ints) -> None:
    """Fill `ranks` [R, 5] for rows in order of node."""
    begin, rows, first = 0, len(node), label.max() + 1 if len(label) else 0
    counts = np.zeros(first + SECTORS, np.int64)  # of each label, then of each sector, around the node at hand
    while begin < rows:
        end = begin
        while end < rows and node[end] == node[begin]:
            same_label, same_sector = counts[label[end]], counts[first + sector[end]]
            ranks[end, 0] = min(end - begin, MOST[0])
            ranks[end, 1], ranks[end, 2] = min(same_label, MOST[1]), min(same_sector, MOST[2])
            counts[label[end]], counts[first + sector[end]] = same_label + 1, same_sector + 1
            end += 1
        for r in range(begin, end):
            ranks[r, 3], ranks[r, 4] = counts[label[r]], counts[first + sector[r]]
        for r in range(begin, end):
            counts[label[r]], counts[first + sector[r]] = 0, 0
        begin = end


def _sectors_of_ways() -> Tensor:
    """[65536] quarter of the compass, or "on-top" (4), of each way."""
    steps = torch.arange(256) - OFFSET
    east, north = steps[:, None].expand(256, 256).reshape(-1), steps[None].expand(256, 256).reshape(-1)
    sector = torch.where(east.abs() > north.abs(), (east > 0).long(), 2 + (north > 0).long())
    return torch.where(torch.hypot(east.float(), north.float()) * STEP_M < ON_TOP_M, 4, sector)


SECTOR_OF_WAY: Final = _sectors_of_ways()


def usual_statements(label: Tensor, rgb: Tensor, parts: Tensor, palette: Palette) -> Tensor:
    """[L, W + 1] share of a map's parts that have a label and a colour word; last, that have the label.

    Args:
        label: [P] of each thing.
        rgb: [P, 3] colour of each, 0..1, NaN where unknown.
        parts: [P] how many parts of cells are of each.
        palette: the map's words.
    """
    names = colour_words(palette)
    centers = torch.tensor(np.asarray(palette.centers) / 255, dtype=torch.float32)
    column = torch.tensor([names.index(word) for word in palette.words])
    known = ~rgb.isnan().any(dim=1)
    table = torch.zeros(int(label.max()) + 1, len(names) + 1)
    many = parts.float()
    table.index_put_(
        (label[known], column[torch.cdist(rgb[known], centers).argmin(dim=1)]), many[known], accumulate=True
    )
    table.index_put_((label, torch.tensor(len(names))), many, accumulate=True)
    return table / many.sum()


def colour_words(palette: Palette) -> list[str]:
    """A palette's words, each once, in order."""
    return list(dict.fromkeys(palette.words))
