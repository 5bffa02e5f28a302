"""What lies around every position of a map: what the hint posterior reads.

Positions are the nodes of a fine grid, each owned by the cell whose centre is nearest. Of a node is known, of every
thing within 15 m, the way from the thing's closest point, whether or not the thing is in the owner's cube: hints speak
of things that a cell has cut off. Of an instance that is in several pieces around it, each is known.
"""

from pathlib import Path
from typing import Protocol

import numpy as np

from models.citymap.cells import CellTable
from models.citymap.gallery import PointClouds
from models.citymap.map_geometry import PieceGeometry
from models.citymap.points import Ints
from models.citymap.types import Floats, Progress
from models.posterior.neighbours.map_objects import Things
from models.posterior.neighbours.neighbours import Around
from models.posterior.neighbours.piece_index import FILE, PieceSurroundings
from models.posterior.neighbours.scan_index import ScanSurroundings


class Surroundings(Protocol):
    """Nodes, and what is around them."""

    @property
    def things(self) -> Things:
        """What there may be."""
        ...

    @property
    def cell_starts(self) -> Ints:
        """[N + 1] int64, cell n owns the nodes cell_starts[n] to cell_starts[n + 1]."""
        ...

    def positions_m(self, nodes: Ints) -> Floats:
        """[n, 2] where some nodes are, map frame."""
        ...

    def owner(self, nodes: Ints) -> Ints:
        """[n] the cell that owns each of some nodes."""
        ...

    def middles(self, centers_m: Floats) -> Ints:
        """[C] of each cell that owns nodes the one that is nearest to its centre, of centres [N, 2]."""
        ...

    @property
    def cuts(self) -> bool:
        """Whether it can cut the parts of cells too, so that nothing else needs to have them."""
        ...

    @property
    def num_bytes(self) -> int:
        """What it takes on disk."""
        ...

    def around(self, nodes: Ints) -> Around:
        """What lies around some nodes [M]; those of a cell stand together."""
        ...

    def take(self, cells: Ints, parts: Ints) -> "Surroundings":
        """Those of some cells.

        Args:
            cells: rows, in the order wanted.
            parts: [P] how many of their parts are of each thing; of things without any nothing is known.
        """
        ...

    def forget(self) -> None:
        """Have what lies on disk take no memory until it is looked at."""
        ...

    def save(self, directory: Path) -> None:
        """Write one file."""
        ...


def surroundings_of(
    bodies: PointClouds | PieceGeometry, cells: CellTable, progress: Progress | None = None, rows: range | None = None
) -> Surroundings:
    """The surroundings of a gallery.

    Args:
        bodies: what stands in the map.
        cells: the gallery.
        progress: called with what is done and to do.
        rows: the cells that are wanted, one after the other, with the nodes that they own among all; None for all.
    """
    if not isinstance(bodies, PieceGeometry):
        return ScanSurroundings.of(bodies, cells, progress, rows)
    every = PieceSurroundings.of(bodies, cells)
    return every if rows is None else every.take(np.arange(rows.start, rows.stop), every.things.parts)


def load_surroundings(directory: Path, cells: CellTable) -> Surroundings:
    """Read what `save` wrote.

    Raises:
        IndexBroken: a file is missing or holds something else.
    """
    if (directory / FILE).exists():
        return PieceSurroundings.load(directory, cells)
    return ScanSurroundings.load(directory, cells)
