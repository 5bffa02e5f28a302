"""The vendored vocabulary, and how it is made."""

import json
import time
import tomllib
import tracemalloc
from pathlib import Path

import pytest

from models.citymap.kinds import make
from models.citymap.kinds.brands import normalize_name
from models.citymap.kinds.vocabulary import FOLDER, Vocabulary, load_vocabulary
from models.citymap.kinds.words import everyday_nouns
from models.errors import DataError

FILES = ("kinds.json.xz", "names.json.xz", "brands.json.xz", "LICENCES.md")


@pytest.fixture(scope="module")
def kinds() -> Vocabulary:
    return load_vocabulary()


def meant(kinds: Vocabulary, phrase: str, tags: dict[str, str], language: str = "en") -> float:
    """How well a phrase fits an object; 0 if not at all."""
    weights = dict(kinds.nouns(language).get(phrase, ()))
    return max((weights.get(kind, 0) for kind in kinds.kinds_of(tags)), default=0)


def test_kinds_come_with_parents_special_before_general(kinds):
    assert kinds.kinds_of({"amenity": "fast_food", "cuisine": "pizza", "building": "yes"}) == (
        "amenity/fast_food/pizza",
        "amenity/fast_food",
        "cuisine/pizza",
        "building",
    )
    assert kinds.kinds_of({"shop": "beauty", "beauty": "nails"}) == ("shop/beauty/nails", "shop/beauty", "shop")
    church = {"amenity": "place_of_worship", "religion": "christian", "denomination": "lutheran", "building": "church"}
    assert kinds.kinds_of(church) == (
        "amenity/place_of_worship/christian/lutheran",
        "amenity/place_of_worship/christian",
        "amenity/place_of_worship",
        "building/church",
        "building",
    )


def test_an_object_can_be_several_things(kinds):
    assert set(kinds.kinds_of({"shop": "bakery", "amenity": "cafe"})) == {"shop/bakery", "amenity/cafe", "shop"}
    both = kinds.kinds_of({"amenity": "restaurant", "cuisine": "pizza; italian"})
    assert {"amenity/restaurant/pizza", "amenity/restaurant/italian", "cuisine/pizza", "cuisine/italian"} <= set(both)
    assert len(both) == len(set(both))


@pytest.mark.parametrize(
    "tags",
    [
        {},
        {"name": "Harlem"},
        {"type": "boundary", "boundary": "administrative", "name": "New York"},
        {"type": "route", "route": "bus"},
        {"railway": "subway", "tunnel": "yes"},
        {"indoor": "room"},
        {"building": "no"},
        {"place": "suburb"},
    ],
)
def test_what_nobody_sees_is_no_kind(kinds, tags):
    assert kinds.kinds_of(tags) == ()


@pytest.mark.parametrize(
    ("phrase", "tags", "least"),
    [
        ("pizza place", {"amenity": "restaurant", "cuisine": "pizza"}, 1),
        ("pizza place", {"amenity": "fast_food", "cuisine": "burger;pizza"}, 1),
        ("thai place", {"amenity": "fast_food", "cuisine": "thai"}, 1),
        ("thai place", {"amenity": "restaurant", "cuisine": "thai"}, 1),
        ("peruvian restaurant", {"amenity": "restaurant", "cuisine": "peruvian"}, 1),
        ("an italian", {"amenity": "restaurant", "cuisine": "italian"}, 0.8),
        ("store", {"shop": "something_new"}, 0.6),
        ("shop", {"shop": "beauty", "beauty": "nails"}, 0.6),
        ("restaurant", {"amenity": "fast_food", "cuisine": "thai"}, 0.6),
        ("cafe", {"shop": "coffee"}, 0.8),
        ("bar", {"amenity": "pub"}, 0.8),
        ("bodega", {"shop": "convenience"}, 1),
        ("drugstore", {"amenity": "pharmacy"}, 1),
        ("chemist", {"amenity": "pharmacy"}, 1),
        ("barber", {"shop": "hairdresser"}, 0.9),
        ("laundromat", {"shop": "laundry"}, 1),
        ("citi bike dock", {"amenity": "bicycle_rental"}, 1),
        ("trash can", {"amenity": "waste_basket"}, 1),
        ("crosswalk", {"highway": "footway", "footway": "crossing"}, 1),
        ("crosswalk", {"highway": "crossing", "crossing": "zebra"}, 1),
        ("subway entrance", {"railway": "subway_entrance"}, 1),
        ("metro", {"railway": "station", "station": "subway"}, 1),
        ("church", {"building": "church"}, 1),
        ("baptist church", {"amenity": "place_of_worship", "religion": "christian", "denomination": "baptist"}, 1),
        ("parking garage", {"amenity": "parking", "parking": "multi-storey"}, 1),
        ("nursery", {"amenity": "kindergarten"}, 0.9),
        ("statue", {"historic": "memorial", "memorial": "statue"}, 1),
        ("construction site", {"landuse": "construction"}, 1),
        ("bridge", {"highway": "footway", "bridge": "yes"}, 1),
        ("clothes shop", {"shop": "clothes"}, 1),
        ("law office", {"office": "lawyer"}, 1),
        ("tree", {"natural": "tree"}, 1),
    ],
)
def test_everyday_words_reach_their_objects(kinds, phrase, tags, least):
    assert meant(kinds, phrase, tags) >= least


