from collections.abc import Sequence

import pytest

from models.language.languages.english import English
from models.language.mentions.cue_reader import MentionSpan, ReadCue
from models.language.mentions.mentions import Mention, add_cues
from models.language.mentions.reader import find_mentions


def phrase(text: str, english: English, *things: str) -> list[tuple[str, float | None]]:
    """(relation, angle) of things in a text."""
    mentions = [Mention(thing, text.index(thing), text.index(thing) + len(thing), "thing") for thing in things]
    return [(m.cue.relation, m.cue.angle) for m in add_cues(text, mentions, english)]


NAMES = [
    ("Starbucks", "the bank"),
    ("CVS", "Gap"),
    ("a church", "Joe's Pizza"),
    ("the library", "Chase"),
    ("Elmo", "a school"),
]
MOST = 3  # of these


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("AAA is on my left and BBB is on my right", [("seen", -90), ("seen", 90)]),
        ("AAA is on my left, BBB on my right", [("seen", -90), ("seen", 90)]),
        ("AAA is behind me. On my right is BBB.", [("seen", 180), ("seen", 90)]),
        ("I'm next to AAA. Behind me there is BBB", [("beside", None), ("seen", 180)]),
        ("near AAA and across from BBB", [("near", None), ("across", None)]),
        ("I am at AAA, facing BBB", [("at", None), ("seen", 0)]),
        ("AAA is on my left BBB is on my right", [("seen", -90), ("seen", 90)]),
    ],
)
def test_words_go_to_the_thing_that_they_tell_of(english, text, expected) -> None:
    stated = [(relation, angle if angle is None else pytest.approx(angle)) for relation, angle in expected]
    right = [
        phrase(text.replace("AAA", one).replace("BBB", other), english, one, other) == stated for one, other in NAMES
    ]
    assert sum(right) >= MOST, "a trained reader may stumble over a name"


def test_mentions_keep_their_order(english) -> None:
    text = "near AAA, past BBB"
    mentions = [Mention("BBB", 15, 18, "thing"), Mention("AAA", 5, 8, "thing")]
    assert [(m.text, m.cue.relation) for m in add_cues(text, mentions, english)] == [("BBB", "past"), ("AAA", "near")]


def test_no_mentions(english) -> None:
    assert add_cues("nothing", [], english) == []


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
def test_the_side_of_a_street(lookup, english, text, side) -> None:
    (mention,) = find_mentions(text, lookup, english)
    assert mention.side == side
    assert mention.cue.wind is None, "a side is no wind"


def test_a_kind_named_again_is_the_same_thing(english) -> None:
    pairs = [("cafe", "bakery"), ("church", "school"), ("bank", "library"), ("bar", "hotel"), ("pharmacy", "cinema")]
    right = 0
    for one, other in pairs:
        text = f"There is a {one} on my left. The {other} is a block east of the {one}."
        position = [(one, text.index(one)), (other, text.index(other)), (one, text.rindex(one))]
        mentions = [Mention(words, start, start + len(words), "thing") for words, start in position]
        right += [m.start for m in add_cues(text, mentions, english)] == [start for _, start in position[:2]]
    assert right >= len(pairs) - 1, "a trained reader may stumble over a word"


def test_who_is_named_again_is_left_out_before_it_is_read(cues) -> None:
    class Credulous(English):
        def read_cues(self, text: str, mentions: Sequence[MentionSpan]) -> list[ReadCue]:
            return [ReadCue(None, (), "seen", has_wind=False, is_meant=True) for _ in mentions]

    text = "A cafe is near. A bakery is north of the cafe."
    position = [("cafe", 2), ("bakery", 18), ("cafe", text.rindex("cafe"))]
    mentions = [Mention(words, start, start + len(words), "thing") for words, start in position]
    assert [m.start for m in add_cues(text, mentions, Credulous(cues))] == [2, 18]


def test_another_of_a_kind_is_another(lookup, english) -> None:
    result = find_mentions("a bench on my left and a bench on my right", lookup, english)
    assert [m.cue.angle for m in result] == [pytest.approx(-90), pytest.approx(90)]


def test_on_top_of_is_on(lookup, english) -> None:
    [mention] = find_mentions("The pose is on-top of a gray bench.", lookup, english)
    assert mention.cue.relation == "on"


def test_each_wind_is_of_one_thing_and_not_of_another_sentence(lookup, english) -> None:
    result = find_mentions("I'm north of Bottino. Elmo is west of me.", lookup, english)
    assert {mention.text: mention.cue.wind for mention in result} == {"Bottino": 180, "Elmo": 270}


def test_a_kind_named_again_takes_no_part(lookup, english) -> None:
    result = find_mentions("Meet me at the bakery. Bottino is north of the bakery.", lookup, english)
    assert [mention.text for mention in result] == ["bakery", "Bottino"]


def test_a_distance_goes_to_what_it_stands_beside(lookup, english) -> None:
    result = find_mentions("Bottino is 30 m ahead, Elmo is behind me.", lookup, english)
    assert {mention.text: mention.cue.distance_m for mention in result} == {"Bottino": 30, "Elmo": None}


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("I'm on 25th about 30 m short of 10th.", {"25th": None, "10th": 30}),
        ("Bottino is straight ahead of me, maybe 30 m, and there's Elmo.", {"Bottino": 30, "Elmo": None}),
        ("I'm on 25th, 30 m from Bottino.", {"25th": None, "Bottino": 30}),
    ],
)
def test_a_distance_is_of_what_it_is_measured_from(lookup, english, text, metres) -> None:
    assert {mention.text: mention.cue.distance_m for mention in find_mentions(text, lookup, english)} == metres


@pytest.mark.parametrize("measure", ["20 metres", "4 km", "410 paces", "twenty-five feet"])
def test_a_measure_behind_a_street_is_no_house_number(lookup, english, measure) -> None:
    [result] = find_mentions(f"I'm on 25th Street {measure} up.", lookup, english)
    assert (result.form, result.text) == ("street", "25th Street")


def test_the_side_of_the_street_is_of_the_street_it_lies_on(lookup, english) -> None:
    text = "I'm on 25th, at a bar that I have never seen before, with a friend of mine and two dogs. Bottino is near. "
    result = find_mentions(text + "It's on the north side of the street.", lookup, english)
    assert {mention.text: mention.side for mention in result if mention.text in ("25th", "Bottino")} == {
        "25th": 0.0,
        "Bottino": None,
    }
