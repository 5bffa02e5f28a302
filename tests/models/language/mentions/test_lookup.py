import numpy as np
import pytest

from models.citymap.gazetteer.gazetteer import ADDRESS_KIND, EMPTY_GAZETTEER, build_gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject
from models.citymap.kinds.vocabulary import load_vocabulary
from models.language.mentions.lookup import MAX_CACHED_PHRASES, Lookup
from models.language.mentions.names import plain_words
from tests.models.citymap.gazetteer.made_town import NUMBERS, called, is_common, line, numbered, point


def words(text: str) -> tuple[str, ...]:
    return plain_words(text)


def test_a_whole_name_is_exact(town, lookup) -> None:
    match = lookup.named(words("Cafe Zoe"))
    assert called(town, match.objects) == {"Café Zoë"}
    assert match.is_exact
    assert match.trust == 1.0
    assert lookup.is_name(words("café zoë"))
    assert not lookup.is_name(words("zoë"))


def test_every_name_of_a_thing_is_exact(town, lookup) -> None:
    for name in ("Whole Foods", "Whole Foods Market"):
        match = lookup.named(words(name))
        assert match.is_exact
        assert called(town, match.objects) == {"Whole Foods Market"}


@pytest.mark.parametrize(
    ("part", "whole"),
    [("London Terrace", "London Terrace Gardens"), ("rossi", "Rossi Bakery"), ("Пушкин", "Кафе Пушкин")],
)
def test_a_telling_part_of_a_name(town, lookup, part, whole) -> None:
    match = lookup.named(words(part))
    assert called(town, match.objects) == {whole}
    assert not match.is_exact
    assert match.trust < 1
    assert (match.weights < 1).all()


@pytest.mark.parametrize("phrase", ["Rossi Pizzeria", "Nobodys", "of the", "&", ""])
def test_words_that_are_in_no_name(lookup, phrase) -> None:
    assert lookup.named(words(phrase)) is None


@pytest.mark.parametrize(
    ("wrong", "right"),
    [("botino", "Bottino"), ("londn terrace gardens", "London Terrace Gardens"), ("Кафе Пушкен", "Кафе Пушкин")],
)
def test_misspelt_names(town, lookup, wrong, right) -> None:
    match = lookup.misspelt(words(wrong))
    assert called(town, match.objects) == {right}
    assert match.trust < 1
    assert not match.is_exact


@pytest.mark.parametrize("phrase", ["elm", "the house", "bottle inn", "zzzzzzz"])
def test_short_common_and_other_words_are_no_misspelt_names(lookup, phrase) -> None:
    assert lookup.misspelt(words(phrase)) is None


@pytest.mark.parametrize(("phrase", "name", "exact"), [
    ("West 25th Street", "West 25th Street", True),
    ("w 25th st", "West 25th Street", True),
    ("25th street", "West 25th Street", False),
    ("25th", "West 25th Street", False),
    ("tenth ave", "10th Avenue", True),
    ("harlem", "Harlem Road", False),
])  # fmt: skip
def test_streets_in_all_their_forms(town, lookup, phrase, name, exact) -> None:
    match = lookup.street(words(phrase))
    assert called(town, match.objects) == {name}
    assert match.is_exact == exact


def test_no_such_street(lookup) -> None:
    assert lookup.street(words("99th Street")) is None
    assert lookup.street(words("Bottino")) is None, "a restaurant"
    assert lookup.street(()) is None


def test_a_short_form_may_mean_several_streets() -> None:
    names = ("East 25th Street", "West 25th Street", "25th Avenue")
    town = build_gazetteer(
        [GazetteerObject((STREET_KIND,), (n,)) for n in names], [line((0, 0), (9, 0))] * 3, [False] * 3
    )
    several = Lookup(town, load_vocabulary(), is_common)
    assert called(town, several.street(("25th",)).objects) == set(names)
    assert called(town, several.street(("25th", "street")).objects) == set(names[:2])


def test_a_misspelt_street(town) -> None:
    town = build_gazetteer([GazetteerObject((STREET_KIND,), ("Broadway",))], [line((0, 0), (9, 0))], [False])
    lookup = Lookup(town, load_vocabulary(), is_common)
    assert called(town, lookup.street_like("brodway").objects) == {"Broadway"}
    assert lookup.street_like("bway") is None
    assert lookup.street_like("restaurant") is None


def test_kinds(town, lookup) -> None:
    assert lookup.kinds(("cafe",))["amenity/cafe"] == 1.0
    assert lookup.kinds(("cafes",)) == lookup.kinds(("cafe",))
    assert lookup.kinds(("bakeries",)) == lookup.kinds(("bakery",))
    assert lookup.kinds(("benches",)) == lookup.kinds(("bench",))
    assert lookup.kinds(("bottino",)) == {}
    match = lookup.of_kinds({"amenity/cafe": 1.0, "shop/bakery": 0.6})
    weight = dict(zip(match.objects.tolist(), match.weights.tolist(), strict=True))
    assert weight[numbered(town, "Café Zoë")] == 1.0
    assert weight[numbered(town, "Rossi Bakery")] == 0.6
    assert lookup.of_kinds({"amenity/zoo": 1.0}) is None


