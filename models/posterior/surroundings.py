"""What lies around every position of a map: the table that the hint posterior reads.

Positions are the nodes of a fine grid, each owned by the cell whose centre is nearest. A node knows, of every instance
within 15 m, the way from the instance's closest point, whether or not the instance is in the owner's cube: hints speak
of things that a cell has cut off. Of an instance that is in several pieces around it, a node knows each.
"""

from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
import numpy.typing as npt
from safetensors import SafetensorError, safe_open
from safetensors.numpy import save_file
from scipy.spatial import cKDTree

from models.city.cells import CellTable
from models.city.gallery import Bodies
from models.city.hints import BEST_CELL_REACH_M, HINT_REACH_M
from models.city.points import Ints, ranges
from models.city.processes import map_forked
from models.city.types import Floats, Progress
from models.errors import IndexBroken
from models.posterior.pieces import PieceFinder, Tiles

SPACING_M = 1.5
STEP_M = HINT_REACH_M / 127  # of the stored ways
FILE = "surroundings.safetensors"
CHUNK = 64  # instances a task
PIECE = 0.6  # a piece has at least this share of the points that a part has; cubes of nodes and of cells differ
LARGE_M = 8.0  # things no larger than this are counted as whole wherever they are near


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
        whole: [R] bool, False for a thing of which less than Bodies.thing_share is in the cube around the node.
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
        bodies: Bodies,
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
        work = _Measuring.of(bodies, cells, nodes, owner, scene).measure
        chunks = [np.arange(i, min(i + CHUNK, len(bodies.scene))) for i in range(0, len(bodies.scene), CHUNK)]
        found, done = [], 0
        for measured in map_forked(work, chunks):
            found.append(measured)
            done += CHUNK
            if progress:
                progress("measure surroundings", min(done, len(bodies.scene)), len(bodies.scene))
        node, instance, way, whole, piece = (np.concatenate(column) for column in zip(*found, strict=True))
        part = np.where(piece >= 0, piece, _parts_of(cells, bodies.part_instance, owner[node], instance))
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


def _of(values: Ints, wanted: int) -> Ints:
    rows: Ints = np.flatnonzero(values == wanted)
    return rows


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


Rows = tuple[Ints, Ints, npt.NDArray[np.int8], npt.NDArray[np.bool_], Ints]


@dataclass(frozen=True, slots=True, eq=False)
class _Measuring:
    """Bodies and nodes, ready to be measured some instances at a time."""

    bodies: Bodies
    cells: CellTable
    nodes_m: Floats  # [M, 3], at the height of their owners
    trees: dict[int, tuple[Ints, cKDTree]]  # of each scene, its nodes
    tiles: Tiles
    shown: Ints  # rows of the cells' parts, by instance
    shown_starts: Ints

    @classmethod
    def of(cls, bodies: Bodies, cells: CellTable, nodes: Floats, owner: Ints, scene: Ints) -> "_Measuring":
        """To measure nodes [M, 2] that are owned by some cells [M], which are in some scenes [N]."""
        trees = {int(s): (rows, cKDTree(nodes[rows])) for s in np.unique(scene) if len(rows := _of(scene[owner], s))}
        shown = np.argsort(bodies.part_instance, kind="stable")
        starts = np.searchsorted(bodies.part_instance[shown], np.arange(len(bodies.scene) + 1))
        at = np.column_stack([nodes, cells.center_m[owner, 2]])
        return cls(bodies, cells, at, trees, Tiles.of(nodes, owner, cells), shown, starts)

    def measure(self, instances: Ints) -> Rows:
        """(node, instance, way, whole, part or -1) of the nodes around some instances."""
        empty = np.zeros(0, np.int64)
        found: list[Rows] = [(empty, empty, np.zeros((0, 2), np.int8), np.zeros(0, np.bool_), empty)]
        for i in instances.tolist():
            shown = self.shown[self.shown_starts[i] : self.shown_starts[i + 1]]
            xyz = self.bodies.xyz[self.bodies.starts[i] : self.bodies.starts[i + 1]].astype(np.float64)
            if not len(xyz) or not len(shown) or int(self.bodies.scene[i]) not in self.trees:
                continue
            near, way = self._near(i, xyz)
            whole, part = np.ones(len(near), np.bool_), np.full(len(near), -1)
            if len(near) and np.ptp(xyz[:, :2], axis=0).max() > LARGE_M:
                if self.bodies.is_thing[i]:
                    whole = self._is_near(near, xyz)
                else:
                    near, way, part = self._apart(near, way, xyz, shown)
                    whole = np.ones(len(near), np.bool_)
            found.append((near, np.full(len(near), i), np.round(way / STEP_M).astype(np.int8), whole, part))
        node, instance, ways, wholes, parts = (np.concatenate(column) for column in zip(*found, strict=True))
        return node, instance, ways, wholes, parts

    def _near(self, i: int, xyz: Floats) -> tuple[Ints, Floats]:
        """[K] nodes in reach of an instance with points xyz [P, 3], and [K, 2] the way to each."""
        rows, tree = self.trees[int(self.bodies.scene[i])]
        low, high = xyz[:, :2].min(axis=0), xyz[:, :2].max(axis=0)
        reach = np.linalg.norm(high - low) / 2 + HINT_REACH_M
        near = rows[np.sort(np.array(tree.query_ball_point((low + high) / 2, reach), dtype=np.int64))]
        if not len(near):
            return near, np.zeros((0, 2))
        bound = 2 * HINT_REACH_M
        distance, closest = cKDTree(xyz, balanced_tree=False).query(self.nodes_m[near], distance_upper_bound=bound)
        within = np.isfinite(distance)
        way = self.nodes_m[near[within], :2] - xyz[closest[within], :2]
        kept = np.hypot(*way.T) <= HINT_REACH_M
        return near[within][kept], way[kept]

    def _is_near(self, near: Ints, xyz: Floats) -> npt.NDArray[np.bool_]:
        """[K] whether enough of a thing is in the cube around each of some nodes."""
        half_m = self.cells.size_m / 2
        plane = cKDTree(xyz[:, :2], balanced_tree=False)
        inside = plane.query_ball_point(self.nodes_m[near, :2], half_m, p=np.inf, return_length=True)
        found: npt.NDArray[np.bool_] = inside >= self.bodies.thing_share * len(xyz)
        return found

    def _apart(self, near: Ints, way: Floats, xyz: Floats, shown: Ints) -> tuple[Ints, Floats, Ints]:
        """(node, way, part or -1) of stuff: of each piece where there are several around a node."""
        finder = PieceFinder(xyz, shown, self.cells, PIECE * self.bodies.min_part_points)
        pieces = finder.around(self.nodes_m[near], self.tiles.of_node[near], self.tiles)
        reached = np.hypot(*pieces.way.T) <= HINT_REACH_M
        node, part = near[pieces.node[reached]], pieces.part[reached]
        single = np.ones(len(near), np.bool_)
        single[pieces.node[reached]] = False
        return (
            np.concatenate([near[single], node]),
            np.concatenate([way[single], pieces.way[reached]]),
            np.concatenate([np.full(single.sum(), -1), part]),
        )


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
