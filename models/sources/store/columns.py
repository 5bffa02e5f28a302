"""Write published cells and poses as columns, one by one, to memory or to .npy files."""

from contextlib import ExitStack
from itertools import pairwise
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from models.citymap.points import Ints
from models.citymap.types import DIRECTIONS, Floats
from models.sources.kitti360pose.records import PublishedCell, PublishedPose
from models.sources.store.layout import (
    COLUMNS,
    RGB_POOLS,
    XYZ_POOLS,
    Column,
    colours_from_bytes,
    empty_column,
    in_cell_units,
    starts_of,
)


class MemorySink:
    """Columns in memory."""

    def __init__(self) -> None:
        self._rows: dict[str, list[Column]] = {name: [] for name in COLUMNS}

    def append(self, name: str, rows: Column) -> None:
        """Add rows to a column."""
        self._rows[name].append(rows)

    def columns(self) -> dict[str, Column]:
        """Return all columns; the sink is empty after this."""
        return {name: np.concatenate([empty_column(name), *self._rows.pop(name)]) for name in COLUMNS}


class DiskSink:
    """Columns as <name>.npy in a directory; complete when the block ends without an error."""

    def __init__(self, directory: Path) -> None:
        self._directory = directory
        self._files: dict[str, BinaryIO] = {}
        self._rows = dict.fromkeys(COLUMNS, 0)
        self._stack = ExitStack()

    def __enter__(self) -> "DiskSink":
        for name in COLUMNS:
            self._files[name] = self._stack.enter_context((self._directory / f"{name}.npy").open("wb"))
            self._header(name)
        return self

    def __exit__(self, kind: object, *rest: object) -> None:
        with self._stack:
            for name, file in self._files.items():
                if kind is None:
                    file.seek(0)
                    self._header(name)

    def append(self, name: str, rows: Column) -> None:
        """Add rows to a column."""
        self._files[name].write(np.ascontiguousarray(rows, dtype=COLUMNS[name][1]).data)
        self._rows[name] += len(rows)

    def _header(self, name: str) -> None:
        """Write the header; numpy leaves room for more rows, so that it can be rewritten in place."""
        _, dtype, shape = COLUMNS[name]
        header = {"descr": dtype, "fortran_order": False, "shape": (self._rows[name], *shape)}
        np.lib.format.write_array_header_1_0(self._files[name], header)


class ColumnWriter:
    """Writes cells and poses as columns, one by one; columns hold the numbers of `words`."""

    def __init__(self, sink: MemorySink | DiskSink) -> None:
        self._sink = sink
        self.words: dict[str, int] = {}
        self.cell_ids: list[str] = []  # in order of the rows
        self._objects = 0
        self._cells: dict[str, tuple[int, dict[int, int]]] = {}  # row, and the rows of its objects by id

    def add_cell(self, cell: PublishedCell, scene: int) -> None:
        """Add a cell of a scene with its objects and their points."""
        put = self._put
        rows = {item.id: self._objects + n for n, item in enumerate(cell.objects)}
        self._cells[cell.id] = (len(self.cell_ids), rows)
        self.cell_ids.append(cell.id)
        self._objects += len(rows)
        put("cell_scene", [scene])
        put("cell_size_m", [cell.cell_size])
        put("cell_bbox_m", [cell.bbox_w])
        put("cell_objects", [len(cell.objects)])
        put("object_instance", [item.instance_id for item in cell.objects])
        put("object_label", [self._word(item.label) for item in cell.objects])
        put("object_points", [len(item.xyz) for item in cell.objects])
        self._add_xyz(cell)
        self._add_rgb(cell)

    def _add_xyz(self, cell: PublishedCell) -> None:
        low, size = cell.bbox_w[:3], cell.cell_size
        xyz, starts = _concatenate_points([item.xyz for item in cell.objects])
        world = xyz * size + low
        compact = world.astype(np.float32)
        exact = np.logical_and.reduceat((in_cell_units(compact, low, size) == xyz).all(axis=1), starts[:-1])
        is_float32 = np.array([item.xyz.dtype == np.float32 for item in cell.objects])
        kinds = np.where(is_float32, 1, np.where(exact, 0, 2))
        self._add_points(XYZ_POOLS, kinds, starts, (compact, xyz, xyz))
        self._put("object_xyz_kind", kinds)
        distance = ((world - (low + cell.bbox_w[3:]) / 2) ** 2).sum(axis=1)
        closest = [s + int(distance[s:e].argmin()) for s, e in pairwise(starts)]
        self._put("object_low_m", np.minimum.reduceat(compact, starts[:-1]))
        self._put("object_high_m", np.maximum.reduceat(compact, starts[:-1]))
        self._put("object_closest_m", compact[closest])

    def _add_rgb(self, cell: PublishedCell) -> None:
        rgb, starts = _concatenate_points([item.rgb for item in cell.objects])
        compact = np.rint(rgb * 255).astype(np.uint8)
        exact = np.logical_and.reduceat((colours_from_bytes(compact) == rgb).all(axis=1), starts[:-1])
        is_float32 = np.array([item.rgb.dtype == np.float32 for item in cell.objects])
        kinds = np.where(is_float32, np.where(exact, 0, 1), 2)
        self._add_points(RGB_POOLS, kinds, starts, (compact, rgb, rgb))
        self._put("object_rgb_kind", kinds)
        self._put("object_mean_rgb", np.add.reduceat(rgb, starts[:-1]) / np.diff(starts)[:, None])

    def _add_points(self, pools: tuple[str, ...], kinds: Column, starts: Ints, values: tuple[Column, ...]) -> None:
        of_point = np.repeat(kinds, np.diff(starts))
        for kind in np.unique(kinds):
            is_whole = (kinds == kind).all()
            self._put(pools[kind], values[kind] if is_whole else values[kind][of_point == kind])

    def add_poses(self, poses: list[PublishedPose]) -> None:
        """Add poses of cells added before; `check_poses` must have accepted them."""
        if not poses:
            return
        put = self._put
        put("pose_cell", [self._cells[pose.cell_id][0] for pose in poses])
        put("pose_world_m", [pose.pose_w for pose in poses])
        put("pose_strategy", [self._word(pose.described_by) for pose in poses])
        put("pose_hints", [len(pose.descriptions) for pose in poses])
        put(
            "hint_object",
            [
                self._cells[pose.cell_id][1].get(hint.object_id, -1)
                if hint.is_matched and hint.object_id is not None
                else -1
                for pose in poses
                for hint in pose.descriptions
            ],
        )
        hints = [hint for pose in poses for hint in pose.descriptions]
        put("hint_label", [self._word(hint.object_label) for hint in hints])
        put("hint_colour", [self._word(hint.object_color_text) for hint in hints])
        put("hint_direction", [DIRECTIONS.index(hint.direction) for hint in hints])

    def _put(self, name: str, rows: Any) -> None:
        _, dtype, shape = COLUMNS[name]
        self._sink.append(name, np.asarray(rows, dtype=dtype).reshape(-1, *shape))

    def _word(self, word: str) -> int:
        return self.words.setdefault(word, len(self.words))


def _concatenate_points(arrays: list[Floats]) -> tuple[Floats, Ints]:
    """Return all points as one float64 array, and where each part begins."""
    joined = np.concatenate(arrays).astype(np.float64, copy=False)
    return joined, starts_of(np.array([len(array) for array in arrays]))
