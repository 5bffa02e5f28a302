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

MIN_PIECE_SHARE = 0.6  # of the points that a part of a cell has at least; cubes of nodes and of cells differ
MAX_WHOLE_M = 8.0  # objects no larger count as whole wherever they are near
Rows = tuple[Ints, Ints, Floats, npt.NDArray[np.bool_], Ints]


@dataclass(frozen=True, slots=True, eq=False)
class ScanDistances:
    """Point clouds and nodes, prepared to measure instances in chunks."""

    bodies: PointClouds
    cells: CellTable
    nodes_m: Floats  # [M, 3], at the height of their owners
    trees: dict[int, tuple[Ints, cKDTree]]  # of each scene, its nodes
    tiles: Tiles
    shown: Ints  # rows of the cells' parts, by instance
    shown_starts: Ints

    @classmethod
    def build(cls, bodies: PointClouds, cells: CellTable, nodes: Floats, owner: Ints, scene: Ints) -> "ScanDistances":
        """Prepare nodes [M, 2] with owner cells [M]; cells are in scenes [N]."""
        trees = dict[int, tuple[Ints, cKDTree]]()
        for s in np.unique(scene[owner]).tolist():
            rows = np.flatnonzero(scene[owner] == s)
            trees[s] = rows, cKDTree(nodes[rows])
        shown = np.argsort(bodies.part_instances, kind="stable")
        starts = np.searchsorted(bodies.part_instances[shown], np.arange(len(bodies.scene) + 1))
        nodes_m = np.column_stack([nodes, cells.center_m[owner, 2]])
        return cls(bodies, cells, nodes_m, trees, Tiles.build(nodes, owner, cells), shown, starts)

    def measure(self, instances: Ints) -> Rows:
        """Return (node, instance, offset_m, whole, part or -1) of the nodes around instances."""
        empty = np.zeros(0, np.int64)
        results: list[Rows] = [(empty, empty, np.zeros((0, 2)), np.zeros(0, np.bool_), empty)]
        for i in instances.tolist():
            shown = self.shown[self.shown_starts[i] : self.shown_starts[i + 1]]
            xyz = self.bodies.xyz[self.bodies.starts[i] : self.bodies.starts[i + 1]].astype(np.float64)
            if not len(xyz) or not len(shown) or int(self.bodies.scene[i]) not in self.trees:
                continue
            near, offset_m = self._near(i, xyz)
            whole, part = np.ones(len(near), np.bool_), np.full(len(near), -1)
            if len(near) and np.ptp(xyz[:, :2], axis=0).max() > MAX_WHOLE_M:
                if self.bodies.is_thing[i]:
                    whole = self._is_near(near, xyz)
                else:
                    near, offset_m, part = self._apart(near, offset_m, xyz, shown)
                    whole = np.ones(len(near), np.bool_)
            results.append((near, np.full(len(near), i), offset_m, whole, part))
        node, instance, offsets_m, wholes, parts = (np.concatenate(column) for column in zip(*results, strict=True))
        return node, instance, offsets_m, wholes, parts

    def _near(self, i: int, xyz: Floats) -> tuple[Ints, Floats]:
        """Return the nodes [K] within reach of points xyz [P, 3], and the offset [K, 2] to each."""
        rows, tree = self.trees[int(self.bodies.scene[i])]
        low, high = xyz[:, :2].min(axis=0), xyz[:, :2].max(axis=0)
        reach = np.linalg.norm(high - low) / 2 + HINT_REACH_M
        near = rows[np.sort(np.array(tree.query_ball_point((low + high) / 2, reach), dtype=np.int64))]
        if not len(near):
            return near, np.zeros((0, 2))
        bound = 2 * HINT_REACH_M
        distance, closest = cKDTree(xyz, balanced_tree=False).query(self.nodes_m[near], distance_upper_bound=bound)
        within = np.isfinite(distance)
        offset_m = self.nodes_m[near[within], :2] - xyz[closest[within], :2]
        is_near = np.hypot(*offset_m.T) <= HINT_REACH_M
        return near[within][is_near], offset_m[is_near]

    def _is_near(self, near: Ints, xyz: Floats) -> npt.NDArray[np.bool_]:
        """Return whether [K] enough of an object is in the cube around each node."""
        half_m = self.cells.size_m / 2
        plane = cKDTree(xyz[:, :2], balanced_tree=False)
        inside = plane.query_ball_point(self.nodes_m[near, :2], half_m, p=np.inf, return_length=True)
        return inside >= self.bodies.thing_share * len(xyz)

    def _apart(self, near: Ints, offset_m: Floats, xyz: Floats, shown: Ints) -> tuple[Ints, Floats, Ints]:
        """Return (node, offset_m, part or -1) of stuff: one row per piece where a node has several around it."""
        finder = PieceFinder(xyz, shown, self.cells, MIN_PIECE_SHARE * self.bodies.min_part_points)
        pieces = finder.around(self.nodes_m[near], self.tiles.of_node[near], self.tiles)
        reached = np.hypot(*pieces.offset_m.T) <= HINT_REACH_M
        node, part = near[pieces.node[reached]], pieces.part[reached]
        single = np.ones(len(near), np.bool_)
        single[pieces.node[reached]] = False
        return (
            np.concatenate([near[single], node]),
            np.concatenate([offset_m[single], pieces.offset_m[reached]]),
            np.concatenate([np.full(single.sum(), -1), part]),
        )
