"""What of the things around them people say when asked: whether one is near, in which wind, and what colour it has."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.posterior.neighbours.neighbour_index import NeighbourIndex
from models.posterior.neighbours.neighbours import STEP_M, Neighbours

NEAR_M, NEAR_SOFT_M = 10.0, 2.0  # what counts as near, and how far people's ideas of that differ
FAR_M, FAR_SOFT_M = 15.0, 2.0  # beyond, a thing is none that is asked for; surroundings know no farther either
APART_M = 2.0  # by which of two things one must be nearer to be the nearest to most people
TURN: Final = 12.0  # degrees that people are off by, near the border between two winds
QUARTERS: Final = ("north", "east", "south", "west")
Words = Callable[[Ints], Floats]


@dataclass(frozen=True, slots=True, eq=False)
class Near:
    """The things of one class around M nodes.

    Attributes:
        node: [R] node of each row.
        bearing: [R] degrees from the node to it, clockwise from north.
        part: [R] which of the surroundings' things.
        nearest_m: [M] infinite where there is none.
        weight: [R] that it is taken for the nearest; of each node they add up to 1.
    """

    node: Ints
    bearing: Floats
    part: Ints
    nearest_m: Floats
    weight: Floats

    def mean(self, values: Floats) -> Floats:
        """[M, K] of values [R, K], that of what is taken for the nearest; 0 where there is none."""
        nodes = len(self.nearest_m)
        return np.stack([np.bincount(self.node, self.weight * column, nodes) for column in values.T], axis=1)


class Sights:
    """The things around the nodes of a map, as people are asked about them.

    Args:
        surroundings: of the gallery.
        label: [P] number of the class of each of the surroundings' things.
        words: says the chance of each colour word [n, W] of some things [n].
    """

    def __init__(self, surroundings: NeighbourIndex, label: npt.NDArray[np.int64], words: Words) -> None:
        self.surroundings, self._label, self._words = surroundings, label, words

    def seen(self, nodes: Ints, classes: Sequence[int]) -> "Seen":
        """What is around some nodes [M] of some classes."""
        around = self.surroundings.around(nodes)
        label = self._label[around.part]
        wanted = np.zeros(int(self._label.max(initial=-1)) + 1, np.bool_)
        wanted[list(classes)] = True
        kept = np.flatnonzero(wanted[label])
        kept = kept[np.argsort(label[kept], kind="stable")]
        starts = (
            np.searchsorted(label[kept], np.asarray(classes)),
            np.searchsorted(label[kept], np.asarray(classes), "right"),
        )
        near = {c: _near(around, kept[low:high], len(nodes)) for c, low, high in zip(classes, *starts, strict=True)}
        return Seen(near, self._words)


def _near(around: Neighbours, rows: Ints, nodes: int) -> Near:
    """Some rows of what is around so many nodes."""
    node, part = around.node[rows], around.part[rows]
    east, north = -around.way[rows].astype(np.float64).T * STEP_M
    metres, nearest = np.hypot(east, north), np.full(nodes, np.inf)
    np.minimum.at(nearest, node, metres)
    weight = np.exp((nearest[node] - metres) / APART_M)
    weight /= np.bincount(node, weight, nodes)[node]
    return Near(node, np.degrees(np.arctan2(east, north)) % 360, part, nearest, weight)


class Seen:
    """What is around M nodes.

    Args:
        near: the things of each class.
        words: says the chance of each colour word [n, W] of some of the surroundings' things [n].
    """

    def __init__(self, near: Mapping[int, Near], words: Words) -> None:
        self._near, self._words = near, words

    def share(self, label: int, mass: Floats) -> float:
        """How much of a mass [M] has a class around it."""
        return float(mass[np.isfinite(self._near[label].nearest_m)].sum())

    def is_near(self, label: int) -> Floats:
        """[M, 2] chance that it is true that one of a class is near, and that none is."""
        yes = _falls(self._near[label].nearest_m, NEAR_M, NEAR_SOFT_M)
        return np.stack([yes, 1 - yes], axis=1)

    def quarter(self, label: int) -> Floats:
        """[M, 5] chance of each of QUARTERS that the nearest of a class is in; last, that there is none."""
        near = self._near[label]
        turned = (near.bearing[:, None] - np.arange(4) * 90.0 + 180) % 360 - 180
        share = _falls(np.abs(turned), 45.0, TURN / 2)
        share /= share.sum(axis=1, keepdims=True)
        here = _falls(near.nearest_m, FAR_M, FAR_SOFT_M)[:, None]
        return np.concatenate([near.mean(share) * here, 1 - here], axis=1)

    def colour(self, label: int, words: Ints) -> Floats:
        """[M, K + 1] chance of each of K colour words, and another, of the nearest of a class; alike where none is."""
        near = self._near[label]
        found = near.mean(self._shares[label][:, words])
        found = np.concatenate([found, 1 - found.sum(axis=1, keepdims=True)], axis=1)
        return np.where(np.isfinite(near.nearest_m)[:, None], found, 1 / found.shape[1])

    def colours(self, label: int, mass: Floats) -> Floats:
        """[W] how much of a mass [M] has each colour word at the nearest of a class."""
        near = self._near[label]
        share: Floats = (near.weight * mass[near.node]) @ self._shares[label]
        return share

    @cached_property
    def _shares(self) -> Mapping[int, Floats]:
        """[R, W] share of each colour word, of the things of each class; of all at once, which is faster."""
        parts = [near.part for near in self._near.values()]
        chance = self._words(np.concatenate(parts))
        ends = np.cumsum([len(some) for some in parts])[:-1]
        return dict(zip(self._near, np.split(chance / chance.sum(axis=1, keepdims=True), ends), strict=True))


def _falls(values: Floats, middle: float, soft: float) -> Floats:
    """About 1 below the middle and 0 above."""
    falls: Floats = 1 / (1 + np.exp(np.clip((values - middle) / soft, -50, 50)))
    return falls
