"""Kinds, names and addresses of the objects of a gazetteer."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final, overload

import numpy as np
import numpy.typing as npt

from models.citymap.points import Ints
from models.spool import Spool, starts_of
from models.strings import Column, StringArray, merge_columns

STREET_KIND: Final = "street"  # the kind of a street with all its pieces
_NUMBER_SEPARATOR: Final = re.compile("[;,&]")
_CODE_SPACES: Final = re.compile(r"[\s-]")
Mask = npt.NDArray[np.bool_]


def plain_code(code: str) -> str:
    """Return a reference or postcode without spaces and hyphens, in lower case."""
    return _CODE_SPACES.sub("", code.lower())


@dataclass(frozen=True, slots=True)
class GazetteerObject:
    """Kinds, names and address of an object."""

    kinds: tuple[str, ...]  # ids of `models.citymap.kinds`, most specific first
    names: tuple[str, ...] = ()  # all its names, the one to show first; many objects have none
    number: str | None = None  # of its address
    street: str | None = None  # of its address
    source_id: str | None = None  # the element it was read from ("way/1234")
    codes: tuple[str, ...] = ()  # what else it is known by, after its kind of code: "stop h2002", "post 00120"

    @property
    def numbers(self) -> tuple[str, ...]:
        """Return all house numbers of the address in lower case; one that starts with a letter ("s/n") is none."""
        parts = (one.strip() for one in _NUMBER_SEPARATOR.split((self.number or "").lower()))
        return tuple(one for one in parts if one and one[0].isdecimal())


class ObjectTable(Sequence[GazetteerObject]):
    """O objects in columns; an object is made on access.

    Args:
        known: all kinds, ascending.
        kind_starts: [O + 1] object o has the kinds kind_starts[o] to kind_starts[o + 1].
        kinds: [K] int32, index into `known`.
        starts: [O + 1] object o has the strings starts[o] to starts[o + 1]: names, number, street, source, codes.
        written: [O, 4] bool, whether the object has each of the last four.
        strings: of all objects.
    """

    def __init__(
        self, known: Sequence[str], kind_starts: Ints, kinds: Ints, starts: Ints, written: Mask, strings: StringArray
    ) -> None:
        self._all_kinds, self._kind_starts, self._kinds = tuple(known), kind_starts, kinds
        self._string_starts, self._written, self._strings = starts, written, strings

    def __len__(self) -> int:
        return len(self._written)

    @overload
    def __getitem__(self, n: int) -> GazetteerObject: ...

    @overload
    def __getitem__(self, n: slice) -> list[GazetteerObject]: ...

    def __getitem__(self, n: int | slice) -> GazetteerObject | list[GazetteerObject]:
        """Return one object, or those of a slice."""
        if isinstance(n, slice):
            return [self[row] for row in range(*n.indices(len(self)))]
        row = range(len(self))[n]
        kinds = self._kinds[self._kind_starts[row] : self._kind_starts[row + 1]].tolist()
        strings = self._strings[int(self._string_starts[row]) : int(self._string_starts[row + 1])]
        codes, source, street, number = (strings.pop() if has else None for has in self._written[row, ::-1].tolist())
        names, own_kinds = tuple(strings), tuple(self._all_kinds[kind] for kind in kinds)
        return GazetteerObject(own_kinds, names, number, street, source, tuple(codes.split(";")) if codes else ())

    def find_source(self, source_id: str) -> int | None:
        """Return the object that was read from an element; None if there is none."""
        for string in self._strings.find(source_id):
            row = int(np.searchsorted(self._string_starts, string, side="right")) - 1
            if self[row].source_id == source_id:
                return row
        return None

    @property
    def known_kinds(self) -> Sequence[str]:
        """Return all kinds, ascending."""
        return self._all_kinds

    @cached_property
    def by_kind(self) -> Mapping[str, Ints]:
        """Return the objects of each kind."""
        order = np.argsort(self._kinds, kind="stable")
        objects = np.repeat(np.arange(len(self)), np.diff(self._kind_starts))[order]
        ends = np.searchsorted(self._kinds[order], np.arange(1, len(self._all_kinds) + 1))
        return {kind: objects[ends[n - 1] if n else 0 : ends[n]] for n, kind in enumerate(self._all_kinds)}

    @property
    def has_name(self) -> Mask:
        """Whether each object [O] has a name."""
        return np.diff(self._string_starts) > self._written.sum(axis=1)

    @property
    def has_kind(self) -> Mask:
        """Whether each object [O] has a kind."""
        return np.diff(self._kind_starts) > 0

    @property
    def has_number(self) -> Mask:
        """Whether each object [O] has a house number."""
        return self._written[:, 0]

    def count_kinds(self, objects: Mask) -> Mapping[str, int]:
        """Return the number of objects of each kind, counting only the most specific kind of each of a mask [O]."""
        kinds, counts = np.unique(self._kinds[self._kind_starts[:-1][self.has_kind & objects]], return_counts=True)
        return {self._all_kinds[kind]: count for kind, count in zip(kinds.tolist(), counts.tolist(), strict=True)}

    @property
    def is_street(self) -> Mask:
        """Whether each object [O] is a street."""
        mask = np.zeros(len(self), np.bool_)
        mask[self.by_kind.get(STREET_KIND, [])] = True
        return mask

    def columns(self) -> dict[str, Column]:
        """Return the arrays that `from_columns` takes."""
        plain = {name: getattr(self, f"_{name}") for name in _NUMBER_COLUMNS}
        return merge_columns(
            [plain, self._strings.columns("strings"), StringArray.from_strings(self._all_kinds).columns("known")]
        )

    @classmethod
    def from_columns(cls, columns: Mapping[str, Column]) -> "ObjectTable":
        """Build a table from what `columns` returned."""
        strings, known = (StringArray.from_columns(columns, name) for name in ("strings", "known"))
        kind_starts, kinds, starts, written = (columns[name] for name in _NUMBER_COLUMNS)
        return cls(known, kind_starts, kinds, starts, written, strings)


_NUMBER_COLUMNS: Final = ("kind_starts", "kinds", "string_starts", "written")


class ObjectTableBuilder:
    """Collects objects in columns on disk."""

    def __init__(self) -> None:
        self._spool, self._kinds = Spool(), dict[str, int]()

    def add(self, objects: Sequence[GazetteerObject]) -> None:
        """Add objects; may be none."""
        kinds = [self._kinds.setdefault(kind, len(self._kinds)) for item in objects for kind in item.kinds]
        written = np.array([[one is not None for one in _optional_texts(item)] for item in objects], np.bool_).reshape(
            -1, 4
        )
        names = np.array([len(item.names) for item in objects], np.int32)
        strings = [one.encode() for item in objects for one in (*item.names, *_optional_texts(item)) if one is not None]
        self._spool.add(
            {
                "kinds": np.array(kinds, np.int32),
                "kinds_of": np.array([len(item.kinds) for item in objects], np.int32),
                "written": written,
                "strings_of": names + written.sum(axis=1, dtype=np.int32),
                "text": np.frombuffer(b"".join(strings), np.uint8),
                "bytes_of": np.array([len(string) for string in strings], np.int32),
            }
        )

    def build(self) -> ObjectTable:
        """Return the table; nothing can be added after this."""
        columns, known = self._spool.columns(), sorted(self._kinds)
        number = np.empty(len(known), np.int32)
        number[[self._kinds[kind] for kind in known]] = np.arange(len(known))
        kind_starts, starts = starts_of(columns["kinds_of"]), starts_of(columns["strings_of"])
        strings = StringArray(columns["text"], starts_of(columns["bytes_of"])[1:])
        return ObjectTable(known, kind_starts, number[columns["kinds"]], starts, columns["written"], strings)


def _optional_texts(item: GazetteerObject) -> tuple[str | None, ...]:
    return item.number, item.street, item.source_id, ";".join(item.codes) or None
