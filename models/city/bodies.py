"""The instances of a map with all their points, from which surroundings are measured."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from models.city.cells import CellTable
from models.city.kitti360.rules import CLASSES
from models.city.points import Ints, PointTable
from models.city.store.pose_store import PoseStore
from models.city.types import CityMap, CutRules, Floats

VOXEL_M = 0.2
STUFF = [rule.label for rule in CLASSES if rule.is_stuff]


@dataclass(frozen=True, slots=True, eq=False)
class Bodies:
    """The instances of a map (or of several scenes) with all their points.

    Attributes:
        xyz: [P, 3] float32 metres, ordered by instance.
        starts: [I + 1] instance i has the points starts[i] to starts[i + 1].
        is_thing: [I] bool, True for what is mentioned only where a share of it is near (`thing_share`).
        scene: [I] number of the scene of each.
        part_instance: [R] instance of each row of the cells' parts.
        thing_share: see `CutRules`.
    """

    xyz: Floats
    starts: Ints
    is_thing: npt.NDArray[np.bool_]
    scene: Ints
    part_instance: Ints
    thing_share: float

    @classmethod
    def of_map(cls, city_map: CityMap, points: PointTable, cells: CellTable) -> "Bodies":
        """Those of a map, every point."""
        scene = np.zeros(len(city_map.instances), dtype=np.int64)
        return cls(points.xyz, points.starts, ~points.is_stuff, scene, cells.parts.instance, city_map.rules.thing_share)

    @classmethod
    def of_store(cls, store: PoseStore, cells: CellTable) -> "Bodies":
        """Those of a data set: of each instance the points that its cells show, one a cube of VOXEL_M."""
        scene = np.unique(cells.scenes, return_inverse=True)[1][cells.parts.cube]
        pairs = np.column_stack([scene, store.instance_ids])
        known, part_instance = np.unique(pairs, axis=0, return_inverse=True)
        order = np.argsort(part_instance, kind="stable")
        corner = cells.center_m[cells.parts.cube] - cells.size_m / 2
        groups = np.split(order, np.flatnonzero(np.diff(part_instance[order])) + 1)
        xyz = []
        for rows in groups:
            seen = np.concatenate([store.instance_points(int(r))[0] * cells.size_m + corner[r] for r in rows])
            voxel = np.floor(seen / VOXEL_M).astype(np.int64) & 0x1FFFFF
            key = (voxel[:, 0] << 42) | (voxel[:, 1] << 21) | voxel[:, 2]
            xyz.append(seen[np.unique(key, return_index=True)[1]].astype(np.float32))
        labels = np.array(store.labels)[[rows[0] for rows in groups]]
        starts = np.concatenate([[0], np.cumsum([len(points) for points in xyz])])
        is_thing, scenes = ~np.isin(labels, STUFF), known[:, 0]
        return cls(np.concatenate(xyz), starts, is_thing, scenes, part_instance, CutRules().thing_share)
