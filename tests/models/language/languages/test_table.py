from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER
from models.citymap.kinds.vocabulary import load_vocabulary
from models.language.languages.cue_reader import COMPASS_DEG, EGO_DEG
from models.language.languages.table import DIRECTORY, LanguageTable, fold, is_inflected, load_table, table_codes
from models.language.mentions.cues import Relation
from models.language.mentions.lookup import Lookup
from models.language.mentions.name_table import NameTable
from models.language.mentions.names import plain_words, split_words, street_forms
from models.language.mentions.street_spans import WINDS, match_street
from models.strings import Postings

FORMS = [line.split("\t") for line in (Path(__file__).parent / "finnish_streets.tsv").read_text("utf-8").splitlines()]
CODES = sorted(table_codes())


@pytest.mark.parametrize("code", CODES)
def test_each_entry_is_of_a_known_type(code) -> None:
    [table] = LanguageTable((code,))._tables
    assert table["cues"].keys() <= EGO_DEG.keys() | set(get_args(Relation))
    assert table["cues"].keys() >= EGO_DEG.keys()
    assert table["winds"].keys() == COMPASS_DEG.keys() | {"of"}
    assert table["discourse"].keys() == {"absent", "denied", "correction", "past", "now", "greeting"}
    assert table["nouns"].keys() <= load_vocabulary().nouns("en").keys()
    assert all(float(n) > 0 for n in (*table["numbers"].values(), *table["metres"].values()))
    assert table["streets"].keys() <= {"street", "avenue"} | WINDS
    assert table["addresses"].keys() <= {"mark", "on", "before", "counted", "other", "flat", "door"}


@pytest.mark.parametrize("code", CODES)
def test_no_phrase_of_a_side_is_one_of_another(code) -> None:
    names: dict[str, str] = {}
    for name, phrases in load_table((code,)).cues.items():
        for phrase in phrases:
            if phrase.alone is not None and name in EGO_DEG:
                assert names.setdefault(phrase.alone.pattern, name) == name, phrase.alone.pattern


def test_a_noun_of_two_things_means_both() -> None:
    assert load_table(("es",)).kinds(("banco",)).keys() >= {"amenity/bank", "amenity/bench"}


def test_a_mixture_has_the_words_of_both_languages() -> None:
    both = load_table(("en", "fi"))
    assert both.nouns.items() >= load_table(("fi",)).nouns.items()
    assert both.stop == load_table(("en",)).stop | load_table(("fi",)).stop


@pytest.mark.parametrize("text", ["İstanbul'dayım", "Straße", "ŁÓDŹ"])  # noqa: RUF001
def test_folding_keeps_the_length(text) -> None:
    assert len(fold(text)) == len(text)


@pytest.mark.parametrize(
    ("word", "base", "result"),
    [
        ("kirkon", "kirkko", True),
        ("apteekissa", "apteekki", True),
        ("apteekin", "apteekki", True),
        ("grunwaldzkiej", "grunwaldzka", True),
        ("bank", "banaani", False),
        ("morgan", "morgue", True),
    ],
)
def test_inflected_words(word, base, result) -> None:
    assert is_inflected(word, base) is result


def street_lookup(names: list[str]) -> Lookup:
    forms = [(" ".join(form), weight, n) for n, name in enumerate(names) for form, weight in street_forms(name)]
    none = Postings.from_pairs(())
    by_form = Postings.from_pairs((form, row) for row, (form, _, _) in enumerate(forms))
    by_word = Postings.from_pairs((word, 0) for form, _, _ in forms for word in form.split())
    street, weight = np.array([n for *_, n in forms]), np.array([weight for _, weight, _ in forms])
    table = NameTable(none, none, none, none, none, by_form, by_word, street, weight)
    return Lookup(EMPTY_GAZETTEER, load_vocabulary(), lambda word: False, table)


@pytest.fixture(scope="module")
def streets() -> tuple[Lookup, list[str]]:
    names = sorted({name for _, name in FORMS})
    return street_lookup(names), names


@pytest.mark.parametrize(("form", "name"), FORMS)
def test_finnish_streets_are_found_in_every_case(streets, form, name) -> None:
    lookup, names = streets
    words = plain_words(form)
    match = lookup.street(words) or lookup.street_form(words)
    assert match is not None
    assert names[match.objects[0]] == name


@pytest.mark.parametrize(("text", "number"), [("la 24 oeste", 1), ("la 24 este", 0)])
def test_the_wind_of_a_numbered_street_counts(text, number) -> None:
    lookup = street_lookup(["East 24th Street", "West 24th Street"])
    words = split_words(text)
    match = match_street(words, 1, 2, tuple(word.plain for word in words[1:]), lookup, table=load_table(("es",)))
    assert match is not None
    assert match[0].objects.tolist() == [number]


def test_a_noun_is_no_street_without_its_kind(streets) -> None:
    lookup, names = streets
    match = lookup.street_form(("kirkko",))
    assert match is not None
    assert names[match.objects[0]] == "Kirkkokatu"
    words = split_words("kirkko on vasemmalla")  # the church is on the left
    assert match_street(words, 0, 0, ("kirkko",), lookup, table=load_table(("fi",))) is None


def test_every_table_is_in_utf_8() -> None:
    assert all((DIRECTORY / f"{code}.toml").read_text("utf-8") for code in CODES)
