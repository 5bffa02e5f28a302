"""What people say when asked: their street, a place that they see, the nearest cross street or house number."""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from scipy.sparse import csc_array, csr_array, find
from scipy.spatial import cKDTree

from models.city.gazetteer.gazetteer import STREET, Gazetteer
from models.city.gazetteer.ways import Around, cut, ways_to
from models.city.points import Ints
from models.city.types import Floats
from models.posterior.places.addresses import Addresses
from models.posterior.places.spelt import Spelt

ON_STREET_M: Final = 40.0  # as far as a street may be which somebody says to be on
BETWEEN_M: Final = 8.0  # by which of two streets or houses one must be nearer to be the one
SEEN_M, SEEN_SOFT_M = 30.0, 8.0  # as far as the sign over a door is read, about
NAMED_M: Final = 15.0  # over which it is said less often than what is nearer
CORNERS: Final = 4  # of a street that may be the nearest
NEAREST_M: Final = 15.0  # by which of two corners one must be nearer to be the one
BLOCK_M: Final = 80.0  # cells are looked at together that lie in a square of this


class Table:
    """Chance [N, K] of names in cells; rows add up to 1, or to less where there may be none to say.

    Args:
        rows: [N, K].
    """

    def __init__(self, rows: csr_array) -> None:
        self.rows = rows

    @cached_property
    def _columns(self) -> csc_array:
        return self.rows.tocsc()  # a reply is about few names in all cells, a question about all names in few

    def of(self, names: Ints) -> Floats:
        """[N] chance of any of some names."""
        chance: Floats = np.asarray(self._columns[:, names].sum(axis=1)).ravel()
        return chance


@dataclass(frozen=True, slots=True, eq=False)
class Crossings:
    """Who is on which street, and which crosses it nearest to them.

    Attributes:
        pairs: chance of D pairs of streets in cells: on one, and the other is the nearest that crosses it.
        on: [D] column of the one.
        other: [D] column of the other.
        streets: how many there are.
    """

    pairs: Table
    on: Ints
    other: Ints
    streets: int

    def rows(self, cells: Ints, on: Ints) -> csr_array:
        """[C, S] chance of each street in some cells.

        Args:
            cells: [C].
            on: the streets that people may have said to be on; none if they have not said. Where none of these is
                near they were wrong, and are on any.
        """
        row, pair, chance = find(self.pairs.rows[cells])
        is_on = np.isin(self.on[pair], on)
        kept = is_on | (np.bincount(row, is_on, len(cells)) == 0)[row]
        row, pair, chance = row[kept], pair[kept], _shares(row[kept], chance[kept])
        return csr_array((chance, (row, self.other[pair])), shape=(len(cells), self.streets))

    def of(self, names: Ints, on: Ints) -> Floats:
        """[N] the same of any of some names, in all cells."""
        is_on, is_other = np.isin(self.on, on), np.isin(self.other, names)
        sums = [self.pairs.of(np.flatnonzero(some)) for some in (is_on & is_other, is_on, is_other)]
        everything = np.asarray(self.pairs.rows.sum(axis=1)).ravel()
        part, whole = np.where(sums[1] > 0, sums[0], sums[2]), np.where(sums[1] > 0, sums[1], everything)
        chance: Floats = part / np.maximum(whole, 1e-300)
        return chance


