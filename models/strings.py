"""Strings and what they stand for, in arrays: a city has a million, which open at once and take no object each."""

from array import array
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from operator import eq
from typing import Any, Final, overload

import numpy as np
import numpy.typing as npt
from marisa_trie import Trie

Column = npt.NDArray[Any]
_NONE: Final = np.zeros(0, np.int64)
AT_ONCE: Final = 2**17  # strings that are looked at together


class Strings(Sequence[str]):
    """Strings in one array; each is made when it is asked for.

    Args:
        text: [B] uint8, UTF-8 of all of them.
        ends: [S] where each ends.
    """

    def __init__(self, text: Column, ends: Column) -> None:
        self._text, self._ends = text, ends

    @classmethod
    def of(cls, strings: Iterable[str]) -> "Strings":
        """Those of some."""
        strings = tuple(strings)
        sizes = np.fromiter((len(string.encode()) for string in strings), np.int64, len(strings))
        return cls(np.frombuffer("".join(strings).encode(), np.uint8), compact(np.cumsum(sizes)))

    def __len__(self) -> int:
        return len(self._ends)

    @overload
    def __getitem__(self, n: int) -> str: ...

    @overload
    def __getitem__(self, n: slice) -> list[str]: ...

    def __getitem__(self, n: int | slice) -> str | list[str]:
        """One string, or those of a slice."""
        if isinstance(n, slice):
            return [self[row] for row in range(*n.indices(len(self)))]
        row = range(len(self))[n]
        first = int(self._ends[row - 1]) if row else 0
        return self._text[first : int(self._ends[row])].tobytes().decode()

    def columns(self, name: str) -> dict[str, Column]:
        """Arrays from which `of_columns` makes it."""
        return {f"{name}.text": self._text, f"{name}.ends": self._ends}

    @classmethod
    def of_columns(cls, columns: Mapping[str, Column], name: str) -> "Strings":
        """What `columns` gave of a name."""
        return cls(columns[f"{name}.text"], columns[f"{name}.ends"])


class Categorical(Sequence[Any]):
    """Strings of which many are alike, and what is none.

    Args:
        categories: each of them once, ascending.
        codes: [I] which of these each is, -1 for None.
    """

    def __init__(self, categories: Sequence[str], codes: Column) -> None:
        self.categories, self.codes = categories, codes

    @classmethod
    def of(cls, strings: Sequence[str | None]) -> "Categorical":
        """That of some strings."""
        if isinstance(strings, Categorical):
            return strings
        categories = tuple(sorted({string for string in strings if string is not None}))
        number: dict[str | None, int] = {string: n for n, string in enumerate(categories)}
        number[None] = -1
        kind = np.min_scalar_type(-len(categories) - 1)
        return cls(categories, np.fromiter(map(number.__getitem__, strings), kind, len(strings)))

    @classmethod
    def of_ascii(cls, strings: Column) -> "Categorical":
        """That of an array of bytes [I], of which most are different."""
        order, codes = np.argsort(strings, kind="stable"), np.empty(len(strings), np.int32)
        text, sizes, count, last = list[bytes](), [np.zeros(0, np.int64)], 0, strings[:0]
        for first in range(0, len(order), AT_ONCE):
            rows = order[first : first + AT_ONCE]
            some = strings[rows]
            is_new = np.concatenate([some[:1] != last if first else [True], some[1:] != some[:-1]])
            codes[rows] = count - 1 + np.cumsum(is_new)
            text.append(b"".join(some[is_new].tolist()))
            sizes.append(np.char.str_len(some[is_new]))
            count, last = count + int(is_new.sum()), some[-1:]
        categories = Strings(np.frombuffer(b"".join(text), np.uint8), compact(np.cumsum(np.concatenate(sizes))))
        return cls(categories, codes.astype(np.min_scalar_type(-count - 1)))

    def __len__(self) -> int:
        return len(self.codes)

    def __getitem__(self, n: Any) -> Any:
        """One string or None, or those of a slice."""
        if isinstance(n, slice):
            return tuple(self[row] for row in range(*n.indices(len(self))))
        code = int(self.codes[n])
        return None if code < 0 else self.categories[code]

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Column:
        values = [*self.categories] if len(self) and self.codes.min() >= 0 else [*self.categories, None]
        return np.array(values, dtype)[self.codes]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and len(self) == len(other) and all(map(eq, self, other))

    __hash__ = None  # type: ignore[assignment]  # as of a list: equal to others

    def columns(self, name: str) -> dict[str, Column]:
        """Arrays from which `of_columns` makes it."""
        strings = self.categories if isinstance(self.categories, Strings) else Strings.of(self.categories)
        return {f"{name}.codes": self.codes} | strings.columns(name)

    @classmethod
    def of_columns(cls, columns: Mapping[str, Column], name: str) -> "Categorical":
        """What `columns` gave of a name."""
        return cls(Strings.of_columns(columns, name), columns[f"{name}.codes"])


