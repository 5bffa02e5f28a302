"""The language of an answer's texts, on the tiny town."""

import pytest

from index.answering.query import Query

STREET = "I'm at the corner of East Street 2 and North Path 3"
WORDS = "I'm on East Street 2, at ///filled.count.soap"


def answer(localizer, text: str, language: str | None = None):
    [result] = localizer.localize([Query(text, language=language)])
    return result


def test_english_texts_get_english_answers(localizer) -> None:
    result = answer(localizer, STREET)
    assert result.language == "en"
    assert result.estimate.place.startswith("at the corner of ")


@pytest.mark.parametrize(
    ("text", "code", "place"),
    [
        ("Olen katujen East Street 2 ja North Path 3 kulmassa", "fi", "katujen "),
        ("Ich stehe an der Ecke East Street 2 und North Path 3", "de", "an der Ecke "),
    ],
)
def test_answers_are_in_the_language_of_the_text(localizer, text, code, place) -> None:
    result = answer(localizer, text)
    assert result.language == code
    assert result.estimate.place.startswith(place)


def test_a_preferred_language_wins_and_changes_texts_only(localizer) -> None:
    english, finnish = answer(localizer, STREET), answer(localizer, STREET, "fi")
    assert finnish.language == "fi"
    assert finnish.estimate.position == english.estimate.position
    assert finnish.estimate.place.startswith("katujen ")
    assert [one.relation for one in finnish.evidence] == [one.relation for one in english.evidence]


def test_no_text_is_remembered_in_another_language(localizer) -> None:
    warnings = [answer(localizer, WORDS, code).warnings for code in ("en", "fi", "sv", "en")]
    assert [one[0].split("soap")[1][:12] for one in warnings] == [
        "' is a three",
        "” on kolmen ",
        "” är en treo",
        "' is a three",
    ]
    assert answer(localizer, "Hello there", "de").warnings[0].startswith("die Beschreibung sagt nicht")


def test_descriptions_of_positions_stay_english(localizer) -> None:
    answer(localizer, STREET, "fi")
    assert localizer.describe((0.0, 0.0)).description.startswith("East Street 2 is 30 m to my south.")
