"""Split an instance into its connected pieces around a position.

All sidewalks of a town may be one instance, but a person between two of them sees two. For each tile of nodes, the
points of an instance in the cube around the tile are split into pieces that do not touch there, similar to the DBSCAN
that cuts cells (docs/formats.md, rule 4).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
import numpy.typing as npt
from numpy.lib.stride_tricks import sliding_window_view
from scipy import ndimage
from scipy.spatial import cKDTree

from models.citymap.cells import CellTable
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats

TILE_M = 5.0  # nodes that share a cube; a cube per node takes ten times as long, with the same result
PIXEL_M = 0.75  # points in adjoining pixels touch
IMAGE_BLOCK_M = 120.0  # bounds the size of an image of pixels
ADJOINING = np.zeros((3, 3, 3), dtype=np.int64)  # pixels of the same window, not of the next
ADJOINING[1] = 1
Piece = tuple[Ints, Floats, Ints]  # node, offset, part


@dataclass(frozen=True, slots=True, eq=False)
class Tiles:
    """T groups of nodes: those of a cell in a square of TILE_M."""

    of_node: Ints  # [M] tile of each node
    cell: Ints  # [T] owner of its nodes
    center_m: Floats  # [T, 2] mean of its nodes

    @classmethod
    def build(cls, nodes_m: Floats, owner: Ints, cells: CellTable) -> "Tiles":
        """Build the tiles of nodes [M, 2] with owner cells [M]."""
        square = np.floor((nodes_m - cells.center_m[owner, :2]) / TILE_M).astype(np.int64)
        square -= square.min(axis=0, initial=0)
        span = square.max(axis=0, initial=0) + 1
        known, of_node = np.unique((owner * span[0] + square[:, 0]) * span[1] + square[:, 1], return_inverse=True)
        count = np.bincount(of_node)[:, None]
        center = np.column_stack([np.bincount(of_node, weights=axis) for axis in nodes_m.T]) / count
        return cls(of_node, known // (span[0] * span[1]), center)


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """R pairs of a node and a piece of an instance around it."""

    node: Ints  # [R]
    offset_m: Floats  # [R, 2] node minus the piece's closest point
    part: Ints  # [R] part of a cell that shows the piece


class PieceFinder:
    """Finds the pieces of one instance with points [P, 3].

    `parts` [S], ascending and at least one, are the cells' parts that show it; pieces below `min_points` are ignored.
    """

    def __init__(self, xyz: Floats, parts: Ints, cells: CellTable, min_points: float) -> None:
        self._min_points, self._parts, self._cells = min_points, parts, cells
        self._width = int(np.ceil(cells.size_m / PIXEL_M))
        self._low = xyz[:, :2].min(axis=0)
        pixel = self._pixel(xyz[:, :2])
        key = pixel[:, 0] << 32 | pixel[:, 1]
        order = np.argsort(key, kind="stable")
        self._xyz = xyz[order]
        first = np.flatnonzero(np.diff(key[order], prepend=-1))
        self._starts = np.append(first, len(xyz))
        self._pixels = pixel[order[first]]

    def _pixel(self, xy: Floats) -> npt.NDArray[np.int64]:
        return np.floor((xy - self._low) / PIXEL_M).astype(np.int64)

    @cached_property
    def _nearest(self) -> cKDTree:
        return cKDTree(self._cells.parts.closest_m[self._parts])

    def around(self, nodes_m: Floats, tile: Ints, tiles: Tiles) -> Pieces:
        """Return the pieces around nodes [M, 3] in tiles [M]; nodes with only one piece have no row."""
        order = np.argsort(tile, kind="stable")
        numbers, first = np.unique(tile[order], return_index=True)
        nodes = np.split(order, first[1:])
        corner = self._pixel(tiles.center_m[numbers] - self._cells.size_m / 2)
        pieces: list[Piece] = [(np.zeros(0, np.int64), np.zeros((0, 2)), np.zeros(0, np.int64))]
        blocks = np.unique(np.floor(tiles.center_m[numbers] / IMAGE_BLOCK_M), axis=0, return_inverse=True)[1]
        for block in range(blocks.max(initial=-1) + 1):
            of_block = np.flatnonzero(blocks == block)
            for n, pixels, piece in self._windows(corner[of_block]):
                rows, cell = nodes[of_block[n]], int(tiles.cell[numbers[of_block[n]]])
                pieces += self._measure(nodes_m[rows], rows, pixels, piece, cell)
        return Pieces(*(np.concatenate(column) for column in zip(*pieces, strict=True)))

    def _windows(self, corner: Ints) -> Iterator[tuple[int, Ints, Ints]]:
        """Yield (number, rows [K] of pixels, their pieces [K]) of the windows at corners [N, 2] with several pieces."""
        low, high = corner.min(axis=0), corner.max(axis=0) + self._width
        rows = np.flatnonzero(((self._pixels >= low) & (self._pixels < high)).all(axis=1))
        image = np.full(high - low, -1, dtype=np.int32)
        image[tuple((self._pixels[rows] - low).T)] = rows
        windows = sliding_window_view(image, (self._width, self._width))[tuple((corner - low).T)]
        labelled, _ = ndimage.label(windows >= 0, ADJOINING)
        # labels ascend from window to window
        last = np.maximum.accumulate(labelled.reshape(len(corner), -1).max(axis=1))
        for n in np.flatnonzero(np.diff(last, prepend=0) > 1):
            inside = windows[n] >= 0
            yield int(n), windows[n][inside], labelled[n][inside]

    def _measure(self, nodes_m: Floats, rows: Ints, pixels: Ints, piece: Ints, cell: int) -> Iterator[Piece]:
        """Yield (node, offset, part) of each piece of a window."""
        order = np.argsort(piece, kind="stable")
        pixels, piece = pixels[order], piece[order]
        middle = nodes_m[0]
        points = self._xyz[ranges(self._starts[pixels], self._starts[pixels + 1])] - middle
        last = np.append(np.flatnonzero(np.diff(piece)), len(piece) - 1)
        ends = np.cumsum(self._starts[pixels + 1] - self._starts[pixels])[last]
        shown = self._shown(cell)
        targets = np.concatenate([nodes_m, self._cells.parts.closest_m[shown]]) - middle
        square = (points**2).sum(axis=1) - 2 * targets @ points.T  # up to a constant of each target
        shows = dict(
            zip(np.searchsorted(ends, square[len(nodes_m) :].argmin(axis=1), side="right"), shown, strict=True)
        )
        for number, (begin, end) in enumerate(pairwise([0, *ends.tolist()])):
            if end - begin < self._min_points:
                continue
            closest = points[begin + square[: len(nodes_m), begin:end].argmin(axis=1)] + middle
            # a part of another cell if this one has cut the piece off
            part = shows[number] if number in shows else self._parts[self._nearest.query(closest[0])[1]]
            yield rows, nodes_m[:, :2] - closest[:, :2], np.full(len(rows), part)

    def _shown(self, cell: int) -> Ints:
        """Return the parts of a cell, the largest last."""
        starts, count = self._cells.parts.starts, self._cells.parts.count
        first, last = np.searchsorted(self._parts, [starts[cell], starts[cell + 1]])
        rows = self._parts[first:last]
        return rows[np.argsort(count[rows], kind="stable")]
