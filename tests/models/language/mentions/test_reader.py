from itertools import pairwise

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER, build_gazetteer
from models.citymap.gazetteer.name_columns import GazetteerObject
from models.citymap.kinds.vocabulary import load_vocabulary
from models.language.mentions.lookup import Lookup
from models.language.mentions.reader import MAX_OBJECTS, find_mentions, is_meeting, listener_wind, mark_goal
from tests.models.citymap.gazetteer.made_town import called, is_common, point

LETTERS = st.text(st.sampled_from("25th 10ave on&W st.,/'!éßⅣ²፩ﾞ٣京\u0308\u200dI"), max_size=25)


def test_a_whole_text(town, lookup, english) -> None:
    text = "Hi, I'm on 25th between 9th and 10th. Bottino is across the street, Whole Foods is 50 m ahead on my left."
    result = find_mentions(text, lookup, english)
    assert [(m.form, m.cue.relation) for m in result[1:]] == [("span", "on"), ("thing", "across"), ("thing", "seen")]
    assert called(town, result[3].objects) == {"Whole Foods Market"}
    assert result[3].cue.distance_m == 50
    assert result[3].cue.angle == pytest.approx(-45)
    assert [text[m.start : m.end] for m in result] == [m.text for m in result]


def test_dictation_without_punctuation(town, lookup, english) -> None:
    text = "im on twenty fifth street cafe zoe is on my left and the bakery is behind me hurry please"
    street, cafe, bakery = find_mentions(text, lookup, english)
    assert called(town, street.objects) == {"West 25th Street"}
    assert called(town, cafe.objects) == {"Café Zoë"}
    assert cafe.cue.angle == pytest.approx(-90)
    assert called(town, bakery.objects) == {"Rossi Bakery"}
    assert bakery.cue.angle == pytest.approx(180)


def test_a_street_that_is_crossed_is_not_what_lies_across(lookup, english) -> None:
    thing, street = find_mentions("Bottino is across 10th Avenue", lookup, english)
    assert (thing.form, thing.cue.relation) == ("thing", "across")
    assert (street.form, street.cue.relation) == ("street", "seen")


def test_names_that_the_map_lacks_are_unknown(lookup, english) -> None:
    (mention,) = find_mentions("next to the Blarney Stone", lookup, english)
    assert mention.form == "unknown"
    assert not len(mention.objects)
    assert not len(mention.lines_m)
    assert mention.text == "Blarney Stone"


@pytest.mark.parametrize(
    "hello",
    ["This is Ruth.", "Hi, it's Leo.", "Hey Margaret,", "Nuala here,", "Hello, Marta here,", "My name is Yusuf."],
)
def test_who_speaks_is_no_place(lookup, english, hello) -> None:
    assert [m.text for m in find_mentions(f"{hello} I'm at 25th and 10th.", lookup, english)] == ["25th and 10th"]


def test_an_unknown_name_is_told_of(lookup, english) -> None:
    assert [
        m.text for m in find_mentions("I'm outside Zanzibar Moon Palace and Elmo is on my left", lookup, english)
    ] == [
        "Zanzibar Moon Palace",
        "Elmo",
    ]
    assert [m.text for m in find_mentions("This is Zanzibar Moon Palace.", lookup, english)] == ["Zanzibar Moon Palace"]


def test_a_kind_that_the_map_lacks_is_unknown(lookup, english) -> None:
    (mention,) = find_mentions("by the lighthouse", lookup, english)
    assert mention.form == "unknown"
    assert mention.kinds


@pytest.mark.parametrize("text", ["", " ", "!!!1", "...", "😀", "1", "5", "on", "\n\n", "the the the", "@", "&"])
def test_texts_that_say_nothing(lookup, english, text) -> None:
    assert find_mentions(text, lookup, english) == []
    assert listener_wind(text) is None
    assert not is_meeting(text)


@pytest.mark.parametrize(
    ("text", "name"),
    [("Рядом с Кафе Пушкин", "Кафе Пушкин"), ("北京饭店", "北京饭店"), ("I'm at 北京饭店", "北京饭店")],  # noqa: RUF001
)
def test_other_scripts(town, lookup, english, text, name) -> None:
    (mention,) = find_mentions(text, lookup, english)
    assert called(town, mention.objects) == {name}


def test_a_long_text(lookup, english) -> None:
    text = ("I'm on 25th between 9th and 10th, Bottino is on my left and the Blarney Stone behind me. " * 60)[:4000]
    result = find_mentions(text, lookup, english)
    assert sum(m.form == "span" for m in result) >= 1
    assert all(a.start <= b.start for a, b in pairwise(result))
    assert len(find_mentions("x" * 4000, lookup, english)) <= 1
    assert find_mentions("a " * 2000, lookup, english) == []


@pytest.mark.parametrize("text", ["፩ street", "on ፩ Ave", "ﾞ", "Bottino ﾞ"])
def test_odd_letters_do_no_harm(lookup, english, text) -> None:
    find_mentions(text, lookup, english)


@settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.one_of(st.text(max_size=40), LETTERS))
def test_any_text_can_be_read(lookup, english, text) -> None:
    for mention in find_mentions(text, lookup, english):
        assert 0 <= mention.start < mention.end <= len(text)
        assert len(mention.weights) == len(mention.objects) + len(mention.lines_m)
        assert np.isfinite(mention.weights).all()


def test_a_map_without_names(lookup, english) -> None:
    bare = Lookup(EMPTY_GAZETTEER, load_vocabulary(), is_common)
    result = find_mentions(
        "I'm at 25th and 10th, Bottino on my left, a bench behind me, at 5 Main Street", bare, english
    )
    assert all(not len(m.objects) and not len(m.lines_m) for m in result)
    assert all(m.form == "unknown" for m in result)


