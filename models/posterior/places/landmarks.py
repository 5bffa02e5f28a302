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
from models.compiled import HALVES, compiled
from models.errors import IndexBroken
from models.files import map_arrays
from models.posterior.places.addresses import Addresses
from models.posterior.places.name_index import NameIndex
from models.posterior.places.name_probabilities import NameProbabilities, shares
from models.spool import Spool, starts_of
from models.strings import Column, merge_columns

FILE: Final = "landmarks.safetensors"
FAINT: Final = 0.01  # what is said more seldom is not kept
AT_ONCE: Final = 16_384  # cells: what is known of them before that takes ten times the room


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Chance [N, K] of names in cells; rows add up to 1 about, or to less where there may be none to say.

    Attributes:
        names: K.
        starts: [N + 1] int32, cell n has the entries starts[n] to starts[n + 1].
        name: [Z] uint16, int32 if there are too many for that.
        chance: [Z] float16.
    """

    names: int
    starts: Ints
    name: Ints
    chance: npt.NDArray[np.float16]

    @classmethod
    def of_entries(cls, names: int, entries: Mapping[str, Column]) -> "Table":
        """Build a table of a number of names from the entries of its cells in order."""
        return cls(names, starts_of(entries["sizes"]), entries["name"], entries["chance"])

    def rows(self, cells: Ints) -> csr_array:
        """Return the rows [C, K] of cells."""
        begin, end = self.starts[cells].astype(np.int64), self.starts[cells + 1].astype(np.int64)
        entries = ranges(begin, end)
        content = self.chance[entries].astype(np.float64), self.name[entries].astype(np.int64)
        return csr_array((*content, np.concatenate([[0], np.cumsum(end - begin)])), shape=(len(cells), self.names))

    def of(self, names: Ints) -> Floats:
        """Return the probability [N] of any of the names."""
        is_one = np.zeros(self.names, np.bool_)
        is_one[names] = True
        chance: Floats = _sums(self.starts, self.name, self.chance.view(np.uint16), HALVES, is_one)
        return chance

    def columns(self, name: str) -> dict[str, Column]:
        """Arrays from which `from_columns` makes it."""
        arrays = {kind: getattr(self, kind) for kind in _ENTRIES} | {"names": np.array([self.names])}
        return {f"{name}.{kind}": array for kind, array in arrays.items()}

    @classmethod
    def from_columns(cls, columns: Mapping[str, Column], name: str) -> "Table":
        """What `columns` gave of a name."""
        starts, names, chance = (columns[f"{name}.{kind}"] for kind in _ENTRIES)
        return cls(int(columns[f"{name}.names"][0]), starts, names, chance)


_ENTRIES: Final = ("starts", "name", "chance")


def _entries_of(rows: csr_array) -> dict[str, Column]:
    """Return the number of entries of each row of a table [N, K] and the entries, without those below FAINT."""
    cell = np.repeat(np.arange(rows.shape[0]), np.diff(rows.indptr))
    kept = rows.data >= FAINT
    return {
        "sizes": np.bincount(cell[kept], minlength=rows.shape[0]),
        "name": rows.indices[kept].astype(np.uint16 if rows.shape[1] <= 1 << 16 else np.int32),
        "chance": rows.data[kept].astype(np.float16),
    }


@compiled
def _sums(starts: Ints, name: Ints, chance: Ints, halves: Floats, is_one: npt.NDArray[np.bool_]) -> Floats:
    """Sum the probabilities, given as bits, of the names that are meant, for each cell [N]."""
    found = np.zeros(len(starts) - 1)
    for cell in range(len(found)):
        for entry in range(starts[cell], starts[cell + 1]):
            if is_one[name[entry]]:
                found[cell] += halves[chance[entry]]
    return found


@dataclass(frozen=True, slots=True, eq=False)
class Crossings:
    """Probabilities of pairs of a street and its nearest cross street.

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
        row, pair, chance = find(self.pairs.rows(cells))
        is_on = np.isin(self.on[pair], on)
        kept = is_on | (np.bincount(row, is_on, len(cells)) == 0)[row]
        row, pair, chance = row[kept], pair[kept], shares(row[kept], chance[kept])
        return csr_array((chance, (row, self.other[pair])), shape=(len(cells), self.streets))

    def of(self, names: Ints, on: Ints) -> Floats:
        """Return the probability [N] of any of the names in all cells."""
        is_on, is_other = np.isin(self.on, on), np.isin(self.other, names)
        sums = [self.pairs.of(np.flatnonzero(some)) for some in (is_on & is_other, is_on, is_other)]
        everything = self.pairs.of(np.arange(self.pairs.names))
        part, whole = np.where(sums[1] > 0, sums[0], sums[2]), np.where(sums[1] > 0, sums[1], everything)
        chance: Floats = part / np.maximum(whole, 1e-300)
        return chance


