"""Describe positions as KITTI360Pose does: hints from the cube around, matched to the best cell (rules 5 to 8)."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from models.citymap.cells import cut_parts
from models.citymap.colours import KITTI360_PALETTE
from models.citymap.hints import Strategy, direction_index, round_robin
from models.citymap.points import Ints, PointTable
from models.citymap.types import DIRECTIONS, Floats
from models.sources.kitti360.raw import RawScene
from models.sources.kitti360.rules import PrepareConfig
from models.sources.kitti360pose.records import PublishedCell, PublishedHint, PublishedObject

CUBE_CENTER = 0.5  # of a cube, in its own units


@dataclass(frozen=True, slots=True, eq=False)
class ReachableParts:
    """The parts within reach of a position, in units of the cube around it; R rows by instance."""

    instance: Ints  # [R] row in `RawScene.instances`
    closest: Floats  # [R, 3] the point nearest to the position, in space
    distance: Floats  # [R] to that point
    center: Floats  # [R, 3] mean of the points
    rgb: Floats  # [R, 3] float32 mean colour

    def __len__(self) -> int:
        return len(self.instance)


class _NearestObject(NamedTuple):
    """An object of the best cell, with its point nearest to the pose in cell units."""

    item: PublishedObject
    closest: Floats


def find_reachable_parts(points: PointTable, config: PrepareConfig, positions_m: Floats) -> list[ReachableParts]:
    """Return the parts within reach of each position [N, 3], world metres."""
    return [_find_reachable_parts(points, config, position) for position in positions_m]


def _find_reachable_parts(points: PointTable, config: PrepareConfig, position_m: Floats) -> ReachableParts:
    size_m = config.cut.cell_size_m
    low_m = position_m - size_m / 2
    members = cut_parts(points, position_m, config.cut)
    closest, center = np.zeros((2, len(members), 3))
    rgb = np.zeros((len(members), 3), dtype=np.float32)
    for part, rows in enumerate(members):
        xyz = (points.xyz[rows] - low_m) / size_m
        closest[part] = xyz[((xyz - CUBE_CENTER) ** 2).sum(axis=1).argmin()]
        center[part] = xyz.mean(axis=0)
        rgb[part] = points.colours(rows).mean(axis=0)
    distance = np.linalg.norm(closest - CUBE_CENTER, axis=1)
    near = distance <= config.hint_reach_m / size_m
    instance = points.instance[[rows[0] for rows in members]] if members else np.zeros(0, dtype=np.int32)
    return ReachableParts(instance[near], closest[near], distance[near], center[near], rgb[near])


def describe_pose(
    reachable: ReachableParts, raw: RawScene, cell: PublishedCell, pose: Floats, config: PrepareConfig
) -> list[tuple[Strategy, tuple[PublishedHint, ...]]]:
    """Return the hints about a pose by each strategy; a description of the same instances as an earlier one is dropped.

    `reachable` has at least `config.num_hints` rows; `pose` [3] is in units of the best cell.
    """
    direction = direction_index(CUBE_CENTER - reachable.closest, config.on_top_share)
    label_number = {label: n for n, label in enumerate({i.label: None for i in raw.instances})}
    labels = np.array([label_number[raw.instances[i].label] for i in reachable.instance])
    keys = {"class": labels, "direction": direction}
    by_instances: dict[frozenset[int], tuple[Strategy, tuple[PublishedHint, ...]]] = {}
    for strategy in config.strategies:
        order = round_robin(keys[strategy]) if strategy in keys else np.argsort(reachable.distance, kind="stable")
        rows = order[: config.num_hints]
        mentioned = frozenset(raw.instances[i].id for i in reachable.instance[rows])
        if mentioned not in by_instances:
            hints = tuple(_hint(reachable, int(row), int(direction[row]), raw, cell, pose) for row in rows)
            by_instances[mentioned] = strategy, hints
    return list(by_instances.values())


def _hint(
    reachable: ReachableParts, row: int, direction: int, raw: RawScene, cell: PublishedCell, pose: Floats
) -> PublishedHint:
    instance = raw.instances[reachable.instance[row]]
    offset = (CUBE_CENTER - reachable.closest[row])[:2]
    matched = _match(instance.id, offset, cell, pose)
    # The closest point is in units of the best cell if the hint is matched there, else of the cube around the position.
    closest = reachable.closest[row] if matched is None else matched.closest
    return PublishedHint(
        object_id=None if matched is None else matched.item.id,
        object_instance_id=instance.id,
        object_label=instance.label,
        object_color_rgb=reachable.rgb[row],
        object_color_text=KITTI360_PALETTE.word(reachable.rgb[row]) or "",
        direction=DIRECTIONS[direction],
        offset_center=(CUBE_CENTER - reachable.center[row])[:2],
        offset_closest=offset,
        closest_point=closest[:2],
        best_offset_center=None if matched is None else (pose - matched.item.xyz.mean(axis=0))[:2],
        best_offset_closest=None if matched is None else (pose - matched.closest)[:2],
        is_matched=matched is not None,
    )


def _match(instance_id: int, offset: Floats, cell: PublishedCell, pose: Floats) -> _NearestObject | None:
    """Return the part of an instance in a cell whose closest point has the offset nearest to the hint's, or None."""
    nearest = [
        _NearestObject(item, item.xyz[((item.xyz - pose) ** 2).sum(axis=1).argmin()])
        for item in cell.objects
        if item.instance_id == instance_id
    ]
    return min(nearest, key=lambda n: float(np.linalg.norm((pose - n.closest)[:2] - offset)), default=None)
