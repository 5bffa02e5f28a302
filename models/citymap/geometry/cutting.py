"""Cut cubes out of a map of pieces (docs/formats.md, rules 4 and 5), by geometry alone."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, cast

import numpy as np
import numpy.typing as npt
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from models.citymap.cells import PartTable
from models.citymap.geometry.pieces import PieceTable
from models.citymap.geometry.solids import THING, Shape, Solid, crown_reach_m, sample_solid
from models.citymap.geometry.tiling import TILE_M, TILE_SLACK_M, Geometries
from models.citymap.point_sample import FIXED_SAMPLING, PointSampling, sample_points, stack_samples
from models.citymap.points import Ints, ranges
from models.citymap.types import CutRules, Floats
from models.processes import map_forked
from models.spool import spooled

CUBES_PER_TASK = 1024  # cubes that one worker process cuts at a time


@dataclass(frozen=True, slots=True, eq=False)
class CubeContents:
    """The pieces in some cubes: P rows in order of cube."""

    cube: Ints  # [P]
    piece: Ints  # [P]
    geometry: Geometries  # [P] the part of the piece in the cube
    bounds_m: Floats  # [P, 4] its box
    point_count: Floats  # [P] its share of the piece's points

    @classmethod
    def cut(cls, table: PieceTable, centers_m: Floats, size_m: float) -> "CubeContents":
        """Cut cubes of a size around centres [N, 2 or more]."""
        low, high = centers_m[:, :2] - size_m / 2, centers_m[:, :2] + size_m / 2
        cube, piece = _pieces_in_cubes(table, centers_m, size_m)
        geometry, bounds, point_count = (
            table.geometry(piece),
            table.bounds_m[piece],
            table.point_count[piece].astype(np.float64),
        )
        cut = (bounds[:, :2] < low[cube] - TILE_SLACK_M).any(axis=1) | (bounds[:, 2:] > high[cube] + TILE_SLACK_M).any(
            axis=1
        )
        rows = np.flatnonzero(cut)
        if len(rows):
            _clip(geometry, rows, cube[rows], low, high)
            before = table.geometry(piece[rows])
            point_count[rows] *= _extent(geometry[rows]) / _extent(before)
            bounds[rows] = shapely.bounds(geometry[rows])
        is_inside = ~shapely.is_empty(geometry)
        return cls(cube[is_inside], piece[is_inside], geometry[is_inside], bounds[is_inside], point_count[is_inside])


def _pieces_in_cubes(table: PieceTable, centers_m: Floats, size_m: float) -> tuple[Ints, Ints]:
    """Return cube [P], ascending, and piece [P] in the tiles of cubes around centres [N, 2 or more], not above them."""
    low, high = centers_m[:, :2] - size_m / 2, centers_m[:, :2] + size_m / 2
    first = np.floor((low + TILE_SLACK_M) / TILE_M + 0.5).astype(np.int64)
    last = np.floor((high - TILE_SLACK_M) / TILE_M + 0.5).astype(np.int64)
    cube, piece = table.in_tiles(first, last)
    if centers_m.shape[1] < 3:
        return cube, piece
    is_below = table.heights_m[piece, 0] <= centers_m[cube, 2] + size_m / 2
    return cube[is_below], piece[is_below]


def _clip(geometry: Geometries, rows: Ints, cube: Ints, low: Floats, high: Floats) -> None:
    first = np.flatnonzero(np.diff(cube, prepend=-1))
    for begin, end in zip(first, np.append(first[1:], len(rows)), strict=True):
        n = cube[begin]
        geometry[rows[begin:end]] = shapely.clip_by_rect(geometry[rows[begin:end]], *low[n], *high[n])


def _extent(geometry: Geometries) -> Floats:
    area, length = shapely.area(geometry), shapely.length(geometry)
    return np.where(area > 0, area, np.where(length > 0, length, 1.0))


def connected_pieces(table: PieceTable, cube: Ints, piece: Ints, is_linked: npt.NDArray[np.bool_]) -> Ints:
    """Return the number [P] of the connected group of each piece in its cube; cubes ascend, and pieces in each cube."""
    key = cube.astype(np.int64) * len(table.instance) + piece
    rows = np.flatnonzero(is_linked)
    begin, end = table.link_starts[piece[rows]], table.link_starts[piece[rows] + 1]
    source = np.repeat(rows, end - begin)
    wanted = cube[source].astype(np.int64) * len(table.instance) + table.links[ranges(begin, end)]
    target = np.minimum(np.searchsorted(key, wanted), len(key) - 1)
    is_in_cube = (key[target] == wanted) & is_linked[target] if len(key) else np.zeros(0, np.bool_)
    graph = coo_array((np.ones(is_in_cube.sum()), (source[is_in_cube], target[is_in_cube])), shape=(len(key),) * 2)
    return connected_components(graph, directed=False)[1]


def cut_pieces(
    table: PieceTable,
    instance_rgb: Floats,
    centers_m: Floats,
    rules: CutRules,
    progress: Callable[[int, int], None] | None = None,
    min_parts: int = 0,
) -> PartTable:
    """Cut the cubes around centres [N, 3] as `cells.cut_cubes`; cubes of fewer than `min_parts` parts stay empty.

    Colours [I, 3] of instances are NaN where unknown.
    """
    chunks = [centers_m[i : i + CUBES_PER_TASK] for i in range(0, len(centers_m), CUBES_PER_TASK)] or [centers_m]
    cut = _cut_rich_cubes if min_parts else _cut_chunk
    work = partial(cut, table, InstanceTotals.from_pieces(table), rules, min_parts)
    done = 0

    def columns() -> Iterator[dict[str, npt.NDArray[Any]]]:
        nonlocal done
        for parts in map_forked(work, chunks):
            yield {
                "sizes": np.diff(parts.starts),
                **{name: getattr(parts, name) for name in ("instance", "count", "low_m", "high_m", "closest_m")},
                "rgb": instance_rgb[parts.instance].astype(np.float32),
            }
            done += len(parts.starts) - 1
            if progress:
                progress(done, len(centers_m))

    columns_of_all = spooled(columns())
    return PartTable(starts=np.concatenate([[0], np.cumsum(columns_of_all.pop("sizes"))]), **columns_of_all)


@dataclass(frozen=True, slots=True, eq=False)
class InstanceTotals:
    """Sums over all pieces of each instance, for things, which are kept whole."""

    point_count: Floats  # [I]
    bounds_m: Floats  # [I, 4]

    @classmethod
    def from_pieces(cls, table: PieceTable) -> "InstanceTotals":
        """Sum up all instances of a table."""
        count = int(table.instance.max()) + 1
        bounds = np.full((count, 4), np.inf) * [1, 1, -1, -1]
        np.minimum.at(bounds[:, :2], table.instance, table.bounds_m[:, :2])
        np.maximum.at(bounds[:, 2:], table.instance, table.bounds_m[:, 2:])
        point_count = np.bincount(table.instance, table.point_count, count).astype(np.float64)
        return cls(point_count, bounds)


@dataclass(frozen=True, slots=True, eq=False)
class _PartGroups:
    """The parts in some cubes as groups of pieces."""

    cubes: CubeContents
    order: Ints  # [P'] rows of `cubes`, group after group; groups by cube, things first, then instance
    starts: Ints  # [G] where in `order` each group begins
    is_kept: npt.NDArray[np.bool_]  # [G] whether the group is large enough to be a part

    @classmethod
    def cut(cls, table: PieceTable, whole: InstanceTotals, rules: CutRules, centers: Floats) -> "_PartGroups":
        """Cut the cubes around centres."""
        cubes = CubeContents.cut(table, centers, rules.cell_size_m)
        return cls(cubes, *_group(table, whole, rules, cubes.cube, cubes.piece, cubes.point_count))


def _group(
    table: PieceTable, whole: InstanceTotals, rules: CutRules, cube: Ints, piece: Ints, point_count: Floats
) -> tuple[Ints, Ints, npt.NDArray[np.bool_]]:
    """Return `order`, `starts` and `is_kept` of `_PartGroups` for pieces [P] in cubes and their points there."""
    is_thing = table.form[piece] == THING
    instance = table.instance[piece].astype(np.int64)
    hanging = connected_pieces(table, cube, piece, ~is_thing)
    group = np.where(is_thing, -1 - cube * len(whole.point_count) - instance, hanging)
    order = np.lexsort((group, instance, ~is_thing, cube))
    starts = np.flatnonzero(np.diff(group[order], prepend=group[order[:1]] - 1))
    points_of_group = np.add.reduceat(point_count[order], starts) if len(starts) else np.zeros(0)
    first = order[starts]
    share = rules.thing_share * whole.point_count[instance[first]]
    return order, starts, points_of_group >= np.where(is_thing[first], share, rules.min_part_points)


def _cut_rich_cubes(
    table: PieceTable, whole: InstanceTotals, rules: CutRules, min_parts: int, centers: Floats
) -> PartTable:
    """Cut the cubes that may have enough parts, as `_cut_chunk`; building geometry is what takes time."""
    cube, piece = _pieces_in_cubes(table, centers, rules.cell_size_m)
    point_count = table.point_count[piece].astype(np.float64)  # at least those in the cube
    order, starts, is_kept = _group(table, whole, rules, cube, piece, point_count)
    rich = np.flatnonzero(np.bincount(cube[order[starts[is_kept]]], minlength=len(centers)) >= min_parts)
    parts = _cut_chunk(table, whole, rules, min_parts, centers[rich])
    sizes = np.zeros(len(centers), np.int64)
    sizes[rich] = np.diff(parts.starts)
    return replace(parts, starts=np.concatenate([[0], np.cumsum(sizes)]))


def _cut_chunk(table: PieceTable, whole: InstanceTotals, rules: CutRules, min_parts: int, centers: Floats) -> PartTable:
    """Cut some cubes; the colours are left out."""
    grouped = _PartGroups.cut(table, whole, rules, centers)
    cubes, order, starts = grouped.cubes, grouped.order, grouped.starts
    if not grouped.is_kept.any():
        return _empty(len(centers))
    first = order[starts]
    cube, piece = cubes.cube[first], cubes.piece[first]
    instance, thing = table.instance[piece], table.form[piece] == THING
    low = np.minimum.reduceat(cubes.bounds_m[order, :2], starts)
    high = np.maximum.reduceat(cubes.bounds_m[order, 2:], starts)
    heights = table.heights_m[cubes.piece[order]]
    base, top = np.minimum.reduceat(heights[:, 0], starts), np.maximum.reduceat(heights[:, 1], starts)
    closest = _closest_points(cubes.geometry[order], centers[cubes.cube[order]], starts)
    offset = centers[cube, :2] - closest
    metres = np.hypot(*offset.T)
    closest += offset * (crown_reach_m(metres, table.crown_m[piece]) / np.maximum(metres, 1e-9))[:, None]
    box = np.where(thing[:, None], whole.bounds_m[instance], np.concatenate([low, high], axis=1))
    count = np.where(thing, whole.point_count[instance], np.add.reduceat(cubes.point_count[order], starts))
    top = np.where(thing, top, np.minimum(top, np.maximum(centers[cube, 2] + rules.cell_size_m / 2, base)))
    rows = np.flatnonzero(grouped.is_kept)
    rows = rows[(np.bincount(cube[rows], minlength=len(centers)) >= min_parts)[cube[rows]]]
    return PartTable(
        starts=np.searchsorted(cube[rows], np.arange(len(centers) + 1)),
        instance=instance[rows].astype(np.int32),
        count=np.round(count[rows]).astype(np.int32),
        low_m=np.column_stack([box[:, :2], base])[rows].astype(np.float32),
        high_m=np.column_stack([box[:, 2:], top])[rows].astype(np.float32),
        closest_m=np.column_stack([closest, np.clip(centers[cube, 2], base, top)])[rows].astype(np.float32),
        rgb=np.zeros((0, 3), np.float32),  # `cut_pieces` adds the colours of the instances
    )


def sample_pieces(
    table: PieceTable,
    instance_rgb: Floats,
    shapes: Sequence[str],
    centers_m: Floats,
    rules: CutRules,
    sampling: PointSampling = FIXED_SAMPLING,
) -> Floats:
    """Return sampled points [R, 256, 6] of the parts in cubes around centres [N, 3], in order of `PartTable`."""
    grouped = _PartGroups.cut(table, InstanceTotals.from_pieces(table), rules, centers_m.astype(np.float64))
    return stack_samples(
        [
            sample_points(
                xyz, np.broadcast_to(instance_rgb[instance], xyz.shape), sampling, centers_m[cube], rules.cell_size_m
            )
            for cube, instance, xyz in _sample_parts(table, shapes, grouped)
        ]
    )


def scan_pieces(table: PieceTable, shapes: Sequence[str], centers_m: Floats, rules: CutRules) -> Floats:
    """Return the point [R, 3] (float32) of each part that is nearest to the centre, among the points a scan would have.

    Arguments and order are those of `sample_pieces`. Scanned points lie apart: far edges can be metres off.
    """
    grouped = _PartGroups.cut(table, InstanceTotals.from_pieces(table), rules, centers_m.astype(np.float64))
    closest = [np.zeros((0, 3))]
    for cube, _, xyz in _sample_parts(table, shapes, grouped):
        closest.append(xyz[np.argmin(((xyz - centers_m[cube]) ** 2).sum(axis=1))][None])
    return np.concatenate(closest).astype(np.float32)


def _sample_parts(table: PieceTable, shapes: Sequence[str], grouped: _PartGroups) -> Iterator[tuple[int, int, Floats]]:
    """Yield the cube, the instance and points [P, 3] in metres of each part in some cubes."""
    for rows in [
        r for r, is_kept in zip(np.split(grouped.order, grouped.starts[1:]), grouped.is_kept, strict=True) if is_kept
    ]:
        piece = grouped.cubes.piece[rows]
        instance, solids = int(table.instance[piece[0]]), []
        for n, geometry in zip(piece.tolist(), grouped.cubes.geometry[rows], strict=True):
            base, top = (float(z) for z in table.heights_m[n])
            solids.append(Solid(instance, cast(Shape, shapes[instance]), geometry, base, top))
        xyz = np.concatenate([sample_solid(solid) for solid in solids])
        xyz = xyz if len(xyz) else np.array([[*shapely.get_coordinates(solids[0].geometry)[0], 0.0]])
        yield int(grouped.cubes.cube[rows[0]]), instance, xyz


def _closest_points(geometry: Geometries, centers: Floats, starts: Ints) -> Floats:
    """Return the point [G, 2] nearest to the centre of each group of geometries; groups begin at `starts`."""
    lines = shapely.shortest_line(shapely.points(centers[:, :2]), geometry)
    metres = shapely.length(lines)
    smallest = np.minimum.reduceat(metres, starts)
    sizes = np.diff(np.append(starts, len(metres)))
    best = np.flatnonzero(metres == np.repeat(smallest, sizes))
    group = np.repeat(np.arange(len(starts)), sizes)[best]
    first = best[np.diff(group, prepend=-1) != 0]
    return shapely.get_coordinates(lines[first]).reshape(-1, 2, 2)[:, 1]


def _empty(cubes: int) -> PartTable:
    none = np.zeros((0, 3), np.float32)
    return PartTable(
        np.zeros(cubes + 1, np.int64), np.zeros(0, np.int32), np.zeros(0, np.int32), none, none, none, none
    )
