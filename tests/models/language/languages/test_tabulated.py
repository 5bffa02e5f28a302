import pytest

from models.citymap.kinds.vocabulary import load_vocabulary
from models.language.languages.detect import detect_languages
from models.language.languages.tabulated import tabulated
from models.language.mentions.lookup import Lookup
from models.language.mentions.reader import find_mentions
from tests.models.citymap.gazetteer.made_town import is_common, made_gazetteer


@pytest.fixture(scope="module")
def lookup() -> Lookup:
    return Lookup(made_gazetteer(), load_vocabulary(), is_common)


def mentions(text: str, lookup: Lookup) -> list[tuple[str, str]]:
    return [(m.form, m.text) for m in find_mentions(text, lookup, tabulated(detect_languages(text)))]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("Ich stehe an der Ecke Harlem Road und 10th Avenue", "Harlem Road und 10th Avenue"),
        ("Olen Harlem Roadin ja 10th Avenuen kulmassa, missä olet", "Harlem Roadin ja 10th Avenuen"),
        ("Estoy en la esquina de la calle 25 con la Décima", "calle 25 con la Décima"),
        ("Estoy en la Décima con 25, te espero", "Décima con 25"),
        ("sono all'angolo tra 10th Avenue e Harlem Road", "10th Avenue e Harlem Road"),
        ("angolo 10th Avenue Harlem Road", "10th Avenue Harlem Road"),
        ("10th Avenue Harlem Road kesişimi", "10th Avenue Harlem Road"),
    ],
)
def test_corners(lookup, text, words) -> None:
    assert words in [mention for form, mention in mentions(text, lookup) if form in ("corner", "unknown")]


def test_numbered_streets_in_spanish(lookup) -> None:
    assert ("street", "calle 25") in mentions("Estoy en la calle 25, delante de una farmacia", lookup)
    assert ("street", "25") in mentions("Estoy en la 25, delante de una farmacia", lookup)
    assert ("street", "Décima") in mentions("Estoy en la Décima, delante de una farmacia", lookup)


def test_the_wind_of_a_numbered_street(lookup) -> None:
    assert ("street", "24 oeste") in mentions("Estoy en la 24 oeste, delante de una farmacia", lookup)


def test_a_number_of_people_is_no_street(lookup) -> None:
    assert ("street", "25") not in mentions("Estoy con 25 personas en la Décima", lookup)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("sono vicino all'ospedale, sull'Harlem Road", ("street", "Harlem Road")),
        ("je suis devant l'Elmo, l'église est à gauche", ("thing", "Elmo")),
        ("davanti all'edicola, il bar è a destra", ("unknown", "edicola")),
    ],
)
def test_an_elided_article_is_no_part_of_a_name(lookup, text, words) -> None:
    assert words in mentions(text, lookup)


def test_names_have_no_cases_in_spanish(lookup) -> None:
    assert ("thing", "Zoes") not in mentions("Estoy en la Décima, la Zoes a la izquierda", lookup)
    assert ("thing", "Zoes") in mentions("Ich stehe an der Ecke, links von Zoes Eingang", lookup)


def test_a_number_at_a_corner_may_be_of_either_street(lookup) -> None:
    text = "Sta op de hoek van West 25th Street en 10th Avenue. Huisnummer 402 ligt rechts van mij"
    by_text = {m.text: m for m in find_mentions(text, lookup, tabulated(("nl",)))}
    assert by_text["402"].form == "address"
    assert by_text["402"].cue.angle == 90


def test_chinese_needs_no_spaces(lookup) -> None:
    text = "我在北京饭店旁边，右手边有一间银行"  # noqa: RUF001
    by_text = {m.text: m for m in find_mentions(text, lookup, tabulated(detect_languages(text)))}
    assert by_text["北京饭店"].cue.relation == "beside"
    assert by_text["银行"].cue.angle == 90


def test_what_is_denied_counts_against_it(lookup) -> None:
    text = "Ich stehe nicht bei Bottino. Vor mir ist die Bäckerei"
    by_text = {m.text: m for m in find_mentions(text, lookup, tabulated(("de",)))}
    assert by_text["Bottino"].is_denied
    assert not by_text["Bäckerei"].is_denied


def test_what_is_corrected_is_left_out(lookup) -> None:
    result = mentions("Je suis devant Bottino, non pardon, devant Elmo", lookup)
    assert ("thing", "Elmo") in result
    assert ("thing", "Bottino") not in result


def test_nouns_in_any_form(lookup) -> None:
    [mention] = find_mentions("Seison apteekin edessä ja odotan sinua", lookup, tabulated(("fi",)))
    assert "amenity/pharmacy" in mention.kinds
    assert mention.cue.relation == "outside"


def test_german_nouns_are_no_unknown_names(lookup) -> None:
    text = "Guten Tag, ich stehe mit meinem Fahrrad und einem Rucksack vor Bottino"
    assert [m.text for m in find_mentions(text, lookup, tabulated(("de",))) if m.form == "unknown"] == []


def test_a_language_without_a_table_gives_names(lookup) -> None:
    [mention] = find_mentions("Jsem u Bottino", lookup, tabulated(("cs",)))
    assert mention.cue.angle is None


@pytest.mark.parametrize(("code", "text"), [("de", "zwischen A und B"), ("fi", "A ja B välissä")])
def test_between(code, text) -> None:
    first, second = text.index("A"), text.index("B")
    assert tabulated((code,)).is_between(text, first, first + 1, second, second + 1)
    assert not tabulated((code,)).is_between("A und B", 0, 1, 6, 7)
