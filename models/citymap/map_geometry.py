"""What stands in a map, however that is known: as the points of a scan, or as geometry."""

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
from models.citymap.points import Ints, PointTable
from models.citymap.types import CityMap, CutRules, Floats
from models.errors import MapError
from models.processes import give_back
from models.spool import forget

CutProgress = Callable[[int, int], None]  # cubes cut, cubes to cut


class MapGeometry(Protocol):
    """Something that cubes can be cut out of."""

    def cut(self, centers_m: Floats, progress: CutProgress | None = None, least: int = 0) -> PartTable:
        """What lies in the cubes around centres [N, 3]; those of fewer parts than `least` may be left empty."""
        ...

    def sample(self, centers_m: Floats, cubes: Ints) -> Floats:
        """[R, 256, 6] points of the parts of some of these cubes, in order of `PartTable`."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class ScanGeometry:
    """A scan.

    Attributes:
        points: all of them.
        rules: how it is cut.
    """

    points: PointTable
    rules: CutRules

    def cut(self, centers_m: Floats, progress: CutProgress | None = None, least: int = 0) -> PartTable:
        """See Bodies."""
        del least
        return cut_cubes(self.points, centers_m, self.rules, progress)

    def sample(self, centers_m: Floats, cubes: Ints) -> Floats:
        """See Bodies."""
        return sample_cubes(self.points, self.rules, centers_m, cubes)


@dataclass(frozen=True, slots=True, eq=False)
class PieceGeometry:
    """A map of lines and areas.

    Attributes:
        pieces: what is in each tile.
        rgb: [I, 3] float32 colour of each instance, NaN where unknown.
        shapes: I shapes, see `models.citymap.geometry.solids`.
        rules: how it is cut.
    """

    pieces: PieceTable
    rgb: Floats
    shapes: Sequence[str]
    rules: CutRules

    def cut(self, centers_m: Floats, progress: CutProgress | None = None, least: int = 0) -> PartTable:
        """See Bodies."""
        return cut_pieces(self.pieces, self.rgb, centers_m, self.rules, progress, least)

    def sample(self, centers_m: Floats, cubes: Ints) -> Floats:
        """See Bodies."""
        return sample_pieces(self.pieces, self.rgb, self.shapes, centers_m[cubes], self.rules)

    @property
    def scene(self) -> Ints:
        """[I] scene of each instance; there is one."""
        return np.zeros(len(self.rgb), np.int64)

    def instances_of_parts(self, cells: CellTable) -> Ints:
        """[R] instance of each row of the cells' parts."""
        return cells.parts.instance

    def nearest_finder(self, instances: Sequence[int]) -> NearestFinder:
        """What tells which of some instances is nearest to a position."""
        rows = np.flatnonzero(np.isin(self.pieces.instance, instances))
        geometry = self.pieces.geometry(rows)
        tree = shapely.STRtree(geometry)

        def find(position: Floats) -> tuple[Floats, int]:
            at = shapely.Point(position)
            row = int(tree.nearest(at))
            ends = shapely.get_coordinates(shapely.shortest_line(at, geometry[row]))
            return ends[1] - ends[0], int(self.pieces.instance[rows[row]])

        return find


@dataclass(frozen=True, slots=True, eq=False)
class ScannedPieceGeometry:
    """A map of lines and areas as a scan shows it: what is nearest is one of its points.

    Attributes:
        pieces: the map.
    """

    pieces: PieceGeometry

    def cut(self, centers_m: Floats, progress: CutProgress | None = None, least: int = 0) -> PartTable:
        """See Bodies; `least` counts for nothing."""
        del least
        table, shapes, rules = self.pieces.pieces, self.pieces.shapes, self.pieces.rules
        parts = self.pieces.cut(centers_m, progress)
        return replace(parts, closest_m=scan_pieces(table, shapes, centers_m, rules))

    def sample(self, centers_m: Floats, cubes: Ints) -> Floats:
        """See Bodies."""
        return self.pieces.sample(centers_m, cubes)


def build_geometry(city_map: CityMap) -> MapGeometry:
    """What stands in a map."""
    if city_map.pieces is None:
        return ScanGeometry(PointTable.from_map(city_map, city_map.rules.eps_m), city_map.rules)
    instances = city_map.instances
    assert isinstance(instances, InstanceTable), "as whoever reads geometry makes them"
    return PieceGeometry(city_map.pieces, instances.rgb, instances.shapes, city_map.rules)


def cut_cells(city_map: CityMap, bodies: MapGeometry, progress: CutProgress | None = None) -> CellTable:
    """Cut a map into overlapping cells on a grid over its locations (docs/formats.md, rule 4).

    Args:
        city_map: the map.
        bodies: what stands in it.
        progress: called with (cells cut, cells to cut).

    Raises:
        MapError: no cell has enough instances.
    """
    rules = city_map.rules
    centers = grid_centers(city_map.locations_m, rules)
    forget([city_map.locations_m])
    parts = bodies.cut(centers, progress, rules.min_instances)
    give_back()
    kept = np.flatnonzero(np.diff(parts.starts) >= rules.min_instances)
    if not len(kept):
        raise MapError(
            f"map '{city_map.name}': none of {len(centers)} cells has {rules.min_instances} instances, "
            "too few to tell places apart; take a larger or richer map"
        )
    return CellTable(
        ids=NumberedCellIds(city_map.name, len(kept)),
        scenes=(city_map.name,) * len(kept),
        center_m=centers[kept],
        size_m=rules.cell_size_m,
        content=parts.take(kept),
        sample=partial(bodies.sample, centers[kept]),
    )
