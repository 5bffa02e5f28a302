"""KITTI360Pose on disk as it is published: scenes, cells and poses (docs/formats.md, published layout)."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import numpy as np

from models.citymap.types import Floats
from models.errors import DataError
from models.files import open_atomic
from models.sources.kitti360pose.fields import Fields, PickleFile, read_cell, read_pose
from models.sources.kitti360pose.pickle_reader import read_pickle
from models.sources.kitti360pose.pickle_writer import cell_record, pose_record, write_records
from models.sources.kitti360pose.records import PublishedCell, PublishedPose

STANDARD_SPLITS = {
    "train": ("0000", "0002", "0004", "0006", "0007"),
    "val": ("0010",),
    "test": ("0003", "0005", "0009"),
}
POSE_TOLERANCE_M = 0.5  # `pose` and `pose_w` give one position twice; farther apart, two frames are mixed
DRIVE = re.compile(r"\d{4}_\d{2}_\d{2}_drive_(.+)_sync")


class CellKey(NamedTuple):
    """The facts about a cell that poses refer to: scene, corner (world metres), edge, and the ids of its objects."""

    scene_name: str
    low_m: Floats
    size_m: float
    objects: frozenset[int]


def short_name(scene: str) -> str:
    """Return the drive's digits, "0003" for "2013_05_28_drive_0003_sync"; any other name as it is."""
    drive = DRIVE.fullmatch(scene)
    return drive[1] if drive else scene


def file_name(scene: str) -> str:
    """Return the name of a scene's files: KITTI-360's name for four digits, any other name as it is."""
    return f"2013_05_28_drive_{scene}_sync" if re.fullmatch(r"\d{4}", scene) else scene


def list_scenes(root: Path) -> tuple[str, ...]:
    """Return the scenes of a published layout by name of file, in order; raise DataError if there is none."""
    scenes = tuple(sorted(path.stem for path in (root / "cells").glob("*.pkl") if path.is_file()))
    if not scenes:
        raise DataError(f"{root / 'cells'}: no scene; the published layout is cells/<scene>.pkl and poses/<scene>.pkl")
    return scenes


def select_scenes(available: Sequence[str], split: str | None, where: Path) -> tuple[str, ...]:
    """Return the scenes of a split.

    A split is "train", "val" or "test" (those of the standard split that are available), a comma list of names, long or
    short, or None for all. Raise DataError, naming the data `where`, if a named scene, or every scene of a standard
    split, is missing, or a name is ambiguous.
    """
    if split is None:
        return tuple(available)
    standard = STANDARD_SPLITS.get(split) if split not in available else None
    wanted = standard or tuple(name.strip() for name in split.split(",") if name.strip())
    chosen: list[str] = []
    for name in wanted:
        matches = [scene for scene in available if name in (scene, short_name(scene))]
        if len(matches) > 1:
            raise DataError(f"{where}: scene '{name}' is any of {', '.join(matches)}; give the whole name")
        if not matches and not standard:
            raise DataError(f"{where}: no scene '{name}'; there are {', '.join(available)}")
        chosen += [scene for scene in matches if scene not in chosen]
    if not chosen:
        needed = f"'{split}' ({', '.join(wanted)})"
        raise DataError(f"{where}: no scene of split {needed}; there are {', '.join(available)}: name some of them")
    return tuple(chosen)


def iter_cells(path: Path) -> Iterator[PublishedCell]:
    """Yield the cells of cells/<scene>.pkl; only one cell's points are in memory at a time.

    Raise DataError, with file and field, if the file is missing, cut short, or holds anything but usable cells.
    """
    ids: set[str] = set()
    scene_name = None
    with _open_records(path, "cells", "Cell") as records:
        for record in records:
            cell = read_cell(record)
            if cell.id in ids:
                raise record.error("id", f"'{cell.id}' is taken by an earlier cell")
            ids.add(cell.id)
            scene_name = scene_name or cell.scene_name
            _check_scene(record, cell.scene_name, scene_name)
            yield cell


