"""Answers to questions about names: the street, a visible place, the nearest cross street or house number."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
import numpy.typing as npt
from safetensors import SafetensorError
from safetensors.numpy import save_file
from scipy.sparse import csr_array, find

from models.citymap.gazetteer.gazetteer import Gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats
from models.compiled import FLOAT16_VALUES, compiled
from models.errors import IndexBroken
from models.files import map_arrays
from models.posterior.places.addresses import Addresses
from models.posterior.places.name_index import NameIndex
from models.posterior.places.name_probabilities import NameProbabilities, shares
from models.spool import Spool, starts_of
from models.strings import Column, merge_columns

FILE: Final = "landmarks.safetensors"
MIN_PROBABILITY: Final = 0.01  # smaller entries are not stored
CELLS_PER_LANDMARK_BLOCK: Final = 16_384  # bounds the memory of a build


@dataclass(frozen=True, slots=True, eq=False)
class NameProbabilityTable:
    """The probabilities [N, K] of names in cells; rows add up to about 1, or less where people may have no name."""

    names: int  # K
    starts: Ints  # [N + 1] int32, cell n has the entries starts[n] to starts[n + 1]
    name: Ints  # [Z] uint16 or int32
    chance: npt.NDArray[np.float16]  # [Z]

    @classmethod
    def from_entries(cls, names: int, entries: Mapping[str, Column]) -> "NameProbabilityTable":
        """Build a table of a number of names from the entries of its cells in order."""
        return cls(names, starts_of(entries["sizes"]), entries["name"], entries["chance"])

    def rows(self, cells: Ints) -> csr_array:
        """Return the rows [C, K] of cells."""
        begin, end = self.starts[cells].astype(np.int64), self.starts[cells + 1].astype(np.int64)
        entries = ranges(begin, end)
        content = self.chance[entries].astype(np.float64), self.name[entries].astype(np.int64)
        return csr_array((*content, np.concatenate([[0], np.cumsum(end - begin)])), shape=(len(cells), self.names))

    def probability(self, names: Ints) -> Floats:
        """Return the probability [N] of any of the names."""
        is_chosen = np.zeros(self.names, np.bool_)
        is_chosen[names] = True
        return _sums(self.starts, self.name, self.chance.view(np.uint16), FLOAT16_VALUES, is_chosen)

    def columns(self, name: str) -> dict[str, Column]:
        """Return the arrays that `from_columns` reads."""
        arrays = {kind: getattr(self, kind) for kind in _ENTRIES} | {"names": np.array([self.names])}
        return {f"{name}.{kind}": array for kind, array in arrays.items()}

    @classmethod
    def from_columns(cls, columns: Mapping[str, Column], name: str) -> "NameProbabilityTable":
        """Restore a table from the arrays of `columns`."""
        starts, names, chance = (columns[f"{name}.{kind}"] for kind in _ENTRIES)
        return cls(int(columns[f"{name}.names"][0]), starts, names, chance)


_ENTRIES: Final = ("starts", "name", "chance")


def _entries_of(rows: csr_array) -> dict[str, Column]:
    """Return the number of entries of each row of a table [N, K], and the entries to store."""
    cell = np.repeat(np.arange(rows.shape[0]), np.diff(rows.indptr))
    stored = rows.data >= MIN_PROBABILITY
    return {
        "sizes": np.bincount(cell[stored], minlength=rows.shape[0]),
        "name": rows.indices[stored].astype(np.uint16 if rows.shape[1] <= 1 << 16 else np.int32),
        "chance": rows.data[stored].astype(np.float16),
    }


@compiled
def _sums(starts: Ints, name: Ints, chance: Ints, halves: Floats, is_chosen: npt.NDArray[np.bool_]) -> Floats:
    """Return the sum [N] of the probabilities, given as bits, of the chosen names in each cell."""
    total = np.zeros(len(starts) - 1)
    for cell in range(len(total)):
        for entry in range(starts[cell], starts[cell + 1]):
            if is_chosen[name[entry]]:
                total[cell] += halves[chance[entry]]
    return total


@dataclass(frozen=True, slots=True, eq=False)
class Crossings:
    """Probabilities of D pairs of a street that a cell is on and the nearest cross street."""

    pairs: NameProbabilityTable
    on: Ints  # [D] column of the street
    other: Ints  # [D] column of the cross street
    streets: int  # number of streets

    def rows(self, cells: Ints, on: Ints) -> csr_array:
        """Return the probability [C, S] of each cross street in cells [C].

        Args:
            cells: rows of the gallery.
            on: streets that people may be on, by their reply. Cells near none of them, or all cells without any, allow
                every street.
        """
        row, pair, chance = find(self.pairs.rows(cells))
        is_on = np.isin(self.on[pair], on)
        allowed = is_on | (np.bincount(row, is_on, len(cells)) == 0)[row]
        row, pair, chance = row[allowed], pair[allowed], shares(row[allowed], chance[allowed])
        return csr_array((chance, (row, self.other[pair])), shape=(len(cells), self.streets))

    def probability(self, names: Ints, on: Ints) -> Floats:
        """Return the probability [N] of any of the names as cross street; `on` as in `rows`."""
        is_on, is_other = np.isin(self.on, on), np.isin(self.other, names)
        both, any_on, any_other = (
            self.pairs.probability(np.flatnonzero(pairs)) for pairs in (is_on & is_other, is_on, is_other)
        )
        everything = self.pairs.probability(np.arange(self.pairs.names))
        part, whole = np.where(any_on > 0, both, any_other), np.where(any_on > 0, any_on, everything)
        return part / np.maximum(whole, 1e-300)


@dataclass(frozen=True, slots=True, eq=False)
class Landmarks:
    """The names that people in each cell of a map may reply; each table has the columns of an index."""

    streets: NameIndex
    names: NameIndex
    addresses: Addresses
    street_table: NameProbabilityTable  # of the street that somebody is on
    name_table: NameProbabilityTable  # of a place that somebody names when asked for one
    address_table: NameProbabilityTable  # of the nearest house number
    crossings: Crossings

    @classmethod
    def build(cls, gazetteer: Gazetteer, centers_m: Floats, kinds: tuple[str, ...]) -> "Landmarks":
        """Build the landmarks of a map with cells at centres [N, 2].

        `kinds` are prefixes of the kinds of places that people know by name.
        """
        words = gazetteer.objects
        roads = gazetteer.by_kind.get(STREET_KIND, np.zeros(0, np.int64))
        known = np.array([n for n in gazetteer.named.tolist() if words[n].kinds[0].startswith(kinds)], np.int64)
        streets = NameIndex.build([words[n].names for n in roads.tolist()], are_streets=True)
        names = NameIndex.build([words[n].names for n in known.tolist()], are_streets=False)
        addresses = Addresses.build(words)
        spools = [Spool() for _ in range(4)]
        for first in range(0, len(centers_m) or 1, CELLS_PER_LANDMARK_BLOCK):
            probabilities = NameProbabilities(gazetteer, centers_m[first : first + CELLS_PER_LANDMARK_BLOCK])
            on_street = probabilities.on_street(roads, streets)
            pairs, on, other = probabilities.crossings(roads, streets, on_street)
            blocks = on_street, probabilities.on_sign(known, names), probabilities.at_address(addresses), pairs
            for spool, rows in zip(spools, blocks, strict=True):
                spool.add(_entries_of(rows))
        street_table, name_table, address_table, pair_table = (
            NameProbabilityTable.from_entries(rows.shape[1], spool.columns())
            for rows, spool in zip(blocks, spools, strict=True)
        )
        crossings = Crossings(pair_table, on, other, max(1, len(streets)))
        return cls(streets, names, addresses, street_table, name_table, address_table, crossings)

    @property
    def has_corners(self) -> bool:
        """Whether the map has corners."""
        return len(self.crossings.on) > 0

    def save(self, directory: Path) -> None:
        """Write the landmarks to one file."""
        tables = self.street_table, self.name_table, self.address_table, self.crossings.pairs
        columns = [table.columns(name) for table, name in zip(tables, _TABLES, strict=True)]
        crossings = {"crossings.on": self.crossings.on, "crossings.other": self.crossings.other}
        names = [self.streets.columns("streets"), self.names.columns("names"), self.addresses.columns("addresses")]
        save_file(merge_columns([*columns[:3], *names, columns[3], crossings]), directory / FILE)

    @classmethod
    def load(cls, directory: Path) -> "Landmarks":
        """Load saved landmarks.

        Raises:
            IndexBroken: the file is missing or damaged.
        """
        try:
            columns = map_arrays(directory / FILE)[0]
            streets = NameIndex.from_columns(columns, "streets", are_streets=True)
            names = NameIndex.from_columns(columns, "names", are_streets=False)
            addresses = Addresses.from_columns(columns, "addresses")
            tables = [NameProbabilityTable.from_columns(columns, name) for name in _TABLES]
            on, other = columns["crossings.on"], columns["crossings.other"]
            crossings = Crossings(tables[3], on, other, max(1, len(streets)))
            return cls(streets, names, addresses, tables[0], tables[1], tables[2], crossings)
        except (OSError, SafetensorError, ValueError, KeyError, TypeError, RuntimeError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; rebuild it with 'hereabouts index'") from error


_TABLES: Final = ("on_street", "said", "numbered", "crossings")  # their names on disk
