import numpy as np
import pytest

from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject
from models.citymap.gazetteer.streets import CORNER_MERGE_M, StreetPiece, StreetPieces, Streets, join_streets
from tests.models.citymap.gazetteer.made_town import line

FIRST = 10


def piece(
    name: str | tuple[str, ...], nodes: tuple[int, ...], *xy: tuple[float, float], number: int = 1
) -> StreetPiece:
    names = (name,) if isinstance(name, str) else name
    return StreetPiece(
        GazetteerObject((STREET_KIND,), names, source_id=f"way/{number}"),
        np.array(nodes),
        line(*xy),
        np.array(xy, dtype=float),
    )


def joined_of(ways: list[StreetPiece]) -> Streets:
    pieces = StreetPieces()
    for part in (ways[:1], ways[1:]):
        pieces.add(part)
    return join_streets(pieces, FIRST)


def corners(pieces: list[StreetPiece]) -> list[tuple[set[str], list[float]]]:
    joined = joined_of(pieces)
    return [
        ({joined.objects[n - FIRST].names[0] for n in pair}, position.tolist())
        for pair, position in zip(joined.corner_streets, joined.corners_m, strict=True)
    ]


def test_pieces_of_one_name_are_one_street() -> None:
    joined = joined_of(
        [
            piece(("Main Street", "Hauptstrasse"), (1, 2), (0, 0), (50, 0), number=4),
            piece("Side Road", (7, 8), (0, 90), (9, 90), number=5),
            piece(("MAIN STREET", "Main St"), (2, 3), (50, 0), (90, 0), number=6),
        ]
    )
    main, side = joined.objects
    assert main.kinds == (STREET_KIND,)
    assert main.names == ("Main Street", "Hauptstrasse", "MAIN STREET", "Main St")
    assert main.source_id == "way/4"
    assert joined.segments_m[0].tolist() == [[0, 0, 50, 0], [50, 0, 90, 0]]
    assert side.names == ("Side Road",)
    assert not len(joined.corner_streets), "a street is no corner with itself"


def test_streets_meet_at_a_shared_node() -> None:
    pieces = [
        piece("Main Street", (1, 2, 3), (0, 0), (50, 0), (90, 0)),
        piece("Side Road", (4, 2), (50, 60), (50, 0)),
    ]
    assert corners(pieces) == [({"Main Street", "Side Road"}, [50, 0])]


def test_streets_that_cross_without_a_node_have_a_corner_where_they_cross() -> None:
    pieces = [piece("Main Street", (1, 3), (0, 0), (90, 0)), piece("High Bridge", (4, 5), (30, -40), (30, 40))]
    assert corners(pieces) == [({"Main Street", "High Bridge"}, [30, 0])]


def test_streets_side_by_side_have_no_corner() -> None:
    assert corners([piece("Main Street", (1, 2), (0, 0), (90, 0)), piece("Side Road", (3, 4), (0, 9), (90, 9))]) == []


def test_carriageways_make_one_corner() -> None:
    far = CORNER_MERGE_M - 10
    pieces = [
        piece("Main Street", (1, 2), (0, 0), (90, 0)),
        piece("Main Street", (3, 4), (0, far), (90, far)),
        piece("Avenue", (5, 6), (40, -90), (40, 90)),
    ]
    assert corners(pieces) == [({"Main Street", "Avenue"}, [40, far / 2])]


def test_streets_that_meet_twice_have_two_corners() -> None:
    pieces = [
        piece("Main Street", (1, 2, 3), (0, 0), (10, 0), (200, 0)),
        piece("Crescent", (1, 4, 3), (0, 0), (100, 80), (200, 0)),
    ]
    assert [position for _, position in corners(pieces)] == [[0, 0], [200, 0]], "along the first"


def test_three_streets_at_a_node_meet_in_pairs() -> None:
    pieces = [piece(name, (n, 9), (n * 10, 50), (0, 0)) for n, name in enumerate(("A Street", "B Street", "C Street"))]
    result = corners(pieces)
    assert [names for names, _ in result] == [
        {"A Street", "B Street"},
        {"A Street", "C Street"},
        {"B Street", "C Street"},
    ]
    assert all(position == [0, 0] for _, position in result)


def test_the_lower_street_of_a_corner_is_first() -> None:
    pieces = [piece(f"Street {n}", (n, 99), (n * 10, 50), (0, 0)) for n in range(12)]
    pairs = joined_of(pieces).corner_streets
    assert len(pairs) == 12 * 11 / 2
    assert (pairs[:, 0] < pairs[:, 1]).all()
    assert pairs.min() == FIRST


def test_streets_on_top_of_each_other_have_a_finite_corner() -> None:
    ((_, position),) = corners(
        [piece("Main Street", (1, 2), (0, 0), (30, 0)), piece("Route 66", (3, 4), (10, 0), (20, 0))]
    )
    assert position == pytest.approx([15, 0])


def test_a_town_without_streets() -> None:
    joined = joined_of([])
    assert joined.objects == []
    assert joined.corner_streets.shape == joined.corners_m.shape == (0, 2)
