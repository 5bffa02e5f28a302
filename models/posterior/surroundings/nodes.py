"""The positions that the posterior is over: nodes of a fine grid."""

from typing import Final

import numpy as np
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
