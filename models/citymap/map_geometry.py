"""The geometry of a map, whether scanned points or lines and areas, and cutting it into cells."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Protocol

import numpy as np
import shapely

from models.citymap.cells import CellTable, PartTable, cut_cubes, grid_centers, sample_cubes
from models.citymap.gallery import NearestFinder, NumberedCellIds
from models.citymap.geometry.cutting import cut_pieces, sample_pieces, scan_pieces
from models.citymap.geometry.pieces import PieceTable
from models.citymap.instances import InstanceTable
from models.citymap.point_sample import FIXED_SAMPLING, PointSampling
from models.citymap.points import Ints, PointTable
from models.citymap.types import CityMap, CutRules, Floats
from models.errors import MapError

CutProgress = Callable[[int, int], None]  # cubes cut, cubes to cut


class MapGeometry(Protocol):
    """Geometry that cubes can be cut out of."""

    def cut(self, centers_m: Floats, progress: CutProgress | None = None, min_parts: int = 0) -> PartTable:
        """Cut the cubes around centres [N, 3]; cubes with fewer than `min_parts` parts may be left empty."""
        ...

    def sample(self, centers_m: Floats, cubes: Ints, sampling: PointSampling = FIXED_SAMPLING) -> Floats:
        """Return sampled points [R, 256, 6] of the parts in some of these cubes, in order of `PartTable`."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class ScanGeometry:
    """The points of a scan."""

    points: PointTable
    rules: CutRules

    def cut(self, centers_m: Floats, progress: CutProgress | None = None, min_parts: int = 0) -> PartTable:
        """Cut the cubes around centres; `min_parts` has no effect."""
        del min_parts
        return cut_cubes(self.points, centers_m, self.rules, progress)

    def sample(self, centers_m: Floats, cubes: Ints, sampling: PointSampling = FIXED_SAMPLING) -> Floats:
        """Return sampled points, as `MapGeometry.sample`."""
        return sample_cubes(self.points, self.rules, centers_m, cubes, sampling)


@dataclass(frozen=True, slots=True, eq=False)
class PieceGeometry:
    """The pieces of a map of lines and areas."""

    pieces: PieceTable
    rgb: Floats  # [I, 3] float32 colour of each instance, NaN where unknown
    shapes: Sequence[str]  # I shapes, see `models.citymap.geometry.solids`
    rules: CutRules

    def cut(self, centers_m: Floats, progress: CutProgress | None = None, min_parts: int = 0) -> PartTable:
        """Cut the cubes around centres, as `MapGeometry.cut`."""
        return cut_pieces(self.pieces, self.rgb, centers_m, self.rules, progress, min_parts)

    def sample(self, centers_m: Floats, cubes: Ints, sampling: PointSampling = FIXED_SAMPLING) -> Floats:
        """Return sampled points, as `MapGeometry.sample`."""
        return sample_pieces(self.pieces, self.rgb, self.shapes, centers_m[cubes], self.rules, sampling)

    @property
    def scene(self) -> Ints:
        """Return the scene [I] of each instance; there is one."""
        return np.zeros(len(self.rgb), np.int64)

    def instances_of_parts(self, cells: CellTable) -> Ints:
        """Return the instance [R] of each row of the cells' parts."""
        return cells.parts.instance

    def nearest_finder(self, instances: Sequence[int]) -> NearestFinder:
        """Return a function that finds the nearest of some instances to a position."""
        rows = np.flatnonzero(np.isin(self.pieces.instance, instances))
        geometry = self.pieces.geometry(rows)
        tree = shapely.STRtree(geometry)

        def find(position: Floats) -> tuple[Floats, int]:
            point = shapely.Point(position)
            row = int(tree.nearest(point))
            ends = shapely.get_coordinates(shapely.shortest_line(point, geometry[row]))
            return ends[1] - ends[0], int(self.pieces.instance[rows[row]])

        return find


@dataclass(frozen=True, slots=True, eq=False)
class ScannedPieceGeometry:
    """A map of lines and areas as a scan would show it: the closest point of a part is a sampled one."""

    pieces: PieceGeometry

    def cut(self, centers_m: Floats, progress: CutProgress | None = None, min_parts: int = 0) -> PartTable:
        """Cut the cubes around centres; `min_parts` has no effect."""
        del min_parts
        table, shapes, rules = self.pieces.pieces, self.pieces.shapes, self.pieces.rules
        parts = self.pieces.cut(centers_m, progress)
        return replace(parts, closest_m=scan_pieces(table, shapes, centers_m, rules))

    def sample(self, centers_m: Floats, cubes: Ints, sampling: PointSampling = FIXED_SAMPLING) -> Floats:
        """Return sampled points, as `MapGeometry.sample`."""
        return self.pieces.sample(centers_m, cubes, sampling)


def build_geometry(city_map: CityMap) -> MapGeometry:
    """Build the geometry of a map."""
    if city_map.pieces is None:
        return ScanGeometry(PointTable.from_map(city_map, city_map.rules.eps_m), city_map.rules)
    instances = city_map.instances
    assert isinstance(instances, InstanceTable), "readers of lines and areas make an InstanceTable"
    return PieceGeometry(city_map.pieces, instances.rgb, instances.shapes, city_map.rules)


def cut_cells(city_map: CityMap, geometry: MapGeometry, progress: CutProgress | None = None) -> CellTable:
    """Cut a map into overlapping cells on a grid over its locations (docs/formats.md, rule 4).

    `progress` gets (cells cut, cells to cut). Raise MapError if no cell has enough instances.
    """
    rules = city_map.rules
    centers = grid_centers(city_map.locations_m, rules)
    parts = geometry.cut(centers, progress, rules.min_instances)
    rich = np.flatnonzero(np.diff(parts.starts) >= rules.min_instances)
    if not len(rich):
        raise MapError(
            f"map '{city_map.name}': none of {len(centers)} cells has {rules.min_instances} instances, "
            "too few to tell places apart; take a larger or richer map"
        )
    return CellTable(
        ids=NumberedCellIds(city_map.name, len(rich)),
        scenes=(city_map.name,) * len(rich),
        center_m=centers[rich],
        size_m=rules.cell_size_m,
        content=parts.take(rich),
        sample=partial(geometry.sample, centers[rich]),
    )
