import pytest

from models.language.languages.english import English
from models.language.mentions.languages import detect_language
from models.language.mentions.lookup import Lookup
from models.language.mentions.reader import find_mentions


@pytest.mark.parametrize(
    ("text", "language"),
    [
        ("I'm on Mannerheimintie next to the Sokos, the tram stop is ahead", "en"),
        ("Uudenmaankatu, Diana Park hostel", "en"),
        ("12345", "en"),
        ("Ich stehe vor der Apotheke neben dem Alexanderplatz", "de"),
        ("Olen Mannerheimintiellä Sokoksen vieressä, kahvila on edessäni", "fi"),
        ("je suis devant la boulangerie au coin de la rue", "fr"),
        ("Я стою рядом с аптекой на Бродвее", "ru"),  # noqa: RUF001
    ],
)
def test_another_language_is_told_where_it_is_sure(text, language) -> None:
    assert detect_language(text) == language


def test_another_language_gives_names_and_nouns_without_directions(lookup: Lookup, english: English) -> None:
    german = "Ich stehe vor der Apotheke, links ist die Bäckerei"
    mentions = find_mentions(german, lookup, english, detect_language(german))
    assert {kind for mention in mentions for kind in mention.kinds} >= {"amenity/pharmacy", "shop/bakery"}
    assert all(mention.cue.angle is None for mention in mentions)


def test_a_foreign_noun_in_an_english_text_is_a_kind(lookup: Lookup, english: English) -> None:
    [mention] = find_mentions("I am next to the Kahvila.", lookup, english)
    assert "amenity/cafe" in mention.kinds
    assert mention.cue.relation == "beside"
