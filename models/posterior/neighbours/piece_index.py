"""The neighbour index of a map of pieces, which computes neighbours on demand: two microseconds a node."""

from collections.abc import Iterator
from dataclasses import astuple, dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np
import numpy.typing as npt
from safetensors import SafetensorError
from safetensors.numpy import save_file

from models.citymap.cells import CELLS_PER_BLOCK, CellTable, PartTable
from models.citymap.geometry.closest_points import CROWN_M, closest_instances
from models.citymap.geometry.cutting import cut_pieces
from models.citymap.geometry.pieces import PieceTable
from models.citymap.geometry.solids import THING
from models.citymap.geometry.tiling import TILE_M
from models.citymap.hints import BEST_CELL_REACH_M, HINT_REACH_M
from models.citymap.map_geometry import PieceGeometry
from models.citymap.points import Ints, ranges
from models.citymap.types import CutRules, Floats
from models.compiled import compiled
from models.errors import IndexBroken
from models.files import map_arrays
from models.posterior.neighbours.map_objects import MapObjects
from models.posterior.neighbours.neighbours import STEP_M, Neighbours
from models.posterior.neighbours.nodes import SPACING_M, central_nodes, owner_of, put_in_order, slices
from models.spool import row_blocks, spooled, spooled_zeros
from models.strings import compact

FILE: Final = "pieces.safetensors"
REACH_M: Final = BEST_CELL_REACH_M + HINT_REACH_M + CROWN_M  # from a cell's centre to what its nodes read
MAX_SHARE_TAKEN: Final = 0.8  # of the pieces; taking more takes more memory than it saves
OBJECT_COLUMNS: Final = ("instance", "rgb", "parts", "is_flat")


