from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.measures import (
    COMPASS,
    ONES,
    TENS,
    Bearing,
    Measure,
    compass_name,
    find_bearings,
    find_measures,
    find_numbers,
    first_bearing,
    match_facts_to_spans,
    ordinal,
)

FOOT, YARD, MILE = 0.3048, 0.9144, 1609.0
BLOCK, DOOR, MINUTE, STEP = 110.0, 9.0, 80.0, 0.75

IN_WORDS = [
    ("seven metres ahead", 7), ("sixteen metres away", 16), ("sixty metres off", 60), ("ninety yards", 90 * YARD),
    ("twenty-five meters", 25), ("twenty five metres", 25), ("Twenty-Five metres", 25), ("ninety-nine feet", 99 * FOOT),
    ("a hundred metres", 100), ("one hundred and fifty feet", 150 * FOOT), ("a hundred and fifty metres", 150),
    ("one hundred fifty feet", 150 * FOOT), ("two hundred metres", 200), ("three-hundred metres", 300),
    ("twelve hundred feet", 1200 * FOOT), ("a thousand metres", 1000), ("two thousand five hundred metres", 2500),
    ("nine thousand nine hundred and ninety-nine metres", 9999), ("a dozen steps", 12 * STEP),
    ("half a dozen steps", 6 * STEP), ("one point five kilometres", 1500), ("hundred metres further", 100),
]  # fmt: skip
IN_DIGITS = [
    ("50 m ahead", 50), ("50m behind me", 50), ("50-metre gap", 50), ("12.5 m to my east", 12.5), ("1,5 km", 1500),
    ("12,5 m", 12.5), ("1,200 m", 1200), ("1,200 feet away", 1200 * FOOT), ("1\u202f200 m", 1200),
    ("1,200.5 m", 1200.5), ("number 1 200 m away", 200),
    ("1.25 km", 1250), ("0.5 miles", MILE / 2), ("5 1/2 blocks", 5.5 * BLOCK), ("1½ miles", 1.5 * MILE),
    ("½ mile", MILE / 2), ("1/2 mile", MILE / 2), ("3/4 of a mile", 0.75 * MILE), ("~20 m", 20), ("north,10 m", 10),
]  # fmt: skip
UNITS = [
    ("20 meters", 20), ("20 metre", 20), ("20 m.", 20), ("100 ft", 100 * FOOT), ("100 ft.", 100 * FOOT),
    ("100ft away", 100 * FOOT), ("a 100 foot gap", 100 * FOOT), ("50' ahead", 50 * FOOT), ("50’ ahead", 50 * FOOT),  # noqa: RUF001
    ("30 yards", 30 * YARD), ("30 yds", 30 * YARD), ("2 km", 2000), ("2 kilometers", 2000), ("2 mi north", 2 * MILE),
    ("two miles", 2 * MILE), ("5 steps", 5 * STEP), ("twenty paces", 20 * STEP), ("20 METERS AHEAD", 20),
    ("Twenty Metres off", 20), ("20 Meters North of it", 20), ("50 M ahead", 50), ("a mile away", MILE),
    ("a yard away", YARD), ("a step away", STEP), ("a foot from it", FOOT),
]  # fmt: skip
PARTS = [
    ("half a mile", MILE / 2), ("half mile", MILE / 2), ("a half-mile", MILE / 2), ("half a block", BLOCK / 2),
    ("a mile and a half", 1.5 * MILE), ("one and a half miles", 1.5 * MILE), ("two and a half blocks", 2.5 * BLOCK),
    ("a quarter of a mile", MILE / 4), ("quarter mile", MILE / 4), ("three quarters of a mile", 0.75 * MILE),
    ("a third of a mile", MILE / 3), ("two thirds of a mile", 2 * MILE / 3), ("about a fifth of a block", BLOCK / 5),
    ("a block and a quarter", 1.25 * BLOCK), ("one and three quarters miles", 1.75 * MILE),
]  # fmt: skip
RANGES = [
    ("10 to 15 m", 12.5), ("10-15 m", 12.5), ("10–15 m", 12.5), ("ten or fifteen metres", 12.5),  # noqa: RUF001
    ("fifty or sixty meters", 55), ("between 10 and 20 metres", 15), ("two or three blocks", 2.5 * BLOCK),
    ("a block or two", 1.5 * BLOCK), ("5 or 6 doors down", 5.5 * DOOR),
]  # fmt: skip
LOOSE = [
    ("two blocks", 2 * BLOCK), ("a block from it", BLOCK), ("two more blocks", 2 * BLOCK), ("3 city blocks", 3 * BLOCK),
    ("6 or so blocks", 6 * BLOCK), ("a couple of blocks", 2 * BLOCK), ("a couple blocks", 2 * BLOCK),
    ("a few blocks", 2.5 * BLOCK), ("several blocks", 4 * BLOCK), ("a few doors down", 2.5 * DOOR),
    ("a few doors on.", 2.5 * DOOR), ("a couple of doors to my right", 2 * DOOR), ("three doors past it", 3 * DOOR),
    ("two shops down", 18), ("four buildings up from it", 60), ("5 buildings from me", 75), ("a shop along", 9),
    ("a few steps ahead", 2.5 * STEP), ("a few metres ahead", 7.5), ("a couple of metres ahead", 6),
    ("a couple hundred feet", 200 * FOOT), ("a few hundred metres", 250), ("a few dozen feet", 30 * FOOT),
    ("2 minutes from it", 2 * MINUTE), ("a five-minute walk", 5 * MINUTE), ("10 min walk away", 10 * MINUTE),
    ("ten minutes' walk", 10 * MINUTE), ("two minutes north", 2 * MINUTE), ("3 more minutes to the bench", 3 * MINUTE),
]  # fmt: skip
NONE = [
    # names, house numbers, streets, lines
    "there's a Foot Locker", "the two Miles McEnery doors", "2 Miles Gallery is ahead", "The Five Yards Cafe is ahead",
    "at 12 Mile Road", "on 10 mile road", "10th Avenue", "the 5th door", "Route 66", "on line M10",
    "at number 31 store",    "the Alea 101 building", "at 5 M Street", "'Pier 50' is ahead", "version 1.2.3 m",
    # times
    "a minute ago", "in 5 minutes", "I'll be 2 min", "waiting ten minutes", "5 minutes late", "2 minutes by bus",
    # sizes
    "a wall 6 foot high", "a tower 30 m tall", "100 metres of wall", "20 square metres", "20 m² of grass",
    # things
    "I'm in a yard", "in a yard off it", "a shop on my left", "in a building", "a building ahead",
    "two shops on my left", "three buildings", "Two buildings to the north", "between the two buildings",
    "a block of flats", "a block with balconies", "some steps go up", "a foot path", "a parking meter",
    # neither
    "5 of them", "near it", "", "I am in the park", "900 km from it", "a mi derecha", "N 60° 10.194' E",
    "99999999999999999999999999 meters", f"{'9' * 400} m", "zero of them", "a m", "1/0 m",
]  # fmt: skip


