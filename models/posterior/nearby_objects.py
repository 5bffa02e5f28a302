"""The truth of closed questions about nearby objects: whether one is near, in which quarter, and of which colour."""

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

# Not measured: how people judge "near", "the nearest" and the border between two quarters.
NEAR_M, NEAR_SOFT_M = 10.0, 2.0
FAR_M, FAR_SOFT_M = 15.0, 2.0  # beyond, an object does not count; the neighbour index ends there
NEAREST_SOFT_M: Final = 2.0
QUARTER_SOFT_DEG: Final = 12.0
QUARTERS: Final = ("north", "east", "south", "west")
ColourWords = Callable[[Ints], Floats]  # from objects [n] to the probability of each colour word [n, W]


@dataclass(frozen=True, slots=True, eq=False)
class ObjectsOfClass:
    """The objects of one class around M nodes, in R rows."""

    node: Ints  # [R]
    bearing: Floats  # [R] degrees from the node, clockwise from north
    part: Ints  # [R] index of the object
    nearest_m: Floats  # [M] infinite without any
    weight: Floats  # [R] probability to be taken for the nearest; adds up to 1 per node

    def mean(self, values: Floats) -> Floats:
        """Return the expectation [M, K] of values [R, K] of the nearest object; 0 without any."""
        nodes = len(self.nearest_m)
        return np.stack([np.bincount(self.node, self.weight * column, nodes) for column in values.T], axis=1)


class NearbyObjects:
    """The objects around the nodes of a map; `label` [P] is the class number of each."""

    def __init__(self, surroundings: NeighbourIndex, label: npt.NDArray[np.int64], colour_words: ColourWords) -> None:
        self.surroundings, self._label, self._colour_words = surroundings, label, colour_words

    def around(self, nodes: Ints, classes: Sequence[int]) -> "ObjectsAround":
        """Return the objects of some classes around nodes [M]."""
        around = self.surroundings.around(nodes)
        label = self._label[around.part]
        is_wanted = np.zeros(int(self._label.max(initial=-1)) + 1, np.bool_)
        is_wanted[list(classes)] = True
        rows = np.flatnonzero(is_wanted[label])
        rows = rows[np.argsort(label[rows], kind="stable")]
        low = np.searchsorted(label[rows], np.asarray(classes))
        high = np.searchsorted(label[rows], np.asarray(classes), "right")
        return ObjectsAround(
            {c: _objects_of_class(around, rows[a:b], len(nodes)) for c, a, b in zip(classes, low, high, strict=True)},
            self._colour_words,
        )


def _objects_of_class(around: Neighbours, rows: Ints, nodes: int) -> ObjectsOfClass:
    """Return some rows of the neighbours of `nodes` nodes as objects of one class."""
    node, part = around.node[rows], around.part[rows]
    east, north = -around.offset[rows].astype(np.float64).T * STEP_M
    metres, nearest = np.hypot(east, north), np.full(nodes, np.inf)
    np.minimum.at(nearest, node, metres)
    weight = np.exp((nearest[node] - metres) / NEAREST_SOFT_M)
    weight /= np.bincount(node, weight, nodes)[node]
    return ObjectsOfClass(node, np.degrees(np.arctan2(east, north)) % 360, part, nearest, weight)


class ObjectsAround:
    """The objects around M nodes, by class."""

    def __init__(self, by_class: Mapping[int, ObjectsOfClass], colour_words: ColourWords) -> None:
        self._by_class, self._colour_words = by_class, colour_words

    def share(self, label: int, mass: Floats) -> float:
        """Return the share of a mass [M] at nodes with an object of a class."""
        return float(mass[np.isfinite(self._by_class[label].nearest_m)].sum())

    def is_near(self, label: int) -> Floats:
        """Return the probability [M, 2] that an object of a class is near, and that none is."""
        yes = _soft_below(self._by_class[label].nearest_m, NEAR_M, NEAR_SOFT_M)
        return np.stack([yes, 1 - yes], axis=1)

    def quarter(self, label: int) -> Floats:
        """Return the probability [M, 5] that the nearest object of a class is in each of QUARTERS; last, of none."""
        objects = self._by_class[label]
        turned = (objects.bearing[:, None] - np.arange(4) * 90.0 + 180) % 360 - 180
        share = _soft_below(np.abs(turned), 45.0, QUARTER_SOFT_DEG / 2)
        share /= share.sum(axis=1, keepdims=True)
        exists = _soft_below(objects.nearest_m, FAR_M, FAR_SOFT_M)[:, None]
        return np.concatenate([objects.mean(share) * exists, 1 - exists], axis=1)

    def colour(self, label: int, words: Ints) -> Floats:
        """Return the probability [M, K + 1] of K colour words and of another for the nearest; uniform without any."""
        objects = self._by_class[label]
        p = objects.mean(self._word_shares[label][:, words])
        p = np.concatenate([p, 1 - p.sum(axis=1, keepdims=True)], axis=1)
        return np.where(np.isfinite(objects.nearest_m)[:, None], p, 1 / p.shape[1])

    def colours(self, label: int, mass: Floats) -> Floats:
        """Return the share [W] of a mass [M] where the nearest object of a class has each colour word."""
        objects = self._by_class[label]
        return (objects.weight * mass[objects.node]) @ self._word_shares[label]

    @cached_property
    def _word_shares(self) -> Mapping[int, Floats]:
        """The share [R, W] of each colour word, by class; computed for all classes at once, which is faster."""
        parts = [objects.part for objects in self._by_class.values()]
        p = self._colour_words(np.concatenate(parts))
        ends = np.cumsum([len(part) for part in parts])[:-1]
        return dict(zip(self._by_class, np.split(p / p.sum(axis=1, keepdims=True), ends), strict=True))


def _soft_below(values: Floats, middle: float, soft: float) -> Floats:
    """Return about 1 below the middle and 0 above."""
    return 1 / (1 + np.exp(np.clip((values - middle) / soft, -50, 50)))
