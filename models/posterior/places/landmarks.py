"""What people say when asked of names: which street they are on, and whether they see a place."""

from collections.abc import Mapping
from functools import cached_property
from typing import Final

import numpy as np
from scipy.sparse import csr_array

from models.city.gazetteer.gazetteer import STREET, Gazetteer
from models.city.gazetteer.ways import Around, cut, ways_to
from models.city.points import Ints
from models.city.types import Floats

ON_STREET_M: Final = 40.0  # as far as a street may be which somebody says to be on
BETWEEN_M: Final = 8.0  # by which of two streets one must be nearer to be the one
SEEN_M, SEEN_SOFT_M = 30.0, 8.0  # as far as the sign over a door is read, about
BLOCK_M: Final = 80.0  # cells are looked at together that lie in a square of this


class Landmarks:
    """The names around the cells of a map, as they are asked about; the same all over a cell.

    Args:
        gazetteer: of the map.
        centers_m: [N, 2] of the cells.
        kinds: beginnings of the kinds of places that people know by their names.
    """

    def __init__(self, gazetteer: Gazetteer, centers_m: Floats, kinds: tuple[str, ...]) -> None:
        self._gazetteer = gazetteer
        block = np.floor(centers_m / BLOCK_M).astype(np.int64)
        group = np.unique(block, axis=0, return_inverse=True)[1].ravel()
        self._order = np.argsort(group, kind="stable")
        self._around = Around.of(centers_m[self._order], group[self._order])
        streets = gazetteer.by_kind.get(STREET, np.zeros(0, np.int64))
        self._objects = [streets, np.array([n for n in gazetteer.named if self._is_known(n, kinds)], np.int64)]
        self.streets, self.names = (self._numbers(objects) for objects in self._objects)

    def _is_known(self, item: int, kinds: tuple[str, ...]) -> bool:
        return self._gazetteer.words[item].kinds[0].startswith(kinds)

    def _numbers(self, objects: Ints) -> Mapping[str, int]:
        """Names of objects, each with the number of its column."""
        names = dict.fromkeys(self._gazetteer.words[n].names[0] for n in objects)
        return {name: number for number, name in enumerate(names)}

    @cached_property
    def on_street(self) -> csr_array:
        """[N, S] chance that who stands in a cell says to be on each street; rows add up to 1, or to less near none."""
        metres = self._metres(self._objects[0], self.streets, ON_STREET_M)
        cell = np.repeat(np.arange(metres.shape[0]), np.diff(metres.indptr))
        nearest = np.full(metres.shape[0], np.inf)
        np.minimum.at(nearest, cell, metres.data)
        weight = np.exp((nearest[cell] - metres.data) / BETWEEN_M)
        metres.data = weight / np.bincount(cell, weight, metres.shape[0])[cell]
        return metres

    @cached_property
    def seen(self) -> csr_array:
        """[N, P] chance that who stands in a cell sees each name."""
        metres = self._metres(self._objects[1], self.names, SEEN_M + 3 * SEEN_SOFT_M)
        metres.data = 1 / (1 + np.exp((metres.data - SEEN_M) / SEEN_SOFT_M))
        return metres

    def _metres(self, objects: Ints, numbers: Mapping[str, int], reach_m: float) -> csr_array:
        """[N, names] distance to the nearest of each name, as far as it is within reach."""
        shape = (len(self._order), max(1, len(numbers)))
        if not len(objects):
            return csr_array(shape)
        column = np.array([numbers[self._gazetteer.words[n].names[0]] for n in objects])
        ways = ways_to(self._around, *cut(self._gazetteer, objects), reach_m)
        cell, name, metres = self._order[ways.point], column[ways.item], ways.metres
        order = np.lexsort((metres, name, cell))
        cell, name, metres = cell[order], name[order], metres[order]
        first = (np.diff(cell, prepend=-1) != 0) | (np.diff(name, prepend=-1) != 0)
        starts = np.searchsorted(cell[first], np.arange(shape[0] + 1))
        return csr_array((metres[first], name[first], starts), shape=shape)
