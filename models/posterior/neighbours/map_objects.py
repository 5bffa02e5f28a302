"""The objects of a neighbour index: parts of a scan's cells, or instances of a map of pieces."""

from dataclasses import dataclass
from typing import Final

import numpy as np
import numpy.typing as npt

from models.citymap.cells import PartTable
from models.citymap.gallery import Gallery
from models.citymap.map_geometry import PieceGeometry
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.strings import Categorical

MAX_GROUND_HEIGHT_M: Final = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class MapObjects:
    """A table of P objects."""

    instance: Ints  # [P] int32, row of the gallery's labels, names and sources
    rgb: Floats  # [P, 3] float32 colour, NaN where unknown
    parts: Ints  # [P] int32, number of parts of cells that show it
    is_flat: npt.NDArray[np.bool_]  # [P] whether people stand on it rather than beside it
    are_parts: bool = False  # whether they are parts, not instances

    @classmethod
    def from_parts(cls, parts: PartTable) -> "MapObjects":
        """Return the parts of cells as objects."""
        is_flat = (parts.high_m - parts.low_m)[:, 2] < MAX_GROUND_HEIGHT_M
        return cls(parts.instance, parts.rgb, np.ones(len(parts.instance), np.int32), is_flat, are_parts=True)

    @classmethod
    def from_instances(cls, bodies: PieceGeometry, parts: PartTable) -> "MapObjects":
        """Return the instances of a map as objects."""
        instances = len(bodies.rgb)
        high = np.zeros(instances)
        np.maximum.at(high, bodies.pieces.instance, np.ptp(bodies.pieces.heights_m, axis=1))
        shown = np.bincount(parts.instance, minlength=instances).astype(np.int32)
        return cls(np.arange(instances, dtype=np.int32), bodies.rgb, shown, high < MAX_GROUND_HEIGHT_M)

    @property
    def is_vague(self) -> npt.NDArray[np.bool_]:
        """[P] whether the nearest point of an object is imprecise, as for ground areas of a map without scans."""
        return self.is_flat & (not self.are_parts)

    def labels(self, gallery: Gallery) -> tuple[tuple[str, ...], npt.NDArray[np.int64]]:
        """Return the distinct labels of the gallery, and the index [P] of each object's label."""
        labels = Categorical.from_strings(gallery.labels)
        return tuple(labels.categories), labels.codes[self.instance].astype(np.int64)
