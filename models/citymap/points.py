"""All points of a map in one table, with a spatial index, and helpers for arrays of points."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from models.citymap.types import CityMap, Floats

INDEX_TILE_M = 10.0  # edge of the tiles of the point index
POINTS_PER_PAIR_BLOCK = 100_000  # points whose neighbours are searched together, to bound memory
Ints = npt.NDArray[np.integer[Any]]


@dataclass(frozen=True, eq=False)
class PointTable:
    """The points of a map, ordered by instance, with a grid of tiles and the neighbour pairs of stuff."""

    xyz: Floats  # [P, 3] float32, metres, map frame
    instance: Ints  # [P] int32, row in `CityMap.instances`
    starts: Ints  # [I + 1] int64, instance i has the points starts[i] to starts[i + 1]
    rgb: Floats | None  # [P, 3] float32, NaN where unknown; None if every instance has at most one colour
    instance_rgb: Floats  # [I, 3] float32 mean colour, NaN where unknown
    is_stuff: npt.NDArray[np.bool_]  # [I] bool, True where an instance is clipped to cells
    tile_order: Ints  # [P] point rows sorted by tile, then by row
    tile_key: Ints  # [P] the keys of their tiles
    pair_starts: Ints  # [P + 1]
    pairs: Ints  # pairs[pair_starts[p]:pair_starts[p + 1]] are the later neighbours of row p in the same stuff instance

    @classmethod
    def from_map(cls, city_map: CityMap, eps_m: float) -> "PointTable":
        """Build the table of a map's points; stuff within `eps_m` is connected."""
        instances = city_map.instances
        counts = np.array([len(i.points_m) for i in instances], dtype=np.int64)
        starts = np.concatenate([[0], np.cumsum(counts)])
        xyz = np.concatenate([i.points_m for i in instances]).astype(np.float32, copy=False)
        instance = np.repeat(np.arange(len(instances), dtype=np.int32), counts)
        is_stuff = np.array([i.label in city_map.stuff for i in instances])
        key = block_keys(xyz, INDEX_TILE_M)
        order = np.argsort(key, kind="stable")
        pair_starts, pairs = _neighbour_pairs(xyz, instance, is_stuff, eps_m)
        instance_rgb = np.full((len(instances), 3), np.nan, dtype=np.float32)
        for row, i in enumerate(instances):
            if i.rgb is not None:
                instance_rgb[row] = i.rgb if i.rgb.ndim == 1 else i.rgb.mean(axis=0)
        has_point_colours = any(i.rgb is not None and i.rgb.ndim == 2 for i in instances)
        rgb = None
        if has_point_colours:
            unknown = np.full(3, np.nan, dtype=np.float32)
            rgb = np.concatenate(
                [np.broadcast_to(unknown if i.rgb is None else i.rgb, i.points_m.shape) for i in instances]
            )
        return cls(xyz, instance, starts, rgb, instance_rgb, is_stuff, order, key[order], pair_starts, pairs)

    def colours(self, rows: Ints) -> Floats:
        """Return the colours [M, 3] (float32) of points, or of their instances; NaN where unknown."""
        return self.instance_rgb[self.instance[rows]] if self.rgb is None else self.rgb[rows]

    def inside(self, low: Floats, high: Floats) -> Ints:
        """Return the rows, ascending, of the points in a box between two corners [3], which belong to the box."""
        first = np.floor(low[:2] / INDEX_TILE_M).astype(np.int64)
        last = np.floor(high[:2] / INDEX_TILE_M).astype(np.int64)
        columns = np.arange(first[0], last[0] + 1)
        begin = np.searchsorted(self.tile_key, _tile_key(columns, first[1]), side="left")
        end = np.searchsorted(self.tile_key, _tile_key(columns, last[1]), side="right")
        rows = np.concatenate([self.tile_order[b:e] for b, e in zip(begin, end, strict=True)])
        xyz = self.xyz[rows]
        return np.sort(rows[((xyz >= low) & (xyz <= high)).all(axis=1)])


def _tile_key(column: Any, row: Any) -> Any:
    return column * (1 << 31) + row


def ranges(begin: Ints, end: Ints) -> Ints:
    """Return the integers begin[0]..end[0]-1, begin[1]..end[1]-1 and so on, one range after the other."""
    sizes = end - begin
    offset = np.repeat(begin - (np.cumsum(sizes) - sizes), sizes)
    return np.arange(sizes.sum()) + offset


def bounding_corners(points_m: Floats) -> tuple[Floats, Floats]:
    """Return the lowest and highest coordinates of points [N, C]; by column, which is faster in NumPy."""
    return np.array([column.min() for column in points_m.T]), np.array([column.max() for column in points_m.T])


def thin_to_spacing(points: Floats, spacing_m: float) -> Floats:
    """Return one point of each square block of the plane, so that points are about `spacing_m` apart."""
    return points[np.sort(np.unique(block_keys(points, spacing_m), return_index=True)[1])]


def block_keys(points: Floats, spacing_m: float) -> Ints:
    """Return one integer [P] for the square block of each point, ascending from west to east, then south to north."""
    block = np.floor(points[:, :2] / spacing_m).astype(np.int64)
    return _tile_key(block[:, 0], block[:, 1])


def first_in_voxel(xyz: Floats, voxel_m: float) -> Ints:
    """Return the rows, ascending, of the first point in each voxel; the lowest corner is in the middle of one."""
    exact = xyz.astype(np.float64)
    voxel = np.floor((exact - (exact.min(axis=0) - voxel_m / 2)) / voxel_m)
    order = np.lexsort(voxel.T)
    is_first = np.ones(len(xyz), dtype=np.bool_)
    is_first[1:] = (np.diff(voxel[order], axis=0) != 0).any(axis=1)
    return np.sort(order[is_first])


def _neighbour_pairs(xyz: Floats, instance: Ints, is_stuff: npt.NDArray[np.bool_], eps_m: float) -> tuple[Ints, Ints]:
    rows = np.flatnonzero(is_stuff[instance])
    from scipy.spatial import cKDTree  # noqa: PLC0415 - 40 MB that only scans need

    rows = rows[np.argsort(xyz[rows, 0], kind="stable")]
    # A fourth axis separates instances by more than eps, so that no pair joins two of them.
    separated = np.column_stack([xyz[rows].astype(np.float64), instance[rows] * (4.0 * eps_m)])
    pair_keys = [np.zeros(0, dtype=np.int64)]
    for begin in range(0, len(rows), POINTS_PER_PAIR_BLOCK):
        # From west to east, so that the partners of a block end not far behind it.
        end = min(begin + POINTS_PER_PAIR_BLOCK, len(rows))
        reach = np.searchsorted(separated[:, 0], separated[end - 1, 0] + eps_m, side="right")
        tree = cKDTree(separated[begin:reach], leafsize=32, balanced_tree=False)
        pairs = tree.query_pairs(eps_m, output_type="ndarray")
        left, right = rows[begin:reach][pairs[:, 0]], rows[begin:reach][pairs[:, 1]]
        key = (np.minimum(left, right) << 32) | np.maximum(left, right)
        pair_keys.append(key[pairs[:, 0] < end - begin])
    keys = np.sort(np.concatenate(pair_keys))
    starts = np.searchsorted(keys, np.arange(len(xyz) + 1) << 32)
    return starts, keys.astype(np.int32)  # the lower half: the later of the two
