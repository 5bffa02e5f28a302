"""What is around the nodes of a map, as the likelihood takes it."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import torch
from torch import Tensor

from models.city.colours import Palette
from models.city.hints import ON_TOP_M
from models.city.points import Ints
from models.posterior.surroundings import STEP_M

RANKS: Final = (16, 4, 4)  # numbers beyond these are as their last
OFFSET: Final = 128  # ways are int8; a pair of them numbers a row of the tables


@dataclass(frozen=True, slots=True, eq=False)
class NodeBatch:
    """The surroundings of M nodes, as torch takes them.

    Attributes:
        node: [R] node of each row, ascending.
        way: [R] number of the way from the instance's closest point, see `way_number`.
        whole: [R] bool, see `models.posterior.surroundings.Surroundings`.
        rank: [R, 5] how many nearer instances there are, and how many in all, see `ranks_of`.
        part: [R] row of `label` and `word`.
        label: [P] label of each part.
        rgb: [P, 3] colour of each, 0..1, NaN where unknown.
        nodes: M.
    """

    node: Tensor
    way: Tensor
    whole: Tensor
    rank: Tensor
    part: Tensor
    label: Tensor
    rgb: Tensor
    nodes: int


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
    sector = _SECTOR_OF_WAY[way]
    keys = [node, node * (int(label.max()) + 1) + label if len(label) else node, node * 5 + sector]
    ranks, numbers = zip(*(_counted(key.numpy()) for key in keys), strict=True)
    nearer = [np.minimum(c, size - 1) for c, size in zip(ranks, RANKS, strict=True)]
    return torch.from_numpy(np.stack([*nearer, *numbers[1:]], axis=1))


def _counted(key: Ints) -> tuple[Ints, Ints]:
    """[R] how many earlier rows have the same key, [R] how many rows have it."""
    # Key and row in one number: sorting plain numbers is an order of magnitude faster than a stable sort of rows.
    packed = np.sort(key << 32 | np.arange(len(key)))
    order, first = packed & 0xFFFFFFFF, np.flatnonzero(np.diff(packed >> 32, prepend=-1))
    size = np.diff(first, append=len(key))
    earlier, count = np.empty(len(key), np.int64), np.empty(len(key), np.int64)
    earlier[order], count[order] = np.arange(len(key)) - np.repeat(first, size), np.repeat(size, size)
    return earlier, count


def _sectors_of_ways() -> Tensor:
    """[65536] quarter of the compass, or "on-top" (4), of each way."""
    steps = torch.arange(256) - OFFSET
    east, north = steps[:, None].expand(256, 256).reshape(-1), steps[None].expand(256, 256).reshape(-1)
    sector = torch.where(east.abs() > north.abs(), (east > 0).long(), 2 + (north > 0).long())
    return torch.where(torch.hypot(east.float(), north.float()) * STEP_M < ON_TOP_M, 4, sector)


_SECTOR_OF_WAY = _sectors_of_ways()


def usual_statements(label: Tensor, rgb: Tensor, palette: Palette) -> Tensor:
    """[L, W + 1] share of a map's parts that have a label and a colour word; last, that have the label.

    Args:
        label: [P] of each part.
        rgb: [P, 3] colour of each, 0..1, NaN where unknown.
        palette: the map's words.
    """
    names = colour_words(palette)
    centers = torch.tensor(np.asarray(palette.centers) / 255, dtype=torch.float32)
    column = torch.tensor([names.index(word) for word in palette.words])
    known = ~rgb.isnan().any(dim=1)
    table = torch.zeros(int(label.max()) + 1, len(names) + 1)
    ones = torch.ones(len(label))
    table.index_put_(
        (label[known], column[torch.cdist(rgb[known], centers).argmin(dim=1)]), ones[known], accumulate=True
    )
    table.index_put_((label, torch.tensor(len(names))), ones, accumulate=True)
    return table / len(label)


def colour_words(palette: Palette) -> list[str]:
    """A palette's words, each once, in order."""
    return list(dict.fromkeys(palette.words))
