"""What is written of the objects of a gazetteer: kinds, names, addresses."""

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
Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class GazetteerObject:
    """What is written of an object.

    Attributes:
        kinds: ids of `models.citymap.kinds`, most specific first.
        names: all its names, the one to show first; none for many.
        number, street: of its address.
        source_id: where it comes from ("way/1234").
    """

    kinds: tuple[str, ...]
    names: tuple[str, ...] = ()
    number: str | None = None
    street: str | None = None
    source_id: str | None = None

    @property
    def numbers(self) -> tuple[str, ...]:
        """Its house numbers, in lower case; some houses have several, and what begins with no digit ("s/n") is none."""
        parts = (one.strip() for one in _NUMBER_SEPARATOR.split((self.number or "").lower()))
        return tuple(one for one in parts if one and one[0].isdecimal())


class ObjectTable(Sequence[GazetteerObject]):
    """What is written of O objects, in columns; what of one is asked for is made then.

    Args:
        known: the kinds there are, ascending.
        kind_starts: [O + 1] object o has the kinds kind_starts[o] to kind_starts[o + 1].
        kinds: [K] int32, which of `known`.
        starts: [O + 1] object o has the strings starts[o] to starts[o + 1]: names, number, street, source.
        written: [O, 3] bool, whether there are the last three.
        strings: of all objects.
    """

    def __init__(
        self, known: Sequence[str], kind_starts: Ints, kinds: Ints, starts: Ints, written: Mask, strings: StringArray
    ) -> None:
        self._all_kinds, self._kind_starts, self._kinds = tuple(known), kind_starts, kinds
        self._string_starts, self._written, self._strings = starts, written, strings

    @classmethod
    def from_objects(cls, words: Sequence[GazetteerObject]) -> "ObjectTable":
        """That of some objects."""
        spool = ObjectTableBuilder()
        spool.add(words)
        return spool.build()

    def __len__(self) -> int:
        return len(self._written)

    @overload
    def __getitem__(self, n: int) -> GazetteerObject: ...

    @overload
    def __getitem__(self, n: slice) -> list[GazetteerObject]: ...

    def __getitem__(self, n: int | slice) -> GazetteerObject | list[GazetteerObject]:
        """What is written of one object, or of those of a slice."""
        if isinstance(n, slice):
            return [self[row] for row in range(*n.indices(len(self)))]
        row = range(len(self))[n]
        kinds = self._kinds[self._kind_starts[row] : self._kind_starts[row + 1]].tolist()
        strings = self._strings[int(self._string_starts[row]) : int(self._string_starts[row + 1])]
        source, street, number = (strings.pop() if has else None for has in self._written[row, ::-1].tolist())
        return GazetteerObject(tuple(self._all_kinds[kind] for kind in kinds), tuple(strings), number, street, source)

    @cached_property
    def by_kind(self) -> Mapping[str, Ints]:
        """The objects of every kind."""
        order = np.argsort(self._kinds, kind="stable")
        objects = np.repeat(np.arange(len(self)), np.diff(self._kind_starts))[order]
        ends = np.searchsorted(self._kinds[order], np.arange(1, len(self._all_kinds) + 1))
        return {kind: objects[ends[n - 1] if n else 0 : ends[n]] for n, kind in enumerate(self._all_kinds)}

    @property
    def has_name(self) -> Mask:
        """[O] whether an object has a name."""
        mask: Mask = np.diff(self._string_starts) > self._written.sum(axis=1)
        return mask

    @property
    def has_kind(self) -> Mask:
        """[O] whether an object has a kind."""
        mask: Mask = np.diff(self._kind_starts) > 0
        return mask

    @property
    def is_street(self) -> Mask:
        """[O] whether an object is a street."""
        mask = np.zeros(len(self), np.bool_)
        mask[self.by_kind.get(STREET_KIND, [])] = True
        return mask

    def columns(self) -> dict[str, Column]:
        """Arrays from which `from_columns` makes it."""
        plain = {name: getattr(self, f"_{name}") for name in _NUMBER_COLUMNS}
        return merge_columns(
            [plain, self._strings.columns("strings"), StringArray.from_strings(self._all_kinds).columns("known")]
        )

    @classmethod
    def from_columns(cls, columns: Mapping[str, Column]) -> "ObjectTable":
        """What `columns` gave."""
        strings, known = (StringArray.from_columns(columns, name) for name in ("strings", "known"))
        kind_starts, kinds, starts, written = (columns[name] for name in _NUMBER_COLUMNS)
        return cls(known, kind_starts, kinds, starts, written, strings)


_NUMBER_COLUMNS: Final = ("kind_starts", "kinds", "string_starts", "written")


class ObjectTableBuilder:
    """What is written of objects, as these come; it lies on disk."""

    def __init__(self) -> None:
        self._spool, self._kinds = Spool(), dict[str, int]()

    def add(self, words: Sequence[GazetteerObject]) -> None:
        """Add some objects, at least none."""
        kinds = [self._kinds.setdefault(kind, len(self._kinds)) for some in words for kind in some.kinds]
        written = np.array([[one is not None for one in _optional_texts(some)] for some in words], np.bool_).reshape(
            -1, 3
        )
        names = np.array([len(some.names) for some in words], np.int32)
        strings = [one.encode() for some in words for one in (*some.names, *_optional_texts(some)) if one is not None]
        self._spool.add(
            {
                "kinds": np.array(kinds, np.int32),
                "kinds_of": np.array([len(some.kinds) for some in words], np.int32),
                "written": written,
                "strings_of": names + written.sum(axis=1, dtype=np.int32),
                "text": np.frombuffer(b"".join(strings), np.uint8),
                "bytes_of": np.array([len(string) for string in strings], np.int32),
            }
        )

    def build(self) -> ObjectTable:
        """All of them; none is added after that."""
        columns, known = self._spool.columns(), sorted(self._kinds)
        number = np.empty(len(known), np.int32)
        number[[self._kinds[kind] for kind in known]] = np.arange(len(known))
        kind_starts, starts = starts_of(columns["kinds_of"]), starts_of(columns["strings_of"])
        strings = StringArray(columns["text"], starts_of(columns["bytes_of"])[1:])
        return ObjectTable(known, kind_starts, number[columns["kinds"]], starts, columns["written"], strings)


def _optional_texts(words: GazetteerObject) -> tuple[str | None, str | None, str | None]:
    return words.number, words.street, words.source_id
