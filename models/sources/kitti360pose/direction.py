"""direction/<scene>.json: the neighbours of each cell, for prototype-based map cloning (docs/method.md, fine stage).

A scene has one JSON object: cell id -> {"east": cell id or null, ...} with the eight points of the compass, each one
step of the grid away. Text2Loc's fine stage looks up a pose's neighbours, so every cell of the scene must be in it.
"""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Literal, get_args

import numpy as np
from scipy.spatial import cKDTree

from models.files import replace_file
from models.sources.kitti360pose.records import PublishedCell

Compass = Literal["east", "west", "north", "south", "northeast", "northwest", "southeast", "southwest"]
Neighbours = dict[str, dict[Compass, str]]
COMPASS_STEPS: dict[Compass, tuple[int, int]] = {
    "east": (1, 0),
    "west": (-1, 0),
    "north": (0, 1),
    "south": (0, -1),
    "northeast": (1, 1),
    "northwest": (-1, 1),
    "southeast": (1, -1),
    "southwest": (-1, -1),
}
NEIGHBOUR_TOLERANCE_M = 1e-3  # cells of one grid are whole steps apart; others belong to another grid


def find_neighbours(cells: Sequence[PublishedCell], grid_m: float) -> Neighbours:
    """Return by cell id and point of the compass the neighbour in a grid of some step, where there is one."""
    neighbours: Neighbours = {cell.id: {} for cell in cells}
    corners_m = np.array([cell.bbox_w[:2] for cell in cells])
    tree = cKDTree(corners_m)
    for point, step in COMPASS_STEPS.items():
        distance, row = tree.query(corners_m + np.array(step) * grid_m)
        for n in np.flatnonzero(distance <= NEIGHBOUR_TOLERANCE_M).tolist():
            neighbours[cells[n].id][point] = cells[int(row[n])].id
    return neighbours


def save_direction(path: Path, neighbours: Neighbours) -> None:
    """Write the neighbours of a scene's cells as published: all points of the compass, null where there is no cell."""
    stored = {
        cell_id: {point: points.get(point) for point in get_args(Compass)} for cell_id, points in neighbours.items()
    }
    replace_file(path, json.dumps(stored, indent=4).encode())
