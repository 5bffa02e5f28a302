import numpy as np
import pytest

from models.citymap.frame import Frame
from models.citymap.gazetteer.gazetteer import build_gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND, GazetteerObject
from models.citymap.kinds.vocabulary import load_vocabulary
from models.language.mentions.codes.reader import CodeReader
from models.language.mentions.lookup import Lookup
from tests.models.citymap.gazetteer.made_town import is_common, line, point

FRAME = Frame(origin_lat=60.1699, origin_lon=24.9384)
HOUSES = [(x, y) for x in (0.0, 100.0, 200.0) for y in (0.0, 100.0)]


@pytest.fixture(scope="module")
def codes() -> CodeReader:
    objects = [
        (GazetteerObject(("highway/bus_stop",), ("Market",), codes=("stop h2002",)), point(10.0, 10.0)),
        (GazetteerObject(("railway/subway_entrance",), codes=("exit f",)), point(50.0, 10.0)),
        (GazetteerObject((STREET_KIND,), ("Main Road",), codes=("road b96",)), line((0.0, 50.0), (200.0, 50.0))),
        *((GazetteerObject(("address",), (), "1", "Main Road", codes=("post 00120",)), point(x, y)) for x, y in HOUSES),
    ]
    words, segments = zip(*objects, strict=True)
    gazetteer = build_gazetteer(words, segments, [False] * len(objects))
    corners = np.array([[-500.0, -500.0], [500.0, 500.0]])
    return CodeReader(Lookup(gazetteer, load_vocabulary(), is_common), FRAME, corners)


def test_coordinates_are_a_point_of_the_map(codes) -> None:
    (mention,) = codes.find("at 60.16990, 24.93840")
    assert (mention.form, mention.is_exact, mention.note) == ("point", True, "")
    assert mention.lines_m == pytest.approx(np.zeros((1, 4)), abs=0.1)


def test_exchanged_coordinates_are_used_with_a_warning(codes) -> None:
    (mention,) = codes.find("24.93840, 60.16990")
    assert mention.lines_m == pytest.approx(np.zeros((1, 4)), abs=0.1)
    assert "longitude and latitude" in mention.warning


def test_coordinates_outside_the_map_are_not_used(codes) -> None:
    (mention,) = codes.find("61.50000, 24.93840")
    assert (mention.form, len(mention.lines_m)) == ("unknown", 0)
    assert "outside the map" in mention.warning


@pytest.mark.parametrize("code", ["9GG65W9Q+X9", "5W9Q+X9"])
def test_a_plus_code_is_its_square(codes, code) -> None:
    (mention,) = codes.find(f"I'm at {code}")
    assert mention.form == "point"
    assert np.abs(mention.lines_m).max() < 10.0


@pytest.mark.parametrize(("text", "row"), [("stop H2002", 0), ("exit F", 1), ("on the B96", 2), ("road B96", 2)])
def test_a_reference_means_its_object(codes, text, row) -> None:
    (mention,) = codes.find(text)
    assert mention.objects.tolist() == [row]


def test_a_reference_that_the_map_lacks_is_unknown(codes) -> None:
    (mention,) = codes.find("stop H9999")
    assert mention.form == "unknown"


def test_a_postcode_is_the_area_of_its_addresses(codes) -> None:
    (mention,) = codes.postcodes("00120 Helsinki", [])
    low, high = mention.lines_m.reshape(-1, 2).min(axis=0), mention.lines_m.reshape(-1, 2).max(axis=0)
    assert (low < [0.0, 20.0]).all()
    assert (high > [200.0, 80.0]).all()
    assert list(codes.postcodes("I have 00120 coins", [])) == []


@pytest.mark.parametrize("text", ["///filled.count.soap", "what3words: filled.count.soap"])
def test_what_cannot_be_decoded_is_named(codes, text) -> None:
    (mention,) = codes.find(text)
    assert "cannot be decoded" in mention.warning
