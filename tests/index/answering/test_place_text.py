import numpy as np
import pytest

from index.answering.place_text import place_text
from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER, build_gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject
from models.language.languages.translation import replies_in
from tests.models.citymap.gazetteer.made_town import line, made_gazetteer, point


@pytest.fixture(scope="module")
def town():
    return made_gazetteer()


@pytest.mark.parametrize(
    ("position", "street"),
    [
        (
            (200, 80),
            {"at the corner of West 25th Street and 10th Avenue", "at the corner of 10th Avenue and West 25th Street"},
        ),
        ((205, 5), {"at the corner of West 24th Street and 10th Avenue"}),
        ((320, 82), {"on West 25th Street, between 9th Avenue and 10th Avenue"}),
        ((201, 125), {"on 10th Avenue, between West 26th Street and West 25th Street"}),
        ((440, 80), {"on West 25th Street, 40 m from 9th Avenue"}),
        ((200, 425), {"on Harlem Road"}),
    ],
)
def test_the_street(town, position, street) -> None:
    text = place_text(town, np.array(position, dtype=float))
    assert any(text == one or text.startswith(f"{one}, ") for one in street)


@pytest.mark.parametrize(
    ("position", "expected"),
    [
        ((215, 102), "10 m north of Bottino"),
        ((195, 92), "20 m west of Bottino"),
        ((130, 158), "14 m northeast of Elmo"),
        ((388.5, 92), "at Café Zoë"),
        ((320, 110), "at Whole Foods Market"),
        ((285, 40), "at Chelsea Park"),
    ],
)
def test_beside_a_named_thing(town, position, expected) -> None:
    text = place_text(town, np.array(position, dtype=float))
    assert text == expected or text.endswith(f", {expected}")


def test_a_thing_without_a_street(town) -> None:
    text = place_text(
        build_gazetteer([GazetteerObject(("amenity/cafe",), ("Café Zoë",))], [point(0, 0)], [False]),
        np.array([0.0, 30.0]),
    )
    assert text == "30 m north of Café Zoë"


@pytest.fixture
def park():
    corners = [(0.0, 0.0), (600.0, 0.0), (600.0, 600.0), (0.0, 600.0), (0.0, 0.0)]
    return build_gazetteer([GazetteerObject(("leisure/park",), ("Great Park",))], [line(*corners)], [True])


def test_what_is_large_is_beside_its_edge(park) -> None:
    assert place_text(park, np.array([300.0, -20.0])) == "20 m south of Great Park"
    assert place_text(park, np.array([300.0, -80.0])) is None


def test_nothing_is_named_far_out_and_on_an_empty_map(town) -> None:
    assert place_text(town, np.array([9000.0, 9000.0])) is None
    assert place_text(EMPTY_GAZETTEER, np.zeros(2)) is None


def test_things_without_names_are_not_told(town) -> None:
    nameless = build_gazetteer(
        [GazetteerObject(("amenity/bench",)), GazetteerObject(("building",), (), "5", "Main")],
        [point(0, 0)] * 2,
        [False] * 2,
    )
    assert place_text(nameless, np.zeros(2)) is None


def test_the_nearest_street_is_told() -> None:
    streets = [GazetteerObject((STREET_KIND,), (name,)) for name in ("Main Street", "Side Road")]
    town = build_gazetteer(streets, [line((0, 0), (90, 0)), line((0, 20), (90, 20))], [False] * 2)
    assert place_text(town, np.array([40.0, 6.0])) == "on Main Street"
    assert place_text(town, np.array([40.0, 16.0])) == "on Side Road"
    assert place_text(town, np.array([40.0, 70.0])) is None


@pytest.mark.parametrize(
    ("code", "corner", "between", "beyond"),
    [
        (
            "fi",
            "katujen West 24th Street ja 10th Avenue kulmassa",
            "kadulla West 25th Street, katujen 9th Avenue ja 10th Avenue välissä",
            "kadulla West 25th Street, 40 m kadun 9th Avenue risteyksestä",
        ),
        (
            "sv",
            "i hörnet av West 24th Street och 10th Avenue",
            "på West 25th Street, mellan 9th Avenue och 10th Avenue",
            "på West 25th Street, 40 m från 9th Avenue",
        ),
        (
            "de",
            "an der Ecke West 24th Street/10th Avenue",
            "West 25th Street, zwischen 9th Avenue und 10th Avenue",
            "West 25th Street, 40 m von der Ecke 9th Avenue entfernt",
        ),
        (
            "fr",
            "à l\u2019angle West 24th Street / 10th Avenue",
            "West 25th Street, entre 9th Avenue et 10th Avenue",
            "West 25th Street, à 40 m du croisement avec 9th Avenue",
        ),
        (
            "es",
            "en la esquina de West 24th Street con 10th Avenue",
            "en West 25th Street, entre 9th Avenue y 10th Avenue",
            "en West 25th Street, a 40 m de 9th Avenue",
        ),
    ],
)
def test_the_street_in_other_languages(town, code, corner, between, beyond) -> None:
    with replies_in(code):
        texts = [place_text(town, np.array(p, dtype=float)) or "" for p in ((205, 5), (320, 82), (440, 80))]
    assert [text[: len(words)] for text, words in zip(texts, (corner, between, beyond), strict=True)] == [
        corner,
        between,
        beyond,
    ]


@pytest.mark.parametrize(
    ("code", "expected"),
    [
        ("fi", "20 m etelään kohteesta Great Park"),
        ("sv", "20 m söder om Great Park"),
        ("de", "20 m südlich von Great Park"),
        ("fr", "à 20 m au sud de «\u00a0Great Park\u00a0»"),
        ("es", "a 20 m al sur de Great Park"),
    ],
)
def test_the_nearest_name_in_other_languages(park, code, expected) -> None:
    with replies_in(code):
        assert place_text(park, np.array([300.0, -20.0])) == expected
