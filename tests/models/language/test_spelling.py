import pytest

from models.language.spelling import Spelling


@pytest.fixture(scope="module")
def spelling(text_encoder):
    known = ["traffic light", "street cabinet", "sidewalk", "telephone booth", "wall", "vegetation"]
    return Spelling(known, text_encoder.pieces, lambda part: len(text_encoder.pieces(part)) == 1)


@pytest.mark.parametrize(
    ("phrase", "meant"),
    [
        ("trafic light", "traffic light"),
        ("teelphone booth", "telephone booth"),
        ("street cabniet", "street cabinet"),
        ("sidwalk", "sidewalk"),
        ("sidewall", "sidewall"),  # two words in one
        ("station", "station"),  # another word
        ("wal", "wal"),  # too short to tell
        ("xylophonist", "xylophonist"),
    ],
)
def test_what_is_no_word_is_mended(spelling, phrase, meant):
    assert spelling.correct(phrase) == meant
