"""What is known of cells beside their vectors: where they are, what is in them, and what map they are of."""

import json
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from safetensors import SafetensorError
from safetensors.numpy import load_file, save_file

from models.city.cells import CellTable, Parts
from models.city.colours import Palette
from models.city.frame import Frame
from models.city.points import Ints
from models.city.types import CityMap, Floats
from models.errors import IndexBroken

CELLS_FILE = "cells.safetensors"
NAMES_FILE = "cells.json"


@dataclass(frozen=True, slots=True, eq=False)
class Gallery:
    """Cells, and labels, names and sources of the instances they hold.

    Attributes:
        cells: the cells; `parts.instance` points into the lists below.
        labels, names, sources: I entries, of each instance.
    """

    cells: CellTable
    labels: tuple[str, ...]
    names: tuple[str | None, ...]
    sources: tuple[str | None, ...]

    @classmethod
    def of(cls, city_map: CityMap, cells: CellTable) -> "Gallery":
        """The gallery of cells cut from a map."""
        instances = city_map.instances
        return cls(
            cells,
            tuple(i.label for i in instances),
            tuple(i.name for i in instances),
            tuple(i.source_id for i in instances),
        )

    def save(self, directory: Path) -> None:
        """Write cells.safetensors and cells.json."""
        parts = self.cells.parts
        arrays = {f.name: np.ascontiguousarray(getattr(parts, f.name)) for f in fields(parts)}
        save_file(arrays | {"center_m": self.cells.center_m}, directory / CELLS_FILE)
        names: dict[str, Any] = {
            "ids": self.cells.ids,
            "scenes": self.cells.scenes,
            "size_m": self.cells.size_m,
            "labels": self.labels,
            "names": self.names,
            "sources": self.sources,
        }
        (directory / NAMES_FILE).write_text(json.dumps(names, ensure_ascii=False))

    @classmethod
    def load(cls, directory: Path) -> "Gallery":
        """Read what `save` wrote.

        Raises:
            IndexBroken: the files do not hold a gallery.
        """
        try:
            arrays = load_file(directory / CELLS_FILE)
            names = json.loads((directory / NAMES_FILE).read_text())
            center_m = arrays.pop("center_m")
            cells = CellTable(tuple(names["ids"]), tuple(names["scenes"]), center_m, names["size_m"], Parts(**arrays))
            return cls(cells, tuple(names["labels"]), tuple(names["names"]), tuple(names["sources"]))
        except (OSError, SafetensorError, ValueError, KeyError, TypeError) as error:
            raise IndexBroken(f"the cells in {directory} cannot be read; rebuild it with 'hereabouts index'") from error


@dataclass(frozen=True, slots=True, eq=False)
class MapData:
    """A map, some of its scenes, or a region of it.

    Attributes:
        name: of the map.
        split: what was taken of it; "all" for everything, "index" for what an index holds.
        gallery: its cells and what is in them.
        palette: its colour words.
        frame: what its metres mean on Earth.
        grid_m: distance between neighbouring cells.
        attribution: what the data's licence asks to show.
    """

    name: str
    split: str
    gallery: Gallery
    palette: Palette
    frame: Frame = field(default_factory=Frame)
    grid_m: float = 10.0
    attribution: str = ""

    @property
    def cells(self) -> CellTable:
        """The cells."""
        return self.gallery.cells


@dataclass(frozen=True, slots=True, eq=False)
class Bodies:
    """The instances of a map (or of several scenes) with all their points.

    Attributes:
        xyz: [P, 3] float32 metres, ordered by instance.
        starts: [I + 1] instance i has the points starts[i] to starts[i + 1].
        is_thing: [I] bool, True for what is mentioned only where a share of it is near (`thing_share`).
        scene: [I] number of the scene of each.
        part_instance: [R] instance of each row of the cells' parts.
        thing_share: see `CutRules`.
        min_part_points: see `CutRules`.
    """

    xyz: Floats
    starts: Ints
    is_thing: npt.NDArray[np.bool_]
    scene: Ints
    part_instance: Ints
    thing_share: float
    min_part_points: int
