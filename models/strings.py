"""Strings and inverted indexes in NumPy arrays.

A city has a million names; as arrays they are memory-mapped at once and need no Python object each.
"""

import re
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
_NO_NUMBERS: Final = np.zeros(0, np.int64)
STRINGS_PER_BLOCK: Final = 2**17  # deduplicated together; bounds the temporary copies while a city is indexed


class StringArray(Sequence[str]):
    """A sequence of strings in one array of UTF-8 text [B] uint8, with the end [S] of each; decoded on access."""

    def __init__(self, text: Column, ends: Column) -> None:
        self._text, self._ends = text, ends

    @classmethod
    def from_strings(cls, strings: Iterable[str]) -> "StringArray":
        """Return an array of the given strings."""
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
        """Return one string, or a list for a slice."""
        if isinstance(n, slice):
            return [self[row] for row in range(*n.indices(len(self)))]
        row = range(len(self))[n]
        first = int(self._ends[row - 1]) if row else 0
        return self._text[first : int(self._ends[row])].tobytes().decode()

    def find(self, string: str) -> Iterator[int]:
        """Yield the number of each string that equals a string, which is not empty; this scans the text."""
        for match in re.finditer(re.escape(string.encode()), self._text.data):
            n = int(np.searchsorted(self._ends, match.end()))
            if self[n] == string:
                yield n

    def columns(self, name: str) -> dict[str, Column]:
        """Return the arrays that `from_columns` reads, with `name` as a prefix."""
        return {f"{name}.text": self._text, f"{name}.ends": self._ends}

    @classmethod
    def from_columns(cls, columns: Mapping[str, Column], name: str) -> "StringArray":
        """Return the instance whose `columns` were stored under `name`."""
        return cls(columns[f"{name}.text"], columns[f"{name}.ends"])


class Categorical(Sequence[Any]):
    """A sequence of strings or None with many repetitions: ascending categories, and codes [I], -1 for None."""

    def __init__(self, categories: Sequence[str], codes: Column) -> None:
        self.categories, self.codes = categories, codes

    @classmethod
    def from_strings(cls, strings: Sequence[str | None]) -> "Categorical":
        """Return the given strings as a Categorical."""
        if isinstance(strings, Categorical):
            return strings
        categories = tuple(sorted({string for string in strings if string is not None}))
        code: dict[str | None, int] = {string: n for n, string in enumerate(categories)}
        code[None] = -1
        dtype = np.min_scalar_type(-len(categories) - 1)
        return cls(categories, np.fromiter(map(code.__getitem__, strings), dtype, len(strings)))

    @classmethod
    def from_bytes(cls, strings: Column) -> "Categorical":
        """Return an array [I] of ASCII byte strings, most of them distinct, as a Categorical."""
        order, codes = np.argsort(strings, kind="stable"), np.empty(len(strings), np.int32)
        text, sizes, count, last = list[bytes](), [np.zeros(0, np.int64)], 0, strings[:0]
        for first in range(0, len(order), STRINGS_PER_BLOCK):
            rows = order[first : first + STRINGS_PER_BLOCK]
            block = strings[rows]
            is_new = np.concatenate([block[:1] != last if first else [True], block[1:] != block[:-1]])
            codes[rows] = count - 1 + np.cumsum(is_new)
            text.append(b"".join(block[is_new].tolist()))
            sizes.append(np.char.str_len(block[is_new]))
            count, last = count + int(is_new.sum()), block[-1:]
        categories = StringArray(np.frombuffer(b"".join(text), np.uint8), compact(np.cumsum(np.concatenate(sizes))))
        return cls(categories, codes.astype(np.min_scalar_type(-count - 1)))

    def __len__(self) -> int:
        return len(self.codes)

    def __getitem__(self, n: Any) -> Any:
        """Return one string or None, or a tuple for a slice."""
        if isinstance(n, slice):
            return tuple(self[row] for row in range(*n.indices(len(self))))
        code = int(self.codes[n])
        return None if code < 0 else self.categories[code]

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Column:
        values = [*self.categories] if len(self) and self.codes.min() >= 0 else [*self.categories, None]
        return np.array(values, dtype)[self.codes]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and len(self) == len(other) and all(map(eq, self, other))

    __hash__ = None  # type: ignore[assignment]  # equal to any sequence of the same values, like a list

    def columns(self, name: str) -> dict[str, Column]:
        """Return the arrays that `from_columns` reads, with `name` as a prefix."""
        strings = self.categories
        if not isinstance(strings, StringArray):
            strings = StringArray.from_strings(strings)
        return {f"{name}.codes": self.codes} | strings.columns(name)

    @classmethod
    def from_columns(cls, columns: Mapping[str, Column], name: str) -> "Categorical":
        """Return the instance whose `columns` were stored under `name`."""
        return cls(StringArray.from_columns(columns, name), columns[f"{name}.codes"])


