"""The neighbour index of a scan: a table, because it takes minutes to measure."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np
import numpy.typing as npt
from safetensors import SafetensorError, safe_open
from safetensors.numpy import save_file

from models.citymap.cells import CellTable
from models.citymap.gallery import PointClouds
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats, Progress
from models.errors import IndexBroken
from models.posterior.neighbours.map_objects import MapObjects
from models.posterior.neighbours.neighbours import STEP_M, Neighbours
from models.posterior.neighbours.nodes import central_nodes, grid, owner_of
from models.posterior.neighbours.scan_distances import ScanDistances
from models.processes import map_forked

FILE: Final = "surroundings.safetensors"
# From fields to columns of the file.
FILE_COLUMNS: Final = {
    "cell_starts": "cell_starts", "nodes_m": "nodes_m", "starts": "starts", "part": "part", "offset": "way",
    "whole": "whole",
}  # fmt: skip
ROW_COLUMNS: Final = ("nodes_m", "part", "offset", "whole")
INSTANCES_PER_TASK: Final = 64


@dataclass(frozen=True, slots=True, eq=False)
class ScanNeighbourIndex:
    """A `NeighbourIndex` of a scan, with the neighbours of all nodes."""

    objects: MapObjects  # the parts of the cells
    cell_starts: Ints
    nodes_m: Floats  # [M, 2] float32, map frame
    starts: Ints  # [M + 1] node m has the rows starts[m] to starts[m + 1], in the order of `Neighbours`
    part: Ints  # [R] int32, index of the object: a part of the owner's cell if possible, or of the piece
    offset: npt.NDArray[np.int8]  # [R, 2] see `Neighbours`
    whole: npt.NDArray[np.bool_]  # [R] see `Neighbours`

    @classmethod
    def build(
        cls, bodies: PointClouds, cells: CellTable, progress: Progress | None = None, rows: range | None = None
    ) -> "ScanNeighbourIndex":
        """Build the index of a gallery or of a range of its cells, in several processes if it is large.

        `progress` is called with instances done and to do.
        """
        scene, rows = np.unique(cells.scenes, return_inverse=True)[1], range(len(cells)) if rows is None else rows
        nodes, owner = grid(cells)
        chosen = (owner >= rows.start) & (owner < rows.stop)
        nodes, owner = nodes[chosen], owner[chosen]
        tasks = len(bodies.scene)
        chunks = [np.arange(i, min(i + INSTANCES_PER_TASK, tasks)) for i in range(0, tasks, INSTANCES_PER_TASK)]
        results, done = [], 0
        for measured in map_forked(ScanDistances.build(bodies, cells, nodes, owner, scene).measure, chunks):
            results.append(measured)
            done += INSTANCES_PER_TASK
            if progress:
                progress("measure surroundings", min(done, tasks), tasks)
        node, instance, offset_m, whole, piece = (np.concatenate(column) for column in zip(*results, strict=True))
        offset = np.round(offset_m / STEP_M).astype(np.int8)
        part = np.where(piece >= 0, piece, _parts_of(cells, bodies.part_instances, owner[node], instance))
        known = part >= 0
        node, part, offset, whole = node[known], part[known], offset[known], whole[known]
        # nearest first
        order = np.lexsort(((offset.astype(np.int32) ** 2).sum(axis=1), ~whole, node))
        return cls(
            objects=MapObjects.from_parts(cells.parts),
            cell_starts=np.searchsorted(owner, np.arange(rows.start, rows.stop + 1)),
            nodes_m=nodes.astype(np.float32),
            starts=np.searchsorted(node[order], np.arange(len(nodes) + 1)),
            part=part[order].astype(np.int32),
            offset=offset[order],
            whole=whole[order],
        )

    @classmethod
    def concatenate(cls, parts: Sequence["ScanNeighbourIndex"]) -> "ScanNeighbourIndex":
        """Concatenate the indexes of consecutive parts of a gallery; at least one."""
        columns = {name: np.concatenate([getattr(part, name) for part in parts]) for name in ROW_COLUMNS}
        for name in ("cell_starts", "starts"):
            sizes = np.concatenate([np.diff(getattr(part, name)) for part in parts])
            columns[name] = np.concatenate([[0], np.cumsum(sizes)])
        return cls(objects=parts[0].objects, **columns)

    @property
    def cuts(self) -> bool:
        """As in `NeighbourIndex`."""
        return False

    @property
    def num_bytes(self) -> int:
        """The size on disk."""
        return sum(getattr(self, name).nbytes for name in FILE_COLUMNS)

    def positions_m(self, nodes: Ints) -> Floats:
        """As in `NeighbourIndex`."""
        return self.nodes_m[nodes].astype(np.float64)

    def middles(self, centers_m: Floats) -> Ints:
        """As in `NeighbourIndex`."""
        return central_nodes(self.cell_starts, np.zeros((len(centers_m), 2)), self.nodes_m, 1.0, centers_m)

    def owner(self, nodes: Ints) -> Ints:
        """As in `NeighbourIndex`."""
        return owner_of(self.cell_starts, nodes)

    def around(self, nodes: Ints) -> Neighbours:
        """As in `NeighbourIndex`."""
        begin, end = self.starts[nodes], self.starts[nodes + 1]
        rows = ranges(begin, end)
        node = np.repeat(np.arange(len(nodes)), end - begin)
        return Neighbours(node, self.part[rows].astype(np.int64), self.offset[rows], self.whole[rows])

    def take(self, cells: Ints, parts: Ints) -> "ScanNeighbourIndex":
        """As in `NeighbourIndex`."""
        nodes = ranges(self.cell_starts[cells], self.cell_starts[cells + 1])
        rows = ranges(self.starts[nodes], self.starts[nodes + 1])
        known = parts[self.part[rows]] > 0
        node = np.repeat(np.arange(len(nodes)), np.diff(self.starts)[nodes])
        return ScanNeighbourIndex(
            objects=replace(self.objects, parts=parts),
            cell_starts=np.concatenate([[0], np.cumsum(np.diff(self.cell_starts)[cells])]),
            nodes_m=self.nodes_m[nodes],
            starts=np.searchsorted(node[known], np.arange(len(nodes) + 1)),
            part=self.part[rows][known],
            offset=self.offset[rows][known],
            whole=self.whole[rows][known],
        )

    def save(self, directory: Path) -> None:
        """Write the index to one file; the objects are in the gallery's."""
        columns = {column: np.ascontiguousarray(getattr(self, name)) for name, column in FILE_COLUMNS.items()}
        save_file(columns, directory / FILE)

    @classmethod
    def load(cls, directory: Path, cells: CellTable) -> "ScanNeighbourIndex":
        """Load a saved index.

        Raises:
            IndexBroken: the file is missing or damaged.
        """
        try:
            with safe_open(directory / FILE, framework="numpy") as file:
                return cls(MapObjects.from_parts(cells.parts), *map(file.get_tensor, FILE_COLUMNS.values()))
        except (OSError, SafetensorError) as error:
            raise IndexBroken(f"{directory / FILE} cannot be read; rebuild it with 'hereabouts index'") from error


def _parts_of(cells: CellTable, part_instance: Ints, owner: Ints, instance: Ints) -> Ints:
    """Return the part [R] that shows an instance in a cell, else in another cell; -1 without any."""
    count = int(part_instance.max()) + 1 if len(part_instance) else 1
    known = np.where(instance < count, instance, -1)
    keys = cells.parts.cube.astype(np.int64) * count + part_instance
    order = np.lexsort((-cells.parts.count, keys))  # the largest part of an instance first
    position = np.minimum(np.searchsorted(keys[order], owner * count + known), len(keys) - 1)
    own = order[position]
    anywhere = np.full(count + 1, -1, dtype=np.int64)
    anywhere[part_instance[::-1]] = np.arange(len(part_instance))[::-1]
    return np.where(keys[own] == owner * count + known, own, anywhere[known])
