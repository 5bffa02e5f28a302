"""Group the pieces around a cell that are connected there, in machine code."""

import numpy as np

from models.citymap.geometry.solids import THING
from models.citymap.geometry.tiling import TILE_M
from models.citymap.points import Ints
from models.citymap.types import Floats
from models.compiled import compiled


@compiled
def first_from_row(column: int, row: int, column_starts: Ints, rows: Ints) -> int:
    """Return the first piece of a column of tiles in a row or in a later one; see `PieceTable`."""
    begin, end = column_starts[column], column_starts[column + 1]
    while begin < end:
        middle = (begin + end) // 2
        if rows[middle] < row:
            begin = middle + 1
        else:
            end = middle
    return begin


@compiled
def first_from_rows(column: Ints, row: Ints, column_starts: Ints, rows: Ints) -> Ints:
    """Return the first piece [n] of each column of tiles in a row or in a later one."""
    first = np.empty(len(column), np.int64)
    for n in range(len(column)):
        first[n] = first_from_row(column[n], row[n], column_starts, rows)
    return first


@compiled
def pieces_near(points_m: Floats, reach_m: float, low: Ints, column_starts: Ints, rows: Ints) -> tuple[Ints, Ints]:
    """Return the pieces in tiles within reach of points, and runs [R, 3]: first, end, position of the first."""
    first, last = np.empty(2, np.int64), np.empty(2, np.int64)
    for axis in range(2):
        first[axis] = np.floor((points_m[:, axis].min() - reach_m) / TILE_M + 0.5) - low[axis]
        last[axis] = np.floor((points_m[:, axis].max() + reach_m) / TILE_M + 0.5) - low[axis]
    first[0], last[0] = max(first[0], 0), min(last[0], len(column_starts) - 2)
    columns = max(last[0] - first[0] + 1, 0)
    runs, count = np.empty((columns, 3), np.int64), 0
    for c in range(columns):
        runs[c, 0] = first_from_row(first[0] + c, first[1], column_starts, rows)
        runs[c, 1] = first_from_row(first[0] + c, last[1] + 1, column_starts, rows)
        runs[c, 2] = count
        count += runs[c, 1] - runs[c, 0]
    pieces = np.empty(count, np.int64)
    for c in range(columns):
        for k in range(runs[c, 0], runs[c, 1]):
            pieces[runs[c, 2] + k - runs[c, 0]] = k
    return pieces, runs


@compiled
def _position(piece: int, runs: Ints) -> int:
    """Return the position of a piece among those of `pieces_near`, -1 if it is not among them."""
    for r in range(len(runs)):
        if runs[r, 0] <= piece < runs[r, 1]:
            return runs[r, 2] + piece - runs[r, 0]
    return -1


@compiled
def group_pieces(
    pieces: Ints, runs: Ints, center_m: Floats, half_m: float, min_count: float, tile: Ints, instance: Ints, form: Ints,
    point_count: Floats, link_starts: Ints, links: Ints,
) -> tuple[Ints, Ints]:  # fmt: skip
    """Return the pieces around a cell by group, and where each group begins (and the last ends)."""
    count = len(pieces)
    kind = np.empty(count, np.int64)  # 0 for what is in the cube, 1 for what is beside it, 2 for things
    first, last = np.floor((center_m - half_m) / TILE_M + 0.5), np.floor((center_m + half_m) / TILE_M + 0.5)
    for p in range(count):
        column, row = tile[pieces[p]]
        is_inside = first[0] <= column <= last[0] and first[1] <= row <= last[1]
        kind[p] = 2 if form[pieces[p]] == THING else 0 if is_inside else 1
    group = _connect(pieces, runs, kind, instance, link_starts, links)
    size, total = np.zeros(count, np.int64), np.zeros(count)
    for p in range(count):
        size[group[p]] += 1
        total[group[p]] += point_count[pieces[p]]
    place, pieces_kept, groups_kept = np.full(count, -1, np.int64), 0, 0
    starts = np.empty(count + 1, np.int64)
    for g in range(count):
        if size[g] and _is_counted(g, size, total, min_count, kind, pieces, instance):
            place[g], starts[groups_kept] = pieces_kept, pieces_kept
            pieces_kept += size[g]
            groups_kept += 1
    starts[groups_kept] = pieces_kept
    order = np.empty(pieces_kept, np.int64)
    for p in range(count):
        g = group[p]
        if place[g] >= 0:
            order[place[g]] = pieces[p]
            place[g] += 1
    return order, starts[: groups_kept + 1]


@compiled
def _is_counted(g: int, size: Ints, total: Floats, min_count: float, kind: Ints, pieces: Ints, instance: Ints) -> bool:
    """Whether a group is large enough, a thing, or the only group of its instance."""
    if total[g] >= min_count or kind[g] == 2:
        return True
    for another in range(len(size)):
        if another != g and size[another] and instance[pieces[another]] == instance[pieces[g]]:
            return False
    return True


@compiled
def _connect(pieces: Ints, runs: Ints, kind: Ints, instance: Ints, link_starts: Ints, links: Ints) -> Ints:
    """Return the first piece [P] of each piece's group; pieces beside the cube join the group that they continue."""
    count = len(pieces)
    parent = np.arange(count)
    thing_first, thing_instance, thing_count = np.empty(count, np.int64), np.empty(count, np.int64), 0
    for p in range(count):
        if kind[p] == 2:
            own = instance[pieces[p]]
            for t in range(thing_count):
                if thing_instance[t] == own:
                    parent[p] = thing_first[t]
                    break
            if parent[p] == p:
                thing_first[thing_count], thing_instance[thing_count] = p, own
                thing_count += 1
            continue
        for linked in links[link_starts[pieces[p]] : link_starts[pieces[p] + 1]]:
            q = _position(linked, runs)
            if q >= 0 and kind[q] == kind[p]:
                a, b = _root(parent, p), _root(parent, q)
                parent[max(a, b)] = min(a, b)
    inside = np.full(count, -1, np.int64)  # of what is beside the cube
    for p in range(count):
        if kind[p] != 1:
            continue
        for linked in links[link_starts[pieces[p]] : link_starts[pieces[p] + 1]]:
            q = _position(linked, runs)
            if q >= 0 and kind[q] == 0:
                inside[_root(parent, p)] = _root(parent, q)
    group = np.empty(count, np.int64)
    for p in range(count):
        root = _root(parent, p)
        group[p] = inside[root] if inside[root] >= 0 else root
    return _number_by_first(group)


@compiled
def _number_by_first(group: Ints) -> Ints:
    first = np.full(len(group), -1, np.int64)
    named = np.empty(len(group), np.int64)
    for p in range(len(group)):
        if first[group[p]] < 0:
            first[group[p]] = p
        named[p] = first[group[p]]
    return named


@compiled
def _root(parent: Ints, p: int) -> int:
    while parent[p] != p:
        parent[p] = parent[parent[p]]
        p = parent[p]
    return p
