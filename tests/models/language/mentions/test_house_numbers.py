import pytest

from models.language.mentions.house_numbers import match_number, number_alone, number_beside, numbers_apart

STREET = "Bulevardi"


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("Bulevardi 12", "12"), ("12 Bulevardi", "12"), ("Bulevardi 12 B", "12 B"), ("Bulevardi 12B", "12B"),
        ("Bulevardi 46-48", "46-48"), ("Bulevardi 3 B 14", "3 B"), ("number 27 on Bulevardi", "27"),
        ("no. 5, Bulevardi", "5"),
        ("Bulevardi, number 9", "9"), ("Bulevardi 12, please", "12"), ("at 331 Bulevardi", "331"),
        ("Bulevardi #7", "7"),
    ],
)  # fmt: skip
def test_the_number_of_a_street(text, number) -> None:
    start = text.index(STREET)
    written = number_beside(text, start, start + len(STREET))
    assert written is not None
    assert written.number == number


@pytest.mark.parametrize(
    "text",
    [
        "Bulevardi 5 minutes ago",
        "tram 6 Bulevardi",
        "Bulevardi, 3 people",
        "Bulevardi 12:30",
        "on Bulevardi",
        "Bulevardi 2 stops",
    ],
)
def test_a_number_of_something_else(text) -> None:
    start = text.index(STREET)
    assert number_beside(text, start, start + len(STREET)) is None


@pytest.mark.parametrize(
    "text",
    [
        "je suis au 12 de la Bulevardi", "devant le 12, Bulevardi", "Bulevardi au 12", "à hauteur du 12 Bulevardi",
        "vor Hausnummer 12 in der Bulevardi", "Bulevardi auf Höhe Nummer 12", "en el 12 de la Bulevardi",
        "davanti al civico 12 di Bulevardi", "Bulevardi n.º 12", "em frente ao número 12 da Bulevardi",
        "pod numerem 12 na Bulevardi", "numeron 12 kohdalla, Bulevardi", "Bulevardi numara 12", "Bulevardi No:12",
        "возле дома 12 по Bulevardi", "nummer 12 på Bulevardi", "huisnummer 12 in de Bulevardi",
    ],
)  # fmt: skip
def test_the_number_of_a_street_in_other_languages(text) -> None:
    start = text.index(STREET)
    written = number_beside(text, start, start + len(STREET))
    assert written is not None
    assert written.number == "12"


@pytest.mark.parametrize(
    "text", ["ligne 12 Bulevardi", "12 metriä Bulevardi", "Bulevardi 12 personas", "Linie 12 Bulevardi"]
)
def test_a_number_of_something_else_in_other_languages(text) -> None:
    start = text.index(STREET)
    assert number_beside(text, start, start + len(STREET)) is None


def test_a_number_without_a_space() -> None:
    text = "我在福順路1177號前面"
    written = number_beside(text, 2, 5)
    assert written is not None
    assert written.number == "1177號"


@pytest.mark.parametrize(
    ("written", "known", "numbers", "is_whole"),
    [
        ("46", ["46-48"], ("46-48",), True),
        ("48", ["46-48"], ("46-48",), True),
        ("20", ["20;22"], ("20;22",), True),
        ("14", ["12-18"], ("12-18",), True),
        ("52 B", ["52B", "52"], ("52B",), True),
        ("52b", ["52"], ("52",), False),
        ("6-10", ["6", "8"], ("6", "8"), True),
    ],
)
def test_a_number_in_a_range_or_with_a_letter(written, known, numbers, is_whole) -> None:
    match = match_number(written, known)
    assert match is not None
    assert match.numbers == numbers
    assert match.is_whole is is_whole


def test_the_other_side_is_no_member() -> None:
    assert match_number("47", ["46-48"]) is None


def test_a_gap_is_between_its_neighbours_on_the_same_side() -> None:
    match = match_number("6", ["2", "3", "5", "7", "10"])
    assert match is not None
    assert [n for n, _ in match.between] == [2, 10]
    assert match_number("12", ["2", "10"]) is None, "past the end"


@pytest.mark.parametrize(("text", "is_marked"), [("at the door of 331", True), ("opposite, 328", False)])
def test_a_number_apart_from_its_street(text, is_marked) -> None:
    ((number, marked),) = numbers_apart(text)
    assert number.number == text[-3:]
    assert marked is is_marked


def test_a_number_alone() -> None:
    assert (number_alone("46-48"), number_alone("no. 5"), number_alone("5 Main Street")) == ("46-48", "5", None)
