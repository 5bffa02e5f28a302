"""Cut the solids of a map into pieces, a band of tiles at a time."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Final

import numpy as np
import shapely

from models.citymap.geometry.segments import Steps, snap, to_segments
from models.citymap.geometry.solids import FORMS, Form, Solid
from models.citymap.geometry.tiling import (
    ALL_TILES,
    BlockSet,
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
    """K pieces in order of tile; see `PieceTable`."""

    column: Ints  # [K] tile
    row: Ints  # [K] tile
    instance: Ints
    form: Ints
    dimension: Ints
    bounds_m: Floats
    heights_m: Floats
    crown_m: Floats
    point_count: Floats
    sizes: Ints  # [K] number of segments
    segments: Steps  # [S, 4] of all

    @classmethod
    def concatenate(cls, tables: Sequence["PieceRows"]) -> "PieceRows":
        """Concatenate tables."""
        return cls(*(np.concatenate([getattr(rows, f.name) for rows in tables]) for f in fields(cls)))

    def take(self, order: Ints) -> "PieceRows":
        """Return the given rows, in their order."""
        ends = np.cumsum(self.sizes)[order]
        columns = {f.name: getattr(self, f.name)[order] for f in fields(self) if f.name != "segments"}
        return replace(self, **columns, segments=self.segments[ranges(ends - self.sizes[order], ends)])


@dataclass(frozen=True, slots=True, eq=False)
class _SolidArrays:
    """N solids of one form, in columns."""

    form: int
    geometry: Geometries
    first: Ints  # [N] first column of tiles that each spans
    last: Ints  # [N] last one
    instance: Ints
    heights_m: Floats
    radius_m: Floats
    crown_m: Floats
    point_density: Floats

    @classmethod
    def from_solids(cls, solids: Sequence[Solid], form: Form) -> "_SolidArrays":
        chosen = [solid for solid in solids if solid.form == form]
        geometry = np.empty(len(chosen), dtype=object)
        geometry[:] = [solid.geometry for solid in chosen]
        return cls(
            FORMS.index(form),
            geometry,
            *tile_span(shapely.bounds(geometry)[:, [0, 2]]),
            np.array([solid.instance for solid in chosen], dtype=np.int64),
            np.array([(solid.base_m, solid.top_m) for solid in chosen]).reshape(-1, 2),
            np.array([solid.radius_m for solid in chosen]),
            np.array([solid.crown_m for solid in chosen]),
            np.array([solid.point_density for solid in chosen]),
        )

    def build_rows(self, column: Ints, row: Ints, solid: Ints, pieces: Geometries, size: Floats) -> PieceRows:
        """Build rows from pieces [K] of the solids `solid` [K]; points grow with the size of a piece."""
        starts, segments = to_segments(pieces, np.stack([column, row], axis=1))
        bounds = shapely.bounds(pieces) + self.radius_m[solid, None] * [-1, -1, 1, 1]
        return PieceRows(
            column.astype(np.int32),
            row.astype(np.int32),
            self.instance[solid].astype(np.int32),
            np.full(len(solid), self.form, np.int8),
            shapely.get_dimensions(pieces).astype(np.int8),
            bounds.astype(np.float32),
            self.heights_m[solid].astype(np.float32),
            self.crown_m[solid].astype(np.float32),
            (self.point_density[solid] * size).astype(np.float32),
            np.diff(starts).astype(np.int32),
            segments,
        )


def cut_band(solids: Sequence[Solid], band: TileSpan, blocks: BlockSet | None = None) -> PieceRows:
    """Cut solids into pieces in some columns of tiles; return them in order of tile, then instance.

    The solids include all that reach into these columns. The area with the lowest number covers others; solids of one
    instance of areas or lines have the same heights. With `blocks`, only pieces in these are returned, and all pieces
    of things with a piece there.
    """
    area, line, thing = (_SolidArrays.from_solids(solids, form) for form in FORMS)
    rows = PieceRows.concatenate(
        [_cut_stuff(area, band, blocks), _cut_stuff(line, band, blocks), _cut_things(thing, band, blocks)]
    )
    return rows.take(np.lexsort((rows.instance, rows.row, rows.column)))


def _cut_stuff(solids: _SolidArrays, band: TileSpan, blocks: BlockSet | None) -> PieceRows:
    """Return the pieces of lines or of the uncovered parts of areas: one for each connected group in a tile."""
    column, row, solid, geometry = _join_in_tiles(solids, band, blocks)
    is_area = FORMS[solids.form] == "area"
    of_piece, pieces = split_connected(geometry, 2 if is_area else 1)
    size = shapely.area(pieces) if is_area else shapely.length(pieces)
    return solids.build_rows(column[of_piece], row[of_piece], solid[of_piece], pieces, size)


def _cut_things(solids: _SolidArrays, band: TileSpan, blocks: BlockSet | None) -> PieceRows:
    """Return the pieces of things, which are kept whole: each tile's piece has its share of the points."""
    cut = clip_to_tiles(solids.geometry, ALL_TILES)
    geometry = snap(cut.geometry)
    is_left = ~shapely.is_empty(geometry)
    solid, geometry = cut.feature[is_left], geometry[is_left]
    length = shapely.length(geometry)
    size = np.where(length > 0, length, 1.0)  # 1 of points
    share = size / np.bincount(solid, size, len(solids.geometry))[solid]
    column, row = cut.column[is_left], cut.row[is_left]
    chosen = (column >= band[0]) & (column < band[1])
    if blocks is not None:
        chosen &= np.isin(solid, solid[blocks.contains(column, row)])
    return solids.build_rows(column[chosen], row[chosen], solid[chosen], geometry[chosen], share[chosen])


def _join_in_tiles(
    solids: _SolidArrays, band: TileSpan, blocks: BlockSet | None
) -> tuple[Ints, Ints, Ints, Geometries]:
    """Return (column, row, a solid, geometry) of each instance in each tile; of areas, the uncovered parts."""
    # Do not touch other geometries: a worker process would copy their memory.
    rows = np.flatnonzero((solids.first < band[1]) & (solids.last >= band[0]))
    cut = clip_to_tiles(solids.geometry[rows], band, blocks)
    solid = rows[cut.feature]
    order = np.lexsort((solids.instance[solid], cut.row, cut.column))
    column, row, solid, geometry = cut.column[order], cut.row[order], solid[order], cut.geometry[order]
    new = (np.diff(column, prepend=column[:1] - 1) != 0) | (np.diff(row, prepend=0) != 0)
    tile = np.cumsum(new) - 1
    group = np.cumsum(new | (np.diff(solids.instance[solid], prepend=-1) != 0)) - 1
    first, joined = join_pieces(group, geometry)
    if FORMS[solids.form] == "area":
        joined = subtract_covers(tile[first], joined)
    return column[first], row[first], solid[first], snap(joined)
