"""The pieces of a map's solids as they are cut, a band of tiles at a time."""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Final

import numpy as np
import shapely

from models.citymap.geometry.segments import Steps, segments_of, snapped
from models.citymap.geometry.solids import FORMS, Form, Solid
from models.citymap.geometry.tiling import (
    EVERYWHERE,
    Geometries,
    Span,
    band_of,
    clip_to_tiles,
    join_pieces,
    take_apart,
    uncovered,
)
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats

BAND: Final = 24  # columns of tiles that are cut together


@dataclass(frozen=True, slots=True, eq=False)
class Rows:
    """Pieces, K rows in order of tile; see `PieceTable`.

    Attributes:
        column, row: [K] tile.
        instance, form, dimension, bounds_m, heights_m, crown_m, worth: as of the table.
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
    worth: Floats
    sizes: Ints
    segments: Steps

    @classmethod
    def joined(cls, some: Sequence["Rows"]) -> "Rows":
        """All of some, one after the other."""
        return cls(*(np.concatenate([getattr(rows, f.name) for rows in some]) for f in fields(cls)))

    def take(self, order: Ints) -> "Rows":
        """Some of them, in the given order."""
        ends = np.cumsum(self.sizes)[order]
        columns = {f.name: getattr(self, f.name)[order] for f in fields(self) if f.name != "segments"}
        return replace(self, **columns, segments=self.segments[ranges(ends - self.sizes[order], ends)])


@dataclass(frozen=True, slots=True, eq=False)
class _Chosen:
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
    worth: Floats

    @classmethod
    def of(cls, solids: Sequence[Solid], form: Form) -> "_Chosen":
        some = [solid for solid in solids if solid.form == form]
        geometry = np.empty(len(some), dtype=object)
        geometry[:] = [solid.geometry for solid in some]
        return cls(
            FORMS.index(form),
            geometry,
            *band_of(shapely.bounds(geometry)[:, [0, 2]]),
            np.array([solid.instance for solid in some], dtype=np.int64),
            np.array([(solid.base_m, solid.top_m) for solid in some]).reshape(-1, 2),
            np.array([solid.radius_m for solid in some]),
            np.array([solid.crown_m for solid in some]),
            np.array([solid.worth for solid in some]),
        )

    def rows(self, column: Ints, row: Ints, of: Ints, pieces: Geometries, size: Floats) -> Rows:
        """Pieces of these; `of` [K] says of which, and their worth grows with their size."""
        starts, segments = segments_of(pieces, np.stack([column, row], axis=1))
        bounds = shapely.bounds(pieces) + self.radius_m[of, None] * [-1, -1, 1, 1]
        return Rows(
            column.astype(np.int32),
            row.astype(np.int32),
            self.instance[of].astype(np.int32),
            np.full(len(of), self.form, np.int8),
            shapely.get_dimensions(pieces).astype(np.int8),
            bounds.astype(np.float32),
            self.heights_m[of].astype(np.float32),
            self.crown_m[of].astype(np.float32),
            (self.worth[of] * size).astype(np.float32),
            np.diff(starts).astype(np.int32),
            segments,
        )


def rows_in(solids: Sequence[Solid], band: Span) -> Rows:
    """The pieces of solids in some columns of tiles, in order of tile, then instance.

    Args:
        solids: all that reach into these columns, and maybe others. Of areas, what has the least number covers others;
            solids of one instance of areas or lines have the same heights.
        band: the columns.
    """
    area, line, thing = (_Chosen.of(solids, form) for form in FORMS)
    rows = Rows.joined([_stuff_of(area, band), _stuff_of(line, band), _things_of(thing, band)])
    return rows.take(np.lexsort((rows.instance, rows.row, rows.column)))


def _stuff_of(chosen: _Chosen, band: Span) -> Rows:
    """Pieces of areas (of what nothing covers) or of lines, each with what hangs together in a tile."""
    column, row, of, geometry = _joined(chosen, band)
    is_area = FORMS[chosen.form] == "area"
    of_piece, pieces = take_apart(geometry, 2 if is_area else 1)
    size = shapely.area(pieces) if is_area else shapely.length(pieces)
    return chosen.rows(column[of_piece], row[of_piece], of[of_piece], pieces, size)


def _things_of(chosen: _Chosen, band: Span) -> Rows:
    """Pieces of things, which are whole: each tile's part is worth its share."""
    cut = clip_to_tiles(chosen.geometry, EVERYWHERE)
    geometry = snapped(cut.geometry)
    kept = ~shapely.is_empty(geometry)
    of, geometry = cut.feature[kept], geometry[kept]
    length = shapely.length(geometry)
    size = np.where(length > 0, length, 1.0)  # 1 of points
    share = size / np.bincount(of, size, len(chosen.geometry))[of]
    column, row = cut.column[kept], cut.row[kept]
    here = (column >= band[0]) & (column < band[1])
    return chosen.rows(column[here], row[here], of[here], geometry[here], share[here])


def _joined(chosen: _Chosen, band: Span) -> tuple[Ints, Ints, Ints, Geometries]:
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
        joined = uncovered(tile[at], joined)
    return column[at], row[at], of[at], snapped(joined)
