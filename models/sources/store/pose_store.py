"""Cells and poses in columns for training, indexing and evaluation; all of a data set, or some scenes."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
import numpy.typing as npt
from pydantic import BaseModel, ConfigDict

from models.citymap.cells import CellTable, PartTable
from models.citymap.point_sample import FIXED_SAMPLING, PointSampling, sample_points, stack_samples
from models.citymap.points import Ints, ranges
from models.citymap.types import DIRECTIONS, Floats, Hint
from models.errors import DataError
from models.sources.kitti360pose.files import select_scenes
from models.sources.store.layout import (
    RGB_POOLS,
    XYZ_POOLS,
    Column,
    colours_from_bytes,
    in_cell_units,
    pool_starts,
    starts_of,
)


class StoredScene(BaseModel):
    """A scene of a store, as in its manifest."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str  # of its files, for example "2013_05_28_drive_0003_sync"
    scene_name: str  # of its cells, for example "0003"
    cells: int
    poses: int | None  # None if there was no file of poses


@dataclass(frozen=True, slots=True, eq=False)
class PoseTable:
    """Q positions with their descriptions, in columns."""

    positions_m: Floats  # [Q, 3] float64 world metres
    cell: Ints  # [Q] best cell, row in the store's cell table
    strategies: tuple[str, ...]  # Q words: how the hints were chosen
    starts: Ints  # [Q + 1] pose q has the hints starts[q] to starts[q + 1]
    direction: Ints  # [H] index into DIRECTIONS
    label: Ints  # [H] index into `words`
    colour: Ints  # [H] index into `words`
    instance: Ints  # [H] the instance meant, row in the cell table's parts; -1 if the best cell lacks it
    words: tuple[str, ...]  # labels and colours

    def __len__(self) -> int:
        return len(self.cell)

    def hints(self, q: int) -> tuple[Hint, ...]:
        """Return the hints of pose q, in stored order."""
        return tuple(
            Hint(
                DIRECTIONS[self.direction[h]],
                self.words[self.label[h]],
                self.words[self.colour[h]],
                int(self.instance[h]) if self.instance[h] >= 0 else None,
            )
            for h in range(self.starts[q], self.starts[q + 1])
        )


