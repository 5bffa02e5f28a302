import pytest

from models.citymap.gazetteer.name_columns import GazetteerObject
from models.posterior.places.addresses import Addresses

HOUSES = [
    GazetteerObject(("building",), (), "12", "Bulevardi"),
    GazetteerObject(("shop",), ("Kiosk",), "12", "Bulevardi"),
    GazetteerObject(("building",), (), "14 A;14 B", "Bulevardi"),
    GazetteerObject(("building",), (), "20", "Bulevardi"),
    GazetteerObject(("building",), (), "350", "5th Avenue"),
    GazetteerObject(("building",), (), "350", "West 42nd Street"),
    GazetteerObject(("building",), (), "352", "West 42nd Street"),
    GazetteerObject(("building",), (), "12", "2. linja"),
    GazetteerObject(("building",), (), "s/n", "Bulevardi"),
    GazetteerObject(("shop",), ("No number",), None, "Bulevardi"),
    GazetteerObject(("shop",), ("No street",), "7", None),
]


@pytest.fixture(scope="module")
def addresses():
    return Addresses.build(HOUSES)


@pytest.mark.parametrize(
    ("address", "meant"),
    [
        ("12 Bulevardi", ["12 Bulevardi"]),
        ("bulevardi 12", ["12 Bulevardi"]),
        ("number 12, BULEVARDI", ["12 Bulevardi"]),
        ("Bulevardi 12 c, Helsinki", ["12 Bulevardi"]),
        ("350 5th Ave", ["350 5th Avenue"]),
        ("5th avenue 350", ["350 5th Avenue"]),
        ("350 W 42nd St, New York", ["350 West 42nd Street"]),
        ("350", ["350 5th Avenue", "350 West 42nd Street"]),
        ("16 Bulevardi", ["14a Bulevardi", "14b Bulevardi", "20 Bulevardi"]),  # between those beside it
        ("14 Bulevardi", ["14a Bulevardi", "14b Bulevardi"]),
        ("Bulevardi 14 B", ["14b Bulevardi"]),
        ("14 b bulevardi", ["14b Bulevardi"]),
        ("350 W 42nd", ["350 West 42nd Street"]),
        ("90 Bulevardi", []),  # past its end
        ("13 Bulevardi", []),  # none on that side
        ("351", []),
        ("Bulevardi", []),
        ("12 Elm Street", []),
        ("2. linja 12", ["12 2. linja"]),
        ("", []),
    ],
)
def test_what_people_say(addresses, address, meant):
    assert [addresses.shown[n] for n in addresses.find(address)] == meant


def test_houses_of_one_address_share_a_column(addresses):
    assert len(addresses) == len(addresses.shown) == len(set(addresses.shown))
    assert addresses.objects.tolist() == [0, 1, 2, 2, 3, 4, 5, 6, 7]  # "s/n" is no number
    assert addresses.column[0] == addresses.column[1]
    assert all(addresses.find(shown).tolist() == [n] for n, shown in enumerate(addresses.shown))


def test_a_map_without_numbers_has_none():
    assert len(Addresses.build([GazetteerObject(("shop",), ("A",))])) == 0
    assert not len(Addresses.build([]).find("12 Bulevardi"))


def test_a_half_of_a_number_is_part_of_it():
    addresses = Addresses.build([GazetteerObject(("building",), (), "891 1/2", "1st Avenue")])
    assert addresses.find("891 1/2 1st Avenue").tolist() == [0]
