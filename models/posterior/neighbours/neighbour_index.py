"""The neighbour index of a map, which the hint posterior reads.

Positions are the nodes of a fine grid; each is owned by the cell with the nearest centre. A node knows every object
within 15 m by the offset from its closest point, also if the owner's cube has cut it off. An instance in several pieces
around the node counts once per piece.
"""

from pathlib import Path
from typing import Protocol

import numpy as np

from models.citymap.cells import CellTable
from models.citymap.gallery import PointClouds
from models.citymap.map_geometry import PieceGeometry
from models.citymap.points import Ints
from models.citymap.types import Floats, Progress
from models.posterior.neighbours.map_objects import MapObjects
from models.posterior.neighbours.neighbours import Neighbours
from models.posterior.neighbours.piece_index import FILE, PieceNeighbourIndex
from models.posterior.neighbours.scan_index import ScanNeighbourIndex


class NeighbourIndex(Protocol):
    """The nodes of a map and their neighbours."""

    @property
    def objects(self) -> MapObjects:
        """The objects that may be neighbours."""
        ...

    @property
    def cell_starts(self) -> Ints:
        """[N + 1] int64, cell n owns the nodes cell_starts[n] to cell_starts[n + 1]."""
        ...

    def positions_m(self, nodes: Ints) -> Floats:
        """Return the positions [n, 2] of nodes, map frame."""
        ...

    def owner(self, nodes: Ints) -> Ints:
        """Return the cell [n] that owns each node."""
        ...

    def middles(self, centers_m: Floats) -> Ints:
        """Return the node [C] nearest to the centre of each cell that owns nodes, for centres [N, 2]."""
        ...

    @property
    def cuts(self) -> bool:
        """Whether it can also cut the parts of cells, which are then not stored."""
        ...

    @property
    def num_bytes(self) -> int:
        """The size on disk."""
        ...

    def around(self, nodes: Ints) -> Neighbours:
        """Return the neighbours of nodes [M], which are grouped by cell."""
        ...

    def take(self, cells: Ints, parts: Ints) -> "NeighbourIndex":
        """Return the index of some cells, in their order.

        `parts` [P] is the number of their parts that show each object; objects without any are dropped.
        """
        ...

    def save(self, directory: Path) -> None:
        """Write the index to one file."""
        ...


def build_neighbour_index(
    bodies: PointClouds | PieceGeometry, cells: CellTable, progress: Progress | None = None, rows: range | None = None
) -> NeighbourIndex:
    """Build the neighbour index of a gallery, or of a range of its cells with the nodes that they own.

    `progress` is called with instances done and to do.
    """
    if not isinstance(bodies, PieceGeometry):
        return ScanNeighbourIndex.build(bodies, cells, progress, rows)
    every = PieceNeighbourIndex.build(bodies, cells)
    return every if rows is None else every.take(np.arange(rows.start, rows.stop), every.objects.parts)


def load_neighbour_index(directory: Path, cells: CellTable) -> NeighbourIndex:
    """Load a saved index.

    Raises:
        IndexBroken: a file is missing or damaged.
    """
    if (directory / FILE).exists():
        return PieceNeighbourIndex.load(directory, cells)
    return ScanNeighbourIndex.load(directory, cells)
