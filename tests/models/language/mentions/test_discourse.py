import pytest

from models.language.mentions.discourse import PAST_TRUST
from models.language.mentions.reader import find_mentions


@pytest.mark.parametrize(
    "text",
    [
        "I'm at Bottino, no wait, Cafe Zoe",
        "I'm at Bottino. Sorry, I mean Cafe Zoe",
        "next to Bottino, scratch that, Cafe Zoe",
        "outside Bottino - actually it's Cafe Zoe",
    ],
)
def test_what_is_taken_back_is_no_mention(lookup, english, text) -> None:
    assert [mention.text for mention in find_mentions(text, lookup, english)] == ["Cafe Zoe"]


def test_a_corner_is_taken_back_whole(lookup, english) -> None:
    text = "corner of 25th and 9th, sorry, I mean 25th and 10th"
    assert [mention.text for mention in find_mentions(text, lookup, english)] == ["25th and 10th"]


@pytest.mark.parametrize("word", ["actually", "sorry", "I mean"])
def test_a_word_of_courtesy_takes_nothing_back(lookup, english, word) -> None:
    (mention,) = find_mentions(f"{word}, I'm next to Bottino", lookup, english)
    assert mention.text == "Bottino"


@pytest.mark.parametrize(
    "words", ["not near", "nowhere near", "away from", "not at", "not the one next to", "we are not at"]
)
def test_what_is_denied_counts_against(lookup, english, words) -> None:
    one, other = find_mentions(f"{words} Bottino, but outside Cafe Zoe", lookup, english)
    assert (one.text, one.is_denied, other.is_denied) == ("Bottino", True, False)


@pytest.mark.parametrize(
    "text",
    [
        "I walked past Bottino and now I'm at Cafe Zoe",
        "I just passed Bottino. I'm outside Cafe Zoe",
    ],
)
def test_the_past_weighs_little(lookup, english, text) -> None:
    one, other = find_mentions(text, lookup, english)
    assert one.trust == pytest.approx(PAST_TRUST)
    assert other.trust == 1.0


def test_a_past_without_a_present_weighs_all(lookup, english) -> None:
    (mention,) = find_mentions("I just passed Bottino", lookup, english)
    assert mention.trust == 1.0
