import pytest

from models.language.mentions.names import plain_words
from models.language.mentions.streets import full_words, street_forms


@pytest.mark.parametrize(
    ("said", "full"),
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
def test_streets_written_out(said, full) -> None:
    assert " ".join(full_words(plain_words(said))) == full


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
