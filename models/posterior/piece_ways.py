"""What lies around the nodes of a map of pieces, as `models.posterior.surroundings` has it."""

import numpy as np
import numpy.typing as npt

from models.city.bodies import PieceBodies
from models.city.cells import CellTable
from models.city.hints import HINT_REACH_M
from models.city.points import Ints
from models.city.tiled.cutting import THING, hanging_together
from models.city.tiled.pieces import PieceTable
from models.city.tiled.tiling import TILE_M
from models.city.tiled.ways import ways_to_groups
from models.city.types import CutRules, Floats

Rows = tuple[Ints, Ints, Floats, npt.NDArray[np.bool_], Ints]
LOOKED_FOR_M = HINT_REACH_M + 3.0  # a crown reaches nearer than its trunk
LEAST = 0.6  # what hangs together counts by itself if it has at least this share of what a part has


class PieceWays:
    """Pieces and nodes, ready to be measured some cells at a time.

    Args:
        bodies: the map.
        cells: the gallery.
        nodes_m: [M, 2] nodes, in order of owner.
        owner: [M] cell that owns each.
    """

    def __init__(self, bodies: PieceBodies, cells: CellTable, nodes_m: Floats, owner: Ints) -> None:
        self._bodies, self._cells, self._nodes_m = bodies, cells, nodes_m
        self._starts = np.searchsorted(owner, np.arange(len(cells) + 1))

    def measure(self, cells: Ints) -> Rows:
        """(node, instance, way, whole, -1) of the nodes of some cells, one after the other."""
        begin, end = self._starts[cells[0]], self._starts[cells[-1] + 1]
        nodes = self._nodes_m[begin:end]
        starts = np.append(self._starts[cells], end) - begin
        node, instance, way = ways_around(
            self._bodies.pieces, self._bodies.rules, self._cells.center_m[cells], nodes, starts
        )
        whole = np.ones(len(node), np.bool_)
        return begin + node, instance, way, whole, np.full(len(node), -1)


def ways_around(
    table: PieceTable, rules: CutRules, centers_m: Floats, nodes_m: Floats, node_starts: Ints
) -> tuple[Ints, Ints, Floats]:
    """The ways from nodes to what is around them.

    Args:
        table: the map's pieces.
        rules: of its cells.
        centers_m: [N, 2 or more] of cells.
        nodes_m: [M, 2]; cell n owns those from node_starts[n] to node_starts[n + 1].
        node_starts: [N + 1].

    Returns:
        [R] node, [R] instance and [R, 2] way from its closest point, of each thing that hangs together there.
    """
    owning = np.flatnonzero(np.diff(node_starts))
    if not len(owning):
        return np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 2))
    first = np.minimum.reduceat(nodes_m, node_starts[owning]) - LOOKED_FOR_M
    last = np.maximum.reduceat(nodes_m, node_starts[owning]) + LOOKED_FOR_M
    cell, piece = table.in_tiles(_tile(first), _tile(last))
    cell_of_group, order, group_starts = _groups(table, rules, centers_m[owning], cell, piece)
    starts = np.searchsorted(cell_of_group, np.arange(len(owning) + 1))
    point_starts = np.append(node_starts[owning], node_starts[-1])
    node, of, way = ways_to_groups(table, nodes_m, point_starts, piece[order], group_starts, starts, HINT_REACH_M)
    return node, table.instance[piece[order]][group_starts[:-1]][of], way


def _groups(table: PieceTable, rules: CutRules, centers_m: Floats, cell: Ints, piece: Ints) -> tuple[Ints, Ints, Ints]:
    """What hangs together in each cell's cube, with what of the same is beside the cube.

    Returns:
        Cell of each group, order of pairs by group, starts of groups in that order.
    """
    low, high = (_tile(centers_m[:, :2] + side * (rules.cell_size_m / 2 - 1e-3)) for side in (-1, 1))
    tile = table.tile[piece]
    is_thing = table.form[piece] == THING
    inner = ((tile >= low[cell]) & (tile <= high[cell])).all(axis=1) & ~is_thing
    group = hanging_together(table, cell, piece, inner)
    beside = hanging_together(table, cell, piece, ~inner & ~is_thing)
    group = _attached(table, cell, piece, group, beside, inner, ~inner & ~is_thing)
    instances = int(table.instance.max()) + 1
    group = np.where(is_thing, len(cell) + cell * instances + table.instance[piece], group)
    order = np.lexsort((piece, group, cell))
    new = np.flatnonzero(np.diff(group[order], prepend=-1))
    keep = _not_too_small(table, cell[order], piece[order], new, LEAST * rules.min_part_points)
    rows = np.repeat(keep, np.diff(np.append(new, len(order))))
    order = order[rows]
    new = np.flatnonzero(np.diff(group[order], prepend=-1))
    return cell[order][new], order, np.append(new, len(order))


def _attached(
    table: PieceTable, cell: Ints, piece: Ints, group: Ints, beside: Ints,
    inner: npt.NDArray[np.bool_], outer: npt.NDArray[np.bool_],
) -> Ints:  # fmt: skip
    """`group`, where what is beside a cube joins what it goes on in, one of several."""
    rows = np.flatnonzero(outer)
    key = cell.astype(np.int64) * len(table.instance) + piece
    count = np.diff(table.link_starts)[piece[rows]]
    one = np.repeat(rows, count)
    nth = np.arange(len(one)) - np.repeat(np.cumsum(count) - count, count)
    wanted = cell[one].astype(np.int64) * len(table.instance) + table.links[table.link_starts[piece[one]] + nth]
    other = np.minimum(np.searchsorted(key, wanted), len(key) - 1)
    here = (key[other] == wanted) & inner[other]
    joined = beside + int(group.max(initial=-1)) + 1
    target = joined.copy()
    to = np.full(int(joined.max(initial=-1)) + 1, -1, dtype=np.int64)
    to[joined[one[here]]] = group[other[here]]
    target = np.where(to[joined] >= 0, to[joined], joined)
    return np.where(outer, target, group)


def _not_too_small(table: PieceTable, cell: Ints, piece: Ints, new: Ints, least: float) -> npt.NDArray[np.bool_]:
    """Whether groups that begin at some rows are large enough, things, or all that there is of their instance."""
    worth = np.add.reduceat(table.worth[piece], new)
    owner = cell[new].astype(np.int64) * (int(table.instance.max()) + 1) + table.instance[piece[new]]
    _, of, count = np.unique(owner, return_inverse=True, return_counts=True)
    kept: npt.NDArray[np.bool_] = (worth >= least) | (table.form[piece[new]] == THING) | (count[of] == 1)
    return kept


def _tile(points_m: Floats) -> Ints:
    tile: Ints = np.floor(points_m / TILE_M + 0.5).astype(np.int64)
    return tile