@dataclass(frozen=True, eq=False)
class Postings:
    """An inverted index: for each key, a list of numbers."""

    keys: Trie  # a trie of K keys, each with a row
    starts: Column  # [K + 1] row k has numbers[starts[k]:starts[k + 1]]
    numbers: Column  # [Z] int32, the numbers of all rows

    @classmethod
    def from_pairs(cls, pairs: Iterable[tuple[str, int]]) -> "Postings":
        """Return the postings of pairs (key, number)."""
        builder = PostingsBuilder()
        for key, number in pairs:
            builder.add(key, number)
        return builder.build()

    def __len__(self) -> int:
        return len(self.keys)

    def __contains__(self, key: object) -> bool:
        return key in self.keys

    def find(self, key: str) -> Column:
        """Return the numbers [k] of a key; an unknown key has none."""
        row = self.keys.get(key)
        return _NO_NUMBERS if row is None else self.row_numbers(row)

    def key(self, row: int) -> str:
        """Return the key of a row."""
        key: str = self.keys.restore_key(row)
        return key

    def row_numbers(self, row: int) -> Column:
        """Return the numbers [k] of a row."""
        return self.numbers[self.starts[row] : self.starts[row + 1]]

    def count(self, key: str) -> int:
        """Return how many numbers a key has."""
        return len(self.find(key))

    @cached_property
    def all_keys(self) -> list[str]:
        """The keys [K] in the order of their rows."""
        return [self.key(row) for row in range(len(self.keys))]

    def with_prefix(self, prefix: str) -> Iterator[tuple[str, Column]]:
        """Yield the remainder and the numbers of each key that begins with `prefix`."""
        for key, row in self.keys.iteritems(prefix):
            yield key[len(prefix) :], self.row_numbers(row)

    def columns(self, name: str) -> dict[str, Column]:
        """Return the arrays that `from_columns` reads, with `name` as a prefix."""
        keys = np.frombuffer(self.keys.tobytes(), np.uint8)
        return {f"{name}.keys": keys, f"{name}.starts": self.starts, f"{name}.numbers": self.numbers}

    @classmethod
    def from_columns(cls, columns: Mapping[str, Column], name: str) -> "Postings":
        """Return the instance whose `columns` were stored under `name`."""
        keys = Trie().frombytes(columns[f"{name}.keys"].tobytes())  # a trie is small, even for a city
        return cls(keys, columns[f"{name}.starts"], columns[f"{name}.numbers"])


class PostingsBuilder:
    """A collector of pairs (key, number) that stores each distinct key once: a city has millions of pairs."""

    def __init__(self) -> None:
        self._row, self._rows, self._numbers = dict[str, int](), array("q"), array("q")

    def add(self, key: str, number: int) -> None:
        """Add a number below 2 ** 31 to a key."""
        self._rows.append(self._row.setdefault(key, len(self._row)))
        self._numbers.append(number)

    def build(self) -> Postings:
        """Return the postings: per key, the distinct numbers in the order in which they were added."""
        row, numbers = np.array(self._rows, np.int64), np.array(self._numbers, np.int64)
        distinct = np.sort(np.unique(row << 32 | numbers, return_index=True)[1])
        row, numbers = row[distinct], numbers[distinct].astype(np.int32)
        keys = Trie(list(self._row), weights=np.bincount(row, minlength=len(self._row)).tolist())
        row = np.array([keys[key] for key in self._row], np.int64)[row]
        order = np.argsort(row, kind="stable")
        starts = np.concatenate([[0], np.cumsum(np.bincount(row, minlength=len(keys)))])
        return Postings(keys, compact(starts), numbers[order])


def merge_columns(columns: Iterable[Mapping[str, Column]]) -> dict[str, Column]:
    """Merge column dictionaries into one, with contiguous arrays as safetensors files need them."""
    return {name: np.ascontiguousarray(column) for name, column in chain.from_iterable(map(Mapping.items, columns))}


def compact(numbers: Column) -> Column:
    """Return ascending numbers as int32 if all fit, else unchanged."""
    return numbers.astype(np.int32) if not len(numbers) or numbers[-1] <= np.iinfo(np.int32).max else numbers