@dataclass(frozen=True, slots=True, eq=False)
class Landmarks:
    """The names that people in each cell of a map may answer.

    Attributes:
        streets: columns of `on_street`.
        names: columns of `said`.
        addresses: columns of `numbered`.
        on_street: of each street, that who stands in a cell says to be on it.
        said: of each place's name, that who stands in a cell says it when asked for one.
        numbered: of each house number, that who stands in a cell says that it is the nearest.
        crossings: the corners near each cell of the streets that it is on.
    """

    streets: NameIndex
    names: NameIndex
    addresses: Addresses
    on_street: Table
    said: Table
    numbered: Table
    crossings: Crossings

    @classmethod
    def build(cls, gazetteer: Gazetteer, centers_m: Floats, kinds: tuple[str, ...]) -> "Landmarks":
        """Build the landmarks of a map.

        Args:
            gazetteer: of the map.
            centers_m: [N, 2] of the cells.
            kinds: beginnings of the kinds of places that people know by their names.
        """
        words = gazetteer.objects
        roads = gazetteer.by_kind.get(STREET_KIND, np.zeros(0, np.int64))
        known = np.array([n for n in gazetteer.named.tolist() if words[n].kinds[0].startswith(kinds)], np.int64)
        streets = NameIndex.build([words[n].names for n in roads.tolist()], are_streets=True)
        names = NameIndex.build([words[n].names for n in known.tolist()], are_streets=False)
        addresses = Addresses.build(words)
        spools = [Spool() for _ in range(4)]
        for first in range(0, len(centers_m) or 1, AT_ONCE):
            chances = NameProbabilities(gazetteer, centers_m[first : first + AT_ONCE])
            on_street = chances.on_street(roads, streets)
            pairs, on, other = chances.crossings(roads, streets, on_street)
            found = on_street, chances.said(known, names), chances.numbered(addresses), pairs
            for spool, rows in zip(spools, found, strict=True):
                spool.add(_entries_of(rows))
        tables = [Table.of_entries(rows.shape[1], spool.columns()) for spool, rows in zip(spools, found, strict=True)]
        on_street_table, said, numbered, crossing = tables
        crossings = Crossings(crossing, on, other, max(1, len(streets)))
        return cls(streets, names, addresses, on_street_table, said, numbered, crossings)

    @property
    def has_corners(self) -> bool:
        """Whether the map has corners."""
        return len(self.crossings.on) > 0

    def save(self, directory: Path) -> None:
        """Write the landmarks to one file."""
        tables = [getattr(self, name).columns(name) for name in _TABLES]
        crossings = {"crossings.on": self.crossings.on, "crossings.other": self.crossings.other}
        names = [self.streets.columns("streets"), self.names.columns("names"), self.addresses.columns("addresses")]
        save_file(
            merge_columns([*tables, *names, self.crossings.pairs.columns("crossings"), crossings]), directory / FILE
        )

    @classmethod
    def load(cls, directory: Path) -> "Landmarks":
        """Load saved landmarks.

        Raises:
            IndexBroken: the file does not hold it.
        """
        try:
            columns = map_arrays(directory / FILE)[0]
            streets, names = (
                NameIndex.from_columns(columns, name, are_streets=name == "streets") for name in ("streets", "names")
            )
            on_street, said, numbered, pairs = (Table.from_columns(columns, name) for name in (*_TABLES, "crossings"))
            on, other = columns["crossings.on"], columns["crossings.other"]
            crossings = Crossings(pairs, on, other, max(1, len(streets)))
            addresses = Addresses.from_columns(columns, "addresses")
            return cls(streets, names, addresses, on_street, said, numbered, crossings)
        except (OSError, SafetensorError, ValueError, KeyError, TypeError, RuntimeError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; rebuild it with 'hereabouts index'") from error


_TABLES: Final = ("on_street", "said", "numbered")