@pytest.mark.parametrize(
    ("phrase", "tags"),
    [
        ("pizza place", {"amenity": "restaurant", "cuisine": "sushi"}),
        ("store", {"amenity": "bank"}),
        ("table", {"amenity": "restaurant"}),
        ("bench", {"natural": "tree"}),
        ("block", {"barrier": "block"}),
        ("green", {"landuse": "grass"}),
    ],
)
def test_words_do_not_reach_others(kinds, phrase, tags):
    assert meant(kinds, phrase, tags) == 0


def test_foreign_nouns(kinds):
    assert meant(kinds, "kahvila", {"amenity": "cafe"}, "fi") == 1
    assert meant(kinds, "apotheke", {"amenity": "pharmacy"}, "de") == 1
    assert kinds.nouns("de-AT") == kinds.nouns("de")
    assert kinds.nouns("nb") == kinds.nouns("no")
    assert not kinds.nouns("tlh")
    assert {"en", "fi", "de", "fr", "es", "ja", "pt-BR"} <= set(kinds.languages)
    ids = {kind.id for kind in kinds.kinds}
    for language in kinds.languages:
        nouns = kinds.nouns(language)
        assert len(nouns) > 200
        assert all(phrase == phrase.casefold() for phrase in nouns)
        assert {kind for rows in nouns.values() for kind, _ in rows} <= ids


def test_nouns_of_one_word_are_those_of_all_languages(kinds):
    wanted = [
        (noun, rows)
        for language in kinds.languages
        for noun, rows in kinds.nouns(language).items()
        if len(noun) >= 5 and " " not in noun
    ]
    assert list(kinds.single_words(5)) == wanted


def test_what_is_read_of_all_languages_is_let_go_of():
    kinds = Vocabulary()
    kinds.nouns()
    tracemalloc.start()
    try:
        for _ in kinds.single_words(5):
            pass
        assert tracemalloc.get_traced_memory()[0] < 2**20
    finally:
        tracemalloc.stop()


def test_brands_by_any_spelling(kinds):
    assert "マクドナルド" in kinds.spellings("McDonald's")
    assert kinds.spellings("McDonald\u2019s") == kinds.spellings("mcdonalds")
    assert kinds.spellings("H and M") == kinds.spellings("h&m") != ()
    assert kinds.spellings("Nobody's Own Little Place") == ()
    assert normalize_name("Café  du Nord!") == "cafedunord"
    assert normalize_name("L_Epi & d'Or") == "lepianddor"


def test_hand_written_words_name_kinds_that_are(kinds):
    ids = {kind.id for kind in kinds.kinds}
    text = everyday_nouns(tomllib.loads((FOLDER / "people.toml").read_text()))
    assert {kind for rows in text.values() for kind in rows} <= ids
    ours = tomllib.loads((FOLDER / "ours.toml").read_text())
    assert {*ours["same"].values(), *ours["names"]} <= ids
    assert len(ids) == len(kinds.kinds)
    assert all(0 < weight <= 1 for rows in kinds.nouns().values() for _, weight in rows)


def test_the_vendored_files_are_small_and_say_whence(kinds):
    assert sum((FOLDER / file).stat().st_size for file in FILES) <= 1_000_000
    assert kinds.version.startswith("id-tagging-schema ")
    assert ", name-suggestion-index " in kinds.version
    licences = (FOLDER / "LICENCES.md").read_text()
    for one in kinds.version.split(", "):
        assert one in licences
    assert "ISC License" in licences
    assert "Redistribution and use in source and binary forms" in licences