def test_the_surest_kind_of_an_object_counts(town, lookup) -> None:
    for kinds in ({"shop": 0.2, "shop/bakery": 0.9}, {"shop/bakery": 0.9, "shop": 0.2}):
        match = lookup.of_kinds(kinds)
        weight = dict(zip(match.objects.tolist(), match.weights.tolist(), strict=True))
        assert weight[numbered(town, "Rossi Bakery")] == 0.9
        assert weight[numbered(town, "T-Optik")] == 0.2


def test_rare_words_are_worth_more_than_common_ones(lookup) -> None:
    assert lookup.word_weight("bottino") > lookup.word_weight("coffee") > lookup.word_weight("the")


@pytest.mark.parametrize("number", NUMBERS)
def test_a_house_number_is_its_object(town, lookup, number) -> None:
    address = lookup.address(number, lookup.street(("25th",)).objects)
    assert address.objects.tolist() == [numbered(town, number)]
    assert not len(address.lines_m)


@pytest.mark.parametrize(
    ("number", "start"), [("430", (300, 95)), ("420", (325, 95)), ("425", (320, 65)), ("430b", (300, 95))]
)
def test_a_number_between_others_lies_between_them_on_its_side(lookup, number, start) -> None:
    address = lookup.address(number, lookup.street(("25th",)).objects)
    assert not len(address.objects)
    assert address.lines_m == pytest.approx(np.array([[*start, *start]]))


@pytest.mark.parametrize("number", ["2", "900", "399", "451", "99999"])
def test_a_number_past_the_end_of_the_street_is_nowhere(lookup, number) -> None:
    assert lookup.address(number, lookup.street(("25th",)).objects) is None


def test_a_street_without_numbers(lookup) -> None:
    assert lookup.address("430", lookup.street(("24th",)).objects) is None


def numbers(*given: str) -> Lookup:
    subset = [GazetteerObject((ADDRESS_KIND,), (), number, "Main St") for number in given] + [
        GazetteerObject((STREET_KIND,), ("Main Street",))
    ]
    shapes = [*(point(10.0 * n, 0) for n in range(len(given))), line((0, 0), (90, 0))]
    return Lookup(build_gazetteer(subset, shapes, [False] * len(subset)), load_vocabulary(), is_common)


def test_several_numbers_of_one_house() -> None:
    lookup = numbers("2;4", "6, 8A")
    street = np.array([2])
    assert [lookup.address(n, street).objects.tolist() for n in ("2", "4", "6", "8a", "8A")] == [
        [0],
        [0],
        [1],
        [1],
        [1],
    ]


def test_odd_house_numbers_of_the_map_do_no_harm() -> None:
    lookup = numbers("2", "5²", "12-14", "½", "x", "", "10")
    assert lookup.address("6", np.array([7])).lines_m == pytest.approx(np.array([[30, 0, 30, 0]]))


def test_a_map_without_names_knows_kinds_alone() -> None:
    bare = build_gazetteer([GazetteerObject(("amenity/bench",))], [point(0, 0)], [False])
    for town in (EMPTY_GAZETTEER, bare):
        lookup = Lookup(town, load_vocabulary(), is_common)
        assert lookup.named(("bottino",)) is None
        assert lookup.misspelt(("bottino",)) is None
        assert lookup.street(("25th",)) is None
        assert lookup.street_like("broadway") is None
        result = lookup.of_kinds(lookup.kinds(("bench",)))
        assert (result is None) == (len(town) == 0)


@pytest.mark.parametrize(
    ("text", "result"),
    [("Kentucky Fried Chicken", [0]), ("Chicken", None), ("KFC", [0]), ("Mobile", None), ("Hotel", None)],
)
def test_a_chain_is_found_by_its_other_names(text, result) -> None:
    given = [GazetteerObject(("amenity/fast_food",), ("KFC",)), GazetteerObject(("amenity/fuel",), ("Mobil",))]
    shops = build_gazetteer(given, [np.zeros((1, 4)), np.ones((1, 4))], [False, False])
    match = Lookup(shops, load_vocabulary(), lambda word: word in ("mobile", "chicken")).named(words(text))
    assert (match.objects.tolist() if match else None) == result


def test_what_people_say_does_not_pile_up(lookup) -> None:
    assert lookup.kinds(("pharmacy",))
    for number in range(2 * MAX_CACHED_PHRASES):
        lookup.kinds((f"x{number}",))
    assert lookup._kinds.cache_info().currsize <= MAX_CACHED_PHRASES
    assert lookup.kinds(("pharmacy",))