@dataclass(frozen=True, slots=True, eq=False)
class PieceNeighbourIndex:
    """A `NeighbourIndex` of a map of pieces."""

    objects: MapObjects  # the map's instances
    cell_starts: Ints
    offset: npt.NDArray[np.int8]  # [M, 2] each node in steps of the grid, from the node next to its cell's centre
    pieces: PieceTable
    rules: CutRules
    center_m: Floats  # [N, 2] of the cells

    @classmethod
    def build(cls, bodies: PieceGeometry, cells: CellTable) -> "PieceNeighbourIndex":
        """Build the index of a gallery."""
        objects, center_m = MapObjects.from_instances(bodies, cells.parts), cells.center_m[:, :2]
        middle = _step_of(center_m)
        count = np.zeros(len(cells), np.int64)

        def count_nodes() -> Iterator[dict[str, Ints]]:
            for steps, owner in slices(cells):
                np.add(count, np.bincount(owner, minlength=len(cells)), out=count)
                yield {"owner": owner, "offset": (steps - middle[owner]).astype(np.int8)}

        spool = spooled(count_nodes())
        starts = np.concatenate([[0], np.cumsum(count)])
        offset, free = spooled_zeros(2 * int(starts[-1]), np.int8).reshape(-1, 2), starts[:-1].copy()
        for columns in row_blocks(spool):
            put_in_order(columns["owner"], columns["offset"], free, offset)
        return cls(objects, compact(starts), offset, _pieces_near(bodies.pieces, center_m), bodies.rules, center_m)

    @property
    def cuts(self) -> bool:
        """As in `NeighbourIndex`."""
        return True

    @property
    def num_bytes(self) -> int:
        """As in `NeighbourIndex`."""
        return sum(column.nbytes for column in self._columns().values())

    def positions_m(self, nodes: Ints) -> Floats:
        """As in `NeighbourIndex`."""
        return _positions_m(self.center_m, self.offset, nodes, self.owner(nodes))

    def middles(self, centers_m: Floats) -> Ints:
        """As in `NeighbourIndex`."""
        return central_nodes(self.cell_starts, _step_of(self.center_m), self.offset, SPACING_M, centers_m)

    def owner(self, nodes: Ints) -> Ints:
        """As in `NeighbourIndex`."""
        return owner_of(self.cell_starts, nodes)

    def around(self, nodes: Ints) -> Neighbours:
        """As in `NeighbourIndex`."""
        cell = self.owner(nodes)
        first = np.flatnonzero(np.diff(cell, prepend=-1))
        starts = np.append(first, len(nodes))
        node, part, steps = closest_instances(
            self.pieces,
            self.rules,
            self.center_m[cell[first]],
            _positions_m(self.center_m, self.offset, nodes, cell),
            starts,
            HINT_REACH_M,
            STEP_M,
        )
        known = self.objects.parts[part] > 0
        if not known.all():  # after `take`
            node, part, steps = node[known], part[known], steps[known]
        return Neighbours(node, part, steps, np.ones(len(node), np.bool_))

    def cut(self, centers_m: Floats) -> PartTable:
        """Return the parts in the cubes around centres [N, 3]."""
        return cut_pieces(self.pieces, self.objects.rgb, centers_m, self.rules)

    def take(self, cells: Ints, parts: Ints) -> "PieceNeighbourIndex":
        """As in `NeighbourIndex`."""
        return replace(
            self,
            objects=replace(self.objects, parts=parts),
            cell_starts=np.concatenate([[0], np.cumsum(np.diff(self.cell_starts)[cells])]),
            offset=self.offset[ranges(self.cell_starts[cells], self.cell_starts[cells + 1])],
            center_m=self.center_m[cells],
        )

    def save(self, directory: Path) -> None:
        """Write the index to one file."""
        save_file(self._columns(), directory / FILE)

    @classmethod
    def load(cls, directory: Path, cells: CellTable) -> "PieceNeighbourIndex":
        """Load a saved index.

        Raises:
            IndexBroken: the file is missing or damaged.
        """
        try:
            columns = map_arrays(directory / FILE)[0]
            instance, rgb, parts, is_flat = (columns[f"things.{name}"] for name in OBJECT_COLUMNS)
            objects = MapObjects(instance, rgb, parts, is_flat)
            pieces = PieceTable.from_columns({name[7:]: c for name, c in columns.items() if name.startswith("pieces.")})
            rules = CutRules(*columns["rules"].tolist())
            starts, offset = columns["cell_starts"], columns["offset"]
            if len(starts) != len(cells) + 1 or starts[-1] != len(offset):
                raise ValueError(f"{len(starts)} starts and {len(offset)} nodes of {len(cells)} cells")
        except (OSError, SafetensorError, KeyError, TypeError, ValueError, IndexError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; rebuild it with 'hereabouts index'") from error
        return cls(objects, starts, offset, pieces, rules, cells.center_m[:, :2])

    def _columns(self) -> dict[str, np.ndarray]:
        columns = {f"things.{name}": getattr(self.objects, name) for name in OBJECT_COLUMNS}
        columns |= {f"pieces.{name}": column for name, column in self.pieces.columns().items()}
        columns |= {
            "cell_starts": self.cell_starts,
            "offset": self.offset,
            "rules": np.array(astuple(self.rules), dtype=np.float64),
        }
        return {name: np.ascontiguousarray(column) for name, column in columns.items()}


def _pieces_near(pieces: PieceTable, centers_m: Floats) -> PieceTable:
    """Return the pieces that cells around centres [N, 2] and their nodes read, if that is much less than all."""
    is_near = pieces.form == THING
    for n in range(0, len(centers_m), CELLS_PER_BLOCK):
        block_m = centers_m[n : n + CELLS_PER_BLOCK]
        first, last = (np.floor((block_m + end) / TILE_M + 0.5).astype(np.int64) for end in (-REACH_M, REACH_M))
        is_near[pieces.in_tiles(first, last)[1]] = True
    return pieces.take(is_near) if is_near.mean() < MAX_SHARE_TAKEN else pieces


@compiled
def _positions_m(center_m: Floats, offset: Ints, nodes: Ints, cell: Ints) -> Floats:
    positions_m = np.empty((len(nodes), 2))
    for n in range(len(nodes)):
        for axis in range(2):
            positions_m[n, axis] = (np.rint(center_m[cell[n], axis] / SPACING_M) + offset[nodes[n], axis]) * SPACING_M
    return positions_m


def _step_of(center_m: Floats) -> Ints:
    """Return the node [N, 2] next to each centre, in steps of the grid."""
    return np.round(center_m / SPACING_M).astype(np.int64)
