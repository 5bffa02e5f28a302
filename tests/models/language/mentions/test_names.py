import pytest
from hypothesis import given
from hypothesis import strategies as st

from models.language.mentions.names import (
    full_words,
    latin_spellings,
    plain_word,
    plain_words,
    split_words,
    street_forms,
)


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


@pytest.mark.parametrize(
    ("phrase", "full"),
    [
        ("W 25th St", "west 25th street"),
        ("West Twenty-Fifth Street", "west 25th street"),
        ("10th Ave", "10th avenue"),
        ("Tenth Avenue", "10th avenue"),
        ("Park Ave S", "park avenue south"),
        ("St Marks Pl", "saint marks place"),
        ("St. Mark's Place", "saint marks place"),
        ("Hauptstr.", "hauptstrasse"),
        ("Hauptstraße", "hauptstrasse"),
        ("NW 5th Rd", "northwest 5th road"),
        ("Broadway", "broadway"),
        ("W", "w"),
    ],
)
def test_streets_written_out(phrase, full) -> None:
    assert " ".join(full_words(plain_words(phrase))) == full


@pytest.mark.parametrize(
    ("name", "forms"),
    [
        ("West 25th Street", {"west 25th street", "25th street", "25th", "west 25th"}),
        ("10th Avenue", {"10th avenue", "10th"}),
        ("Park Avenue South", {"park avenue south", "park avenue", "park south"}),
        ("Broadway", {"broadway", "bway"}),
        ("Lexington Avenue", {"lexington avenue", "lexington", "lex"}),
        ("Avenue A", {"avenue a"}),
        ("West Street", {"west street"}),
        ("The High Line", {"high line"}),
        ("Madison Square", {"madison square", "madison", "mad"}),
        ("Cours Émile Zola", {"cours emile zola", "emile zola", "zola"}),
        ("Rue du Faubourg Poissonnière", {"rue du faubourg poissonniere", "faubourg poissonniere", "poissonniere"}),
        ("Đường Nguyễn Văn Mai", {"duong nguyen van mai", "nguyen van mai"}),
        ("!!!", {""}),
    ],
)
def test_forms(name, forms) -> None:
    assert {" ".join(form) for form, _ in street_forms(name)} == forms


def test_the_whole_name_is_the_surest_form() -> None:
    weights = dict(street_forms("West 25th Street"))
    assert weights[("west", "25th", "street")] == 1.0
    assert all(0 < weight < 1 for form, weight in weights.items() if form != ("west", "25th", "street"))


def test_all_spellings_of_a_name_have_the_same_forms() -> None:
    assert len({tuple(street_forms(name)) for name in ("West 25th Street", "W. 25th St.", "west twenty-fifth st")}) == 1


def test_a_german_street_goes_without_its_kind() -> None:
    assert ("karl", "liebknecht") in dict(street_forms("Karl-Liebknecht-Straße"))
    assert ("karl", "liebknecht", "strasse") in dict(street_forms("Karl-Liebknecht-Straße"))


@pytest.mark.parametrize(
    ("name", "spellings"),
    [
        ("Потаповский переулок", {"potapovskiy pereulok", "potapovsky pereulok", "potapovsky lane", "potapovsky"}),
        ("улица Покровка", {"ulitsa pokrovka", "pokrovka street", "pokrovka", "покровка"}),
        ("Ερμού", {"ermou", "ermoy"}),
        ("Kuzu Kestane Sokak", {"kuzu kestane"}),
        ("شارع عباس العقاد", {"عباس العقاد"}),
    ],
)
def test_latin_spellings_and_bare_names_of_streets(name, spellings) -> None:
    assert {" ".join(form) for form, _ in street_forms(name)} >= spellings


def test_a_latin_name_has_no_other_spelling() -> None:
    assert latin_spellings("Łódź") == latin_spellings("北京") == ()
