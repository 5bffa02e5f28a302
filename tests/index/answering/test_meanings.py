import pytest

from index.answering.meanings import PHRASES_FILE, VECTORS_FILE, Meanings, embed_phrases
from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER, build_gazetteer
from models.citymap.gazetteer.name_columns import GazetteerObject
from models.citymap.kinds.vocabulary import load_vocabulary
from models.errors import IndexBroken
from models.language.languages.english import English
from models.language.mentions.lookup import Lookup
from models.language.mentions.paraphrases import PARAPHRASE_TRUST
from models.language.mentions.reader import find_mentions
from models.posterior.model import load_posterior
from tests.models.citymap.gazetteer.made_town import is_common, point

THINGS = {
    ("shop/baby_goods", "shop"): (),
    ("building",): ("City Art Museum",),
    ("amenity/cafe",): ("Old Mill",),
    ("amenity/bar",): ("Baby Goods Shop",),
}


@pytest.fixture(scope="module")
def lookup() -> Lookup:
    words = [GazetteerObject(kinds, names) for kinds, names in THINGS.items()]
    gazetteer = build_gazetteer(words, [point(100.0 * n, 0.0) for n in range(len(words))], [False] * len(words))
    return Lookup(gazetteer, load_vocabulary(), is_common)


def made(lookup, text_encoder) -> Meanings:
    return Meanings.from_vectors(*embed_phrases(lookup.phrases(), text_encoder.embed), text_encoder.embed)


@pytest.fixture(scope="module")
def meanings(lookup, text_encoder) -> Meanings:
    return made(lookup, text_encoder)


@pytest.fixture(scope="module")
def english() -> English:
    return English(load_posterior().cues)


def read(text, noun, lookup, meanings, english):
    start = text.index(noun)
    return find_mentions(text, lookup, english, nouns=[(start, start + len(noun))], find_paraphrase=meanings.like)


@pytest.mark.parametrize(("noun", "thing"), [("baby shop", 0), ("municipal art museum", 1)])
def test_paraphrases_of_nouns_and_names_are_understood(lookup, meanings, english, noun, thing) -> None:
    text = f"I'm right outside the {noun}, it's on my left"
    [mention] = read(text, noun, lookup, meanings, english)
    assert mention.objects.tolist() == [thing]
    assert (mention.text, mention.form, mention.is_exact) == (noun, "thing", False)
    assert mention.trust == PARAPHRASE_TRUST, "less sure than what was said"
    assert not any(len(m.objects) for m in find_mentions(text, lookup, english)), "neither is in the words"


def test_shops_are_found_without_being_told_of(lookup, meanings, english) -> None:
    text = "in front of the baby shop"
    [mention] = find_mentions(text, lookup, english, find_paraphrase=meanings.like)
    assert (mention.text, mention.objects.tolist()) == ("baby shop", [0])
    assert not any(len(m.objects) for m in find_mentions(text, lookup, english))


@pytest.mark.parametrize("noun", ["purple elephant", "padel place", "town hall", "the shop"])
def test_what_means_nothing_of_the_map_is_left_alone(lookup, meanings, english, noun) -> None:
    text = f"I'm right outside {noun}, it's on my left"
    assert not any(len(mention.objects) for mention in read(text, noun, lookup, meanings, english))


def test_what_is_said_in_a_name_is_not_read_twice(lookup, meanings, english) -> None:
    text = "I'm outside the Old Mill baby shop"
    mentions = read(text, "Old Mill baby shop", lookup, meanings, english)
    assert [mention.text for mention in mentions] == [m.text for m in find_mentions(text, lookup, english)]


def test_what_has_a_name_is_not_taken_for_another(lookup, english) -> None:
    text = "I'm outside the Old Mill"
    [mention] = find_mentions(
        text, lookup, english, nouns=[(16, 24)], find_paraphrase=lambda _: ("baby", "goods", "shop")
    )
    assert mention.objects.tolist() == [2]


def test_meanings_are_saved_and_read_back(lookup, meanings, text_encoder, tmp_path) -> None:
    meanings.save(tmp_path)
    again = Meanings.load(tmp_path, text_encoder.embed)
    assert again.like("the baby shop") == meanings.like("the baby shop") is not None
    (tmp_path / PHRASES_FILE).write_text("[]")
    with pytest.raises(IndexBroken, match="do not match; rebuild"):
        Meanings.load(tmp_path, text_encoder.embed)
    (tmp_path / VECTORS_FILE).write_bytes(b"no index")
    with pytest.raises(IndexBroken, match="cannot be read; rebuild"):
        Meanings.load(tmp_path, text_encoder.embed)


def test_what_is_said_again_is_not_embedded_again(meanings, text_encoder, tmp_path) -> None:
    embedded: list[str] = []
    meanings.save(tmp_path)
    counted = Meanings.load(tmp_path, lambda texts: embedded.extend(texts) or text_encoder.embed(texts))
    assert [counted.like(each) for each in ("the baby shop", "green red", "the baby shop", "green red")] == [
        meanings.like(each) for each in ("the baby shop", "green red") * 2
    ]
    assert embedded == ["baby shop", "green red"]


def test_a_map_without_names_means_nothing(text_encoder, tmp_path) -> None:
    made(Lookup(EMPTY_GAZETTEER, load_vocabulary(), is_common), text_encoder).save(tmp_path)
    assert Meanings.load(tmp_path, text_encoder.embed).like("the baby shop") is None
