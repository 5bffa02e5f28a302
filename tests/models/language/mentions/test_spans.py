from itertools import pairwise

import pytest

from models.language.mentions.spans import correct_noun, find_spans
from tests.models.citymap.gazetteer.made_town import called


def spans(text: str, lookup, english) -> list[tuple[str, str]]:
    """(form, words) of what is found."""
    words, result = find_spans(text, lookup, english)
    return [(span.form, text[words[span.first].start : words[span.last].end]) for span in result]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("Bottino", [("thing", "Bottino")]),
        ("by the Café Zoë now", [("thing", "Café Zoë")]),
        ("by cafe zoe now", [("thing", "cafe zoe")]),
        ("near london terrace gardens", [("thing", "london terrace gardens")]),
        ("near Bottino, Elmo and T-Optik", [("thing", "Bottino"), ("thing", "Elmo"), ("thing", "T-Optik")]),
        ("bottino elmo", [("thing", "bottino"), ("thing", "elmo")]),
        ("walking on 25th now", [("street", "25th")]),
        ("on W 25th St", [("street", "W 25th St")]),
        ("on twenty-fifth street", [("street", "twenty-fifth street")]),
        ("Harlem Road", [("street", "Harlem Road")]),
        ("the 10th floor", []),
        ("the 10th time", []),
        ("the second one", []),
        ("the bakery and a bench", [("thing", "bakery"), ("thing", "bench")]),
        ("the bakary", [("thing", "bakary")]),
        ("near the Blarney Stone", [("unknown", "Blarney Stone")]),
        ("the street, the corner, the block", []),
        ("!!!1", []),
        ("", []),
        ("😀 \n\t", []),
        ("in front of me on my left", []),
        ("Кафе Пушкин", [("thing", "Кафе Пушкин")]),
        ("near 北京饭店", [("thing", "北京饭店")]),
    ],
)
def test_what_is_found(lookup, english, text, expected) -> None:
    assert spans(text, lookup, english) == expected


def test_a_measure_is_no_street(lookup, english) -> None:
    assert spans("Bottino is nearly twenty-five metres ahead", lookup, english) == [("thing", "Bottino")]
    assert ("street", "twenty fifth") in spans("Bottino is nearly at twenty fifth", lookup, english)


@pytest.mark.parametrize("text", ["402 W 25th", "Bottino, W 25th", "the bakery W 25th"])
def test_a_wind_before_an_ordinal_tells_of_a_street(lookup, english, text) -> None:
    assert "street" in [form for form, _ in spans(text, lookup, english)]


def test_the_name_is_taken_and_not_the_kind_in_it(town, lookup, english) -> None:
    _, (span,) = find_spans("by Rossi Bakery", lookup, english)
    assert called(town, span.match.objects) == {"Rossi Bakery"}
    assert span.match.is_exact


def test_a_name_and_its_kind_are_one_thing(town, lookup, english) -> None:
    for text in (
        "the T-Optik optician",
        "the optician, T-Optik",
        "an optician called T-Optik",
        "T-Optik, the optician",
    ):
        _, (span,) = find_spans(text, lookup, english)
        assert called(town, span.match.objects) == {"T-Optik"}
        assert "shop/optician" in span.kinds


def test_a_name_across_a_full_stop_is_none(lookup, english) -> None:
    assert ("thing", "London. Terrace Gardens") not in spans("In London. Terrace Gardens", lookup, english)


def test_spans_are_in_order_and_apart(lookup, english) -> None:
    words, result = find_spans(
        "Elmo on W 25th St near Joe's Coffee, the cafe at 10th Ave and 26th, Chelsea Park bench, Nowhere Inn",
        lookup,
        english,
    )
    assert len(result) >= 7
    assert all(one.last < other.first for one, other in pairwise(result))
    assert result[-1].last < len(words)


@pytest.mark.parametrize(
    ("wrong", "right"), [("bakary", "bakery"), ("resturant", "restaurant"), ("bottino", "bottino"), ("caf", "caf")]
)
def test_misspelt_nouns(lookup, wrong, right) -> None:
    assert correct_noun(wrong, lookup) == right


@pytest.mark.parametrize(("wrong", "right"), [("hotell", "hotel"), ("watter", "water")])
def test_of_nouns_that_are_as_like_the_shortest_is_meant_in_every_process(lookup, wrong, right) -> None:
    assert correct_noun(wrong, lookup) == right
    nouns = list(lookup.noun_words)  # not in the order of a set, which is another one in each process
    assert nouns == sorted(nouns, key=lambda noun: (len(noun), noun))


@pytest.mark.parametrize(
    ("text", "result"),
    [
        ("10th is on my left", True), ("I see 9th's lights", True), ("the 10th is on my left", False),
        ("by the crossing", False), ("across the crossing", False),
    ],
)  # fmt: skip
def test_an_ordinal_that_is_told_of_is_a_street(lookup, english, text, result) -> None:
    assert ("street" in [form for form, _ in spans(text, lookup, english)]) is result
