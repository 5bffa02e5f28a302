"""What people say when asked: their street, a place that they see, the nearest cross street or house number."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Final

import numpy as np
from safetensors import SafetensorError
from safetensors.numpy import save_file
from scipy.sparse import csc_array, csr_array, find

from models.city.gazetteer.gazetteer import Gazetteer
from models.city.gazetteer.words import STREET
from models.city.points import Ints
from models.city.types import Floats
from models.errors import IndexBroken
from models.files import mapped
from models.posterior.places.addresses import Addresses
from models.posterior.places.chances import Chances, shares
from models.posterior.places.spelt import Spelt
from models.strings import Column, joined

FILE: Final = "landmarks.safetensors"


class Table:
    """Chance [N, K] of names in cells; rows add up to 1, or to less where there may be none to say.

    Args:
        rows: [N, K].
    """

    def __init__(self, rows: csr_array) -> None:
        self.rows = csr_array((rows.data.astype(np.float32, copy=False), rows.indices, rows.indptr), rows.shape)

    @cached_property
    def _columns(self) -> csc_array:
        return self.rows.tocsc()  # a reply is about few names in all cells, a question about all names in few

    def of(self, names: Ints) -> Floats:
        """[N] chance of any of some names."""
        chance: Floats = np.asarray(self._columns[:, names].sum(axis=1, dtype=np.float64)).ravel()
        return chance

    def columns(self, name: str) -> dict[str, Column]:
        """Arrays from which `of_columns` makes it."""
        rows = self.rows
        shape = np.array(rows.shape, np.int64)
        return {
            f"{name}.chance": rows.data, f"{name}.column": rows.indices.astype(np.int32),
            f"{name}.starts": rows.indptr.astype(np.int32), f"{name}.shape": shape,
        }  # fmt: skip

    @classmethod
    def of_columns(cls, columns: Mapping[str, Column], name: str) -> "Table":
        """What `columns` gave of a name."""
        content = tuple(columns[f"{name}.{kind}"] for kind in ("chance", "column", "starts"))
        return cls(csr_array(content, tuple(columns[f"{name}.shape"].tolist())))


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
        row, pair, chance = row[kept], pair[kept], shares(row[kept], chance[kept])
        return csr_array((chance, (row, self.other[pair])), shape=(len(cells), self.streets))

    def of(self, names: Ints, on: Ints) -> Floats:
        """[N] the same of any of some names, in all cells."""
        is_on, is_other = np.isin(self.on, on), np.isin(self.other, names)
        sums = [self.pairs.of(np.flatnonzero(some)) for some in (is_on & is_other, is_on, is_other)]
        everything = np.asarray(self.pairs.rows.sum(axis=1, dtype=np.float64)).ravel()
        part, whole = np.where(sums[1] > 0, sums[0], sums[2]), np.where(sums[1] > 0, sums[1], everything)
        chance: Floats = part / np.maximum(whole, 1e-300)
        return chance


@dataclass(frozen=True, slots=True, eq=False)
class Landmarks:
    """The names around the cells of a map, as they are asked for; the same all over a cell.

    Attributes:
        streets: columns of `on_street`.
        names: columns of `said`.
        addresses: columns of `numbered`.
        on_street: of each street, that who stands in a cell says to be on it.
        said: of each place's name, that who stands in a cell says it when asked for one.
        numbered: of each house number, that who stands in a cell says that it is the nearest.
        crossings: the corners near each cell of the streets that it is on.
    """

    streets: Spelt
    names: Spelt
    addresses: Addresses
    on_street: Table
    said: Table
    numbered: Table
    crossings: Crossings

    @classmethod
    def of(cls, gazetteer: Gazetteer, centers_m: Floats, kinds: tuple[str, ...]) -> "Landmarks":
        """Those of a map.

        Args:
            gazetteer: of the map.
            centers_m: [N, 2] of the cells.
            kinds: beginnings of the kinds of places that people know by their names.
        """
        words, chances = gazetteer.words, Chances(gazetteer, centers_m)
        roads = gazetteer.by_kind.get(STREET, np.zeros(0, np.int64))
        known = np.array([n for n in gazetteer.named.tolist() if words[n].kinds[0].startswith(kinds)], np.int64)
        streets = Spelt.of([words[n].names for n in roads.tolist()], are_streets=True)
        names = Spelt.of([words[n].names for n in known.tolist()], are_streets=False)
        addresses = Addresses.of(words)
        on_street = chances.on_street(roads, streets)
        pairs, on, other = chances.crossings(roads, streets, on_street)
        return cls(
            streets,
            names,
            addresses,
            Table(on_street),
            Table(chances.said(known, names)),
            Table(chances.numbered(addresses)),
            Crossings(Table(pairs), on, other, max(1, len(streets))),
        )

    @property
    def has_corners(self) -> bool:
        """Whether any streets meet."""
        return len(self.crossings.on) > 0

    def save(self, directory: Path) -> None:
        """Write one file."""
        tables = [getattr(self, name).columns(name) for name in _TABLES]
        crossings = {"crossings.on": self.crossings.on, "crossings.other": self.crossings.other}
        names = [self.streets.columns("streets"), self.names.columns("names"), self.addresses.columns("addresses")]
        save_file(joined([*tables, *names, self.crossings.pairs.columns("crossings"), crossings]), directory / FILE)

    @classmethod
    def load(cls, directory: Path) -> "Landmarks":
        """Read what `save` wrote.

        Raises:
            IndexBroken: the file does not hold it.
        """
        try:
            columns = mapped(directory / FILE)[0]
            streets, names = (
                Spelt.of_columns(columns, name, are_streets=name == "streets") for name in ("streets", "names")
            )
            on_street, said, numbered, pairs = (Table.of_columns(columns, name) for name in (*_TABLES, "crossings"))
            on, other = columns["crossings.on"], columns["crossings.other"]
            crossings = Crossings(pairs, on, other, max(1, len(streets)))
            addresses = Addresses.of_columns(columns, "addresses")
            return cls(streets, names, addresses, on_street, said, numbered, crossings)
        except (OSError, SafetensorError, ValueError, KeyError, TypeError, RuntimeError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; rebuild it with 'hereabouts index'") from error


_TABLES: Final = ("on_street", "said", "numbered")
