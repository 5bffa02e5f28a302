import pytest

from models.language.places.mentions import Mention, with_cues, without_again
from models.language.places.reader import find_mentions


def cues(text: str, *things: str) -> list[tuple[str, float | None]]:
    """(relation, angle) of things in a text."""
    mentions = [Mention(thing, text.index(thing), text.index(thing) + len(thing), "thing") for thing in things]
    return [(m.cue.relation, m.cue.angle) for m in with_cues(text, mentions)]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("AAA is on my left and BBB is on my right", [("seen", -90), ("seen", 90)]),
        ("AAA is on my left, BBB on my right", [("seen", -90), ("seen", 90)]),
        ("AAA is behind me. On my right is BBB.", [("seen", 180), ("seen", 90)]),
        ("I'm next to AAA. Behind me there is BBB", [("beside", None), ("seen", 180)]),
        ("near AAA and across from BBB", [("near", None), ("across", None)]),
        ("AAA behind me\nBBB", [("seen", 180), ("seen", None)]),
        ("I am at AAA, facing BBB", [("at", None), ("across", 0)]),
        ("AAA is on my left BBB is on my right", [("seen", -90), ("seen", 90)]),
    ],
)
def test_words_go_to_the_thing_that_they_tell_of(text, expected) -> None:
    assert cues(text, "AAA", "BBB") == [
        (relation, pytest.approx(angle) if angle is not None else None) for relation, angle in expected
    ]


def test_mentions_keep_their_order() -> None:
    text = "near AAA, past BBB"
    mentions = [Mention("BBB", 15, 18, "thing"), Mention("AAA", 5, 8, "thing")]
    assert [(m.text, m.cue.relation) for m in with_cues(text, mentions)] == [("BBB", "past"), ("AAA", "near")]


def test_no_mentions() -> None:
    assert with_cues("nothing", []) == []


@pytest.mark.parametrize(
    ("text", "side"),
    [
        ("on the north side of 25th Street", 0),
        ("on the south side of W 25th St", 180),
        ("I'm on 25th Street on the south side", 180),
        ("on the southwest corner of 25th and 10th", 225),
        ("on the eastern side of 10th Avenue", 90),
        ("on 25th Street", None),
    ],
)
def test_the_side_of_a_street(lookup, text, side) -> None:
    (mention,) = find_mentions(text, lookup)
    assert mention.side == side
    assert mention.cue.wind is None, "a side is no wind"


def test_a_kind_named_again_is_the_same_thing(lookup) -> None:
    found = find_mentions("There is a cafe on my left. The bakery is a block east of the cafe.", lookup)
    assert [m.text for m in found] == ["cafe", "bakery"]


def test_another_of_a_kind_is_another(lookup) -> None:
    found = find_mentions("a bench on my left and a bench on my right", lookup)
    assert [m.cue.angle for m in found] == [pytest.approx(-90), pytest.approx(90)]


def test_naming_again_leaves_the_text_as_long_as_it_was() -> None:
    text = "a cafe, a bank north of the cafe"
    mentions = [Mention("cafe", at, at + 4, "thing", kinds=("amenity/cafe",)) for at in (2, 28)]
    shorter, kept = without_again(text, mentions)
    assert len(shorter) == len(text)
    assert shorter.startswith("a cafe, a bank north of it")
    assert kept == mentions[:1]
