"""What lies around every position of a map: the table that the hint posterior reads.

Positions are the nodes of a fine grid, each owned by the cell whose centre is nearest. A node knows, of every instance
within 15 m, the way from the instance's closest point, whether or not the instance is in the owner's cube: hints speak
of things that a cell has cut off. Of an instance that is in several pieces around it, a node knows each.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
import numpy.typing as npt
from safetensors import SafetensorError, safe_open
from safetensors.numpy import save_file
from scipy.spatial import cKDTree

from models.city.bodies import PieceBodies
from models.city.cells import CellTable
from models.city.gallery import Clouds
from models.city.hints import BEST_CELL_REACH_M, HINT_REACH_M
from models.city.points import Ints, ranges
from models.city.processes import map_forked
from models.city.types import Floats, Progress
from models.errors import IndexBroken
from models.posterior.piece_ways import PieceWays, Rows
from models.posterior.scan_ways import ScanWays

SPACING_M = 1.5
STEP_M = HINT_REACH_M / 127  # of the stored ways
FILE = "surroundings.safetensors"
CHUNK = 64  # instances or cells a task


@dataclass(frozen=True, slots=True, eq=False)
class Surroundings:
    """Nodes, and what is around each.

    Attributes:
        cell_starts: [N + 1] int64, cell n owns the nodes cell_starts[n] to cell_starts[n + 1].
        nodes_m: [M, 2] float32, map frame.
        starts: [M + 1] int64, node m has the rows starts[m] to starts[m + 1]: whole ones first, nearest first.
        part: [R] int32, row of the cells' parts; that of the owner's cell if it has one of the instance, or of the
            piece where the instance is in several.
        way: [R, 2] int8, node minus the instance's (or piece's) closest point (east, north), in steps of STEP_M.
        whole: [R] bool, False for a thing of which less than Clouds.thing_share is in the cube around the node.
    """

    cell_starts: Ints
    nodes_m: Floats
    starts: Ints
    part: Ints
    way: npt.NDArray[np.int8]
    whole: npt.NDArray[np.bool_]

    @classmethod
    def of(
        cls,
        bodies: Clouds | PieceBodies,
        cells: CellTable,
        progress: Progress | None = None,
    ) -> "Surroundings":
        """Measure a gallery's surroundings; in several processes when there is much to do.

        Args:
            bodies: what stands in the map.
            cells: the gallery.
            progress: called with instances done and to do.
        """
        scene = np.unique(cells.scenes, return_inverse=True)[1]
        nodes, owner = _grid(cells, scene)
        work: Callable[[Ints], Rows]
        if isinstance(bodies, PieceBodies):
            work, tasks = PieceWays(bodies, cells, nodes, owner).measure, len(cells)
        else:
            work, tasks = ScanWays.of(bodies, cells, nodes, owner, scene).measure, len(bodies.scene)
        chunks = [np.arange(i, min(i + CHUNK, tasks)) for i in range(0, tasks, CHUNK)]
        found, done = [], 0
        for measured in map_forked(work, chunks):
            found.append(measured)
            done += CHUNK
            if progress:
                progress("measure surroundings", min(done, tasks), tasks)
        node, instance, way_m, whole, piece = (np.concatenate(column) for column in zip(*found, strict=True))
        way = np.round(way_m / STEP_M).astype(np.int8)
        part = np.where(piece >= 0, piece, _parts_of(cells, bodies.part_instance(cells), owner[node], instance))
        known = part >= 0
        node, part, way, whole = node[known], part[known], way[known], whole[known]
        # nearest first
        order = np.lexsort(((way.astype(np.int32) ** 2).sum(axis=1), ~whole, node))
        return cls(
            cell_starts=np.searchsorted(owner, np.arange(len(cells) + 1)),
            nodes_m=nodes.astype(np.float32),
            starts=np.searchsorted(node[order], np.arange(len(nodes) + 1)),
            part=part[order].astype(np.int32),
            way=way[order],
            whole=whole[order],
        )

    @property
    def bytes_a_cell(self) -> float:
        """What it costs on disk, on average."""
        total: int = sum(getattr(self, f.name).nbytes for f in fields(self))
        return total / max(1, len(self.cell_starts) - 1)

    def take(self, cells: Ints, part_of: Ints) -> "Surroundings":
        """Those of some cells.

        Args:
            cells: rows, in the order wanted.
            part_of: [R of all] new row of each part, -1 for parts that are gone, whose rows are left out.
        """
        nodes = ranges(self.cell_starts[cells], self.cell_starts[cells + 1])
        rows = ranges(self.starts[nodes], self.starts[nodes + 1])
        part = part_of[self.part[rows]]
        node = np.repeat(np.arange(len(nodes)), np.diff(self.starts)[nodes])
        kept = part >= 0
        return Surroundings(
            cell_starts=np.concatenate([[0], np.cumsum(np.diff(self.cell_starts)[cells])]),
            nodes_m=self.nodes_m[nodes],
            starts=np.searchsorted(node[kept], np.arange(len(nodes) + 1)),
            part=part[kept].astype(np.int32),
            way=self.way[rows][kept],
            whole=self.whole[rows][kept],
        )

    def save(self, directory: Path) -> None:
        """Write one file."""
        save_file({f.name: np.ascontiguousarray(getattr(self, f.name)) for f in fields(self)}, directory / FILE)

    @classmethod
    def load(cls, directory: Path) -> "Surroundings":
        """Read what `save` wrote.

        Raises:
            IndexBroken: the file is missing or holds something else.
        """
        try:
            with safe_open(directory / FILE, framework="numpy") as file:
                return cls(**{f.name: file.get_tensor(f.name) for f in fields(cls)})
        except (OSError, SafetensorError, TypeError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; rebuild it with 'hereabouts index'") from error


def _grid(cells: CellTable, scene: Ints) -> tuple[Floats, Ints]:
    """Nodes [M, 2] within 15 m of a centre, and the cell [M] that owns each, in order of owner."""
    nodes, owners = [], []
    for s in np.unique(scene):
        rows = np.flatnonzero(scene == s)
        centers = cells.center_m[rows, :2]
        low, high = centers.min(axis=0) - BEST_CELL_REACH_M, centers.max(axis=0) + BEST_CELL_REACH_M
        axes = [
            np.arange(np.floor(a / SPACING_M), np.ceil(b / SPACING_M) + 1) * SPACING_M
            for a, b in zip(low, high, strict=True)
        ]
        grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
        distance, nearest = cKDTree(centers).query(grid, distance_upper_bound=BEST_CELL_REACH_M)
        near = np.isfinite(distance)
        nodes.append(grid[near])
        owners.append(rows[nearest[near]])
    owner = np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    return np.concatenate(nodes)[order], owner[order]


def _parts_of(cells: CellTable, part_instance: Ints, owner: Ints, instance: Ints) -> Ints:
    """[R] part that shows an instance in a cell; of another cell if that has none; -1 if none has."""
    count = int(part_instance.max()) + 1 if len(part_instance) else 1
    known = np.where(instance < count, instance, -1)
    keys = cells.parts.cube.astype(np.int64) * count + part_instance
    order = np.lexsort((-cells.parts.count, keys))  # the largest part of an instance first
    position = np.minimum(np.searchsorted(keys[order], owner * count + known), len(keys) - 1)
    own = order[position]
    anywhere = np.full(count + 1, -1, dtype=np.int64)
    anywhere[part_instance[::-1]] = np.arange(len(part_instance))[::-1]
    found: Ints = np.where(keys[own] == owner * count + known, own, anywhere[known])
    return found
