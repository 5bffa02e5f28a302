"""The cells of a map with the facts about their instances and about the map itself."""

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields, replace
from operator import eq
from pathlib import Path
from typing import Any, Final, overload

import numpy as np
import numpy.typing as npt
from safetensors import SafetensorError
from safetensors.numpy import save_file
from scipy.spatial import cKDTree

from models.citymap.cells import CellTable, PartTable
from models.citymap.colours import Palette
from models.citymap.frame import Frame
from models.citymap.instances import InstanceTable
from models.citymap.points import Ints
from models.citymap.types import CityMap, Floats
from models.errors import IndexBroken
from models.files import map_arrays
from models.strings import Categorical, merge_columns

# Maps a position [2] to the offset [2] to the nearest instance, and that instance.
NearestFinder = Callable[[Floats], tuple[Floats, int]]
CELLS_FILE = "cells.safetensors"
NAMES_FILE = "cells.json"
INSTANCE_COLUMNS: Final = ("labels", "names", "sources")  # of a gallery, one entry for each instance
PART_COLUMNS: Final = tuple(f.name for f in fields(PartTable))
MAX_ID_DIGITS: Final = 19  # a longer cell number does not fit 64 bits


@dataclass(frozen=True, slots=True, eq=False)
class Gallery:
    """Cells, with the labels, names and sources of the instances in them."""

    cells: CellTable  # `parts.instance` is a row of the lists below
    labels: Sequence[str]  # one entry for each of I instances, like the next two
    names: Sequence[str | None]
    sources: Sequence[str | None]

    @classmethod
    def from_map(cls, city_map: CityMap, cells: CellTable) -> "Gallery":
        """Build the gallery of cells cut from a map."""
        instances = city_map.instances
        if isinstance(instances, InstanceTable):
            return cls(cells, instances.labels, instances.names, instances.sources)
        return cls(
            cells,
            tuple(i.label for i in instances),
            tuple(i.name for i in instances),
            tuple(i.source_id for i in instances),
        )

    def save(self, directory: Path, *, with_parts: bool = True) -> None:
        """Write cells.safetensors and cells.json; leave out the parts if they can be cut again."""
        cells = self.cells
        arrays = {"center_m": cells.center_m}
        if with_parts:
            arrays |= {name: getattr(cells.parts, name) for name in PART_COLUMNS}
        instance_columns = (Categorical.from_strings(getattr(self, name)).columns(name) for name in INSTANCE_COLUMNS)
        save_file(merge_columns([arrays, *instance_columns]), directory / CELLS_FILE)
        scene = cells.scenes[0] if cells.ids == NumberedCellIds(cells.scenes[0], len(cells)) else None
        names: dict[str, Any] = {
            "scene": scene,
            "ids": None if scene else tuple(cells.ids),
            "scenes": None if scene else cells.scenes,
            "size_m": cells.size_m,
        }
        (directory / NAMES_FILE).write_text(json.dumps(names, ensure_ascii=False))

    @classmethod
    def load(cls, directory: Path, cut: Callable[[Ints], PartTable] | None = None) -> "Gallery":
        """Read the files that `save` wrote; raise IndexBroken if they do not hold a gallery.

        `cut` cuts the parts of given cells, if they were left out.
        """
        try:
            arrays = map_arrays(directory / CELLS_FILE)[0]
            names = json.loads((directory / NAMES_FILE).read_text())
            center_m, scene = arrays.pop("center_m"), names["scene"]
            ids = NumberedCellIds(scene, len(center_m)) if scene else tuple(names["ids"])
            scenes = (scene,) * len(center_m) if scene else tuple(names["scenes"])
            parts = {name: column for name, column in arrays.items() if name in PART_COLUMNS}
            content = PartTable(**parts) if parts or cut is None else cut
            cells = CellTable(ids, scenes, center_m, names["size_m"], content)
            return cls(cells, *(Categorical.from_columns(arrays, name) for name in INSTANCE_COLUMNS))
        except (OSError, SafetensorError, ValueError, KeyError, TypeError) as error:
            raise IndexBroken(f"the cells in {directory} cannot be read; rebuild it with 'hereabouts index'") from error


