import time
from types import SimpleNamespace

import numpy as np
import pytest

from models.language.mentions.addresses import add_addresses, without_city
from models.language.mentions.house_numbers import NumberMatch
from models.language.mentions.lookup import NO_LINES, AddressMatch
from models.language.mentions.mentions import Mention
from models.language.mentions.reader import find_mentions


@pytest.mark.parametrize("tail", ["", ", 10001 New York, USA", ", NY 10001", ", 10001", ", Gotham", ", Gotham, 10001"])
def test_city_and_postcode_after_an_address_are_no_mentions(lookup, english, tail) -> None:
    (mention,) = find_mentions(f"402 West 25th Street{tail}", lookup, english)
    assert (mention.form, mention.text, mention.is_exact) == ("address", "402 West 25th Street", True)


def test_a_whole_name_after_an_address_is_a_mention(lookup, english) -> None:
    assert [m.text for m in find_mentions("402 West 25th Street, Bottino", lookup, english)][-1] == "Bottino"


def test_what_was_assumed_is_a_warning(lookup, english) -> None:
    (mention,) = find_mentions("406 West 25th Street", lookup, english)
    assert (
        mention.warning
        == "'406 West 25th Street' is not on the map; 402 and 410 are, so a place between them is assumed"
    )
    assert {m.form for m in find_mentions("990 West 25th Street", lookup, english)} == {"street", "unknown"}


def test_the_number_is_elsewhere_than_its_street(lookup, english) -> None:
    forms = [(m.form, m.text) for m in find_mentions("on West 25th Street, at the door of 402", lookup, english)]
    assert ("address", "402") in forms


def place(text: str, name: str, number: int) -> Mention:
    start = text.index(name)
    return Mention(name, start, start + len(name), "street", np.array([number]), np.ones(1))


def test_a_number_at_a_corner_may_be_of_either_street() -> None:
    text = "hoek van Elmstraat en Oakstraat. Rechts is huisnummer 9"
    lookup = SimpleNamespace(
        address=lambda _number, streets: AddressMatch(streets + 10, NO_LINES, NumberMatch(("9",))),
        has_numbers=lambda _name: False,
    )
    mentions = add_addresses([place(text, "Elmstraat", 1), place(text, "Oakstraat", 2)], text, lookup)
    [address] = [mention for mention in mentions if mention.form == "address"]
    assert dict(zip(address.objects.tolist(), address.weights.tolist(), strict=True)) == {12: 1.0, 11: 0.5}


def test_a_whole_name_with_numbers_is_rather_meant_than_a_street_of_a_part_of_it() -> None:
    text = "67 Boulevard de Rochechouart"
    lookup = SimpleNamespace(
        address=lambda _number, _streets: None,
        has_numbers=lambda name: name == ("boulevard", "de", "rochechouart"),
        address_of_names=lambda _number, _names: AddressMatch(np.array([5]), NO_LINES, NumberMatch(("67",))),
    )
    [address] = add_addresses([place(text, "Rochechouart", 1)], text, lookup)
    assert (address.form, address.text, address.objects.tolist()) == ("address", text, [5])


def test_the_city_and_country_at_the_end_are_left_out(lookup) -> None:
    assert without_city("next to Bottino, New York, USA", lookup) == "next to Bottino"
    assert without_city("next to Elmo, Rossi Bakery, Bottino", lookup) == "next to Elmo, Rossi Bakery, Bottino"
    assert without_city("Helsinki, Finland", lookup) == "Helsinki, Finland"


@pytest.mark.parametrize("tail", ["A-" * 1900, "A " * 1900, "A." * 1900])
def test_a_long_tail_takes_no_time(lookup, english, tail) -> None:
    text = f"402 West 25th Street, {tail}@"
    start_s = time.process_time()
    find_mentions(text, lookup, english)
    without_city(text, lookup)
    assert time.process_time() - start_s < 5
