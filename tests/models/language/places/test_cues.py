import pytest

from models.language.places.cues import Cue, angle_of, cue_of, distance_of, spelt, wind_of


def said(text: str) -> Cue:
    """The cue of THING in a text."""
    before, _, after = text.partition("THING")
    return cue_of(spelt(before), spelt(after))


@pytest.mark.parametrize(
    ("text", "relation", "angle", "wind"),
    [
        ("the THING is on my left", "seen", -90, None),
        ("to my right is a THING", "seen", 90, None),
        ("a THING ahead on the right", "seen", 45, None),
        ("a THING behind me", "seen", 180, None),
        ("a THING behind me to the left", "seen", -135, None),
        ("the THING straight ahead", "seen", 0, None),
        ("in front of me is the THING", "seen", 0, None),
        ("I'm in front of the THING", "outside", None, None),
        ("I am across from the THING", "across", None, None),
        ("the THING is across the street", "across", None, None),
        ("accross from the THING", "across", None, None),
        ("opposite the THING", "across", None, None),
        ("a THING across the road on my left", "across", -90, None),
        ("a THING on my rigth", "seen", 90, None),
        ("I'm right next to the THING", "beside", None, None),
        ("beside the THING", "beside", None, None),
        ("next door to the THING", "beside", None, None),
        ("right outside the THING", "outside", None, None),
        ("the THING is right here", "beside", None, None),
        ("I just left the THING", "beside", 180, None),
        ("my back to the THING", "beside", 180, None),
        ("with my back against the THING", "beside", 180, None),
        ("facing the THING", "across", 0, None),
        ("looking at the THING", "far", 0, None),
        ("at the THING", "at", None, None),
        ("almost at the THING", "near", None, None),
        ("near the THING", "near", None, None),
        ("not far from the THING", "near", None, None),
        ("just past the THING", "past", None, None),
        ("inside the THING", "inside", None, None),
        ("the THING is north of me", "wind", None, 0),
        ("I'm north of the THING", "wind", None, 180),
        ("southeast of the THING", "wind", None, 315),
        ("north-west of the THING", "wind", None, 135),
        ("the THING is to the west", "wind", None, 270),
        ("two blocks north of the THING", "wind", None, 180),
        ("the THING is further down the street", "far", None, None),
        ("there is a THING on the next block", "block", None, None),
        ("a THING", "seen", None, None),
    ],
)
def test_where_a_thing_is(text, relation, angle, wind) -> None:
    cue = said(text)
    assert cue.relation == relation
    assert cue.angle == (None if angle is None else pytest.approx(angle, abs=0.01))
    assert cue.wind == wind


@pytest.mark.parametrize("text", ["on my left is THING", "on my left is the THING", "to the left there is THING"])
def test_what_is_on_the_left_is_not_what_was_left(text) -> None:
    cue = said(text)
    assert cue.relation == "seen"
    assert cue.angle == pytest.approx(-90)


@pytest.mark.parametrize(("words", "angle"), [
    ("ahead a bit to the left", -21.8),
    ("slightly to the right", 45),
    ("the right side", 90),
    ("right ahead", 0),
    ("right behind me", 180),
    ("right by the door", None),
    ("all right", None),
    ("we just left", None),
    ("", None),
])  # fmt: skip
def test_angles(words, angle) -> None:
    found = angle_of(words)
    assert found == (None if angle is None else pytest.approx(angle, abs=0.1))


@pytest.mark.parametrize(
    ("text", "metres", "loose"),
    [
        ("the THING is 50 m ahead", 50, False),
        ("50m behind me is a THING", 50, False),
        ("about 100 feet from the THING", 30.48, False),
        ("THING is twenty metres off", 20, False),
        ("the THING is 10 yards away", 9.144, False),
        ("1.5 km from the THING", 1500, False),
        ("1,5 km from the THING", 1500, False),
        ("two blocks north of the THING", 220, True),
        ("a block from the THING", 110, True),
        ("a couple of blocks from the THING", 220, True),
        ("half block from the THING", 55, True),
        ("2 minutes from the THING", 160, True),
        ("3 doors down from the THING", 27, True),
        ("20 steps from the THING", 15, False),
        ("900 km from the THING", None, None),
        ("5 of the THING", None, None),
        ("near the THING", None, None),
    ],
)
def test_how_far_a_thing_is(text, metres, loose) -> None:
    cue = said(text)
    assert cue.distance_m == (None if metres is None else pytest.approx(metres))
    assert cue.is_loose == bool(loose)


def test_a_few_doors_are_loose_and_not_far() -> None:
    metres, loose = distance_of("a few doors down")
    assert loose
    assert 15 <= metres <= 40


def test_a_few_blocks_are_loose_and_several() -> None:
    metres, loose = distance_of("a few blocks down")
    assert loose
    assert 220 < metres <= 330


@pytest.mark.parametrize("words", ["a few metres ahead", "a couple of metres ahead", "a few feet ahead"])
def test_a_few_metres_are_not_measured(words) -> None:
    found = distance_of(words)
    assert found is not None
    assert found[1]


@pytest.mark.parametrize(("words", "metres"), [
    ("seventy five feet ahead", 22.86),
    ("twenty-five metres ahead", 25),
    ("1,200 feet away", 365.76),
    ("half a block ahead", 55),
    ("a block and a half ahead", 165),
    ("two and a half blocks ahead", 275),
])  # fmt: skip
def test_compound_numbers(words, metres) -> None:
    found = distance_of(words)
    assert found is not None
    assert found[0] == pytest.approx(metres)


@pytest.mark.parametrize(("words", "degrees"), [
    ("north", 0), ("north east", 45), ("north-east", 45), ("the eastern side", 90), ("southwards", 180),
    ("westbound", 270), ("northwest", 315), ("left", None), ("the northern", 0), ("eastwood", None),
])  # fmt: skip
def test_winds(words, degrees) -> None:
    assert wind_of(words) == degrees


@pytest.mark.parametrize(
    ("wrong", "right"),
    [
        ("ACCROSS", "across"),
        ("on my lef", "on my left"),
        ("infront", "in front"),
        ("nr", "near"),
        ("rite", "right"),
        ("", ""),
    ],
)
def test_misspelt_words_are_mended(wrong, right) -> None:
    assert spelt(wrong) == right
