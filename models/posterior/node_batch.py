"""The neighbours of nodes as tensors, and statistics of a map's objects."""

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

RANKS: Final = (16, 4, 4)  # sizes of the rank tables: over all, of the class, of the direction; then ranks are capped
DIRECTIONS_AND_ON_TOP: Final = 5
OFFSET_STEPS: Final = 128  # makes int8 offsets row numbers of the tables
OFFSET_CODES: Final = (2 * OFFSET_STEPS) ** 2


@dataclass(frozen=True, slots=True, eq=False)
class NodeBatch:
    """The R neighbours of M nodes, as the likelihood takes them, and the P objects among them."""

    node: Tensor  # [R] ascending
    offset_code: Tensor  # [R] see `offset_codes`
    whole: Tensor  # [R] bool, see `Neighbours`
    rank: Tensor  # [R, 5] see `ranks_of`
    part: Tensor  # [R] index of the object in the next three
    label: Tensor  # [P]
    rgb: Tensor  # [P, 3] colour, 0..1, NaN where unknown
    is_vague: Tensor  # [P] see `MapObjects`
    nodes: int  # M

    @property
    def relation_row(self) -> Tensor:
        """The row [R] of `Likelihood.relation_table`."""
        return self.offset_code + OFFSET_CODES * self.is_vague.index_select(0, self.part)

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
        node, code = torch.from_numpy(around.node), offset_codes(torch.from_numpy(around.offset))
        rank = ranks_of(node, code, label[torch.from_numpy(around.part)])
        chosen = torch.from_numpy(parts)
        looks = label[chosen], rgb[chosen], is_vague[chosen]
        return cls(node, code, torch.from_numpy(around.whole), rank, torch.from_numpy(part), *looks, nodes)


def offset_codes(offset: Tensor) -> Tensor:
    """Return the code [R], a row of the tables, of offsets [R, 2] int8."""
    shifted = offset.long() + OFFSET_STEPS
    return shifted[:, 0] * 256 + shifted[:, 1]


def ranks_of(node: Tensor, offset_code: Tensor, label: Tensor) -> Tensor:
    """Return the ranks and counts [R, 5] of neighbours, ordered by node and distance.

    The first three are numbers of nearer neighbours of the node: over all, of the same class, in the same direction.
    The last two are numbers of all neighbours of the class and of the direction.
    """
    ranks = np.empty((len(node), len(RANKS) + 2), np.int64)
    _fill_ranks(node.numpy(), label.numpy(), _DIRECTION_OF_OFFSET[offset_code].numpy(), ranks)
    return torch.from_numpy(ranks)


@compiled
def _fill_ranks(node: Ints, label: Ints, direction: Ints, ranks: Ints) -> None:
    begin, rows, first = 0, len(node), label.max() + 1 if len(label) else 0
    counts = np.zeros(first + DIRECTIONS_AND_ON_TOP, np.int64)  # of each label, then of each direction, at one node
    while begin < rows:
        end = begin
        while end < rows and node[end] == node[begin]:
            same_label, same_direction = counts[label[end]], counts[first + direction[end]]
            ranks[end, 0] = min(end - begin, RANKS[0] - 1)
            ranks[end, 1], ranks[end, 2] = min(same_label, RANKS[1] - 1), min(same_direction, RANKS[2] - 1)
            counts[label[end]], counts[first + direction[end]] = same_label + 1, same_direction + 1
            end += 1
        for r in range(begin, end):
            ranks[r, 3], ranks[r, 4] = counts[label[r]], counts[first + direction[r]]
        for r in range(begin, end):
            counts[label[r]], counts[first + direction[r]] = 0, 0
        begin = end


def _directions_of_offsets() -> Tensor:
    """Return the quarter of the compass, or 4 for "on-top", of each offset code [65536]."""
    steps = torch.arange(256) - OFFSET_STEPS
    east, north = steps[:, None].expand(256, 256).reshape(-1), steps[None].expand(256, 256).reshape(-1)
    direction = torch.where(east.abs() > north.abs(), (east > 0).long(), 2 + (north > 0).long())
    return torch.where(torch.hypot(east.float(), north.float()) * STEP_M < ON_TOP_M, 4, direction)


_DIRECTION_OF_OFFSET: Final = _directions_of_offsets()


def mean_statements(label: Tensor, rgb: Tensor, parts: Tensor, palette: Palette) -> Tensor:
    """Return the share [L, W + 1] of a map's parts with each label and colour word; last, with the label.

    Objects have labels [P], colours [P, 3], NaN where unknown, and are shown by a number of parts [P].
    """
    names = colour_words(palette)
    centers = torch.tensor(np.asarray(palette.centers) / 255, dtype=torch.float32)
    column = torch.tensor([names.index(word) for word in palette.words])
    known = ~rgb.isnan().any(dim=1)
    table = torch.zeros(int(label.max()) + 1, len(names) + 1)
    count = parts.float()
    word = column[torch.cdist(rgb[known], centers).argmin(dim=1)]
    table.index_put_((label[known], word), count[known], accumulate=True)
    table.index_put_((label, torch.tensor(len(names))), count, accumulate=True)
    return table / count.sum()


def colour_words(palette: Palette) -> list[str]:
    """Return the distinct words of a palette in order."""
    return list(dict.fromkeys(palette.words))
