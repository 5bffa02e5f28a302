"""Prepare KITTI360Pose's cells and poses from a raw KITTI-360 scene (docs/formats.md, preparation rules)."""

from collections.abc import Callable
from functools import partial

import numpy as np
from scipy.spatial import cKDTree

from models.citymap.cells import centers_within_reach, cut_parts
from models.citymap.points import Ints, PointTable
from models.citymap.types import CityMap, Floats
from models.errors import DataError
from models.processes import map_forked
from models.sources.kitti360.describe import describe_pose, find_reachable_parts
from models.sources.kitti360.raw import RawScene
from models.sources.kitti360.rules import PrepareConfig
from models.sources.kitti360pose.records import PublishedCell, PublishedObject, PublishedPose

CUBES_PER_TASK = 16  # cubes that one worker process cuts at a time
Progress = Callable[[int, int], None]


def prepare_scene(
    raw: RawScene, config: PrepareConfig, rng: np.random.Generator, progress: Progress | None = None
) -> tuple[list[PublishedCell], list[PublishedPose]]:
    """Make a scene's cells, in order of x, then y, and its poses, in order of location, copy and strategy.

    `rng` draws the positions, `progress` gets (cubes cut, cubes to cut). Raise DataError if there is no location near a
    thing, no cell, or no position with enough instances around it.
    """
    points = scene_points(raw, config)
    locations = choose_locations(raw, config)
    centers = grid_centers(locations, config)
    if not len(centers):
        raise DataError(
            f"scene '{raw.name}': field 'trajectory': its locations span {np.ptp(locations[:, :2], axis=0)} m in x "
            "and y; cells need a metre in each"
        )
    positions = shift_locations(locations, config, rng)
    done = 0

    def step(cubes: int) -> None:
        nonlocal done
        done += cubes
        if progress:
            progress(done, len(centers) + len(positions))

    cells = cut_cells(raw, points, centers, config, step)
    poses = describe_positions(raw, points, cells, positions, config, step)
    if not poses:
        raise DataError(
            f"scene '{raw.name}': field 'poses': none of {len(positions)} positions has {config.num_hints} instances "
            f"within {config.hint_reach_m} m and a cell's centre within {config.best_cell_reach_m} m"
        )
    return cells, poses


def scene_points(raw: RawScene, config: PrepareConfig) -> PointTable:
    """Return the scene's points with their index, for `describe_positions`."""
    city_map = CityMap(raw.name, raw.instances, raw.stuff, raw.trajectory_m, rules=config.cut)
    return PointTable.from_map(city_map, config.cut.eps_m)


def choose_locations(raw: RawScene, config: PrepareConfig) -> Floats:
    """Return poses [L, 3] of the trajectory, spaced, near some thing (rule 3); raise DataError if there is none."""
    spaced = raw.trajectory_m[spaced_rows(raw.trajectory_m, config.spacing_m)]
    things = [instance.points_m for instance in raw.instances if instance.label not in raw.stuff]
    if things:
        tree = cKDTree(np.concatenate(things), balanced_tree=False, compact_nodes=False)
        near: Floats = spaced[tree.query(spaced)[0] <= config.thing_reach_m]
        if len(near):
            return near
    raise DataError(
        f"scene '{raw.name}': field 'trajectory': no pose within {config.thing_reach_m} m of a thing; "
        "are points and trajectory of the same scene, in the same frame?"
    )


def spaced_rows(trajectory_m: Floats, spacing_m: float) -> Ints:
    """Return the rows [L] of the poses that are far enough from all rows before (rule 3)."""
    spaced_m = np.full_like(trajectory_m, np.inf)
    rows: list[int] = []
    for row, position in enumerate(trajectory_m):
        if np.linalg.norm(spaced_m[: len(rows)] - position, axis=1).min(initial=np.inf) >= spacing_m:
            spaced_m[len(rows)] = position
            rows.append(row)
    return np.array(rows)


def grid_centers(locations_m: Floats, config: PrepareConfig) -> Floats:
    """Return the centres [N, 3] of the cells to cut, by x, then y (rule 4): whole metres, without the upper bound."""
    low, high = locations_m.min(axis=0).astype(int), locations_m.max(axis=0).astype(int)
    axes = [np.arange(low[axis], high[axis], config.cut.grid_m) for axis in range(2)]
    x, y = np.meshgrid(*axes, indexing="ij")
    return centers_within_reach(np.column_stack([x.ravel(), y.ravel()]), locations_m, config.cut.reach_m)


