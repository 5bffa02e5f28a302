"""A city made of copies: copy 0 as it was, the others beside it with names of their own."""

from collections import Counter, defaultdict
from itertools import combinations, pairwise

import numpy as np
import osmium
import pytest

from models.citymap.frame import Frame
from models.citymap.gazetteer.name_columns import STREET_KIND
from models.errors import MapError
from models.sources.osm.city_copies import CityExtract, CopyGrid
from models.sources.osm.gazetteer import load_gazetteer
from models.sources.osm.map import load_osm

COPIES = 5
LETTERS = {"n": 0, "w": 1, "r": 2}
BAKERIES = [("Ada", "Aada"), ("Bo", None), ("Cy", "Syy"), ("Dee", None), ("Eve", None), ("Flo", None)]
TOWN = """<?xml version='1.0' encoding='UTF-8'?><osm version='0.6'>
<bounds minlat="60.0" minlon="25.0" maxlat="60.002" maxlon="25.003"/>
{bakeries}
<node id="11" version="1" lat="60.001" lon="25.0005"><tag k="amenity" v="cafe"/><tag k="name" v="Alone"/></node>
<node id="12" version="1" lat="60.0015" lon="25.001"><tag k="highway" v="bus_stop"/><tag k="name" v="High Road"/></node>
<node id="13" version="1" lat="60.0012" lon="25.001"><tag k="addr:housenumber" v="7"/>
<tag k="addr:street" v="High Road"/><tag k="addr:street:sv" v="Hög väg"/></node>
<node id="14" version="1" lat="60.0013" lon="25.001"><tag k="addr:street" v="Far Lane"/></node>
<node id="21" version="1" lat="60.0" lon="25.0"/><node id="22" version="1" lat="60.0" lon="25.003"/>
<node id="23" version="1" lat="60.002" lon="25.003"/><node id="24" version="1" lat="60.002" lon="25.0"/>
<way id="5" version="1"><nd ref="21"/><nd ref="22"/><nd ref="99"/><tag k="highway" v="residential"/>
<tag k="name" v="High Road"/><tag k="name:sv" v="Hög väg"/><tag k="old_name:fi" v="Vanha"/></way>
<way id="6" version="1"><nd ref="22"/><nd ref="23"/><tag k="highway" v="service"/><tag k="name" v="high road"/></way>
<way id="7" version="1"><nd ref="23"/><nd ref="24"/><tag k="highway" v="residential"/><tag k="name" v="Low Road"/></way>
<way id="8" version="1"><nd ref="21"/><nd ref="22"/><nd ref="23"/><nd ref="24"/><nd ref="21"/></way>
<relation id="3" version="1"><member type="way" ref="8" role="outer"/><member type="node" ref="11" role="x"/>
<tag k="type" v="multipolygon"/><tag k="building" v="yes"/></relation></osm>"""