class Landmarks:
    """The names around the cells of a map, as they are asked for; the same all over a cell.

    Args:
        gazetteer: of the map.
        centers_m: [N, 2] of the cells.
        kinds: beginnings of the kinds of places that people know by their names.

    Attributes:
        streets: columns of `on_street`.
        names: columns of `said`.
        addresses: columns of `numbered`.
    """

    def __init__(self, gazetteer: Gazetteer, centers_m: Floats, kinds: tuple[str, ...]) -> None:
        self._gazetteer, self._centers_m = gazetteer, centers_m
        block = np.floor(centers_m / BLOCK_M).astype(np.int64)
        group = np.unique(block, axis=0, return_inverse=True)[1].ravel()
        self._order = np.argsort(group, kind="stable")
        self._around = Around.of(centers_m[self._order], group[self._order])
        words = gazetteer.words
        self._street_objects = gazetteer.by_kind.get(STREET, np.zeros(0, np.int64))
        known = [int(n) for n in gazetteer.named if words[n].kinds[0].startswith(kinds)]
        self._named_objects = np.array(known, np.int64)
        self.streets = Spelt([words[n].names for n in self._street_objects], are_streets=True)
        self.names = Spelt([words[n].names for n in known], are_streets=False)
        self.addresses = Addresses(words)

    @property
    def has_corners(self) -> bool:
        """Whether any streets meet."""
        return len(self._gazetteer.corner_streets) > 0

    @cached_property
    def on_street(self) -> Table:
        """Of each street, that who stands in a cell says to be on it."""
        metres = self._metres(self._street_objects, self.streets, ON_STREET_M)
        cell, nearest = _nearest(metres)
        metres.data = _shares(cell, np.exp((nearest[cell] - metres.data) / BETWEEN_M))
        return Table(metres)

    @cached_property
    def said(self) -> Table:
        """Of each place's name, that who stands in a cell says it when asked for one."""
        metres = self._metres(self._named_objects, self.names, SEEN_M + 3 * SEEN_SOFT_M)
        cell, nearest = _nearest(metres)
        share = _shares(cell, np.exp(-metres.data / NAMED_M) * _is_seen(metres.data))
        metres.data = share * _is_seen(nearest)[cell]
        return Table(metres)

    @cached_property
    def numbered(self) -> Table:
        """Of each house number, that who stands in a cell says that it is the nearest."""
        metres = self._metres(self.addresses.objects, self.addresses, SEEN_M + 3 * SEEN_SOFT_M)
        cell, nearest = _nearest(metres)
        share = _shares(cell, np.exp((nearest[cell] - metres.data) / BETWEEN_M))
        metres.data = share * _is_seen(nearest)[cell]
        return Table(metres)

    @cached_property
    def crossings(self) -> Crossings:
        """The corners near each cell of the streets that it is on."""
        to_column = np.full(len(self._gazetteer) + 1, -1)
        to_column[self._street_objects] = self.streets.column
        pair = to_column[self._gazetteer.corner_streets.reshape(-1, 2)]
        on, other = np.concatenate([pair, pair[:, ::-1]]).T
        at = np.tile(self._gazetteer.corners_m.astype(np.float64), (2, 1))
        there = self.on_street.rows.tocsc()
        found = [self._corners(there, street, on, at) for street in np.unique(on)]
        cell, corner, chance = (np.concatenate([some[n] for some in found]) if found else _EMPTY for n in range(3))
        streets = max(1, len(self.streets))
        pairs, column = np.unique(on * streets + other, return_inverse=True)
        shape = len(self._order), max(1, len(pairs))
        table = csr_array((chance, (cell.astype(np.int64), column[corner.astype(np.int64)])), shape=shape)
        return Crossings(Table(table), pairs // streets, pairs % streets, streets)

    def _corners(self, there: csc_array, street: int, on: Ints, at: Floats) -> tuple[Ints, Ints, Floats]:
        """(cell, corner, chance) of the nearest corners of a street, in the cells that are on it."""
        of = slice(there.indptr[street], there.indptr[street + 1])
        cells, chance = there.indices[of], there.data[of]
        corners = np.flatnonzero(on == street)
        few = min(CORNERS, len(corners))
        metres, row = cKDTree(at[corners]).query(self._centers_m[cells], k=range(1, few + 1))
        weight = np.exp((metres[:, :1] - metres) / NEAREST_M)
        weight *= (chance / weight.sum(axis=1))[:, None]
        return np.repeat(cells, few), corners[row].ravel(), weight.ravel()

    def _metres(self, objects: Ints, names: Spelt | Addresses, reach_m: float) -> csr_array:
        """[N, names] distance to the nearest of each name, as far as it is within reach."""
        shape = (len(self._order), max(1, len(names)))
        if not len(objects):
            return csr_array(shape)
        ways = ways_to(self._around, *cut(self._gazetteer, objects), reach_m)
        entry = self._order[ways.point] * shape[1] + names.column[ways.item]
        order = np.argsort(entry, kind="stable")
        first = np.flatnonzero(np.diff(entry[order], prepend=-1))
        metres = np.minimum.reduceat(ways.metres[order], first) if len(first) else np.zeros(0)
        cell, name = np.divmod(entry[order[first]], shape[1])
        return csr_array((metres, name, np.searchsorted(cell, np.arange(shape[0] + 1))), shape=shape)


_EMPTY: Final = np.zeros(0)


def _nearest(metres: csr_array) -> tuple[Ints, Floats]:
    """The row of each entry, and the least of each row; infinite in empty ones."""
    cell = np.repeat(np.arange(metres.shape[0]), np.diff(metres.indptr))
    nearest = np.full(metres.shape[0], np.inf)
    np.minimum.at(nearest, cell, metres.data)
    return cell, nearest


def _shares(cell: Ints, weight: Floats) -> Floats:
    """Weights of entries, made to add up to 1 in each cell."""
    share: Floats = weight / np.bincount(cell, weight)[cell] if len(cell) else weight
    return share


def _is_seen(metres: Floats) -> Floats:
    chance: Floats = 1 / (1 + np.exp(np.minimum((metres - SEEN_M) / SEEN_SOFT_M, 50.0)))
    return chance
