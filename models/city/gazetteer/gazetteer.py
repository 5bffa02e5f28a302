"""The table of what a passer-by could name: geometry, kinds and all names of every object of a map."""

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt
from safetensors import SafetensorError
from safetensors.numpy import load_file, save_file

from models.city.points import Ints
from models.city.types import Floats
from models.errors import IndexBroken

STREET: Final = "street"  # the kind of a street with all its pieces
ADDRESS: Final = "address"  # the kind of what has a house number alone
WALKED: Final = "walked"  # the kind of the one object that is all lines people walk on
SHAPES_FILE = "gazetteer.safetensors"
WORDS_FILE = "gazetteer.json"
_SEVERAL: Final = re.compile("[;,&]")


@dataclass(frozen=True, slots=True)
class Words:
    """What is written of an object.

    Attributes:
        kinds: ids of `models.city.kinds`, most specific first.
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
        parts = (one.strip() for one in _SEVERAL.split((self.number or "").lower()))
        return tuple(one for one in parts if one and one[0].isdecimal())


@dataclass(frozen=True, eq=False)
class Gazetteer:
    """O objects.

    Attributes:
        words: O of them.
        segments_m: [G, 4] float32, x and y of both ends, map frame; a point is a segment without length.
        starts: [O + 1] object o has the segments starts[o] to starts[o + 1].
        is_area: [O] bool, True where the segments close to rings and the object is what is inside.
        corner_streets: [C, 2] objects of kind STREET that meet, the lower first.
        corners_m: [C, 2] float32, where.
    """

    words: tuple[Words, ...]
    segments_m: Floats
    starts: Ints
    is_area: npt.NDArray[np.bool_]
    corner_streets: Ints
    corners_m: Floats

    def __len__(self) -> int:
        return len(self.words)

    @cached_property
    def by_kind(self) -> Mapping[str, Ints]:
        """The objects of every kind, parents' kinds too."""
        found: dict[str, list[int]] = {}
        for number, words in enumerate(self.words):
            for kind in words.kinds:
                found.setdefault(kind, []).append(number)
        return {kind: np.array(numbers) for kind, numbers in found.items()}

    @cached_property
    def named(self) -> Ints:
        """What has a name and a kind, and is no street."""
        some = [n for n, w in enumerate(self.words) if w.names and w.kinds and w.kinds != (STREET,)]
        return np.array(some, dtype=np.int64)

    @cached_property
    def middles_m(self) -> Floats:
        """[O, 2] the middle of each object's box."""
        low, high = self._boxes
        middle: Floats = (low + high) / 2
        return middle

    @cached_property
    def reach_m(self) -> Floats:
        """[O] how far an object's box reaches from its middle."""
        low, high = self._boxes
        reach: Floats = np.hypot(*((high - low) / 2).T)
        return reach

    @cached_property
    def where_named(self) -> tuple[Floats, Floats]:
        """[2, n] middles and [n] reach of what is `named`: all of them are looked through for every answer."""
        return np.ascontiguousarray(self.middles_m[self.named].T), self.reach_m[self.named]

    @cached_property
    def _boxes(self) -> tuple[Floats, Floats]:
        if not len(self):
            return np.zeros((0, 2)), np.zeros((0, 2))
        ends = self.segments_m.reshape(-1, 2, 2).astype(np.float64)
        low = np.minimum.reduceat(ends.min(axis=1), self.starts[:-1])
        return low, np.maximum.reduceat(ends.max(axis=1), self.starts[:-1])

    def save(self, directory: Path) -> None:
        """Write gazetteer.safetensors and gazetteer.json."""
        arrays = {name: np.ascontiguousarray(getattr(self, name)) for name in _ARRAYS}
        save_file(arrays, directory / SHAPES_FILE)
        kinds = sorted({kind for words in self.words for kind in words.kinds})
        number = {kind: n for n, kind in enumerate(kinds)}
        rows = [
            [[number[kind] for kind in words.kinds], list(words.names), words.number, words.street, words.source_id]
            for words in self.words
        ]
        text = json.dumps({"kinds": kinds, "objects": rows}, ensure_ascii=False, separators=(",", ":"))
        (directory / WORDS_FILE).write_text(text, encoding="utf-8")

    @classmethod
    def load(cls, directory: Path) -> "Gazetteer":
        """Read what `save` wrote.

        Raises:
            IndexBroken: the files do not hold a gazetteer.
        """
        try:
            arrays = load_file(directory / SHAPES_FILE)
            found = json.loads((directory / WORDS_FILE).read_text(encoding="utf-8"))
            kinds = found["kinds"]
            words = tuple(
                Words(tuple(kinds[n] for n in of), tuple(names), number, street, source)
                for of, names, number, street, source in found["objects"]
            )
            if len(arrays["starts"]) != len(words) + 1 or arrays["starts"][-1] != len(arrays["segments_m"]):
                raise ValueError("names and shapes are of different gazetteers")
            return cls(words, **{name: arrays[name] for name in _ARRAYS})
        except (OSError, SafetensorError, ValueError, KeyError, TypeError, IndexError) as error:
            raise IndexBroken(
                f"the gazetteer in {directory} cannot be read; rebuild it with 'hereabouts index'"
            ) from error


_ARRAYS = tuple(f.name for f in fields(Gazetteer) if f.name != "words")


def build_gazetteer(
    words: Sequence[Words], segments_m: Sequence[Floats], is_area: Sequence[bool], corners: Any = None
) -> Gazetteer:
    """A gazetteer of objects with their segments, [n, 4] each, and corners (streets [C, 2], places [C, 2]) if any."""
    streets, places = corners if corners is not None else (np.zeros((0, 2), np.int64), np.zeros((0, 2), np.float32))
    sizes = [len(some) for some in segments_m]
    joined = np.concatenate([np.zeros((0, 4)), *segments_m]).astype(np.float32)
    starts = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
    return Gazetteer(tuple(words), joined, starts, np.array(is_area, dtype=np.bool_), streets, places)


NOTHING_NAMED = build_gazetteer((), (), ())
