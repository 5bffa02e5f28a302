"""Streets: pieces of one name joined, and the corners where two of them meet."""

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

CORNER_MERGE_M = 45.0  # carriageways of one street meet another at several places, which are one corner


@dataclass(frozen=True, slots=True, eq=False)
class StreetPiece:
    """A piece of a street.

    Attributes:
        object: its names.
        nodes: [n] numbers of its nodes; streets that share one meet.
        segments_m: [s, 4].
        nodes_m: [n, 2] where they are.
    """

    object: GazetteerObject
    nodes: Ints
    segments_m: Floats
    nodes_m: Floats


class StreetPieces:
    """Pieces of streets, as they come; of these the words alone stay in memory.

    Attributes:
        objects: of each.
    """

    def __init__(self) -> None:
        self.objects, self._names, self._spool = (
            list[GazetteerObject](),
            dict[tuple[str, ...], tuple[str, ...]](),
            Spool(),
        )

    def add(self, ways: Sequence[StreetPiece]) -> None:
        """Add some, at least none."""
        names = [self._names.setdefault(way.object.names, way.object.names) for way in ways]  # once for all of a street
        self.objects += [replace(way.object, names=some) for way, some in zip(ways, names, strict=True)]
        self._spool.add(
            {
                "nodes": np.concatenate([np.zeros(0, np.int64), *(way.nodes for way in ways)]),
                "nodes_m": np.concatenate([np.zeros((0, 2)), *(way.nodes_m for way in ways)]),
                "nodes_of": np.array([len(way.nodes) for way in ways], np.int64),
                "segments_m": np.concatenate([np.zeros((0, 4)), *(way.segments_m for way in ways)]),
                "segments_of": np.array([len(way.segments_m) for way in ways], np.int64),
            }
        )

    def columns(self) -> dict[str, Column]:
        """Of all, one after the other, what Ways has, and where that of each begins; none is added after that."""
        columns = self._spool.columns()
        return columns | {name: starts_of(columns[name]) for name in ("nodes_of", "segments_of")}


@dataclass(frozen=True, slots=True, eq=False)
class Streets:
    """Streets with all their pieces; see Gazetteer."""

    objects: list[GazetteerObject]
    segments_m: list[Floats]
    corner_streets: Ints
    corners_m: Floats


def join_streets(pieces: StreetPieces, first: int) -> Streets:
    """Join the pieces of each name.

    Args:
        pieces: of all streets; none is added after that.
        first: number of the first street in the gazetteer.
    """
    by_name: dict[str, list[int]] = {}
    for n, of in enumerate(pieces.objects):
        by_name.setdefault(of.names[0].casefold(), []).append(n)
    columns, streets = pieces.columns(), list(by_name.values())
    words, segments = [], []
    for rows in streets:
        names = dict.fromkeys(name for n in rows for name in pieces.objects[n].names)
        words.append(GazetteerObject((STREET_KIND,), tuple(names), source_id=pieces.objects[rows[0]].source_id))
        segments.append(columns["segments_m"][_rows_of(columns["segments_of"], np.array(rows))])
    meets = _shared_nodes(columns, streets, first)
    for pair, at in _crossings_without_node(segments, first):
        if pair not in meets:
            meets[pair] = at
    pairs, places = [], []
    for pair, at in sorted(meets.items()):
        for corner in _merge_corners(np.array(at)):
            pairs.append(pair)
            places.append(corner)
    corner_streets = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    return Streets(words, segments, corner_streets, np.array(places, dtype=np.float32).reshape(-1, 2))


def _shared_nodes(
    columns: Mapping[str, Column], streets: Sequence[Sequence[int]], first: int
) -> dict[tuple[int, int], list[Floats]]:
    """Streets that share a node, the lower first, and where.

    Args:
        columns: of pieces.
        streets: of each, its pieces.
        first: number of the first street.
    """
    pieces = np.array([n for rows in streets for n in rows], np.int64)
    street = np.repeat(np.arange(len(streets)), [len(rows) for rows in streets])
    street, rows = np.repeat(street, np.diff(columns["nodes_of"])[pieces]), _rows_of(columns["nodes_of"], pieces)
    nodes, nodes_m = columns["nodes"][rows], columns["nodes_m"][rows]
    _, at, which = np.unique(nodes, return_index=True, return_inverse=True)
    pairs = np.unique(which * len(streets) + street)  # each street of a node once
    node, street = np.divmod(pairs, max(1, len(streets)))
    begin = np.flatnonzero(np.diff(node, prepend=-1))
    end = np.append(begin[1:], len(node))
    shared = np.flatnonzero(end - begin > 1)
    meets: dict[tuple[int, int], list[Floats]] = {}
    for n in shared[np.argsort(at[shared])].tolist():  # as they come along the streets
        for pair in combinations((first + street[begin[n] : end[n]]).tolist(), 2):
            meets.setdefault(pair, []).append(nodes_m[at[n]])
    return meets


def _rows_of(starts: Ints, pieces: Ints) -> Ints:
    """What belongs to some pieces, piece after piece."""
    return ranges(starts[pieces], starts[pieces + 1])


def _crossings_without_node(segments: Sequence[Floats], first: int) -> Iterator[tuple[tuple[int, int], list[Floats]]]:
    """Streets that cross without meeting, on bridges and in tunnels, and where."""
    if not segments:
        return
    lines = [shapely.multilinestrings(some.reshape(-1, 2, 2)) for some in segments]
    one, other = shapely.STRtree(lines).query(lines, "intersects")
    for a, b in zip(*(some[one < other].tolist() for some in (one, other)), strict=True):
        at = shapely.get_coordinates(shapely.intersection(lines[a], lines[b]))
        yield (first + a, first + b), list(at)


def _merge_corners(at: Floats) -> list[Floats]:
    """The middles of the places [n, 2] that are one corner."""
    if len(at) == 1:
        return [at[0]]
    of = fcluster(linkage(at, "single"), CORNER_MERGE_M, "distance")
    return [at[of == number].mean(axis=0) for number in np.unique(of)]
