import re

import pytest

from models.language.languages.tabulated import tabulated


def cues(codes: tuple[str, ...], text: str, *things: str) -> list[tuple[str, float | None]]:
    """Relation and angle of things in a text; a thing in capital letters is a street."""
    spans = []
    for thing in things:
        start = text.index(thing)
        spans.append((start, start + len(thing), "street" if thing.isupper() else "thing"))
    return [(cue.relation, cue.angle) for cue in tabulated(codes).read_cues(text, spans)]


@pytest.mark.parametrize(
    ("code", "text", "expected"),
    [
        ("fi", "AAAn edessä, BBB on vasemmalla", [("outside", None), ("seen", -90.0)]),
        ("fi", "Olen AAAn vieressä. Takanani on BBB", [("beside", None), ("seen", 180.0)]),
        ("sv", "Jag står framför AAA, till höger är BBB", [("outside", None), ("seen", 90.0)]),
        ("de", "Ich stehe vor der AAA, links ist die BBB", [("outside", None), ("seen", -90.0)]),
        ("de", "neben dem AAA, rechts vor mir BBB", [("beside", None), ("seen", 45.0)]),
        ("nl", "Ik sta naast de AAA, links zie ik de BBB", [("beside", None), ("seen", -90.0)]),
        ("fr", "devant la AAA, le BBB est à ma droite", [("outside", None), ("seen", 90.0)]),
        ("es", "al lado de la AAA, a mi izquierda el BBB", [("beside", None), ("seen", -90.0)]),
        ("it", "accanto alla AAA, il BBB è alla mia destra", [("beside", None), ("seen", 90.0)]),
        ("pt", "em frente à AAA, à minha esquerda o BBB", [("outside", None), ("seen", -90.0)]),
        ("pl", "obok AAA, po prawej mam BBB", [("beside", None), ("seen", 90.0)]),
        ("ru", "рядом с AAA, слева BBB", [("beside", None), ("seen", -90.0)]),  # noqa: RUF001
        ("tr", "AAA'nın önündeyim, solumda BBB var", [("outside", None), ("seen", -90.0)]),  # noqa: RUF001
        ("en", "next to the AAA, the BBB is on my left", [("beside", None), ("seen", -90.0)]),
    ],
)
def test_relations_and_sides(code, text, expected) -> None:
    text = text.replace("AAA", "Aaaaa").replace("BBB", "Bbbbb")
    things = re.findall(r"Aaaaa[\w']*|Bbbbb", text)
    assert cues((code,), text, *things) == expected


def test_one_side_is_of_all_things_of_a_list() -> None:
    assert cues(("de",), "links Aaaaa und Bbbbb, rechts Ccccc", "Aaaaa", "Bbbbb", "Ccccc") == [
        ("seen", -90.0),
        ("seen", -90.0),
        ("seen", 90.0),
    ]


def test_a_clause_without_a_thing_is_about_the_one_before() -> None:
    assert cues(("de",), "neben Aaaaa, das ist links", "Aaaaa") == [("beside", -90.0)]


def test_a_side_is_of_the_next_thing_behind_a_distance() -> None:
    [cue, _] = cues(("de",), "bei Aaaaa links, und geradeaus, so 30 Meter, der Bbbbb", "Bbbbb", "Aaaaa")
    assert cue[1] == 0.0


def test_a_side_of_an_unknown_thing_is_of_no_other() -> None:
    assert cues(("fi",), "Olen Aaaaa, oikealla turkisliike", "Aaaaa") == [("seen", None)]


def test_a_street_is_where_the_speaker_is_unless_the_text_says_otherwise() -> None:
    assert cues(("de",), "in der AAAAA, die BBBBB links", "AAAAA", "BBBBB") == [("inside", None), ("seen", -90.0)]


@pytest.mark.parametrize(
    ("code", "text", "metres"),
    [("de", "noch 30 Meter weiter", 30.0), ("fi", "noin kaksikymmentä metriä", 20.0), ("fr", "à 1,5 km", 1500.0)],
)
def test_distances(code, text, metres) -> None:
    [measure] = tabulated((code,)).find_measures(text)
    assert measure.metres == metres


def test_winds() -> None:
    [north, southeast] = tabulated(("de",)).find_bearings("im Norden die Post, südöstlich der Kirche")
    assert (north.degrees, southeast.degrees) == (0.0, 135.0)
    assert not north.is_of
    assert southeast.is_of


def test_the_speaker_is_on_the_first_of_several_streets() -> None:
    assert cues(("de",), "AAAAA, BBBBB", "AAAAA", "BBBBB") == [("inside", None), ("near", None)]


def test_a_word_with_an_accent_is_no_and() -> None:
    assert cues(("it",), "il Aaaaa è alla mia destra, Bbbbb", "Aaaaa", "Bbbbb") == [("seen", 90.0), ("seen", None)]
