"""Streets: pieces of one name joined, and the corners where two of them meet."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import shapely
from scipy.cluster.hierarchy import fcluster, linkage

from models.city.gazetteer.words import STREET, Words
from models.city.points import Ints
from models.city.types import Floats

ONE_CORNER_M = 45.0  # carriageways of one street meet another at several places, which are one corner


@dataclass(frozen=True, slots=True, eq=False)
class Ways:
    """A piece of a street.

    Attributes:
        words: its names.
        nodes: [n] numbers of its nodes; streets that share one meet.
        segments_m: [s, 4].
        nodes_m: [n, 2] where they are.
    """

    words: Words
    nodes: Ints
    segments_m: Floats
    nodes_m: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Streets:
    """Streets with all their pieces; see Gazetteer."""

    words: list[Words]
    segments_m: list[Floats]
    corner_streets: Ints
    corners_m: Floats


def join_streets(pieces: Sequence[Ways], first: int) -> Streets:
    """Join the pieces of each name.

    Args:
        pieces: of all streets.
        first: number of the first street in the gazetteer.
    """
    by_name: dict[str, list[Ways]] = {}
    for piece in pieces:
        by_name.setdefault(piece.words.names[0].casefold(), []).append(piece)
    words, segments = [], []
    for some in by_name.values():
        names = dict.fromkeys(name for piece in some for name in piece.words.names)
        words.append(Words((STREET,), tuple(names), source_id=some[0].words.source_id))
        segments.append(np.concatenate([piece.segments_m for piece in some]))
    meets = _meetings(list(by_name.values()), first)
    for pair, at in _crossings(segments, first):
        if pair not in meets:
            meets[pair] = at
    pairs, places = [], []
    for pair, at in sorted(meets.items()):
        for corner in _corners(np.array(at)):
            pairs.append(pair)
            places.append(corner)
    corner_streets = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    return Streets(words, segments, corner_streets, np.array(places, dtype=np.float32).reshape(-1, 2))


def _meetings(streets: Sequence[Sequence[Ways]], first: int) -> dict[tuple[int, int], list[Floats]]:
    """Streets that share a node, the lower first, and where; `first` is the number of the first street."""
    pieces = [piece for some in streets for piece in some]
    if not pieces:
        return {}
    street = np.repeat(np.arange(len(streets)), [sum(len(piece.nodes) for piece in some) for some in streets])
    nodes, nodes_m = (np.concatenate([getattr(piece, name) for piece in pieces]) for name in ("nodes", "nodes_m"))
    _, at, which = np.unique(nodes, return_index=True, return_inverse=True)
    node, street = np.divmod(np.unique(which * len(streets) + street), len(streets))  # each street of a node once
    begin = np.flatnonzero(np.diff(node, prepend=-1))
    end = np.append(begin[1:], len(node))
    shared = np.flatnonzero(end - begin > 1)
    meets: dict[tuple[int, int], list[Floats]] = {}
    for n in shared[np.argsort(at[shared])].tolist():  # as they come along the streets
        for pair in combinations((first + street[begin[n] : end[n]]).tolist(), 2):
            meets.setdefault(pair, []).append(nodes_m[at[n]])
    return meets


def _crossings(segments: Sequence[Floats], first: int) -> Iterator[tuple[tuple[int, int], list[Floats]]]:
    """Streets that cross without meeting, on bridges and in tunnels, and where."""
    if not segments:
        return
    lines = [shapely.multilinestrings(some.reshape(-1, 2, 2)) for some in segments]
    one, other = shapely.STRtree(lines).query(lines, "intersects")
    for a, b in zip(*(some[one < other].tolist() for some in (one, other)), strict=True):
        at = shapely.get_coordinates(shapely.intersection(lines[a], lines[b]))
        yield (first + a, first + b), list(at)


def _corners(at: Floats) -> list[Floats]:
    """The middles of the places [n, 2] that are one corner."""
    if len(at) == 1:
        return [at[0]]
    of = fcluster(linkage(at, "single"), ONE_CORNER_M, "distance")
    return [at[of == number].mean(axis=0) for number in np.unique(of)]
