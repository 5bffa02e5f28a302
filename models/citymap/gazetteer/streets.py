"""Streets: joining the pieces of one name, and the corners where two streets meet."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
import shapely
from scipy.cluster.hierarchy import fcluster, linkage

from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject
from models.citymap.points import Ints, ranges
from models.citymap.types import Floats
from models.spool import Column, Spool, starts_of

CORNER_MERGE_M = 45.0  # carriageways of one street cross another within this distance of each other: one corner


@dataclass(frozen=True, slots=True, eq=False)
class StreetPiece:
    """A piece of a street."""

    object: GazetteerObject
    nodes: Ints  # [n] numbers of its nodes; streets that share a node meet there
    segments_m: Floats  # [s, 4]
    nodes_m: Floats  # [n, 2] positions of the nodes


class StreetPieces:
    """Collects pieces of streets; only their names (`objects`) stay in memory."""

    def __init__(self) -> None:
        self.objects, self._names, self._spool = (
            list[GazetteerObject](),
            dict[tuple[str, ...], tuple[str, ...]](),
            Spool(),
        )

    def add(self, pieces: Sequence[StreetPiece]) -> None:
        """Add pieces; may be none."""
        names = [
            self._names.setdefault(piece.object.names, piece.object.names) for piece in pieces
        ]  # share one tuple for all pieces of a street
        self.objects += [replace(piece.object, names=shared) for piece, shared in zip(pieces, names, strict=True)]
        self._spool.add(
            {
                "nodes": np.concatenate([np.zeros(0, np.int64), *(piece.nodes for piece in pieces)]),
                "nodes_m": np.concatenate([np.zeros((0, 2)), *(piece.nodes_m for piece in pieces)]),
                "nodes_of": np.array([len(piece.nodes) for piece in pieces], np.int64),
                "segments_m": np.concatenate([np.zeros((0, 4)), *(piece.segments_m for piece in pieces)]),
                "segments_of": np.array([len(piece.segments_m) for piece in pieces], np.int64),
            }
        )

    def columns(self) -> dict[str, Column]:
        """Return the columns of all pieces, and where those of each piece start; nothing can be added after this."""
        columns = self._spool.columns()
        return columns | {name: starts_of(columns[name]) for name in ("nodes_of", "segments_of")}


@dataclass(frozen=True, slots=True, eq=False)
class Streets:
    """Streets with all their pieces, and corners; see `Gazetteer`."""

    objects: list[GazetteerObject]
    segments_m: list[Floats]
    corner_streets: Ints
    corners_m: Floats


def join_streets(pieces: StreetPieces, first: int) -> Streets:
    """Join the pieces of each name; `first` is the number of the first street in the gazetteer."""
    by_name: dict[str, list[int]] = {}
    for n, item in enumerate(pieces.objects):
        by_name.setdefault(item.names[0].casefold(), []).append(n)
    columns, streets = pieces.columns(), list(by_name.values())
    objects, segments = [], []
    for rows in streets:
        names = dict.fromkeys(name for n in rows for name in pieces.objects[n].names)
        codes = dict.fromkeys(code for n in rows for code in pieces.objects[n].codes)
        source_id = pieces.objects[rows[0]].source_id
        objects.append(GazetteerObject((STREET_KIND,), tuple(names), source_id=source_id, codes=tuple(codes)))
        segments.append(columns["segments_m"][_rows_of(columns["segments_of"], np.array(rows))])
    meets = _shared_nodes(columns, streets, first)
    for pair, points in _crossings_without_node(segments, first):
        if pair not in meets:
            meets[pair] = points
    pairs, places = [], []
    for pair, points in sorted(meets.items()):
        for corner in _merge_corners(np.array(points)):
            pairs.append(pair)
            places.append(corner)
    corner_streets = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    return Streets(objects, segments, corner_streets, np.array(places, dtype=np.float32).reshape(-1, 2))


def _shared_nodes(
    columns: Mapping[str, Column], streets: Sequence[Sequence[int]], first: int
) -> dict[tuple[int, int], list[Floats]]:
    """Return the positions of the nodes that two streets share, by pair of streets, the lower first."""
    pieces = np.array([n for rows in streets for n in rows], np.int64)
    street = np.repeat(np.arange(len(streets)), [len(rows) for rows in streets])
    street, rows = np.repeat(street, np.diff(columns["nodes_of"])[pieces]), _rows_of(columns["nodes_of"], pieces)
    nodes, nodes_m = columns["nodes"][rows], columns["nodes_m"][rows]
    _, first_row, which = np.unique(nodes, return_index=True, return_inverse=True)
    pairs = np.unique(which * len(streets) + street)  # each street of a node once
    node, street = np.divmod(pairs, max(1, len(streets)))
    begin = np.flatnonzero(np.diff(node, prepend=-1))
    end = np.append(begin[1:], len(node))
    shared = np.flatnonzero(end - begin > 1)
    meets: dict[tuple[int, int], list[Floats]] = {}
    for n in shared[np.argsort(first_row[shared])].tolist():  # in their order along the streets
        for pair in combinations((first + street[begin[n] : end[n]]).tolist(), 2):
            meets.setdefault(pair, []).append(nodes_m[first_row[n]])
    return meets


def _rows_of(starts: Ints, pieces: Ints) -> Ints:
    return ranges(starts[pieces], starts[pieces + 1])


def _crossings_without_node(segments: Sequence[Floats], first: int) -> Iterator[tuple[tuple[int, int], list[Floats]]]:
    """Yield pairs of streets that cross on bridges or in tunnels, and where."""
    if not segments:
        return
    lines = [shapely.multilinestrings(lines_m.reshape(-1, 2, 2)) for lines_m in segments]
    left, right = shapely.STRtree(lines).query(lines, "intersects")
    for a, b in zip(*(lines_m[left < right].tolist() for lines_m in (left, right)), strict=True):
        points = shapely.get_coordinates(shapely.intersection(lines[a], lines[b]))
        yield (first + a, first + b), list(points)


def _merge_corners(points_m: Floats) -> list[Floats]:
    """Return the mean position of each group of points [n, 2] that are one corner."""
    if len(points_m) == 1:
        return [points_m[0]]
    cluster = fcluster(linkage(points_m, "single"), CORNER_MERGE_M, "distance")
    return [points_m[cluster == number].mean(axis=0) for number in np.unique(cluster)]
