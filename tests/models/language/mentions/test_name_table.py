import pytest

from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER
from models.citymap.kinds.vocabulary import load_vocabulary
from models.errors import IndexBroken
from models.language.mentions.lookup import Lookup
from models.language.mentions.name_table import FILE, NameTable
from models.language.mentions.names import plain_words
from tests.models.citymap.gazetteer.made_town import is_common

PHRASES = (
    "Cafe Zoe", "london terrace", "whole foods", "10th avenue", "w 25th st", "25th", "tenth ave", "harlem", "nobody",
    "Пушкин", "botino", "",
)  # fmt: skip


@pytest.fixture
def opened(town, tmp_path) -> Lookup:
    NameTable.from_gazetteer(town, load_vocabulary(), is_common).save(tmp_path)
    return Lookup(town, load_vocabulary(), is_common, NameTable.load(tmp_path))


def result(match):
    return match and (match.objects.tolist(), match.weights.tolist(), match.trust, match.is_exact)


@pytest.mark.parametrize("phrase", PHRASES)
def test_an_opened_table_finds_what_a_made_one_finds(lookup, opened, phrase) -> None:
    words = plain_words(phrase)
    for ask in ("named", "street", "is_name"):
        was, now = getattr(lookup, ask)(words), getattr(opened, ask)(words)
        assert was == now if ask == "is_name" else result(was) == result(now)
    if words:
        assert result(lookup.misspelt(words)) == result(opened.misspelt(words))
        assert [lookup.word_weight(word) for word in words] == [opened.word_weight(word) for word in words]
        assert [lookup.is_strange(word) for word in words] == [opened.is_strange(word) for word in words]


def test_house_numbers_are_found_of_an_opened_table(lookup, opened) -> None:
    streets = lookup.street(plain_words("West 25th Street")).objects
    for number in ("402", "406", "9999"):
        was, now = lookup.address(number, streets), opened.address(number, streets)
        assert (was is None) == (now is None) == (number == "9999")
        if was is not None:
            assert was.objects.tolist() == now.objects.tolist()
            assert was.lines_m.tolist() == now.lines_m.tolist()
    assert len(opened.address("402", streets).objects)


def test_the_phrases_are_the_same(lookup, opened) -> None:
    assert lookup.phrases() == opened.phrases() != []


def test_a_table_of_nothing(tmp_path) -> None:
    NameTable.from_gazetteer(EMPTY_GAZETTEER, load_vocabulary(), is_common).save(tmp_path)
    nothing = Lookup(EMPTY_GAZETTEER, load_vocabulary(), is_common, NameTable.load(tmp_path))
    assert nothing.named(("a",)) is None
    assert nothing.street(("a",)) is None


@pytest.mark.parametrize("content", [None, b"", b"{}"])
def test_a_missing_or_broken_file_is_refused(tmp_path, content) -> None:
    if content is not None:
        (tmp_path / FILE).write_bytes(content)
    with pytest.raises(IndexBroken, match="hereabouts index"):
        NameTable.load(tmp_path)