@pytest.mark.parametrize(("text", "metres"), IN_WORDS + IN_DIGITS + UNITS + PARTS + RANGES + LOOSE)
def test_a_measure(text, metres) -> None:
    [result] = find_measures(text)
    assert result.metres == pytest.approx(metres)
    assert 0 <= result.start < result.end <= len(text)


@pytest.mark.parametrize(("text", "_"), LOOSE)
def test_a_measure_in_loose_words(text, _) -> None:
    assert find_measures(text)[0].is_loose


@pytest.mark.parametrize(("text", "_"), IN_WORDS + IN_DIGITS[:8] + UNITS)
def test_a_measure_in_units_of_length(text, _) -> None:
    assert not find_measures(text)[0].is_loose


@pytest.mark.parametrize("text", NONE)
def test_no_measure(text) -> None:
    assert find_measures(text) == ()


def test_within_a_measure_of_something() -> None:
    assert [result.metres for result in find_measures("we are within 20 metres of the bank")] == [20]


def test_every_measure_stands_where_it_is_said() -> None:
    text = (
        "The bank is 1,200 feet ahead and the bus stop twenty five metres to my right, a few doors on, half a mile up."
    )
    phrase = [text[result.start : result.end] for result in find_measures(text)]
    assert phrase == ["1,200 feet", "twenty five metres", "a few doors", "half a mile"]


@pytest.mark.parametrize(("text", "is_of"), [
    ("100 feet short of 34th", True), ("30 meters up from 40th", True), ("twenty metres south-east of it", False),
    ("two doors down from the corner", True), ("40 feet ahead of me", False), ("maybe 80 feet, and a bench", False),
    ("a foot away from the wall", True), ("a few steps from the bank", True),
])  # fmt: skip
def test_what_a_measure_is_from(text, is_of) -> None:
    assert [result.is_of for result in find_measures(text)] == [is_of]


