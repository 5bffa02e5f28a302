import pytest

from models.language.mentions.reader import find_mentions


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("at Pasila bakery", "Pasila bakery"),
        ("Kallio bakery", "Kallio bakery"),
        ("next to the Astoria Bakery", "Astoria Bakery"),
        ("im at kallio bakery", "kallio bakery"),
        ("National Bakery", "National Bakery"),
    ],
)
def test_a_kind_with_a_name_that_the_map_lacks_is_one_mention(lookup, english, text, words) -> None:
    (mention,) = find_mentions(text, lookup, english)
    assert (mention.text, mention.lacks_name, mention.is_unknown) == (words, True, True)
    assert mention.trust < 0.5


@pytest.mark.parametrize(
    "text", ["Rossi Bakery", "the bakery, Rossi", "next to a bakery", "A bakery is behind me", "Bottino"]
)
def test_a_known_name_or_a_mere_kind_lacks_none(lookup, english, text) -> None:
    assert not any(mention.is_unknown for mention in find_mentions(text, lookup, english))