@dataclass(frozen=True, eq=False)
class PoseStore:
    """Cells and poses of some scenes of a data set; cell, instance and pose rows count within this view."""

    source: Path
    scenes: tuple[StoredScene, ...]  # in order
    columns: Mapping[str, Column]  # of the whole data set (models.sources.store.layout)
    words: tuple[str, ...]  # of the whole data set
    all_cell_ids: tuple[str, ...]  # of the whole data set
    all_scenes: tuple[StoredScene, ...]
    cell_rows: Ints  # [N] rows of the whole data set in this view
    pose_rows: Ints  # [Q] likewise

    @classmethod
    def whole(
        cls,
        source: Path,
        scenes: tuple[StoredScene, ...],
        columns: Mapping[str, Column],
        words: tuple[str, ...],
        cell_ids: tuple[str, ...],
    ) -> "PoseStore":
        """Return a view of everything; `find_problem` must have accepted the columns."""
        num_cells, num_poses = len(columns["cell_scene"]), len(columns["pose_cell"])
        return cls(source, scenes, columns, words, cell_ids, scenes, np.arange(num_cells), np.arange(num_poses))

    def split(self, split: str | None) -> "PoseStore":
        """Return the view of some of its scenes; arguments and errors as `select_scenes`."""
        names = select_scenes([scene.name for scene in self.scenes], split, self.source)
        chosen = [n for n, scene in enumerate(self.all_scenes) if scene.name in names]
        cell_scene = self.columns["cell_scene"]
        return replace(
            self,
            scenes=tuple(self.all_scenes[n] for n in chosen),
            cell_rows=np.flatnonzero(np.isin(cell_scene, chosen)),
            pose_rows=np.flatnonzero(np.isin(cell_scene[self.columns["pose_cell"]], chosen)),
        )

    @cached_property
    def cell_ids(self) -> tuple[str, ...]:
        """Return the N ids as published."""
        return tuple(self.all_cell_ids[n] for n in self.cell_rows)

    @cached_property
    def labels(self) -> tuple[str, ...]:
        """Return the class of each instance, in rows of the cell table's parts."""
        return tuple(self.words[n] for n in self.columns["object_label"][self._object_rows])

    @property
    def instance_ids(self) -> Ints:
        """Return the data set's number [R] of each instance, in rows of the cell table's parts."""
        return self.columns["object_instance"][self._object_rows]

    def cell_table(self) -> CellTable:
        """Return the cells with their parts, world metres; each part is an instance, numbered by its row."""
        sizes = self.columns["cell_size_m"][self.cell_rows]
        if (sizes != sizes[0]).any():
            raise DataError(
                f"{self.source}: cells of {sizes.min():g} m and of {sizes.max():g} m; name scenes of one size"
            )
        box = self.columns["cell_bbox_m"][self.cell_rows]
        rows = self._object_rows
        low, high, closest, rgb = (
            self.columns[name][rows]
            for name in ("object_low_m", "object_high_m", "object_closest_m", "object_mean_rgb")
        )
        return CellTable(
            ids=self.cell_ids,
            scenes=tuple(self.all_scenes[n].scene_name for n in self.columns["cell_scene"][self.cell_rows]),
            center_m=(box[:, :3] + box[:, 3:]) / 2,
            size_m=float(sizes[0]),
            content=PartTable(
                starts=starts_of(self.columns["cell_objects"][self.cell_rows]),
                instance=np.arange(len(rows), dtype=np.int32),
                count=self.columns["object_points"][rows],
                low_m=low,
                high_m=high,
                closest_m=closest,
                rgb=rgb,
            ),
            sample=self._sample,
        )

    @cached_property
    def poses(self) -> PoseTable:
        """Return the positions with their descriptions; raise DataError if a scene has cells only."""
        for scene in self.scenes:
            if scene.poses is None:
                raise DataError(
                    f"{self.source}: scene '{scene.name}' has no poses/{scene.name}.pkl, only cells; add it"
                )
        c, rows = self.columns, self.pose_rows
        hints = ranges(self._hint_starts[rows], self._hint_starts[rows + 1])
        return PoseTable(
            positions_m=c["pose_world_m"][rows],
            cell=_inverse_rows(self.cell_rows, len(c["cell_scene"]))[c["pose_cell"][rows]],
            strategies=tuple(self.words[n] for n in c["pose_strategy"][rows]),
            starts=starts_of(c["pose_hints"][rows]),
            direction=c["hint_direction"][hints],
            label=c["hint_label"][hints],
            colour=c["hint_colour"][hints],
            # One more, so that -1, no instance, stays -1.
            instance=np.append(_inverse_rows(self._object_rows, len(c["object_label"])), -1)[c["hint_object"][hints]],
            words=self.words,
        )

    def instance_points(self, row: int) -> tuple[Floats, Floats]:
        """Return the points [P, 3], cell units, and colours [P, 3], 0..1, of one instance (float32 or float64)."""
        return self._points(int(self._object_rows[row]))

    def _sample(self, cells: Ints, sampling: PointSampling = FIXED_SAMPLING) -> Floats:
        rows = self.cell_rows[cells]
        objects = ranges(self._cell_starts[rows], self._cell_starts[rows + 1])
        # Points are in cell units, 0..1 inside.
        return stack_samples([sample_points(*self._points(row), sampling, 0.5) for row in objects.tolist()])

    def _points(self, row: int) -> tuple[Floats, Floats]:
        c = self.columns
        xyz_kind, rgb_kind, count = c["object_xyz_kind"][row], c["object_rgb_kind"][row], int(c["object_points"][row])
        xyz = c[XYZ_POOLS[xyz_kind]][self._xyz_starts[row] :][:count]
        rgb = c[RGB_POOLS[rgb_kind]][self._rgb_starts[row] :][:count]
        if xyz_kind == 0:
            cell = np.searchsorted(self._cell_starts, row, side="right") - 1
            xyz = in_cell_units(xyz, c["cell_bbox_m"][cell, :3], c["cell_size_m"][cell])
        return np.array(xyz), colours_from_bytes(rgb) if rgb_kind == 0 else np.array(rgb)

    @cached_property
    def _object_rows(self) -> Ints:
        return ranges(self._cell_starts[self.cell_rows], self._cell_starts[self.cell_rows + 1])

    @cached_property
    def _cell_starts(self) -> Ints:
        return starts_of(self.columns["cell_objects"])

    @cached_property
    def _hint_starts(self) -> Ints:
        return starts_of(self.columns["pose_hints"])

    @cached_property
    def _xyz_starts(self) -> Ints:
        return pool_starts(self.columns["object_xyz_kind"], self.columns["object_points"])

    @cached_property
    def _rgb_starts(self) -> Ints:
        return pool_starts(self.columns["object_rgb_kind"], self.columns["object_points"])


def _inverse_rows(rows: Ints, size: int) -> Ints:
    """Return the position [size] of each number in `rows`, -1 if it is not there."""
    positions: npt.NDArray[np.int64] = np.full(size, -1, dtype=np.int64)
    positions[rows] = np.arange(len(rows))
    return positions