def in_words(number: int, hyphen: str, conjunction: str, one: str) -> str:
    """A number below 10,000 as people write it."""
    below_20 = {n: word for word, n in ONES.items()}
    tens = {n: word for word, n in TENS.items()}
    if number < 20:
        return below_20[number]
    if number < 100:
        return tens[number // 10 * 10] + (hyphen + below_20[number % 10] if number % 10 else "")
    size, name = (1000, "thousand") if number >= 1000 else (100, "hundred")
    many = number // size
    words = f"{one if many == 1 else in_words(many, hyphen, conjunction, one)} {name}"
    if not (rest := number % size):
        return words
    joint = conjunction if size == 100 or rest < 100 else " "
    return words + joint + in_words(rest, hyphen, conjunction, "one")


WRITTEN = st.tuples(
    st.integers(0, 9999), st.sampled_from(["-", " "]), st.sampled_from([" and ", " "]), st.sampled_from(["a", "one"])
)


@given(WRITTEN)
def test_a_number_in_words_is_read_back(written) -> None:
    words = in_words(*written)
    assert [(result.start, result.end, result.value) for result in find_numbers(words)] == [(0, len(words), written[0])]


@given(WRITTEN, st.sampled_from(["metres", "feet", "yards", "steps", "paces", "ft"]))
def test_a_measure_in_words_and_in_digits_is_the_same(written, unit) -> None:
    [in_digits] = find_measures(f"it is {written[0]} {unit} away")
    [spoken] = find_measures(f"it is {in_words(*written)} {unit} away")
    assert spoken.metres == in_digits.metres


@given(st.integers(0, 999_999), st.integers(0, 9))
def test_digits_are_read_back(number, tenths) -> None:
    for written in (f"{number}", f"{number:,}", f"{number:,}".replace(",", "\u202f")):
        assert [result.value for result in find_numbers(written)] == [number]
    assert [result.value for result in find_numbers(f"{number},{tenths}")] == [pytest.approx(number + tenths / 10)]


@given(st.text(alphabet="0123456789 .,-/½½abhmndft'", max_size=40))
def test_any_text_is_read(text) -> None:
    for result in find_measures(text):
        assert 0 <= result.start < result.end <= len(text)
        assert 0 <= result.metres <= 1e5


@pytest.mark.parametrize(("words", "degrees"), [
    ("north", 0), ("north east", 45), ("North-East", 45), ("the eastern side", 90), ("southwards", 180),
    ("westbound", 270), ("northwest", 315), ("the northern", 0), ("NW of it", 315), ("50 m NE", 45), ("NNE", 22.5),
    ("north-northeast", 22.5), ("west south-west", 247.5), ("to the ESE", 112.5), ("N of the bank", 0),
    ("due E", 90), ("to my W.", 270), ("on the S side", 180), ("20 m W.", 270),
    ("left", None), ("eastwood", None), ("I'm at E 53rd", None), ("NE 5th Street", None), ("n of it", None),
    ("a se", None), ("A and E", None), ("the E train", None),
])  # fmt: skip
def test_compass_directions(words, degrees) -> None:
    assert first_bearing(words) == degrees


def test_a_direction_of_something_is_told_from_one_alone() -> None:
    result = find_bearings("north of the bank, and the bar is to the west")
    assert [bearing.is_of for bearing in result] == [True, False]


@given(st.integers(0, 7), st.floats(-22, 22), st.integers(-2, 2))
def test_the_nearest_compass_direction(point, off, turns) -> None:
    assert compass_name(45 * point + off + 360 * turns) == COMPASS[point]


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (1, "1st"),
        (2, "2nd"),
        (3, "3rd"),
        (4, "4th"),
        (11, "11th"),
        (12, "12th"),
        (13, "13th"),
        (21, "21st"),
        (42, "42nd"),
        (111, "111th"),
        (123, "123rd"),
    ],
)
def test_ordinals(number, text) -> None:
    assert ordinal(number) == text


@dataclass(frozen=True)
class Named:
    """A name in a text."""

    start: int
    end: int


def named(text: str, *names: str) -> list[Named]:
    return [Named(text.index(name), text.index(name) + len(name)) for name in names]


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("About ten metres north of a bench.", {"bench": 10.0}),
        ("A bench is 12.5 m to my east, a pole is north.", {"bench": 12.5}),
        ("A bench is to my east. The pole is 20 feet away.", {"pole": 20 * FOOT}),
        ("The bench is 5 steps from me.", {"bench": 5 * STEP}),
        ("Some 30 yards from the bench", {"bench": 30 * YARD}),
        ("The bench is 10 m away, 20 m past the pole.", {"bench": 10.0, "pole": 20.0}),
        ("A bench on line M10 near me.", {}),
        ("I'm 30 m short of the pole, beside a bench.", {"pole": 30.0}),
    ],
)
def test_a_measure_belongs_to_what_is_nearest(text, metres) -> None:
    names = [name for name in ("bench", "pole") if name in text]
    result = match_facts_to_spans(text, find_measures(text), named(text, *names))
    assert {names[n]: measure.metres for n, measure in result.items()} == pytest.approx(metres)


def test_a_fact_belongs_to_one_and_not_to_what_it_is_a_part_of() -> None:
    text = "The 50 m pool and the bench are 20 m north."
    result = match_facts_to_spans(text, find_measures(text), named(text, "50 m pool", "bench"))
    assert {n: measure.metres for n, measure in result.items()} == {1: 20}
    assert match_facts_to_spans("a yard off", [Measure(0, 6, 1.0)], [Named(2, 6)]) == {}, "its unit"
    assert match_facts_to_spans("x", [Measure(0, 1, 1.0)], [None]) == {}
    assert match_facts_to_spans("x y", [Bearing(0, 1, 1.0)], [Named(2, 3), Named(2, 3)]) == {0: Bearing(0, 1, 1.0)}
