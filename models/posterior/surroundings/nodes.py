"""The positions that the posterior is over: nodes of a fine grid."""

from typing import Final

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from models.city.cells import CellTable
from models.city.hints import BEST_CELL_REACH_M
from models.city.points import Ints
from models.city.types import Floats

SPACING_M: Final = 1.5


def grid(cells: CellTable) -> tuple[Floats, Ints]:
    """Nodes [M, 2] within 15 m of a centre, and the cell [M] that owns each, in order of owner: the nearest one."""
    scene = np.unique(cells.scenes, return_inverse=True)[1]
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


def owner_of(cell_starts: Ints, nodes: Ints) -> Ints:
    """[n] the cell that owns each of some nodes, of cells that own cell_starts[n] to cell_starts[n + 1]."""
    owner: Ints = np.searchsorted(cell_starts, nodes, side="right") - 1
    return owner


def is_coarse(positions_m: Floats) -> npt.NDArray[np.bool_]:
    """[M] which nodes [M, 2] are of the grid that is twice as coarse."""
    coarse: npt.NDArray[np.bool_] = (np.round(positions_m / SPACING_M) % 2 == 0).all(axis=1)
    return coarse
