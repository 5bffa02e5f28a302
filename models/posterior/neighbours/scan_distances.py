"""Measure offsets from nodes to their neighbours in scans: closest points, and pieces of clipped stuff."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from models.citymap.cells import CellTable
from models.citymap.gallery import PointClouds
from models.citymap.hints import HINT_REACH_M
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.posterior.neighbours.scan_pieces import PieceFinder, Tiles

PIECE = 0.6  # a piece has at least this share of the points that a part has; cubes of nodes and of cells differ
LARGE_M = 8.0  # things no larger than this are counted as whole wherever they are near
Rows = tuple[Ints, Ints, Floats, npt.NDArray[np.bool_], Ints]


def _of(values: Ints, wanted: int) -> Ints:
    rows: Ints = np.flatnonzero(values == wanted)
    return rows


@dataclass(frozen=True, slots=True, eq=False)
class ScanWays:
    """Point clouds and nodes, prepared to measure instances in chunks."""

    bodies: PointClouds
    cells: CellTable
    nodes_m: Floats  # [M, 3], at the height of their owners
    trees: dict[int, tuple[Ints, cKDTree]]  # of each scene, its nodes
    tiles: Tiles
    shown: Ints  # rows of the cells' parts, by instance
    shown_starts: Ints

    @classmethod
    def build(cls, bodies: PointClouds, cells: CellTable, nodes: Floats, owner: Ints, scene: Ints) -> "ScanWays":
        """Prepare nodes [M, 2] with owner cells [M]; cells are in scenes [N]."""
        trees = {int(s): (rows, cKDTree(nodes[rows])) for s in np.unique(scene) if len(rows := _of(scene[owner], s))}
        shown = np.argsort(bodies.part_instances, kind="stable")
        starts = np.searchsorted(bodies.part_instances[shown], np.arange(len(bodies.scene) + 1))
        at = np.column_stack([nodes, cells.center_m[owner, 2]])
        return cls(bodies, cells, at, trees, Tiles.build(nodes, owner, cells), shown, starts)

    def measure(self, instances: Ints) -> Rows:
        """Return (node, instance, way, whole, part or -1) of the nodes around instances."""
        empty = np.zeros(0, np.int64)
        found: list[Rows] = [(empty, empty, np.zeros((0, 2)), np.zeros(0, np.bool_), empty)]
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
            found.append((near, np.full(len(near), i), way, whole, part))
        node, instance, ways, wholes, parts = (np.concatenate(column) for column in zip(*found, strict=True))
        return node, instance, ways, wholes, parts

    def _near(self, i: int, xyz: Floats) -> tuple[Ints, Floats]:
        """Return the nodes [K] within reach of points xyz [P, 3], and the way [K, 2] to each."""
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
        """Return whether [K] enough of a thing is in the cube around each node."""
        half_m = self.cells.size_m / 2
        plane = cKDTree(xyz[:, :2], balanced_tree=False)
        inside = plane.query_ball_point(self.nodes_m[near, :2], half_m, p=np.inf, return_length=True)
        found: npt.NDArray[np.bool_] = inside >= self.bodies.thing_share * len(xyz)
        return found

    def _apart(self, near: Ints, way: Floats, xyz: Floats, shown: Ints) -> tuple[Ints, Floats, Ints]:
        """Return (node, way, part or -1) of stuff: one row per piece where a node has several around it."""
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
