import numpy as np
import pytest

from index.answering.address import address_at
from models.citymap.gazetteer.gazetteer import EMPTY_GAZETTEER, build_gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject
from tests.models.citymap.gazetteer.made_town import line, point, ring


def house(number, street, *codes):
    return GazetteerObject(("address",), (), number, street, f"node/{number}", codes)


def district(name, half_m):
    """An object like those that are circles around a point of the map."""
    return GazetteerObject((), (name,)), ring(-half_m, -half_m, half_m, half_m)


@pytest.fixture(scope="module")
def town():
    rows = [
        (GazetteerObject((STREET_KIND,), ("High Street",)), line((-500, 0), (500, 0))),
        (house("1", "Low Street"), point(0, 12)),
        (house("2", "High Street"), point(10, -12)),
        (house("4", "High Street", "exit a", "post sw1a"), point(40, -12)),
        (GazetteerObject(("leisure/park",), ("The Park",)), ring(-400, -400, 400, 400)),
        district("Old Corner", 300),
        district("Hillside", 700),
        district("Metropolis", 4000),
    ]
    objects, segments = zip(*rows, strict=True)
    return build_gazetteer(objects, segments, [len(each) == 4 for each in segments])


def test_an_address_has_house_street_districts_and_postcode(town) -> None:
    assert address_at(town, np.zeros(2)) == {
        "house_number": "2",
        "road": "High Street",
        "neighbourhood": "Old Corner",
        "suburb": "Hillside",
        "city": "Metropolis",
        "postcode": "SW1A",
    }


@pytest.mark.parametrize(
    ("position", "address"),
    [
        ((120.0, 0.0), {"road": "High Street", "neighbourhood": "Old Corner", "postcode": "SW1A"}),
        ((350.0, 0.0), {"road": "High Street"}),
        ((0.0, 200.0), {"neighbourhood": "Old Corner"}),
        ((0.0, 5000.0), {}),
    ],
)
def test_an_address_has_only_what_is_near(town, position, address) -> None:
    parts = address_at(town, np.array(position))
    assert {name: part for name, part in parts.items() if name not in ("suburb", "city")} == address


def test_a_map_without_names_has_no_addresses() -> None:
    assert address_at(EMPTY_GAZETTEER, np.zeros(2)) == {}
