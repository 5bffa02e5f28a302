"""The columns of a pose store: their formats, how points are stored, and consistency checks.

Points are stored exactly, in the fewest bytes that allow it: the released cells were made from float32 world
coordinates and 8-bit colours, so (world - box) / size and n / 255 restore them from 15 bytes a point instead of 36.
An instance for which that is not exact keeps its numbers as they are.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from models.citymap.points import Ints
from models.citymap.types import DIRECTIONS, Floats

MANIFEST, STRINGS = "manifest.json", "strings.json"
Column = npt.NDArray[Any]
# By name: what its rows are, dtype, shape of a row. Lengths are stored as counts, so that scenes can be appended.
COLUMNS: dict[str, tuple[str, str, tuple[int, ...]]] = {
    "cell_scene": ("cells", "<i4", ()),
    "cell_size_m": ("cells", "<f8", ()),
    "cell_bbox_m": ("cells", "<f8", (6,)),
    "cell_objects": ("cells", "<i4", ()),
    "object_instance": ("objects", "<i8", ()),
    "object_label": ("objects", "<i4", ()),
    "object_points": ("objects", "<i4", ()),
    "object_xyz_kind": ("objects", "|u1", ()),
    "object_rgb_kind": ("objects", "|u1", ()),
    "object_low_m": ("objects", "<f4", (3,)),
    "object_high_m": ("objects", "<f4", (3,)),
    "object_closest_m": ("objects", "<f4", (3,)),
    "object_mean_rgb": ("objects", "<f4", (3,)),
    "xyz_world": ("xyz_world", "<f4", (3,)),
    "xyz_f4": ("xyz_f4", "<f4", (3,)),
    "xyz_f8": ("xyz_f8", "<f8", (3,)),
    "rgb_u1": ("rgb_u1", "|u1", (3,)),
    "rgb_f4": ("rgb_f4", "<f4", (3,)),
    "rgb_f8": ("rgb_f8", "<f8", (3,)),
    "pose_cell": ("poses", "<i4", ()),
    "pose_world_m": ("poses", "<f8", (3,)),
    "pose_strategy": ("poses", "<i4", ()),
    "pose_hints": ("poses", "<i4", ()),
    "hint_object": ("hints", "<i4", ()),
    "hint_label": ("hints", "<i4", ()),
    "hint_colour": ("hints", "<i4", ()),
    "hint_direction": ("hints", "|u1", ()),
}
XYZ_POOLS = ("xyz_world", "xyz_f4", "xyz_f8")  # by kind
RGB_POOLS = ("rgb_u1", "rgb_f4", "rgb_f8")


def empty_column(name: str) -> Column:
    """Return a column without rows."""
    _, dtype, shape = COLUMNS[name]
    return np.zeros((0, *shape), dtype=dtype)


def in_cell_units(world: Floats, low: Floats, size: float) -> Floats:
    """Return points [P, 3] (float64) in cell units, as preparation computes them (rule 4), from float32 metres."""
    return (world - low) / size


def colours_from_bytes(rgb: Column) -> Floats:
    """Return colours [P, 3] (float32, 0..1) from bytes [P, 3]."""
    return rgb.astype(np.float32) / np.float32(255)


def starts_of(counts: Column) -> Ints:
    """Return where the rows of each of N begin, and the end [N + 1]."""
    starts = np.zeros(len(counts) + 1, dtype=np.int64)
    np.cumsum(counts, out=starts[1:])
    return starts


def pool_starts(kinds: Column, counts: Column) -> Ints:
    """Return where the points of each object [N] begin in the pool of its kind."""
    starts = np.zeros(len(kinds), dtype=np.int64)
    for kind in range(3):
        rows = np.flatnonzero(kinds == kind)
        starts[rows] = starts_of(counts[rows])[:-1]
    return starts


def find_problem(columns: Mapping[str, Column], num_words: int, num_scenes: int) -> str | None:
    """Return why columns are unusable (a wrong dtype, numbers out of range), or None if they are usable."""
    for name, (group, dtype, shape) in COLUMNS.items():
        first = next(first_name for first_name, spec in COLUMNS.items() if spec[0] == group)
        column = columns[name]
        if column.dtype != np.dtype(dtype) or column.shape != (len(columns[first]), *shape):
            return f"{name} has dtype {column.dtype} and shape {list(column.shape)}"
    points = columns["object_points"].astype(np.int64)
    sizes = {"cell_objects": "object_label", "pose_hints": "hint_object"}
    for name, rows in sizes.items():
        if (columns[name] < 0).any() or columns[name].sum(dtype=np.int64) != len(columns[rows]):
            return f"{name} does not add up to {len(columns[rows])}"
    for kinds, pools in (("object_xyz_kind", XYZ_POOLS), ("object_rgb_kind", RGB_POOLS)):
        expected = np.bincount(columns[kinds], weights=points, minlength=3)
        if (points < 1).any() or expected.tolist() != [len(columns[pool]) for pool in pools]:
            return f"{kinds} and object_points do not add up to the points"
    limits = {"cell_scene": num_scenes, "pose_cell": len(columns["cell_scene"]), "hint_direction": len(DIRECTIONS)}
    limits |= dict.fromkeys(("object_label", "pose_strategy", "hint_label", "hint_colour"), num_words)
    for name, limit in limits.items():
        if len(columns[name]) and not 0 <= columns[name].min() <= columns[name].max() < limit:
            return f"{name} points outside"
    hint_object = columns["hint_object"]
    if len(hint_object) and not -1 <= hint_object.min() <= hint_object.max() < len(points):
        return "hint_object points outside"
    return None
