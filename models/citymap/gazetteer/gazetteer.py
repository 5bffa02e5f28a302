"""The gazetteer: geometry, kinds and all names of every object of a map that a passer-by could name."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np
import numpy.typing as npt
from safetensors import SafetensorError
from safetensors.numpy import save_file

from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject, ObjectTable, ObjectTableBuilder
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.errors import IndexBroken
from models.files import map_arrays
from models.spool import Spool, starts_of
from models.strings import merge_columns

ADDRESS_KIND: Final = "address"  # the kind of an object that has a house number only
WALKED_KIND: Final = "walked"  # the kind of the single object made of all lines that people walk on
GAZETTEER_FILE = "gazetteer.safetensors"


@dataclass(frozen=True, eq=False)
class Gazetteer:
    """O objects."""

    objects: ObjectTable  # kinds, names and address of each
    segments_m: Floats  # [G, 4] float32, x and y of both ends, map frame; a point is a segment without length
    starts: Ints  # [O + 1] object o has the segments starts[o] to starts[o + 1]
    is_area: npt.NDArray[np.bool_]  # [O] bool, True where the segments close to rings and the object is what is inside
    corner_streets: Ints  # [C, 2] objects of kind STREET_KIND that meet, the lower first
    corners_m: Floats  # [C, 2] float32, where they meet

    def __len__(self) -> int:
        return len(self.objects)

    @cached_property
    def by_kind(self) -> Mapping[str, Ints]:
        """Return the objects of each kind; an object also has the parents of its kinds."""
        return self.objects.by_kind

    @cached_property
    def named(self) -> Ints:
        """Return the objects with a name and a kind, except streets."""
        return np.flatnonzero(self.objects.has_name & self.objects.has_kind & ~self.objects.is_street)

    @cached_property
    def middles_m(self) -> Floats:
        """Return the middle [O, 2] of each object's bounding box."""
        low, high = self._boxes
        return (low + high) / 2

    @cached_property
    def reach_m(self) -> Floats:
        """Return the distance [O] from the middle of each object's bounding box to its corners."""
        low, high = self._boxes
        return np.hypot(*((high - low) / 2).T)

    @cached_property
    def streets(self) -> Ints:
        """Return the streets."""
        return self.by_kind.get(STREET_KIND, np.zeros(0, np.int64))

    @cached_property
    def named_extents(self) -> tuple[Floats, Floats]:
        """Return the middles [2, n] and reach [n] of the `named` objects; cached, because each answer scans them."""
        return self._extents(self.named)

    @cached_property
    def street_extents(self) -> tuple[Floats, Floats]:
        """Return the middles [2, n] and reach [n] of the `streets`."""
        return self._extents(self.streets)

    def _extents(self, objects: Ints) -> tuple[Floats, Floats]:
        middles_m, reach_m = np.ascontiguousarray(self.middles_m[objects].T), self.reach_m[objects]
        return middles_m.astype(np.float32), reach_m.astype(np.float32)  # half the memory to scan

    def overlaps(self, low_m: Floats, high_m: Floats) -> npt.NDArray[np.bool_]:
        """Return whether the bounding box of each object [O] overlaps a box, given by two corners [2]."""
        low, high = self._boxes
        return np.asarray(((high >= low_m) & (low <= high_m)).all(axis=1))

    @cached_property
    def _boxes(self) -> tuple[Floats, Floats]:
        if not len(self):
            return np.zeros((0, 2)), np.zeros((0, 2))
        starts, ends = self.starts[:-1], self.segments_m.T  # by axis, which takes a fifth of the time
        low = [np.minimum.reduceat(np.minimum(ends[axis], ends[axis + 2]), starts) for axis in (0, 1)]
        high = [np.maximum.reduceat(np.maximum(ends[axis], ends[axis + 2]), starts) for axis in (0, 1)]
        return np.stack(low, axis=1).astype(np.float64), np.stack(high, axis=1).astype(np.float64)

    def save(self, directory: Path) -> None:
        """Write gazetteer.safetensors."""
        shapes = {name: getattr(self, name) for name in _SHAPE_COLUMNS}
        save_file(merge_columns([shapes, self.objects.columns()]), directory / GAZETTEER_FILE)

    @classmethod
    def load(cls, directory: Path) -> "Gazetteer":
        """Read the file that `save` wrote; raise IndexBroken if it does not hold a gazetteer."""
        try:
            columns = map_arrays(directory / GAZETTEER_FILE)[0]
            objects = ObjectTable.from_columns(columns)
            shapes = {name: columns[name] for name in _SHAPE_COLUMNS}
            if len(shapes["starts"]) != len(objects) + 1 or shapes["starts"][-1] != len(shapes["segments_m"]):
                raise ValueError("names and shapes belong to different gazetteers")
            return cls(objects, **shapes)
        except (OSError, SafetensorError, ValueError, KeyError, TypeError, IndexError) as error:
            raise IndexBroken(
                f"the gazetteer in {directory} cannot be read; rebuild it with 'hereabouts index'"
            ) from error


_SHAPE_COLUMNS = tuple(f.name for f in fields(Gazetteer) if f.name != "objects")


class GazetteerBuilder:
    """Collects the objects of a gazetteer in columns on disk."""

    def __init__(self) -> None:
        self._objects, self._spool, self._count = ObjectTableBuilder(), Spool(), 0

    def __len__(self) -> int:
        return self._count

    def add(self, objects: Sequence[GazetteerObject], segments_m: Sequence[Floats], is_area: Sequence[bool]) -> None:
        """Add objects with their segments, [n, 4] each; may be none."""
        self._objects.add(objects)
        sizes, areas = np.array([len(segments) for segments in segments_m], np.int64), np.array(is_area, dtype=np.bool_)
        self._spool.add({"sizes": sizes, "segments_m": concatenate_segments(segments_m), "is_area": areas})
        self._count += len(objects)

    def build(self, corners: Any = None) -> Gazetteer:
        """Return the gazetteer, with corners (streets, positions) [C, 2] if given; nothing can be added after this."""
        streets, places = corners if corners is not None else (np.zeros((0, 2), np.int64), np.zeros((0, 2), np.float32))
        columns = self._spool.columns()
        starts = starts_of(columns["sizes"])
        return Gazetteer(self._objects.build(), columns["segments_m"], starts, columns["is_area"], streets, places)


def concatenate_segments(segments_m: Sequence[Floats]) -> Floats:
    """Return the segments [n, 4] (float32) of several arrays, [k, 4] each."""
    return np.concatenate([np.zeros((0, 4)), *segments_m], dtype=np.float32, casting="same_kind")


def build_gazetteer(
    objects: Sequence[GazetteerObject], segments_m: Sequence[Floats], is_area: Sequence[bool], corners: Any = None
) -> Gazetteer:
    """Build a gazetteer of objects with their segments, [n, 4] each; corners as `GazetteerBuilder.build`."""
    builder = GazetteerBuilder()
    builder.add(objects, segments_m, is_area)
    return builder.build(corners)


EMPTY_GAZETTEER = build_gazetteer((), (), ())
