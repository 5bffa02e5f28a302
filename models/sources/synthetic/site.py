"""Synthetic towns, part 6: the site of a town, which collects objects near the drive as numbered points."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from models.citymap.points import Ints
from models.citymap.types import Floats
from models.sources.kitti360.rules import CLASSES, GROUND
from models.sources.synthetic.layout import Land
from models.sources.synthetic.shapes import LocalFrame, Rng
from models.sources.synthetic.styles import Habits, draw_shade, speckle

SCAN_REACH_M = 44.0  # objects farther from the drive are not scanned
RASTER_SPACING_M = 2.0  # of the raster of distances to the drive
RASTER_MARGIN_M = 120.0  # around the drive
CLASS_ROW = {rule.label: row for row, rule in enumerate(CLASSES)}
INSTANCES_PER_CLASS = 1000  # instances a class, as KITTI-360 counts them


@dataclass(frozen=True, slots=True, eq=False)
class Scan:
    """All points of a town."""

    xyz: Floats  # [P, 3] float32, world metres
    rgb: npt.NDArray[np.uint8]  # [P, 3] uint8
    semantic: Ints  # [P] int32, KITTI-360's numbers
    instance: Ints  # [P] int32, KITTI-360's numbers
    pose: Ints  # [P] int32, the nearest pose of the drive


class Site:
    """Collects objects in the plan's frame, and keeps those near the drive."""

    def __init__(self, rng: Rng, habits: Habits, land: Land, drive_m: Floats) -> None:
        self.rng, self.habits, self._land = rng, habits, land
        low, high = drive_m[:, :2].min(axis=0) - RASTER_MARGIN_M, drive_m[:, :2].max(axis=0) + RASTER_MARGIN_M
        self._low, counts = low, np.ceil((high - low) / RASTER_SPACING_M).astype(int)
        places = low + (np.indices(tuple(counts)).reshape(2, -1).T + 0.5) * RASTER_SPACING_M
        distance, pose = cKDTree(drive_m[:, :2]).query(places)
        self._distance, self._pose = distance.reshape(counts), pose.reshape(counts).astype(np.int32)
        self._clouds: list[Floats] = []
        self._cloud_instance: list[int] = []  # row of `_classes`, for each cloud
        self._classes: list[int] = []  # row of CLASSES, for each instance
        self._chains: dict[tuple[str, str], int] = {}

    @property
    def spacing_m(self) -> float:
        """Return the distance between points of well-scanned surfaces."""
        return self.habits.spacing_m

    def distance_to_drive_m(self, spot: LocalFrame) -> float:
        """Return the distance from a position to the drive, exact to a metre or two."""
        return float(self._distance[self._raster_cells(self._land.to_world(np.array([[spot.u, spot.v, 0.0]])))][0])

    def _raster_cells(self, world: Floats) -> tuple[Ints, Ints]:
        cell = np.clip(
            ((world[:, :2] - self._low) / RASTER_SPACING_M).astype(np.int64), 0, np.array(self._distance.shape) - 1
        )
        return cell[:, 0], cell[:, 1]

    def add(self, label: str, spot: LocalFrame, xyz: Floats, chain: str = "") -> None:
        """Add an object with points [P, 3] in its frame, if the drive comes near it.

        Objects added under one name `chain` are one instance, until the chain is cut.
        """
        rule = CLASSES[CLASS_ROW[label]]
        if not rule.is_stuff and self.distance_to_drive_m(spot) > SCAN_REACH_M:
            return
        world = self._land.to_world(spot.to_plan(xyz))
        if rule.is_stuff:
            world = world[self._distance[self._raster_cells(world)] <= SCAN_REACH_M]
        if not len(world):
            return
        row = self._chains.get((label, chain)) if chain else None
        if row is None:
            row = len(self._classes)
            self._classes.append(CLASS_ROW[label])
        if chain:
            self._chains[label, chain] = row
        self._clouds.append(world.astype(np.float32))
        self._cloud_instance.append(row)

    def cut_chains(self, share: float = 1.0, label: str | None = None) -> None:
        """End some of the open chains, of a class or of all."""
        for key in list(self._chains):
            if label in (None, key[0]) and self.rng.random() < share:
                del self._chains[key]

    def scan(self, own_pieces: bool = False) -> Scan:
        """Return all points, numbered and coloured, by instance as far as these were added together.

        More than 999 instances of a class, which KITTI-360 cannot have, are numbered from (100 + semantic) * 1000. With
        `own_pieces`, so is each piece of ground, instead of KITTI-360's single number for all of a class.
        """
        classes = np.array(self._classes)
        shades = [draw_shade(self.rng, self.habits, row) for row in self._classes]
        mean = np.array([shade[0] for shade in shades], dtype=np.float32)
        spread = np.array([shade[1] for shade in shades], dtype=np.float32)
        semantic = np.array([rule.semantic for rule in CLASSES])[classes]
        nth = np.zeros(len(classes), dtype=np.int64)
        for row in range(len(CLASSES)):
            of_class = np.flatnonzero(classes == row)
            nth[of_class] = np.arange(len(of_class))
        thousands, rest = np.divmod(nth, INSTANCES_PER_CLASS - 1)
        number = (semantic + 100 * thousands) * INSTANCES_PER_CLASS + rest + 1
        if not own_pieces:
            is_ground = np.array([rule.label in GROUND for rule in CLASSES])[classes]
            number[is_ground] = semantic[is_ground] * INSTANCES_PER_CLASS
        point_instance = np.repeat(self._cloud_instance, [len(cloud) for cloud in self._clouds])
        xyz = np.concatenate(self._clouds)
        self._clouds.clear()
        rgb = np.concatenate(
            [speckle(self.rng, mean[rows], spread[rows]) for rows in np.array_split(point_instance, 16)]
        )
        pose = np.concatenate([self._pose[self._raster_cells(points)] for points in np.array_split(xyz, 16)])
        return Scan(xyz, rgb, semantic[point_instance].astype(np.int32), number[point_instance].astype(np.int32), pose)