@dataclass(frozen=True, eq=False)
class Postings:
    """The numbers of each of some keys.

    Attributes:
        keys: K of them, each with a row.
        starts: [K + 1] row k has the numbers starts[k] to starts[k + 1].
        numbers: [Z] int32.
    """

    keys: Trie
    starts: Column
    numbers: Column

    @classmethod
    def of(cls, pairs: Iterable[tuple[str, int]]) -> "Postings":
        """Those of pairs (key, number); see Pairs."""
        some = Pairs()
        for key, number in pairs:
            some.add(key, number)
        return some.postings()

    def __len__(self) -> int:
        return len(self.keys)

    def __contains__(self, key: object) -> bool:
        return key in self.keys

    def find(self, key: str) -> Column:
        """[k] the numbers of a key; none of one that is not there."""
        row = self.keys.get(key)
        return _NONE if row is None else self.of_row(row)

    def key(self, row: int) -> str:
        """The key of a row."""
        found: str = self.keys.restore_key(row)
        return found

    def of_row(self, row: int) -> Column:
        """[k] the numbers of a row."""
        return self.numbers[self.starts[row] : self.starts[row + 1]]

    def count(self, key: str) -> int:
        """How many numbers a key has."""
        return len(self.find(key))

    @cached_property
    def all_keys(self) -> list[str]:
        """[K] the keys, in order of their rows."""
        return [self.key(row) for row in range(len(self.keys))]

    def below(self, prefix: str) -> Iterator[tuple[str, Column]]:
        """The rest of each key that begins with some letters, and its numbers."""
        for key, row in self.keys.iteritems(prefix):
            yield key[len(prefix) :], self.of_row(row)

    def columns(self, name: str) -> dict[str, Column]:
        """Arrays from which `of_columns` makes it."""
        keys = np.frombuffer(self.keys.tobytes(), np.uint8)
        return {f"{name}.keys": keys, f"{name}.starts": self.starts, f"{name}.numbers": self.numbers}

    @classmethod
    def of_columns(cls, columns: Mapping[str, Column], name: str) -> "Postings":
        """What `columns` gave of a name."""
        keys = Trie().frombytes(columns[f"{name}.keys"].tobytes())  # few bytes, even of a city
        return cls(keys, columns[f"{name}.starts"], columns[f"{name}.numbers"])


class Pairs:
    """Keys and numbers, as these come: a city has millions, of which each key is held once."""

    def __init__(self) -> None:
        self._row, self._rows, self._numbers = dict[str, int](), array("q"), array("q")

    def add(self, key: str, number: int) -> None:
        """Add a number below 2 ** 31 to those of a key."""
        self._rows.append(self._row.setdefault(key, len(self._row)))
        self._numbers.append(number)

    def postings(self) -> Postings:
        """The numbers of each key in the order in which they came, each once."""
        row, numbers = np.array(self._rows, np.int64), np.array(self._numbers, np.int64)
        once = np.sort(np.unique(row << 32 | numbers, return_index=True)[1])
        row, numbers = row[once], numbers[once].astype(np.int32)
        keys = Trie(list(self._row), weights=np.bincount(row, minlength=len(self._row)).tolist())
        row = np.array([keys[key] for key in self._row], np.int64)[row]
        order = np.argsort(row, kind="stable")
        starts = np.concatenate([[0], np.cumsum(np.bincount(row, minlength=len(keys)))])
        return Postings(keys, compact(starts), numbers[order])


def joined(columns: Iterable[Mapping[str, Column]]) -> dict[str, Column]:
    """Columns of several names together, as files of arrays take them."""
    return {name: np.ascontiguousarray(column) for name, column in chain.from_iterable(map(Mapping.items, columns))}


def compact(numbers: Column) -> Column:
    """Ascending numbers in half the bytes, if they are small enough."""
    return numbers.astype(np.int32) if not len(numbers) or numbers[-1] <= np.iinfo(np.int32).max else numbers
