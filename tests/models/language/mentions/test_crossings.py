import numpy as np
import pytest

from models.language.mentions.mentions import Mention
from models.language.mentions.reader import find_mentions
from tests.models.citymap.gazetteer.made_town import called


def of_form(text: str, lookup, english, form: str) -> Mention:
    (mention,) = [m for m in find_mentions(text, lookup, english) if m.form == form]
    return mention


@pytest.mark.parametrize(
    ("text", "position"),
    [
        ("I'm at 25th and 10th.", (200, 80)),
        ("10th Ave at West 25th", (200, 80)),
        ("10th Ave & 26th St", (200, 160)),
        ("at the corner of W 24th St and Ninth Avenue", (400, 0)),
        ("where 25th street meets 11th avenue", (0, 80)),
        ("im on twenty fourth and eleventh", (0, 0)),
        ("I stand on 25th street at the corner of 9th", (400, 80)),
    ],
)
def test_corners(lookup, english, text, position) -> None:
    corner = of_form(text, lookup, english, "corner")
    assert corner.lines_m.tolist() == [[*position, *position]]
    assert corner.weights.shape == (1,)
    assert corner.cue.relation == "at"
    assert corner.is_exact
    assert text[corner.start : corner.end] == corner.text


def test_a_slash_joins_streets(lookup, english) -> None:
    assert of_form("on the corner of 26th/9th", lookup, english, "corner").lines_m.tolist() == [[400, 160, 400, 160]]


def test_streets_that_never_meet_stay_streets(town, lookup, english) -> None:
    result = find_mentions("Harlem Road and 25th Street", lookup, english)
    assert sorted(m.form for m in result) == ["street", "street", "unknown"], "that they meet is not found"
    streets = [called(town, m.objects) for m in result if m.form == "street"]
    assert streets == [{"Harlem Road"}, {"West 25th Street"}]


def test_streets_in_two_sentences_are_no_corner(lookup, english) -> None:
    result = find_mentions("I am on 25th Street. There is a bench. I came from 10th Avenue.", lookup, english)
    assert [m.form for m in result] == ["street", "thing", "street"]


def test_near_a_corner_is_on_the_street_too(lookup, english) -> None:
    result = find_mentions("on 25th just past 10th", lookup, english)
    assert sorted(m.form for m in result) == ["corner", "street"]
    assert next(m for m in result if m.form == "corner").cue.relation == "near"


@pytest.mark.parametrize(
    "text",
    [
        "on 25th between 9th and 10th",
        "on West 25th Street between the 10th and 9th avenue",
        "im on twenty fifth btwn ninth & tenth",
        "between 9th and 10th on 25th street",
    ],
)
def test_spans_between_two_streets(town, lookup, english, text) -> None:
    span = of_form(text, lookup, english, "span")
    ends = sorted(tuple(end) for end in span.lines_m.reshape(-1, 2).tolist())
    assert ends == [(200, 80), (400, 80)]
    assert span.cue.relation == "on"
    assert called(town, of_form(text, lookup, english, "street").objects) == {"West 25th Street"}


def test_a_span_of_no_said_street_is_of_any(lookup, english) -> None:
    span = of_form("I'm between 9th and 10th", lookup, english, "span")
    assert {tuple(line[1::2]) for line in span.lines_m.tolist()} == {(0, 0), (80, 80), (160, 160)}
    assert len(span.weights) == 3


def test_between_two_streets_that_share_no_street_is_no_span(lookup, english) -> None:
    result = find_mentions("between Harlem Road and 10th", lookup, english)
    assert "span" not in [m.form for m in result]


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("at 410 West 25th Street", "410"),
        ("402 W 25th St", "402"),
        ("number 449 25th street", "449"),
        ("West 25th Street 401", "401"),
    ],
)
def test_addresses(town, lookup, english, text, number) -> None:
    address = of_form(text, lookup, english, "address")
    assert called(town, address.objects) == {number}
    assert address.is_exact
    assert text[address.start : address.end] == address.text


def test_an_address_between_two(lookup, english) -> None:
    address = of_form("at 430 W 25th St", lookup, english, "address")
    assert not len(address.objects)
    assert address.lines_m == pytest.approx(np.array([[300, 95, 300, 95]]))
    assert not address.is_exact
    assert len(address.weights) == 1


def test_a_number_past_the_end_leaves_the_street_and_is_told_of(town, lookup, english) -> None:
    address, street = find_mentions("at 900 West 25th Street", lookup, english)
    assert (address.form, address.text) == ("unknown", "900 West 25th Street")
    assert street.form == "street"
    assert called(town, street.objects) == {"West 25th Street"}


def test_a_number_behind_a_street_may_end_the_sentence(town, lookup, english) -> None:
    address = of_form("I'm at West 25th Street 402. Help.", lookup, english, "address")
    assert called(town, address.objects) == {"402"}
    assert [m.form for m in find_mentions("I'm at West 25th Street 999.", lookup, english)] == ["street", "unknown"]
    assert [m.form for m in find_mentions("I'm at West 25th Street 2.5 km off", lookup, english)] == ["street"]


@pytest.mark.parametrize(
    "text", ["on 25th street 50 m from here", "on 25th street 2 blocks away", "25th Street, 30 feet ahead"]
)
def test_a_distance_behind_a_street_is_no_house_number(lookup, english, text) -> None:
    assert [m.form for m in find_mentions(text, lookup, english)] == ["street"]
