"""The positions of the posterior: nodes of a fine grid."""

from collections.abc import Iterator
from typing import Any, Final

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from models.citymap.cells import CellTable
from models.citymap.hints import BEST_CELL_REACH_M
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import compiled

SPACING_M: Final = 1.5  # of the grid
COLUMNS_PER_SLICE: Final = 32
LINES_AROUND: Final = np.arange(
    -int(BEST_CELL_REACH_M // SPACING_M), int(BEST_CELL_REACH_M // SPACING_M) + 2, dtype=np.int32
)


def grid(cells: CellTable) -> tuple[Floats, Ints]:
    """Return nodes [M, 2] within 15 m of a centre and the nearest cell [M], which owns each, in order of owner."""
    steps, owners = zip(*slices(cells), strict=True)
    owner = np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    return np.concatenate(steps)[order] * SPACING_M, owner[order].astype(np.int64)


def slices(cells: CellTable) -> Iterator[tuple[Ints, Ints]]:
    """Yield nodes [m, 2] int32 in steps of the grid and the cell [m] int32 that owns each, in slices of columns."""
    scene = np.unique(cells.scenes, return_inverse=True)[1]
    for s in np.unique(scene):
        rows = np.flatnonzero(scene == s).astype(np.int32)
        centers = cells.center_m[rows, :2]
        tree, eastward = cKDTree(centers), centers[np.argsort(centers[:, 0])]
        low, high = eastward[[0, -1], 0] + np.array([-1, 1]) * BEST_CELL_REACH_M
        for first in range(int(low // SPACING_M), int(high // SPACING_M) + 2, COLUMNS_PER_SLICE):
            columns = np.arange(first, first + COLUMNS_PER_SLICE, dtype=np.int32)
            ends_m = columns[[0, -1]] * SPACING_M + np.array([-1, 1]) * BEST_CELL_REACH_M
            northing_m = eastward[slice(*np.searchsorted(eastward[:, 0], ends_m)), 1]
            lines = np.unique((northing_m // SPACING_M).astype(np.int32)[:, None] + LINES_AROUND)
            steps = np.stack(np.meshgrid(columns, lines, indexing="ij"), axis=-1)
            steps = steps.reshape(-1, 2)
            distance, nearest = tree.query(steps * SPACING_M, distance_upper_bound=BEST_CELL_REACH_M)
            near = np.isfinite(distance)
            yield steps[near], rows[nearest[near]]


@compiled
def put_in_order(owner: Ints, rows: npt.NDArray[Any], free: Ints, ordered: npt.NDArray[Any]) -> None:
    """Scatter rows [m, 2] to the next free places [N] of their owners [m]; advance these."""
    for n in range(len(owner)):
        place = free[owner[n]]
        ordered[place, 0], ordered[place, 1] = rows[n, 0], rows[n, 1]
        free[owner[n]] = place + 1


@compiled
def owner_of(cell_starts: Ints, nodes: Ints) -> Ints:
    """Return the cell [n] that owns each node; cell n owns nodes cell_starts[n] to cell_starts[n + 1].

    Fast if nodes are grouped by cell.
    """
    owner, cell = np.empty(len(nodes), np.int64), 0
    for n in range(len(nodes)):
        if not cell_starts[cell] <= nodes[n] < cell_starts[cell + 1]:
            cell = np.searchsorted(cell_starts, nodes[n], side="right") - 1
        owner[n] = cell
    return owner


@compiled
def central_nodes(
    cell_starts: Ints, origins: npt.NDArray[Any], nodes: npt.NDArray[Any], step_m: float, centers_m: Floats
) -> Ints:
    """Return the node [C] nearest to the centre of each cell that has nodes.

    Cell n owns nodes cell_starts[n] to cell_starts[n + 1]; nodes [M, 2] count steps from the cell's origin [N, 2].
    """
    central, count = np.empty(len(centers_m), np.int64), 0
    for n in range(len(centers_m)):
        nearest_m = np.inf
        for node in range(cell_starts[n], cell_starts[n + 1]):
            x, y = (origins[n, 0] + nodes[node, 0]) * step_m, (origins[n, 1] + nodes[node, 1]) * step_m
            distance_m = np.hypot(x - centers_m[n, 0], y - centers_m[n, 1])
            if distance_m < nearest_m:
                nearest_m, central[count] = distance_m, node
        if nearest_m < np.inf:
            count += 1
    return central[:count].copy()


@compiled
def is_coarse(positions_m: Floats, factor: Ints) -> npt.NDArray[np.bool_]:
    """Return whether nodes [M, 2] belong to the grid that is coarser by a factor [M]."""
    coarse = np.empty(len(positions_m), np.bool_)
    for n in range(len(positions_m)):
        x, y = np.rint(positions_m[n, 0] / SPACING_M), np.rint(positions_m[n, 1] / SPACING_M)
        coarse[n] = x % factor[n] == 0 and y % factor[n] == 0
    return coarse
