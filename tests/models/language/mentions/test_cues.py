import pytest

from models.language.mentions.cues import distances_of, wind_of, winds_of


@pytest.mark.parametrize(
    ("text", "metres", "loose"),
    [
        ("it is 50 m ahead", 50, False),
        ("50m behind me", 50, False),
        ("about 100 feet from it", 30.48, False),
        ("Twenty Metres off", 20, False),
        ("10 yards away", 9.144, False),
        ("1.5 km from it", 1500, False),
        ("1,5 km from it", 1500, False),
        ("two blocks north of it", 220, True),
        ("a block from it", 110, True),
        ("a couple of blocks from it", 220, True),
        ("half block from it", 55, True),
        ("2 minutes from it", 160, True),
        ("3 doors down from it", 27, True),
        ("20 steps from it", 15, False),
        ("seventy five feet ahead", 22.86, False),
        ("twenty-five metres ahead", 25, False),
        ("1,200 feet away", 365.76, False),
        ("half a block ahead", 55, True),
        ("a block and a half ahead", 165, True),
        ("two and a half blocks ahead", 275, True),
    ],
)
def test_distances(text, metres, loose) -> None:
    [said] = distances_of(text)
    assert said.value == pytest.approx(metres)
    assert said.is_loose == loose
    assert 0 <= said.start < said.end <= len(text)


@pytest.mark.parametrize(
    "text",
    [
        "900 km from it", "5 of them", "near it", "", "I am in the park", "99999999999999999999999999 meters",
        "there's a Foot Locker", "the two Miles McEnery doors", "I'm in a yard", "a shop on my left", "in a building",
    ],
)  # fmt: skip
def test_no_distances(text) -> None:
    assert distances_of(text) == []


@pytest.mark.parametrize(("text", "is_of"), [
    ("100 feet short of 34th", True), ("30 meters up from 40th", True), ("twenty metres south-east of it", False),
    ("two doors down from the corner", True), ("40 feet ahead of me", False), ("maybe 80 feet, and a bench", False),
    ("a foot away from the wall", True),
])  # fmt: skip
def test_what_a_distance_is_measured_from(text, is_of) -> None:
    assert [said.is_of for said in distances_of(text)] == [is_of]


def test_every_distance_of_a_text_is_found_where_it_stands() -> None:
    text = "The bank is 1,200 feet ahead and the bus stop twenty five metres to my right, a few doors on."
    found = sorted(distances_of(text), key=lambda said: said.start)
    assert [text[said.start : said.end] for said in found] == ["1,200 feet", "twenty five metres", "a few doors"]


@pytest.mark.parametrize("words", ["a few metres ahead", "a couple of metres ahead", "a few feet ahead"])
def test_a_few_metres_are_not_measured(words) -> None:
    [said] = distances_of(words)
    assert said.is_loose


@pytest.mark.parametrize(("words", "low", "high"), [("a few doors down", 15, 40), ("a few blocks down", 220, 330)])
def test_a_few_are_several(words, low, high) -> None:
    [said] = distances_of(words)
    assert said.is_loose
    assert low < said.value <= high


@pytest.mark.parametrize(("words", "degrees"), [
    ("north", 0), ("north east", 45), ("North-East", 45), ("the eastern side", 90), ("southwards", 180),
    ("westbound", 270), ("northwest", 315), ("left", None), ("the northern", 0), ("eastwood", None),
])  # fmt: skip
def test_winds(words, degrees) -> None:
    assert wind_of(words) == degrees


def test_a_wind_of_something_is_told_from_one_alone() -> None:
    assert [said.is_of for said in winds_of("north of the bank, and the bar is to the west")] == [True, False]
