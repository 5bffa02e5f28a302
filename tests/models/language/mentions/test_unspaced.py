from models.language.mentions.names import split_words
from models.language.mentions.unspaced import split_unspaced, unspaced_words

KNOWN = [unspaced_words(["藝術街", "藝術", "銀行", "bank"])]


def split(text: str) -> list[str]:
    words = list(split_unspaced(split_words(text), KNOWN))
    assert [text[word.start : word.end] for word in words] == [word.plain for word in words]
    return [word.plain for word in words]


def test_long_words_are_preferred() -> None:
    assert split("我在藝術街的銀行") == ["我在", "藝術街", "的", "銀行"]


def test_words_between_spaces_stay() -> None:
    assert split("the bank 藝術") == ["the", "bank", "藝術"]
