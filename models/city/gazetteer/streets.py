"""Streets: pieces of one name joined, and the corners where two of them meet."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

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
        nodes: numbers of its nodes; streets that share one meet.
        segments_m: [n, 4].
        nodes_m: [nodes, 2] where they are.
    """

    words: Words
    nodes: tuple[int, ...]
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
    by_name: dict[str, list[int]] = {}
    for n, piece in enumerate(pieces):
        by_name.setdefault(piece.words.names[0].casefold(), []).append(n)
    words, segments = [], []
    streets_at: dict[int, set[int]] = {}
    place: dict[int, Floats] = {}
    for number, rows in enumerate(by_name.values(), first):
        names = dict.fromkeys(name for n in rows for name in pieces[n].words.names)
        words.append(Words((STREET,), tuple(names), source_id=pieces[rows[0]].words.source_id))
        segments.append(np.concatenate([pieces[n].segments_m for n in rows]))
        for n in rows:
            for node, at in zip(pieces[n].nodes, pieces[n].nodes_m, strict=True):
                streets_at.setdefault(node, set()).add(number)
                place[node] = at
    meets: dict[tuple[int, int], list[Floats]] = {}
    for node, some in streets_at.items():
        ordered = sorted(some)
        for k, one in enumerate(ordered):
            for other in ordered[k + 1 :]:
                meets.setdefault((one, other), []).append(place[node])
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