def load_poses(path: Path) -> list[PublishedPose]:
    """Load the poses of poses/<scene>.pkl; errors as `iter_cells`."""
    poses: list[PublishedPose] = []
    with _open_records(path, "poses", "Pose") as records:
        for record in records:
            poses.append(read_pose(record))
            _check_scene(record, poses[-1].scene_name, poses[0].scene_name)
    return poses


def build_cell_key(cell: PublishedCell) -> CellKey:
    """Return the facts about a cell for `check_poses`."""
    return CellKey(cell.scene_name, cell.bbox_w[:3], cell.cell_size, frozenset(item.id for item in cell.objects))


def check_poses(path: Path, poses: Sequence[PublishedPose], cells: Mapping[str, CellKey]) -> None:
    """Check that the poses of a file belong to the cells of the same scene, by id.

    Raise DataError if a pose's cell or a matched hint's object is missing, or the cells are of another scene or frame.
    """
    for n, pose in enumerate(poses):
        problem = _pose_problem(pose, cells)
        if problem:
            raise DataError(f"{path}: poses[{n}].{problem}; cells and poses must come from one preparation")


def _pose_problem(pose: PublishedPose, cells: Mapping[str, CellKey]) -> str | None:
    cell = cells.get(pose.cell_id)
    if cell is None:
        return f"cell_id: cell '{pose.cell_id}' is not in this scene's cells"
    if pose.scene_name != cell.scene_name:
        return f"scene_name: is '{pose.scene_name}', its cell is of scene '{cell.scene_name}'"
    offset_m = pose.pose[:2] * cell.size_m + cell.low_m[:2] - pose.pose_w[:2]
    if np.abs(offset_m).max() > POSE_TOLERANCE_M:
        return f"pose_w: lies {np.abs(offset_m).max():.3g} m from where `pose` puts it in cell '{pose.cell_id}'"
    for h, hint in enumerate(pose.descriptions):
        if hint.is_matched and hint.object_id not in cell.objects:
            return f"descriptions[{h}].object_id: cell '{pose.cell_id}' has no object {hint.object_id}"
    return None


def save_scene(root: Path, scene: str, cells: Iterable[PublishedCell], poses: Sequence[PublishedPose]) -> None:
    """Write a scene so that this module and the reference code can read it; without poses, remove the file of poses.

    A name of four digits becomes KITTI-360's name. Cells are written one by one. Raise DataError, and change nothing,
    if poses do not belong to the cells, or the name is not a valid file name.
    """
    name = file_name(scene)
    if not name or Path(name).name != name or name.startswith("."):
        raise DataError(f"{root}: '{scene}' cannot be the name of a scene; take letters, digits and underscores")
    poses_path, cells_path = (root / part / f"{name}.pkl" for part in ("poses", "cells"))
    keys: dict[str, CellKey] = {}

    def written() -> Iterator[PublishedCell]:
        for cell in cells:
            keys[cell.id] = build_cell_key(cell)
            yield cell

    # The inner file first: if the poses are refused, the cells are not put in place either.
    with open_atomic(cells_path) as cells_file:
        write_records(cells_file, map(cell_record, written()))
        check_poses(poses_path, poses, keys)
        if poses:
            with open_atomic(poses_path) as poses_file:
                write_records(poses_file, map(pose_record, poses))
        else:
            poses_path.unlink(missing_ok=True)


@contextmanager
def _open_records(path: Path, name: str, kind: str) -> Iterator[list[Fields]]:
    try:
        file = path.open("rb")
    except FileNotFoundError as error:
        raise DataError(f"{path}: no {name} for this scene; the file is missing") from error
    except OSError as error:
        raise DataError(f"{path}: cannot be opened: {error.strerror}") from error
    with file:
        records = PickleFile(path, file).read_records(read_pickle(file, path), name, kind)
        if not records:
            raise DataError(f"{path}: holds no {name}; delete the file or prepare the scene again")
        yield records


def _check_scene(record: Fields, scene_name: str, expected: str) -> None:
    if scene_name != expected:
        raise record.error("scene_name", f"is '{scene_name}', but '{expected}' before; a file holds one scene")