def test_kinds_are_found_fast(kinds):
    tags = {"amenity": "restaurant", "cuisine": "pizza;italian", "building": "yes", "name": "x", "phone": "1", "a": "b"}
    start = time.perf_counter()
    for _ in range(5_000):
        kinds.kinds_of(tags)
    assert (time.perf_counter() - start) / 5_000 < 100e-6  # 3 on an idle machine


def written(package: Path, file: str, content: dict) -> None:
    path = package / file
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(content, ensure_ascii=False))


@pytest.fixture
def packages(tmp_path):
    schema, brands = tmp_path / "schema", tmp_path / "brands"
    presets = {
        "amenity/cafe": {"tags": {"amenity": "cafe"}},
        "amenity/cafe-US": {"tags": {"amenity": "cafe"}, "name": "{amenity/cafe}"},
        "shop": {"tags": {"shop": "*"}},
        "shop/bag": {"tags": {"shop": "bag"}},
        "amenity": {"tags": {"amenity": "*"}},
        "type/route": {"tags": {"type": "route"}},
    }
    english = {
        "amenity/cafe": {"name": "Cafe", "aliases": "Coffee House\nEspresso Bar", "terms": "latte,tea"},
        "shop": {"name": "Shop"},
        "shop/bag": {"name": "Bag/Luggage Store (Any)"},
    }
    written(schema, "package.json", {"name": "@x/schema", "version": "1.2", "license": "ISC", "more": 1})
    written(schema, "dist/presets.min.json", presets)
    written(schema, "dist/translations/en.min.json", {"en": {"presets": {"presets": english}}})
    finnish = {"amenity/cafe": {"name": "Kahvila"}}
    written(schema, "dist/translations/fi.min.json", {"fi": {"presets": {"presets": finnish}}})
    (schema / "LICENSE.md").write_text("Use it.\n")
    tags = {"amenity": "cafe", "brand": "Löfbergs", "brand:ja": "レフ", "brand:wikidata": "Q1", "name": "Löfbergs"}
    item = {"displayName": "Löfbergs", "tags": tags, "matchNames": ["lofbergs lila"]}
    sign = {"displayName": "Sign", "tags": {"advertising": "totem", "brand": "Sign"}, "matchNames": ["board"]}
    index = {"brands/amenity/cafe": {"items": [item]}, "brands/advertising/totem": {"items": [sign]}}
    written(brands, "package.json", {"name": "brand-index", "version": "8", "license": "BSD-3-Clause"})
    written(brands, "dist/json/nsi.min.json", {"nsi": index})
    (brands / "LICENSE.md").write_text("Use that.\n")
    return schema, brands


def test_making_is_deterministic_and_keeps_what_is_selected(packages, tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    for out in (first, second):
        make.write_vocabulary(*packages, out)
    assert {path.name for path in first.iterdir()} == set(FILES)
    for path in first.iterdir():
        assert path.read_bytes() == (second / path.name).read_bytes()
    made = Vocabulary(first)
    assert made.version == "schema 1.2, brand-index 8"
    assert made.languages == ("en", "fi")
    assert made.kinds_of({"amenity": "cafe", "type": "route"}) == ("amenity/cafe",)
    assert made.kinds_of({"shop": "bag"}) == ("shop/bag", "shop")
    assert dict(made.nouns()["luggage shop"])["shop/bag"] == 1
    assert dict(made.nouns()["latte"]) == {"amenity/cafe": 0.5}
    assert dict(made.nouns()["coffee house"])["amenity/cafe"] == 1
    assert made.nouns("fi") == {"kahvila": (("amenity/cafe", 1.0),)}
    assert "レフ" in made.spellings("Lofbergs LILA")
    assert made.spellings("löfbergs") == ("レフ", "lofbergs lila")
    assert made.spellings("sign") == (), "what has no kind is left out"
    assert "Use that." in (first / "LICENCES.md").read_text()


def test_what_cannot_be_read_is_named(packages, tmp_path):
    with pytest.raises(DataError, match=r"kinds\.json\.xz"):
        Vocabulary(tmp_path)
    schema, brands = packages
    (schema / "dist" / "presets.min.json").write_text("[")
    with pytest.raises(DataError, match=r"presets\.min\.json"):
        make.write_vocabulary(schema, brands, tmp_path / "out")
