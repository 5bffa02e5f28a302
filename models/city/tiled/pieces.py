"""The table of pieces: what of each instance of a map lies in each tile, and which pieces hang together."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
import shapely

from models.city.points import Ints, ranges, thin
from models.city.tiled.segments import Steps, geometry_of, segments_of, snapped
from models.city.tiled.solids import FORMS, Solid
from models.city.tiled.tiling import (
    TILE_M,
    TOUCHING_M,
    Geometries,
    clip_to_tiles,
    join_pieces,
    take_apart,
    uncovered,
)
from models.city.types import Floats


@dataclass(frozen=True, eq=False)
class PieceTable:
    """K pieces, in order of tile, then instance.

    Attributes:
        low: [2] column and row of the first tile, shape: [2] how many there are.
        tile_starts: [columns * rows + 1] tile (c, r) has the pieces tile_starts[c * rows + r] to the next.
        instance: [K] int32.
        form: [K] index into FORMS.
        dimension: [K] int8 of its geometry: 0 for points, 1 for lines, 2 for areas.
        bounds_m: [K, 4] float32 its box, metres, map frame.
        heights_m: [K, 2] float32 base and top.
        crown_m: [K] float32 radius of a tree's crown, 0 for what has none.
        worth: [K] float32 points that a sensor would see of it.
        segment_starts: [K + 1], segments: [S, 4] int16 its lines and rings, see `segments_of`.
        link_starts: [K + 1], links: piece k hangs together with links[link_starts[k]:link_starts[k + 1]].
        whole: [K] its geometry, metres, map frame, if it is at hand; in an index it is not.
    """

    low: Ints
    shape: Ints
    tile_starts: Ints
    instance: Ints
    form: Ints
    dimension: Ints
    bounds_m: Floats
    heights_m: Floats
    crown_m: Floats
    worth: Floats
    segment_starts: Ints
    segments: Steps
    link_starts: Ints
    links: Ints
    whole: Geometries | None = None

    @classmethod
    def of(cls, solids: Sequence[Solid]) -> "PieceTable":
        """The pieces of a map's features."""
        parts = [
            _stuff(solids, "area", 2, shapely.area),
            _stuff(solids, "line", 1, shapely.length),
            _things(solids),
        ]
        rows = _Rows(*(np.concatenate([getattr(some, f.name) for some in parts]) for f in fields(_Rows)))
        low = np.array([rows.column.min(), rows.row.min()])
        shape = np.array([rows.column.max(), rows.row.max()]) - low + 1
        tile = (rows.column - low[0]) * shape[1] + rows.row - low[1]
        order = np.lexsort((rows.instance, tile))
        at = np.stack([rows.column, rows.row], axis=1)[order]
        starts = np.searchsorted(tile[order], np.arange(shape[0] * shape[1] + 1))
        geometry = rows.geometry[order]
        link_starts, links = _links(tile[order], shape, low, rows.instance[order], rows.form[order], geometry)
        return cls(
            low, shape, starts, rows.instance[order].astype(np.int32), rows.form[order].astype(np.int8),
            shapely.get_dimensions(geometry).astype(np.int8),
            rows.bounds_m[order].astype(np.float32), rows.heights_m[order].astype(np.float32),
            rows.crown_m[order].astype(np.float32), rows.worth[order].astype(np.float32),
            *segments_of(geometry, at), link_starts, links, geometry,
        )  # fmt: skip

    @classmethod
    def of_columns(cls, columns: Mapping[str, npt.NDArray[Any]]) -> "PieceTable":
        """What `columns` gave; of none of them the geometry is at hand."""
        return cls(**columns)

    def columns(self) -> dict[str, npt.NDArray[Any]]:
        """All but `whole`, by name."""
        return {f.name: getattr(self, f.name) for f in fields(self) if f.name != "whole"}

    def geometry(self, pieces: Ints) -> Geometries:
        """[n] of some pieces, metres, map frame; to a fifth of a millimetre where it has to be put together."""
        if self.whole is not None:
            return self.whole[pieces]
        return geometry_of(self.segment_starts, self.segments, self.tile, self.dimension, pieces)

    def in_tiles(self, first: Ints, last: Ints) -> tuple[Ints, Ints]:
        """The pieces in rectangles of tiles.

        Args:
            first: [n, 2] column and row of their first corners.
            last: [n, 2] the same of the last, which are within.

        Returns:
            [P] which rectangle, ascending, and [P] which piece, ascending in it.
        """
        first = np.maximum(first - self.low, 0)
        last = np.minimum(last - self.low, self.shape - 1)
        columns = np.maximum(last[:, 0] - first[:, 0] + 1, 0)
        of = np.repeat(np.arange(len(first)), columns)
        column = ranges(first[:, 0], first[:, 0] + columns) * self.shape[1]
        begin = self.tile_starts[column + np.minimum(first[of, 1], self.shape[1])]
        end = np.maximum(begin, self.tile_starts[column + np.maximum(last[of, 1] + 1, 0)])
        return np.repeat(of, end - begin), ranges(begin, end)

    @cached_property
    def tile(self) -> Ints:
        """[K, 2] column and row of each piece's tile."""
        number = np.repeat(np.arange(len(self.tile_starts) - 1), np.diff(self.tile_starts))
        return np.stack([number // self.shape[1], number % self.shape[1]], axis=1) + self.low

    def lattice(self, pieces: Ints, spacing_m: float) -> Floats:
        """[n, 2] places in some areas, one a square block of `spacing_m` of which a corner or a middle is inside."""
        step_m = spacing_m / 2
        low, high = (np.floor(self.bounds_m[pieces, axis : axis + 2] / step_m).astype(np.int64) + 1 for axis in (0, 2))
        across, along = (np.maximum(high - low, 0)).T
        of = np.repeat(np.arange(len(pieces)), across * along)
        nth = ranges(np.zeros(len(pieces), np.int64), across * along)
        xy = np.stack([low[of, 0] + nth // along[of], low[of, 1] + nth % along[of]], axis=1) * step_m
        areas = self.geometry(pieces)
        shapely.prepare(areas)
        return thin(xy[shapely.contains_xy(areas[of], *xy.T)], spacing_m)


@dataclass(frozen=True, slots=True, eq=False)
class _Rows:
    column: Ints
    row: Ints
    instance: Ints
    form: Ints
    geometry: Geometries
    bounds_m: Floats
    heights_m: Floats
    crown_m: Floats
    worth: Floats


def _stuff(solids: Sequence[Solid], form: str, dimensions: int, size: Callable[[Geometries], Floats]) -> _Rows:
    """Pieces of areas (of what nothing covers) or of lines; `size` is what their worth is of."""
    chosen = [solid for solid in solids if solid.form == form]
    column, row, of, geometry = _joined(chosen, covers=form == "area")
    of_piece, pieces = take_apart(geometry, dimensions)
    worth = np.array([solid.worth for solid in chosen])[of[of_piece]] * size(pieces)
    return _rows(chosen, column[of_piece], row[of_piece], of[of_piece], pieces, worth)


def _things(solids: Sequence[Solid]) -> _Rows:
    chosen = [solid for solid in solids if solid.form == "thing"]
    cut = clip_to_tiles(_array([solid.geometry for solid in chosen]))
    geometry = snapped(cut.geometry)
    kept = ~shapely.is_empty(geometry)
    column, row, of, geometry = cut.column[kept], cut.row[kept], cut.feature[kept], geometry[kept]
    size = _extent(geometry)
    whole = np.bincount(of, size, len(chosen))
    worth = np.array([solid.worth for solid in chosen])[of] * size / whole[of]
    return _rows(chosen, column, row, of, geometry, worth)


def _joined(chosen: Sequence[Solid], covers: bool) -> tuple[Ints, Ints, Ints, Geometries]:
    """(column, row, first feature, geometry) of each instance in each tile; of areas, what nothing covers."""
    cut = clip_to_tiles(_array([solid.geometry for solid in chosen]))
    instance = np.array([solid.instance for solid in chosen], dtype=np.int64)
    known, first = np.unique(instance, return_index=True)
    rank = first[np.searchsorted(known, instance)][cut.feature]  # its first feature: what comes first covers
    order = np.lexsort((rank, cut.row, cut.column))
    column, row, rank, geometry = cut.column[order], cut.row[order], rank[order], cut.geometry[order]
    new = (np.diff(column, prepend=column[:1] - 1) != 0) | (np.diff(row, prepend=0) != 0)
    tile = np.cumsum(new) - 1
    group = np.cumsum(new | (np.diff(rank, prepend=-1) != 0)) - 1
    at, joined = join_pieces(group, geometry)
    if covers:
        joined = uncovered(tile[at], joined)
    return column[at], row[at], rank[at], snapped(joined)


def _rows(chosen: Sequence[Solid], column: Ints, row: Ints, of: Ints, pieces: Geometries, worth: Floats) -> _Rows:
    instance = np.array([solid.instance for solid in chosen], dtype=np.int64)[of]
    heights = np.array([(solid.base_m, solid.top_m) for solid in chosen]).reshape(-1, 2)[of]
    form = np.full(len(of), FORMS.index(chosen[0].form) if chosen else 0)
    radius = np.array([solid.radius_m for solid in chosen])[of]
    bounds = shapely.bounds(pieces) + radius[:, None] * [-1, -1, 1, 1]
    crown = np.array([solid.crown_m for solid in chosen])[of]
    return _Rows(column, row, instance, form, pieces, bounds, heights, crown, worth)


def _array(geometries: Sequence[shapely.Geometry]) -> Geometries:
    array = np.empty(len(geometries), dtype=object)
    array[:] = geometries
    return array


def _extent(geometry: Geometries) -> Floats:
    """Length of lines and outlines; 1 of points."""
    length = shapely.length(geometry)
    return np.where(length > 0, length, 1.0)


def _links(tile: Ints, shape: Ints, low: Ints, instance: Ints, form: Ints, geometry: Geometries) -> tuple[Ints, Ints]:
    """CSR of pairs of pieces of one instance that touch across the border of two tiles."""
    stuff = np.flatnonzero(form != FORMS.index("thing"))
    found = [_across(axis, tile, shape, low, instance, geometry, stuff) for axis in (0, 1)]
    one, other = (np.concatenate([some[n] for some in found]) for n in range(2))
    a, b = np.concatenate([one, other]), np.concatenate([other, one])
    order = np.lexsort((b, a))
    a, b = a[order], b[order]
    kept = (np.diff(a, prepend=-1) != 0) | (np.diff(b, prepend=-1) != 0)
    return np.searchsorted(a[kept], np.arange(len(tile) + 1)), b[kept].astype(np.int32)


def _across(
    axis: int, tile: Ints, shape: Ints, low: Ints, instance: Ints, geometry: Geometries, stuff: Ints
) -> tuple[Ints, Ints]:
    """Pairs of pieces that touch across borders where x (axis 0) or y (axis 1) is constant."""
    xy, of = shapely.get_coordinates(geometry[stuff], return_index=True)
    of = stuff[of]
    at = np.stack([tile[of] // shape[1] + low[0], tile[of] % shape[1] + low[1]], axis=1)
    borders, intervals, pieces = [], [], []
    for side in (-1, 1):
        border = (at[:, axis] + side / 2) * TILE_M
        on = np.abs(xy[:, axis] - border) < 1e-6
        goes_on = np.flatnonzero(on[:-1] & on[1:] & (of[:-1] == of[1:]))
        is_line = on & (shapely.get_dimensions(geometry[of]) == 1)
        alone = np.flatnonzero(is_line)
        for first, last in ((goes_on, goes_on + 1), (alone, alone)):
            along = np.sort(np.stack([xy[first, 1 - axis], xy[last, 1 - axis]], axis=1), axis=1)
            number = at[first, axis] + (side + 1) // 2  # of the border, from low to high
            borders.append(np.stack([number, at[first, 1 - axis], instance[of[first]]], axis=1))
            intervals.append(along)
            pieces.append(of[first])
    border, interval, piece = (np.concatenate(some) for some in (borders, intervals, pieces))
    group = np.unique(border, axis=0, return_inverse=True)[1].ravel()
    order = np.lexsort((interval[:, 0], group))
    group, interval, piece = group[order], interval[order], piece[order]
    # In each group, sweep along the border: what begins before all earlier ones have ended touches them.
    reach = _running_end(group, interval[:, 1])
    touches = np.flatnonzero((group[1:] == group[:-1]) & (interval[1:, 0] <= reach[:-1] + TOUCHING_M))
    one, other = piece[touches], piece[touches + 1]
    different = one != other
    return one[different], other[different]


def _running_end(group: Ints, end: Floats) -> Floats:
    """Greatest end so far in each group; `group` ascending."""
    span = float(np.ptp(end)) + 1.0 if len(end) else 1.0
    raised: Floats = np.maximum.accumulate(end + group * 2 * span) - group * 2 * span
    return raised