@pytest.fixture(scope="module")
def town(tmp_path_factory):
    bakeries = "".join(
        f'<node id="{n}" version="1" lat="60.0005" lon="25.00{n}"><tag k="shop" v="bakery"/><tag k="name" v="{name}"/>'
        + (f'<tag k="name:fi" v="{own}"/><tag k="brand" v="{name}s"/>' if own else "")
        + "</node>"
        for n, (name, own) in enumerate(BAKERIES, 1)
    )
    path = tmp_path_factory.mktemp("town") / "town.osm"
    path.write_text(TOWN.format(bakeries=bakeries), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def extract(town):
    return CityExtract.read(town)


@pytest.fixture(scope="module")
def tiled(extract, tmp_path_factory):
    path = tmp_path_factory.mktemp("tiled") / "city.osm.pbf"
    extract.write_tiled(COPIES, path)
    return path


def element(result) -> tuple:
    """Return the tags of an element, and its position, refs or members."""
    letter = result.type_str()
    rest: tuple = ()
    if letter == "n":
        rest = result.location.x, result.location.y
    elif letter == "w":
        rest = tuple(node.ref for node in result.nodes)
    elif letter == "r":
        rest = tuple((member.type, member.ref, member.role) for member in result.members)
    return dict(result.tags), rest


def elements(path) -> list[tuple]:
    return [(result.type_str(), result.id, *element(result)) for result in osmium.FileProcessor(str(path))]


@pytest.fixture(scope="module")
def by_copy(tiled, extract):
    """Map each copy to {(letter, number in the extract): (tags, rest)}."""
    result = defaultdict(dict)
    for letter, number, *what in elements(tiled):
        copy, own = divmod(number, extract.numbers[letter])
        assert (letter, own) not in result[copy], "numbers are unique"
        result[copy][letter, own] = what
    return result


def test_copy_0_is_the_extract(town, by_copy) -> None:
    assert {(letter, number): what for letter, number, *what in elements(town)} == by_copy[0]


def test_every_copy_has_every_element_and_refers_to_its_own(by_copy, extract, tiled) -> None:
    assert sorted(by_copy) == list(range(COPIES))
    nodes = {number for letter, number, *_ in elements(tiled) if letter == "n"}
    for copy, result in by_copy.items():
        assert result.keys() == by_copy[0].keys()
        assert 99 + copy * extract.numbers["n"] not in nodes, "what the extract lacks is in no other copy"
        by = {letter: copy * count for letter, count in extract.numbers.items()}
        assert result["w", 5][1] == tuple(ref + by["n"] for ref in (21, 22, 99))
        assert result["r", 3][1] == (("w", 8 + by["w"], "outer"), ("n", 11 + by["n"], "x"))
        assert result["r", 3][0] == {"type": "multipolygon", "building": "yes"}


def test_a_file_is_in_osmium_s_order(tiled) -> None:
    keys = [(LETTERS[letter], number) for letter, number, *_ in elements(tiled)]
    assert all(one < two for one, two in pairwise(keys))


def test_copies_lie_side_by_side_in_the_header_s_box(by_copy, tiled) -> None:
    boxes = []
    for result in by_copy.values():
        places = np.array([rest for (letter, _), (_, rest) in result.items() if letter == "n"])
        boxes.append((places.min(axis=0), places.max(axis=0)))
        assert np.array_equal(boxes[-1][1] - boxes[-1][0], boxes[0][1] - boxes[0][0])
    for (low, high), (other_low, other_high) in combinations(boxes, 2):
        assert (high < other_low).any() or (other_high < low).any()
    header = osmium.io.Reader(str(tiled)).header().box()
    west, south = np.min([low for low, _ in boxes], axis=0)
    east, north = np.max([high for _, high in boxes], axis=0)
    corners = header.bottom_left, header.top_right
    assert [(corner.x, corner.y) for corner in corners] == [(west, south), (east, north)]
    wide, high = (east - west) * np.cos(np.radians(60)), north - south
    assert 0.5 < wide / high < 2


def test_streets_of_a_copy_have_names_that_no_other_has(by_copy) -> None:
    uses = Counter()
    for copy in range(1, COPIES):
        result = by_copy[copy]
        high, again, low = (result["w", number][0]["name"] for number in (5, 6, 7))
        assert high == again, "one street in two pieces, in whatever case"
        assert result["w", 5][0] == {"highway": "residential", "name": high}, "no other language, no old name"
        assert result["n", 13][0] == {"addr:housenumber": "7", "addr:street": high}
        uses.update([high, low, result["n", 14][0]["addr:street"]])
    assert set(uses.values()) == {1}
    assert len(uses) == 3 * (COPIES - 1)
    assert not {"high road", "low road", "far lane"} & {name.casefold() for name in uses}


def test_things_of_a_kind_swap_names_with_all_that_belongs_to_them(by_copy) -> None:
    names = dict(BAKERIES)
    orders = []
    for result in by_copy.values():
        tags = [result["n", number][0] for number in range(1, len(BAKERIES) + 1)]
        assert sorted(one["name"] for one in tags) == sorted(names)
        for one in tags:
            own = names[one["name"]]
            assert one["shop"] == "bakery"
            assert one.get("name:fi") == own
            assert one.get("brand") == (f"{one['name']}s" if own else None)
        orders.append(tuple(one["name"] for one in tags))
        assert result["n", 11][0]["name"] == "Alone", "the only one of its kind"
        assert result["n", 12][0]["name"] == "High Road", "a stop is no street"
    assert len(set(orders)) > COPIES / 2


def test_the_same_names_come_again(town, tiled, tmp_path) -> None:
    CityExtract.read(town).write_tiled(COPIES, tmp_path / "again.osm.pbf")
    assert elements(tmp_path / "again.osm.pbf") == elements(tiled)


def test_a_tiled_city_is_read_with_as_many_times_the_streets(osm_file, city, tmp_path) -> None:
    out = tmp_path / "city.osm.pbf"
    block = CityExtract.read(osm_file).write_tiled(4, out)
    result = load_osm(out)
    names = Counter(instance.label for instance in city.instances if instance.name)
    assert names
    assert Counter(instance.label for instance in result.instances if instance.name) == Counter(
        {label: 4 * count for label, count in names.items()}
    )
    assert len({i.name for i in result.instances}) - 1 == 4 * (len({i.name for i in city.instances}) - 1)
    own = [load_gazetteer(path, map_.frame) for path, map_ in ((osm_file, city), (out, result))]
    streets, corners = ([len(g.by_kind[STREET_KIND]) for g in own], [len(g.corners_m) for g in own])
    assert streets[1] == 4 * streets[0]
    assert corners[1] > 3 * corners[0], "streets that end on another one's line meet it or not, by rounding"
    assert len(result.locations_m) == pytest.approx(4 * len(city.locations_m), rel=0.15)
    lat, lon = city.frame.to_wgs84(city.locations_m[:1])
    shifted = lat[0] + block.shift(3)[1] / 1e7, lon[0] + block.shift(3)[0] / 1e7
    assert block.to_first_copy(*shifted) == pytest.approx((lat[0], lon[0]), abs=1e-9)
    near = result.frame.from_wgs84(*map(np.array, shifted))
    assert np.hypot(*(result.locations_m[:, :2] - near).T).min() < 2.5


@pytest.mark.parametrize(("copies", "columns"), [(1, 1), (4, 2), (5, 2), (100, 10), (101, 10)])
def test_a_block_is_as_wide_as_high(copies, columns) -> None:
    side_m = 1000
    frame = Frame("map", 0.0, 25.0)
    (south, north), (west, east) = frame.to_wgs84(np.array([[0, 0], [side_m, side_m]]))
    block = CopyGrid(tuple(round(1e7 * each) for each in (west, south, east, north)), copies)
    assert block.columns == columns
    assert len({block.shift(copy) for copy in range(copies)}) == copies


def test_what_does_not_fit_on_earth_and_what_is_no_map_is_said(extract, tmp_path) -> None:
    with pytest.raises(MapError, match="fewer cells"):
        extract.write_tiled(300_000_000, tmp_path / "a.osm.pbf")
    with pytest.raises(MapError, match="as --map"):
        CityExtract.read(tmp_path / "nothing.osm.pbf")
    (tmp_path / "bad.osm.pbf").write_bytes(b"no" * 100)
    with pytest.raises(MapError, match="download it again"):
        CityExtract.read(tmp_path / "bad.osm.pbf")
    (tmp_path / "empty.osm").write_text("<?xml version='1.0'?><osm version='0.6'></osm>")
    with pytest.raises(MapError, match="no positions"):
        CityExtract.read(tmp_path / "empty.osm")
    with pytest.raises(MapError, match="cannot be written"):
        extract.write_tiled(2, tmp_path / "no" / "such.osm.pbf")