def test_what_so_many_things_may_be_is_left_out(english) -> None:
    count = MAX_OBJECTS + 1
    town = build_gazetteer([GazetteerObject(("amenity/bench",))] * count, [point(0, 0)] * count, [False] * count)
    assert find_mentions("a bench", Lookup(town, load_vocabulary(), is_common), english) == []


@pytest.mark.parametrize(
    "text",
    [
        "Meet me at the cafe",
        "Meet me by the cafe",
        "let's meet in front of the cafe",
        "Meet me, the cafe, near Bottino",
    ],
)
def test_the_goal_of_a_meeting(town, lookup, english, text) -> None:
    assert is_meeting(text)
    first = mark_goal(find_mentions(text, lookup, english))[0]
    assert first.text == "cafe"
    assert first.cue.relation == "at"
    assert first.cue.angle is None


def test_what_is_said_to_be_elsewhere_is_no_goal(lookup, english) -> None:
    text = "Meet me across from the cafe, two blocks north of Bottino, by the bakery"
    relations = [(m.text, m.cue.relation) for m in mark_goal(find_mentions(text, lookup, english))]
    assert relations == [("cafe", "across"), ("Bottino", "wind"), ("bakery", "at")]


def test_a_goal_that_is_said_is_kept(lookup, english) -> None:
    mentions = find_mentions("Near Bottino, meet me at the cafe", lookup, english)
    assert [m.cue.relation for m in mark_goal(mentions)] == [m.cue.relation for m in mentions] == ["near", "at"]
    assert mark_goal([]) == []


@pytest.mark.parametrize(
    ("text", "degrees"),
    [
        ("I am north of you", 0),
        ("The cafe is to the south-west of you", 225),
        ("it's slightly northeast of where you are", 45),
        ("a bit east of your location", 90),
        ("Head southwest, then stop at the cafe", 225),
        ("Go straight north for two blocks", 0),
        ("please walk west", 270),
        ("I'm to your south", 180),
        ("north of Bottino", None),
        ("the cafe is north of me", None),
        ("Bottino heads south", None),
    ],
)
def test_where_the_listener_is_to_look(text, degrees) -> None:
    assert listener_wind(text) == degrees


@pytest.mark.parametrize("text", ["I'm at Bottino, two blocks north of you.", "I'm 300 m to your west, at Bottino."])
def test_a_measure_from_the_listener_is_not_one_from_the_speaker(lookup, english, text) -> None:
    (mention,) = find_mentions(text, lookup, english)
    assert (mention.cue.measure, mention.cue.wind) == (None, None)


def test_the_wind_from_the_listener_is_not_one_from_the_speaker(lookup, english) -> None:
    (mention,) = find_mentions("I'm at Bottino, north of you", lookup, english)
    assert mention.cue.wind is None
    assert mention.cue.relation == "at"


@pytest.mark.parametrize("text", ["There is no bakery here.", "I can't see the bakery"])
def test_what_is_not_there_is_no_mention(lookup, english, text) -> None:
    assert find_mentions(text, lookup, english) == []


def test_what_is_told_of_again_has_what_is_said_then(lookup, english) -> None:
    first, *again = find_mentions("I'm next to a bakery in the rain. The bakery's on my left.", lookup, english)
    assert (first.text, first.cue.relation) == ("bakery", "beside")
    assert {mention.cue.angle for mention in (first, *again)} == {-90}


@pytest.mark.parametrize(
    ("text", "angle", "things"),
    [
        ("the bakery and the optician on my left", -90, 2),
        ("the bakery is on my right, with an optician", 90, 2),
        ("the optician, the old one, is behind me and nothing else", 180, 1),
    ],
)
def test_things_of_a_list_share_where_they_are(lookup, english, text, angle, things) -> None:
    assert [mention.cue.angle for mention in find_mentions(text, lookup, english)] == pytest.approx([angle] * things)


def test_a_kind_right_after_a_name_tells_where_it_is(town, lookup, english) -> None:
    result = find_mentions("I'm outside Rossi Bakery, bakery's on my right hand.", lookup, english)
    assert result[0].is_exact
    assert result[0].cue.relation == "outside"
    assert all(called(town, mention.objects) == {"Rossi Bakery"} for mention in result)
    assert 90 in {mention.cue.angle for mention in result}


def test_a_noun_with_a_hyphen_is_found(lookup, english) -> None:
    [mention] = find_mentions("I'm next to the u-bahn", lookup, english)
    assert any("subway" in kind for kind in mention.kinds)


@pytest.mark.parametrize(
    ("text", "street"),
    [
        ("I'm at 25th and 10th, the avenue is behind me.", "10th Avenue"),
        ("I'm at 10th and 25th, the avenue is behind me.", "10th Avenue"),
        ("I'm on 25th, Bottino on my left, and the street is at my back.", "West 25th Street"),
    ],
)
def test_a_street_named_by_its_kind_alone_is_the_last_such(town, lookup, english, text, street) -> None:
    again = [mention for mention in find_mentions(text, lookup, english) if mention.text in ("avenue", "street")]
    assert [called(town, mention.objects) for mention in again] == [{street}]
    assert again[0].cue.angle == 180


@pytest.mark.parametrize("text", ["Bottino is across the street.", "I walk down the street to Bottino."])
def test_the_street_of_across_the_street_is_none(lookup, english, text) -> None:
    assert [mention.text for mention in find_mentions(text, lookup, english)] == ["Bottino"]


def test_the_east_of_a_street_is_no_wind(lookup, english) -> None:
    result = find_mentions("Bottino is north of me on West 25th Street", lookup, english)
    assert {mention.text: mention.cue.wind for mention in result} == {"Bottino": 0, "West 25th Street": None}
