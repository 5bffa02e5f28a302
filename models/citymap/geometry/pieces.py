"""The table of pieces: the part of each instance in each tile, and which pieces are connected."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, Final

import numpy as np
import numpy.typing as npt
import shapely

from models.citymap.geometry.groups import first_from_rows
from models.citymap.geometry.piece_rows import PieceRows
from models.citymap.geometry.segments import STEP_M, TILE_EDGE_STEPS, Steps, segments_of, to_geometry
from models.citymap.geometry.solids import THING
from models.citymap.geometry.tiling import BEYOND_MAP_M, TILE_M, TOUCHING_M, Geometries
from models.citymap.points import Ints, block_keys, ranges, thin_to_spacing
from models.citymap.types import Floats
from models.spool import row_blocks, spooled, starts_of

PIECES_PER_BLOCK: Final = 20_000  # pieces whose geometries are built at a time, to bound memory
TILE_COLUMNS_PER_BLOCK: Final = 64  # columns of tiles whose pieces are linked together
_STORED_NAMES: Final = {"point_count": "worth"}  # fields whose column has another name in an index
_FIELD_NAMES: Final = {stored: name for name, stored in _STORED_NAMES.items()}


@dataclass(frozen=True, eq=False)
class PieceTable:
    """K pieces, in order of tile, then instance."""

    low: Ints  # [2] column and row of the first tile
    column_starts: Ints  # [C + 1] int32, column c of tiles has the pieces column_starts[c] to the next
    row: Ints  # [K] uint16, or uint32 on maps of more than 655 km; row of each piece's tile, from the first one
    instance: Ints  # [K] int32
    form: Ints  # [K] index into FORMS
    dimension: Ints  # [K] int8 of its geometry: 0 for points, 1 for lines, 2 for areas
    bounds_m: Floats  # [K, 4] float32 its box, metres, map frame
    heights_m: Floats  # [K, 2] float32 base and top
    crown_m: Floats  # [K] float32 radius of a tree's crown, 0 for others
    point_count: Floats  # [K] float32 points that a scanner would measure on it
    segment_starts: Ints  # [K + 1] int32
    segments: Steps  # [S, 4] int16 its lines and rings, none if it is its whole tile, see `to_segments`
    link_starts: Ints  # [K + 1]
    links: Ints  # piece k is connected with links[link_starts[k]:link_starts[k + 1]]

    @classmethod
    def from_bands(cls, bands: Iterable[PieceRows]) -> "PieceTable":
        """Build the table of a whole map, in columns on disk, from bands from west to east; one must have pieces."""
        columns = spooled({f.name: getattr(rows, f.name) for f in fields(PieceRows)} for rows in bands)
        column, row, sizes = (columns.pop(name) for name in ("column", "row", "sizes"))
        low, high = (np.array([ends(column), ends(row)], dtype=np.int64) for ends in (np.min, np.max))
        row_type = np.uint16 if high[1] - low[1] <= np.iinfo(np.uint16).max else np.uint32
        rows_of_pieces = spooled(
            {"row": (block["row"] - low[1]).astype(row_type)} for block in row_blocks({"row": row})
        )["row"]
        column_starts = np.searchsorted(column, np.arange(low[0], high[0] + 2)).astype(np.int32)
        segment_starts = starts_of(sizes)
        links = spooled(_find_links(column, row, segment_starts, columns))
        table = cls(
            low, column_starts, rows_of_pieces, segment_starts=segment_starts,
            link_starts=starts_of(links["sizes"]), links=links["links"], **columns,
        )  # fmt: skip
        tiles = (
            {"tile": np.stack([block["column"], block["row"]], 1)}
            for block in row_blocks({"column": column, "row": row})
        )
        table.__dict__["tile"] = spooled(tiles)["tile"]  # on disk, before the property makes it in memory
        return table

    @classmethod
    def from_columns(cls, columns: Mapping[str, npt.NDArray[Any]]) -> "PieceTable":
        """Build a table from what `columns` returned."""
        return cls(**{_FIELD_NAMES.get(name, name): column for name, column in columns.items()})

    def columns(self) -> dict[str, npt.NDArray[Any]]:
        """Return all columns by the names that an index stores them under."""
        return {_STORED_NAMES.get(f.name, f.name): getattr(self, f.name) for f in fields(self)}

    def renumber_instances(self, numbers: Ints) -> "PieceTable":
        """Return the table with instances numbered by their place among `numbers` [I], ascending."""
        blocks = (block["instance"] for block in row_blocks({"instance": self.instance}))
        table = replace(
            self, **spooled({"instance": np.searchsorted(numbers, block).astype(np.int32)} for block in blocks)
        )
        table.__dict__["tile"] = self.tile  # the tiles stay the same
        return table

    def take(self, is_taken: npt.NDArray[np.bool_]) -> "PieceTable":
        """Return the table of the pieces where `is_taken` [K]; links to others are dropped."""
        pieces = np.flatnonzero(is_taken)
        number = np.cumsum(is_taken) - 1
        segments = ranges(self.segment_starts[pieces], self.segment_starts[pieces + 1])
        links = self.links[ranges(self.link_starts[pieces], self.link_starts[pieces + 1])]
        source = np.repeat(np.arange(len(pieces)), np.diff(self.link_starts)[pieces])
        stays = is_taken[links]
        columns = ("row", "instance", "form", "dimension", "bounds_m", "heights_m", "crown_m", "point_count")
        return replace(
            self,
            column_starts=np.concatenate([[0], np.cumsum(is_taken)])[self.column_starts].astype(np.int32),
            segment_starts=starts_of(np.diff(self.segment_starts)[pieces]),
            segments=self.segments[segments],
            link_starts=starts_of(np.bincount(source[stays], minlength=len(pieces))),
            links=number[links[stays]].astype(np.int32),
            **{name: getattr(self, name)[pieces] for name in columns},
        )

    def geometry(self, pieces: Ints) -> Geometries:
        """Return the geometries [n] of some pieces, metres, map frame; a repeated piece is built once."""
        known, which = np.unique(pieces, return_inverse=True)
        return to_geometry(self.segment_starts, self.segments, self.tile, self.dimension, known)[which]

    def in_tiles(self, first: Ints, last: Ints) -> tuple[Ints, Ints]:
        """Return rectangle [P], ascending, and piece [P] in rectangles of tiles, given their corners [n, 2]."""
        first, last = first - self.low, last - self.low
        first_column, last_column = np.maximum(first[:, 0], 0), np.minimum(last[:, 0], len(self.column_starts) - 2)
        columns = np.maximum(last_column - first_column + 1, 0)
        rectangle = np.repeat(np.arange(len(first)), columns)
        column = ranges(first_column, first_column + columns)
        begin, end = (
            first_from_rows(column, row[rectangle], self.column_starts, self.row)
            for row in (first[:, 1], last[:, 1] + 1)
        )
        end = np.maximum(begin, end)
        return np.repeat(rectangle, end - begin), ranges(begin, end)

    @cached_property
    def tile(self) -> Ints:
        """Return the column and row [K, 2] (int32) of each piece's tile."""
        column = np.repeat(np.arange(len(self.column_starts) - 1, dtype=np.int32), np.diff(self.column_starts))
        return np.stack([column, self.row], axis=1, dtype=np.int32, casting="unsafe") + self.low.astype(np.int32)

    def ground_lattice(self, pieces: Ints, spacing_m: float) -> Floats:
        """Return positions [n, 3] (float32) in areas, one in each square block with a corner or middle inside."""
        return spooled({"m": block} for block in self._lattice_batches(pieces, spacing_m))["m"]

    def _lattice_batches(self, pieces: Ints, spacing_m: float) -> Iterator[Floats]:
        yield np.zeros((0, 3), np.float32)
        emitted = np.zeros(0, np.int64)
        for n in range(0, len(pieces), PIECES_PER_BLOCK):
            batch = pieces[n : n + PIECES_PER_BLOCK]
            xy = thin_to_spacing(self._lattice_inside(batch, spacing_m), spacing_m)
            block = block_keys(xy, spacing_m)
            new = ~np.isin(block, emitted)
            yield np.column_stack([xy[new], np.zeros(new.sum())]).astype(np.float32)
            column_m = (self.tile[batch[-1], 0] - 0.5) * TILE_M - spacing_m  # no later piece lies west of it
            emitted = np.concatenate([emitted, block[new]])
            emitted = emitted[emitted >= block_keys(np.array([[column_m, -BEYOND_MAP_M]]), spacing_m)[0]]

    def _lattice_inside(self, pieces: Ints, spacing_m: float) -> Floats:
        """Return the corners and middles [n, 2] of blocks that are inside some areas."""
        step_m = spacing_m / 2
        low, high = (np.floor(self.bounds_m[pieces, axis : axis + 2] / step_m).astype(np.int64) + 1 for axis in (0, 2))
        across, along = (np.maximum(high - low, 0)).T
        area = np.repeat(np.arange(len(pieces)), across * along)
        nth = ranges(np.zeros(len(pieces), np.int64), across * along)
        xy = np.stack([low[area, 0] + nth // along[area], low[area, 1] + nth % along[area]], axis=1) * step_m
        areas = self.geometry(pieces)
        shapely.prepare(areas)
        return xy[shapely.contains_xy(areas[area], *xy.T)]


def _find_links(
    column: Ints, row: Ints, starts: Ints, columns: Mapping[str, npt.NDArray[Any]]
) -> Iterator[dict[str, Ints]]:
    """Yield the numbers of links ("sizes") and "links" between pieces of one instance that touch across tiles.

    Works on some columns of tiles at a time; pieces are in order of column.
    """
    instance, dimension, form, segments = (columns[name] for name in ("instance", "dimension", "form", "segments"))
    count, known, pending = len(column), 0, np.zeros(0, np.int64)
    rows = range(int(row.min()), int(row.max()) + 2)
    for first in range(int(column[0]), int(column[-1]) + 2, TILE_COLUMNS_PER_BLOCK):
        # Include the column to the west, for the border between; the eastern border belongs to the next block.
        begin, own, end = np.searchsorted(column, [first - 1, first, first + TILE_COLUMNS_PER_BLOCK])
        tiles = np.stack([column[begin:end], row[begin:end]], axis=1).astype(np.int64)
        piece, ends = segments_of(starts, segments, np.arange(begin, end))
        on_border = (np.abs(ends) == TILE_EDGE_STEPS).any(axis=1) & (form[begin:end] != THING)[piece]
        piece, ends = piece[on_border], ends[on_border]
        local = tiles, instance[begin:end], dimension[begin:end]
        pairs = _touching_pairs(0, piece, ends, *local, range(first, first + TILE_COLUMNS_PER_BLOCK))
        is_own = piece >= own - begin
        pairs = np.concatenate([pairs, _touching_pairs(1, piece[is_own], ends[is_own], *local, rows)]) + begin
        keys = np.unique(np.concatenate([pending, np.concatenate([pairs, pairs[:, ::-1]]) @ [count, 1]]))
        # Pieces of the last column may have links to the next block.
        done = count if end == count else int(np.searchsorted(column, first + TILE_COLUMNS_PER_BLOCK - 1))
        pending = keys[keys >= done * count]
        keys = keys[: len(keys) - len(pending)]
        yield {
            "sizes": np.bincount(keys // count - known, minlength=done - known).astype(np.int32),
            "links": (keys % count).astype(np.int32),
        }
        known = done


def _touching_pairs(
    axis: int, segment_piece: Ints, segments: Steps, tile: Ints, instance: Ints, dimension: Ints, wanted: range
) -> Ints:
    """Return pairs [L, 2] of pieces that touch across borders of constant x (axis 0) or y (axis 1).

    Segments [S, 4] are those that may lie on a border. A wanted border is west or south of the tile of its number.
    """
    is_line = dimension[segment_piece] == 1
    along_m = segments[:, [1 - axis, 3 - axis]] * STEP_M + tile[segment_piece, 1 - axis, None] * TILE_M
    borders, intervals, pieces = [], [], []
    for side in (-1, 1):
        is_on = segments[:, [axis, 2 + axis]] == side * TILE_EDGE_STEPS
        number = tile[segment_piece, axis] + (side + 1) // 2  # of the border, from low to high
        is_on &= ((number >= wanted.start) & (number < wanted.stop))[:, None]
        for rows, ends in (
            (is_on.all(axis=1), [0, 1]),
            (is_on[:, 0] & is_line, [0, 0]),
            (is_on[:, 1] & is_line, [1, 1]),
        ):
            piece = segment_piece[rows]
            borders.append(np.stack([number[rows], tile[piece, 1 - axis], instance[piece]], axis=1))
            intervals.append(np.sort(along_m[rows][:, ends], axis=1))
            pieces.append(piece)
    border, interval, piece = (np.concatenate(arrays) for arrays in (borders, intervals, pieces))
    group = np.unique(border, axis=0, return_inverse=True)[1].ravel()
    order = np.lexsort((interval[:, 0], group))
    group, interval, piece = group[order], interval[order], piece[order]
    # In each group, sweep along the border: an interval that begins before the earlier ones end touches them.
    reach = _running_end(group, interval[:, 1])
    touches = np.flatnonzero((group[1:] == group[:-1]) & (interval[1:, 0] <= reach[:-1] + TOUCHING_M))
    pairs: Ints = np.stack([piece[touches], piece[touches + 1]], axis=1)
    return pairs[pairs[:, 0] != pairs[:, 1]]


def _running_end(group: Ints, end: Floats) -> Floats:
    """Return the greatest end so far in each group; `group` ascends."""
    span = float(np.ptp(end)) + 1.0 if len(end) else 1.0
    return np.maximum.accumulate(end + group * 2 * span) - group * 2 * span