class NumberedCellIds(Sequence[str]):
    """The ids of the cells of one scene, made on access: a city has a million."""

    def __init__(self, scene: str, count: int) -> None:
        self._scene, self._count = scene, count

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, n: int) -> str: ...

    @overload
    def __getitem__(self, n: slice) -> tuple[str, ...]: ...

    def __getitem__(self, n: int | slice) -> str | tuple[str, ...]:
        """Return the id of one cell, or those of a slice."""
        if isinstance(n, slice):
            return tuple(self[row] for row in range(*n.indices(self._count)))
        return f"{self._scene}_{range(self._count)[n]:05d}"

    def index(self, value: str, start: int = 0, stop: int | None = None) -> int:
        """Return the cell of an id without a search."""
        number = value.rpartition("_")[2]
        rows = range(*slice(start, stop).indices(self._count))
        if number.isdecimal() and len(number) < MAX_ID_DIGITS and int(number) in rows and self[int(number)] == value:
            return int(number)
        raise ValueError(f"no cell is named {value}")

    def __eq__(self, other: object) -> bool:
        if isinstance(other, NumberedCellIds):
            return (self._scene, self._count) == (other._scene, other._count)
        return isinstance(other, Sequence) and len(self) == len(other) and all(map(eq, self, other))

    __hash__ = None  # type: ignore[assignment]  # like a list, it equals other sequences


@dataclass(frozen=True, slots=True, eq=False)
class MapData:
    """A map, some of its scenes, or a region of it."""

    name: str
    split: str  # the part of it: "all", a split's name, or "index" for the content of an index
    gallery: Gallery
    palette: Palette
    frame: Frame = field(default_factory=Frame)
    grid_m: float = 10.0  # distance between neighbouring cells
    attribution: str = ""  # the text that the data's licence asks to show

    @property
    def cells(self) -> CellTable:
        """Return the cells of the gallery."""
        return self.gallery.cells

    def with_deferred_parts(self, cut: Callable[[Floats], PartTable]) -> "MapData":
        """Return the same data without parts; `cut` makes those of a cell (around centres [N, 3]) on access."""
        centers_m = self.cells.center_m
        cells = replace(self.cells, content=lambda rows: cut(centers_m[rows]))
        return replace(self, gallery=replace(self.gallery, cells=cells))


@dataclass(frozen=True, slots=True, eq=False)
class PointClouds:
    """The instances of one or more scanned scenes with all their points."""

    xyz: Floats  # [P, 3] float32 metres, ordered by instance
    starts: Ints  # [I + 1] instance i has the points starts[i] to starts[i + 1]
    is_thing: npt.NDArray[np.bool_]  # [I] counts only where at least `thing_share` of it is near
    scene: Ints  # [I] number of the scene of each
    part_instances: Ints  # [R] instance of each row of the cells' parts
    thing_share: float  # as in `CutRules`
    min_part_points: int  # as in `CutRules`

    def instances_of_parts(self, _cells: CellTable) -> Ints:
        """Return the instance [R] of each row of the cells' parts."""
        return self.part_instances

    def nearest_finder(self, instances: Sequence[int]) -> NearestFinder:
        """Return a function that finds the nearest of some instances to a position."""
        spans = [slice(int(self.starts[n]), int(self.starts[n + 1])) for n in instances]
        tree = cKDTree(np.concatenate([self.xyz[span, :2] for span in spans]).astype(np.float64))
        owner = np.repeat(instances, [span.stop - span.start for span in spans])

        def find(position: Floats) -> tuple[Floats, int]:
            row = int(tree.query(position)[1])
            return tree.data[row] - position, int(owner[row])

        return find
