"""Probabilities that a person in a cell names a street, a place, a house number or a corner."""

from typing import Final

import numpy as np
from scipy.sparse import csc_array, csr_array
from scipy.spatial import cKDTree

from models.citymap.gazetteer.closest_points import PointGroups, find_closest_points, select_objects
from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.posterior.places.addresses import Addresses
from models.posterior.places.name_index import NameIndex

# Not measured: how people judge these.
ON_STREET_REACH_M: Final = 40.0  # of a street that somebody may be on
NEARER_SOFT_M: Final = 8.0  # by which the nearest of streets or houses must be nearer
LEGIBLE_M, LEGIBLE_SOFT_M = 30.0, 8.0  # up to which a sign can be read
NAME_DECAY_M: Final = 15.0  # over which a name is given less often
CORNER_SOFT_M: Final = 15.0  # by which the nearest of corners must be nearer
MAX_CORNERS: Final = 4  # of a street that may be the nearest
SEARCH_BLOCK_M: Final = 80.0  # cells in a square of this size are searched together
Entries = tuple[Ints, Ints, Floats]  # rows, columns and values of a sparse table


class NameProbabilities:
    """The probabilities of names in the cells of a map, by their centres [N, 2]."""

    def __init__(self, gazetteer: Gazetteer, centers_m: Floats) -> None:
        self._gazetteer, self._centers_m = gazetteer, centers_m
        block = np.floor(centers_m / SEARCH_BLOCK_M).astype(np.int64)
        group = np.unique(block, axis=0, return_inverse=True)[1].ravel()
        self._order = np.argsort(group, kind="stable")
        self._around = PointGroups.from_groups(centers_m[self._order], group[self._order])

    def on_street(self, objects: Ints, streets: NameIndex) -> csr_array:
        """Return the probability [N, S] that a person in a cell names each street as theirs."""
        metres = self._metres(objects, streets, ON_STREET_REACH_M)
        cell, nearest = _nearest(metres)
        metres.data = shares(cell, np.exp((nearest[cell] - metres.data) / NEARER_SOFT_M))
        return metres

    def on_sign(self, objects: Ints, names: NameIndex) -> csr_array:
        """Return the probability [N, K] that a person in a cell names each place when asked for one."""
        metres = self._metres(objects, names, LEGIBLE_M + 3 * LEGIBLE_SOFT_M)
        cell, nearest = _nearest(metres)
        share = shares(cell, np.exp(-metres.data / NAME_DECAY_M) * _is_legible(metres.data))
        metres.data = share * _is_legible(nearest)[cell]
        return metres

    def at_address(self, addresses: Addresses) -> csr_array:
        """Return the probability [N, K] that a person in a cell gives each address as the nearest."""
        metres = self._metres(addresses.objects, addresses, LEGIBLE_M + 3 * LEGIBLE_SOFT_M)
        cell, nearest = _nearest(metres)
        share = shares(cell, np.exp((nearest[cell] - metres.data) / NEARER_SOFT_M))
        metres.data = share * _is_legible(nearest)[cell]
        return metres

    def crossings(self, objects: Ints, streets: NameIndex, on_street: csr_array) -> tuple[csr_array, Ints, Ints]:
        """Return the nearest corners of the streets that each cell is on, as in `Crossings`.

        Returns:
            [N, D] chance of pairs of streets, [D] column of the one, [D] of the other.
        """
        to_column = np.full(len(self._gazetteer) + 1, -1)
        to_column[objects] = streets.column
        pair = to_column[self._gazetteer.corner_streets.reshape(-1, 2)]
        on, other = np.concatenate([pair, pair[:, ::-1]]).T
        corners_m = np.tile(self._gazetteer.corners_m.astype(np.float64), (2, 1))
        by_street = on_street.tocsc()
        order = np.argsort(on, kind="stable")
        order = order[np.diff(by_street.indptr)[on[order]] > 0]  # of streets that any of the cells are on
        first = np.flatnonzero(np.diff(on[order], prepend=-1))
        entries = [
            self._corners(by_street, int(on[corners[0]]), corners, corners_m) for corners in np.split(order, first)[1:]
        ]
        cell, corner, chance = (np.concatenate([part[n] for part in entries]) if entries else _EMPTY for n in range(3))
        count = max(1, len(streets))
        pairs, column = np.unique(on * count + other, return_inverse=True)
        shape = len(self._order), max(1, len(pairs))
        table = csr_array((chance, (cell.astype(np.int64), column[corner.astype(np.int64)])), shape=shape)
        return table, pairs // count, pairs % count

    def _corners(self, on_street: csc_array, street: int, corners: Ints, corners_m: Floats) -> Entries:
        """Return (cell, corner, probability) of the nearest corners of a street in the cells on it."""
        entries = slice(on_street.indptr[street], on_street.indptr[street + 1])
        cells, chance = on_street.indices[entries], on_street.data[entries]
        count = min(MAX_CORNERS, len(corners))
        metres, row = cKDTree(corners_m[corners]).query(self._centers_m[cells], k=range(1, count + 1))
        weight = np.exp((metres[:, :1] - metres) / CORNER_SOFT_M)
        weight *= (chance / weight.sum(axis=1))[:, None]
        return np.repeat(cells, count), corners[row].ravel(), weight.ravel()

    def _metres(self, objects: Ints, names: NameIndex | Addresses, reach_m: float) -> csr_array:
        """Return the distance [N, names] to the nearest object of each name within reach."""
        shape = (len(self._order), max(1, len(names)))
        if not len(objects):
            return csr_array(shape)
        closest = find_closest_points(self._around, *select_objects(self._gazetteer, objects), reach_m)
        entry = self._order[closest.point] * shape[1] + names.column[closest.target]
        order = np.argsort(entry, kind="stable")
        first = np.flatnonzero(np.diff(entry[order], prepend=-1))
        metres = np.minimum.reduceat(closest.distance_m[order], first) if len(first) else np.zeros(0)
        cell, name = np.divmod(entry[order[first]], shape[1])
        return csr_array((metres, name, np.searchsorted(cell, np.arange(shape[0] + 1))), shape=shape)


_EMPTY: Final = np.zeros(0)


def _nearest(metres: csr_array) -> tuple[Ints, Floats]:
    """Return the row of each entry, and the minimum of each row, infinite if empty."""
    cell = np.repeat(np.arange(metres.shape[0]), np.diff(metres.indptr))
    nearest = np.full(metres.shape[0], np.inf)
    np.minimum.at(nearest, cell, metres.data)
    return cell, nearest


def shares(cell: Ints, weight: Floats) -> Floats:
    """Normalize the weights of entries to a sum of 1 per cell."""
    return weight / np.bincount(cell, weight)[cell] if len(cell) else weight


def _is_legible(metres: Floats) -> Floats:
    return 1 / (1 + np.exp(np.minimum((metres - LEGIBLE_M) / LEGIBLE_SOFT_M, 50.0)))
