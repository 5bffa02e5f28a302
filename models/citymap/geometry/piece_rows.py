"""The pieces of a map's solids as they are cut, a band of tiles at a time."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Final

import numpy as np
import shapely

from models.citymap.geometry.segments import Steps, snap, to_segments
from models.citymap.geometry.solids import FORMS, Form, Solid
from models.citymap.geometry.tiling import (
    ALL_TILES,
    Geometries,
    TileSpan,
    clip_to_tiles,
    join_pieces,
    split_connected,
    subtract_covers,
    tile_span,
)
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats

TILE_COLUMNS_PER_BAND: Final = 24  # columns of tiles that are cut together


@dataclass(frozen=True, slots=True, eq=False)
class PieceRows:
    """Pieces, K rows in order of tile; see `PieceTable`.

    Attributes:
        column, row: [K] tile.
        instance, form, dimension, bounds_m, heights_m, crown_m, point_count: as of the table.
        sizes: [K] segments of each.
        segments: [S, 4] of all.
    """

    column: Ints
    row: Ints
    instance: Ints
    form: Ints
    dimension: Ints
    bounds_m: Floats
    heights_m: Floats
    crown_m: Floats
    point_count: Floats
    sizes: Ints
    segments: Steps

    @classmethod
    def concatenate(cls, some: Sequence["PieceRows"]) -> "PieceRows":
        """All of some, one after the other."""
        return cls(*(np.concatenate([getattr(rows, f.name) for rows in some]) for f in fields(cls)))

    def take(self, order: Ints) -> "PieceRows":
        """Some of them, in the given order."""
        ends = np.cumsum(self.sizes)[order]
        columns = {f.name: getattr(self, f.name)[order] for f in fields(self) if f.name != "segments"}
        return replace(self, **columns, segments=self.segments[ranges(ends - self.sizes[order], ends)])


@dataclass(frozen=True, slots=True, eq=False)
class _SolidArrays:
    """N solids of one form.

    Attributes:
        first, last: [N] columns of tiles that each reaches over.
    """

    form: int
    geometry: Geometries
    first: Ints
    last: Ints
    instance: Ints
    heights_m: Floats
    radius_m: Floats
    crown_m: Floats
    point_density: Floats

    @classmethod
    def from_solids(cls, solids: Sequence[Solid], form: Form) -> "_SolidArrays":
        some = [solid for solid in solids if solid.form == form]
        geometry = np.empty(len(some), dtype=object)
        geometry[:] = [solid.geometry for solid in some]
        return cls(
            FORMS.index(form),
            geometry,
            *tile_span(shapely.bounds(geometry)[:, [0, 2]]),
            np.array([solid.instance for solid in some], dtype=np.int64),
            np.array([(solid.base_m, solid.top_m) for solid in some]).reshape(-1, 2),
            np.array([solid.radius_m for solid in some]),
            np.array([solid.crown_m for solid in some]),
            np.array([solid.point_density for solid in some]),
        )

    def build_rows(self, column: Ints, row: Ints, of: Ints, pieces: Geometries, size: Floats) -> PieceRows:
        """Pieces of these; `of` [K] says of which, and their worth grows with their size."""
        starts, segments = to_segments(pieces, np.stack([column, row], axis=1))
        bounds = shapely.bounds(pieces) + self.radius_m[of, None] * [-1, -1, 1, 1]
        return PieceRows(
            column.astype(np.int32),
            row.astype(np.int32),
            self.instance[of].astype(np.int32),
            np.full(len(of), self.form, np.int8),
            shapely.get_dimensions(pieces).astype(np.int8),
            bounds.astype(np.float32),
            self.heights_m[of].astype(np.float32),
            self.crown_m[of].astype(np.float32),
            (self.point_density[of] * size).astype(np.float32),
            np.diff(starts).astype(np.int32),
            segments,
        )


def cut_band(solids: Sequence[Solid], band: TileSpan) -> PieceRows:
    """The pieces of solids in some columns of tiles, in order of tile, then instance.

    Args:
        solids: all that reach into these columns, and maybe others. Of areas, what has the least number covers others;
            solids of one instance of areas or lines have the same heights.
        band: the columns.
    """
    area, line, thing = (_SolidArrays.from_solids(solids, form) for form in FORMS)
    rows = PieceRows.concatenate([_cut_stuff(area, band), _cut_stuff(line, band), _cut_things(thing, band)])
    return rows.take(np.lexsort((rows.instance, rows.row, rows.column)))


def _cut_stuff(chosen: _SolidArrays, band: TileSpan) -> PieceRows:
    """Pieces of areas (of what nothing covers) or of lines, each with what hangs together in a tile."""
    column, row, of, geometry = _join_in_tiles(chosen, band)
    is_area = FORMS[chosen.form] == "area"
    of_piece, pieces = split_connected(geometry, 2 if is_area else 1)
    size = shapely.area(pieces) if is_area else shapely.length(pieces)
    return chosen.build_rows(column[of_piece], row[of_piece], of[of_piece], pieces, size)


def _cut_things(chosen: _SolidArrays, band: TileSpan) -> PieceRows:
    """Pieces of things, which are whole: each tile's part is worth its share."""
    cut = clip_to_tiles(chosen.geometry, ALL_TILES)
    geometry = snap(cut.geometry)
    kept = ~shapely.is_empty(geometry)
    of, geometry = cut.feature[kept], geometry[kept]
    length = shapely.length(geometry)
    size = np.where(length > 0, length, 1.0)  # 1 of points
    share = size / np.bincount(of, size, len(chosen.geometry))[of]
    column, row = cut.column[kept], cut.row[kept]
    here = (column >= band[0]) & (column < band[1])
    return chosen.build_rows(column[here], row[here], of[here], geometry[here], share[here])


def _join_in_tiles(chosen: _SolidArrays, band: TileSpan) -> tuple[Ints, Ints, Ints, Geometries]:
    """(column, row, a solid, geometry) of each instance in each tile; of areas, what nothing covers."""
    # Of others no geometry is looked at: a process that does so has a copy of it.
    rows = np.flatnonzero((chosen.first < band[1]) & (chosen.last >= band[0]))
    cut = clip_to_tiles(chosen.geometry[rows], band)
    of = rows[cut.feature]
    order = np.lexsort((chosen.instance[of], cut.row, cut.column))
    column, row, of, geometry = cut.column[order], cut.row[order], of[order], cut.geometry[order]
    new = (np.diff(column, prepend=column[:1] - 1) != 0) | (np.diff(row, prepend=0) != 0)
    tile = np.cumsum(new) - 1
    group = np.cumsum(new | (np.diff(chosen.instance[of], prepend=-1) != 0)) - 1
    at, joined = join_pieces(group, geometry)
    if FORMS[chosen.form] == "area":
        joined = subtract_covers(tile[at], joined)
    return column[at], row[at], of[at], snap(joined)
