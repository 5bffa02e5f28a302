"""Whole scenes of KITTI360Pose's published layout, without the checks across files (`load_data` has these)."""

from pathlib import Path
from typing import NamedTuple

from models.sources.kitti360pose.files import iter_cells, list_scenes, load_poses, select_scenes
from models.sources.kitti360pose.records import PublishedCell, PublishedPose


class Scene(NamedTuple):
    """A scene, its cells and poses in stored order."""

    name: str
    cells: list[PublishedCell]
    poses: list[PublishedPose]


def load_cells(path: Path) -> list[PublishedCell]:
    return list(iter_cells(path))


def load_scene(root: Path, scene: str) -> Scene:
    [name] = select_scenes(list_scenes(root), scene, root / "cells")
    return Scene(name, load_cells(root / f"cells/{name}.pkl"), load_poses(root / f"poses/{name}.pkl"))