def shift_locations(locations_m: Floats, config: PrepareConfig, rng: np.random.Generator) -> Floats:
    """Return positions [L * copies, 3]: copies of the locations, shifted by whole metres east and north (rule 5)."""
    positions = np.repeat(locations_m, config.copies, axis=0)
    share = rng.random((len(positions), 2))
    positions[:, :2] += np.trunc(share * config.cut.cell_size_m / config.shift_divisor)
    return positions


def cut_cells(
    raw: RawScene, points: PointTable, centers_m: Floats, config: PrepareConfig, step: Callable[[int], None]
) -> list[PublishedCell]:
    """Cut the cells around some centres; numbers count all centres, also those with too few instances (rule 4)."""
    cells: list[PublishedCell] = []
    chunks = [centers_m[i : i + CUBES_PER_TASK] for i in range(0, len(centers_m), CUBES_PER_TASK)]
    number = 0
    for members in map_forked(partial(_cut_chunk, points, config), chunks):
        for parts in members:
            if parts is not None:
                cells.append(_cell(raw, points, number, centers_m[number], parts, config))
            number += 1
        step(len(members))
    if not cells:
        raise DataError(
            f"scene '{raw.name}': field 'cells': none of {len(centers_m)} has {config.cut.min_instances} instances"
        )
    return cells


def _cut_chunk(points: PointTable, config: PrepareConfig, centers_m: Floats) -> list[list[Ints] | None]:
    """Return the point rows of the parts of some cubes; None for one with too few parts."""
    cubes = (cut_parts(points, center, config.cut) for center in centers_m)
    return [[p.astype(np.int32) for p in parts] if len(parts) >= config.cut.min_instances else None for parts in cubes]


def _cell(
    raw: RawScene, points: PointTable, number: int, center_m: Floats, parts: list[Ints], config: PrepareConfig
) -> PublishedCell:
    size_m = config.cut.cell_size_m
    low_m = center_m - size_m / 2
    objects = []
    for part, rows in enumerate(parts):
        instance = raw.instances[points.instance[rows[0]]]
        xyz = (points.xyz[rows] - low_m) / size_m
        objects.append(PublishedObject(part, instance.id, xyz, points.colours(rows), instance.label))
    box_m = np.concatenate([low_m, center_m + size_m / 2])
    return PublishedCell(f"{raw.name}_{number:05d}", raw.name, tuple(objects), size_m, box_m)


def describe_positions(
    raw: RawScene,
    points: PointTable,
    cells: list[PublishedCell],
    positions_m: Floats,
    config: PrepareConfig,
    step: Callable[[int], None] = lambda cubes: None,
) -> list[PublishedPose]:
    """Return poses with descriptions at positions [N, 3], in order of position, then strategy (rules 5 to 8).

    A position without a cell centre in reach, or with fewer instances in reach than hints, is left out. `points` are
    `scene_points(raw, config)`; `step` gets the number of positions done since the last call.
    """
    distance, best = _best_cells(cells, positions_m, config)
    reachable = np.flatnonzero(distance <= config.best_cell_reach_m)
    step(len(positions_m) - len(reachable))
    chunks = [reachable[i : i + CUBES_PER_TASK] for i in range(0, len(reachable), CUBES_PER_TASK)]
    poses = []
    reachable_parts = map_forked(
        partial(find_reachable_parts, points, config), [positions_m[chunk] for chunk in chunks]
    )
    for chunk, per_position in zip(chunks, reachable_parts, strict=True):
        for n, parts in zip(chunk, per_position, strict=True):
            if len(parts) >= config.num_hints:
                cell, position = cells[best[n]], positions_m[n]
                pose = (position - cell.bbox_w[:3]) / cell.cell_size
                for strategy, hints in describe_pose(parts, raw, cell, pose, config):
                    poses.append(PublishedPose(pose, position, cell.id, raw.name, strategy, hints))
        step(len(chunk))
    return poses


def _best_cells(cells: list[PublishedCell], positions_m: Floats, config: PrepareConfig) -> tuple[Floats, Ints]:
    """Return the distance [N] to the nearest centre in metres, and its row in `cells`; the first if several are."""
    centers_m = np.array([cell.bbox_w[:3] for cell in cells]) + config.cut.cell_size_m / 2
    # On a grid at most four centres are equally near.
    distance, row = cKDTree(centers_m).query(positions_m, k=[1, 2, 3, 4])
    return distance[:, 0], np.where(distance == distance[:, :1], row, len(cells)).min(axis=1)
