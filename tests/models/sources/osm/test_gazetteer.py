from pathlib import Path

import numpy as np
import pytest

from models.citymap.frame import Frame
from models.citymap.gazetteer.gazetteer import ADDRESS_KIND, WALKED_KIND, Gazetteer
from models.citymap.gazetteer.name_columns import STREET_KIND
from models.errors import MapError
from models.sources.osm.gazetteer import MAX_NAMES, load_gazetteer

FRAME = Frame("map", 60.0, 25.0)
LAT_M, LON_M = 1 / 111_412.0, 1 / 55_800.0  # degrees a metre, near enough at 60 degrees
Place = tuple[float, float]


class Map:
    """OpenStreetMap XML, written piece by piece."""

    def __init__(self) -> None:
        self.nodes, self.ways, self.relations = [], [], []

    def node(self, position: Place, **tags: str) -> int:
        x, y = position
        number = len(self.nodes) + 1
        lat, lon = f"{60 + y * LAT_M:.8f}", f"{25 + x * LON_M:.8f}"
        self.nodes.append(f'<node id="{number}" version="1" lat="{lat}" lon="{lon}">{written(tags)}</node>')
        return number

    def way(self, refs: list[int], **tags: str) -> int:
        number = len(self.ways) + 1
        body = "".join(f'<nd ref="{ref}"/>' for ref in refs)
        self.ways.append(f'<way id="{number}" version="1">{body}{written(tags)}</way>')
        return number

    def line(self, *position: Place, **tags: str) -> int:
        return self.way([self.node(place) for place in position], **tags)

    def ring(self, low: float, high: float, **tags: str) -> int:
        refs = [self.node(position) for position in ((low, low), (high, low), (high, high), (low, high))]
        return self.way([*refs, refs[0]], **tags)

    def relation(self, members: dict[int, str], **tags: str) -> int:
        number = len(self.relations) + 1
        body = "".join(f'<member type="way" ref="{ref}" role="{role}"/>' for ref, role in members.items())
        self.relations.append(f'<relation id="{number}" version="1">{body}{written(tags)}</relation>')
        return number

    def load(self, folder: Path) -> Gazetteer:
        path = folder / "map.osm"
        content = "".join(self.nodes + self.ways + self.relations)
        path.write_text(f"<?xml version='1.0' encoding='UTF-8'?><osm version='0.6'>{content}</osm>", encoding="utf-8")
        return load_gazetteer(path, FRAME)


def written(tags: dict[str, str]) -> str:
    return "".join(f'<tag k="{key.replace("__", ":")}" v="{value}"/>' for key, value in tags.items())


def segments(gazetteer: Gazetteer, number: int) -> np.ndarray:
    return gazetteer.segments_m[gazetteer.starts[number] : gazetteer.starts[number + 1]]


def names(gazetteer: Gazetteer) -> list[str]:
    return [words.names[0] for words in gazetteer.objects if words.names]


@pytest.fixture
def osm() -> Map:
    """A street, so that there is something."""
    made = Map()
    made.line((0, 900), (100, 900), highway="residential", name="High Street")
    return made


def test_streets_that_share_a_node_meet_there(tmp_path) -> None:
    osm = Map()
    middle = osm.node((50, 0))
    osm.way([osm.node((0, 0)), middle, osm.node((100, 0))], highway="residential", name="Main Street")
    osm.way([osm.node((50, -60)), middle, osm.node((50, 60))], highway="secondary", name="Oak Avenue")
    result = osm.load(tmp_path)
    assert [words.kinds for words in result.objects] == [(STREET_KIND,), (STREET_KIND,), (WALKED_KIND,)]
    assert names(result) == ["Main Street", "Oak Avenue"]
    assert result.corner_streets.tolist() == [[0, 1]]
    assert result.corners_m[0] == pytest.approx([50, 0], abs=0.3)
    assert not result.is_area.any()


def test_a_bridge_crosses_without_a_shared_node(tmp_path) -> None:
    osm = Map()
    osm.line((0, 0), (100, 0), highway="residential", name="Main Street")
    osm.line((30, -60), (30, 60), highway="primary", name="High Bridge", bridge="yes", layer="1")
    result = osm.load(tmp_path)
    assert result.corner_streets.tolist() == [[0, 1]]
    assert result.corners_m[0] == pytest.approx([30, 0], abs=0.3)


def test_a_street_in_pieces_is_one_object(tmp_path, osm) -> None:
    osm.line((100, 900), (160, 900), highway="residential", name="High Street")
    osm.line((300, 900), (360, 900), highway="footway", name="High Street")
    result = osm.load(tmp_path)
    assert names(result) == ["High Street"]
    assert len(segments(result, 0)) == 3
    assert result.reach_m[0] == pytest.approx(180, abs=1)


def test_a_named_shop_has_its_kinds_and_its_place(tmp_path, osm) -> None:
    osm.node((40, 880), shop="bakery", name="Rossi")
    result = osm.load(tmp_path)
    shop = result.objects[0]
    assert shop.names == ("Rossi",)
    assert shop.kinds[0] == "shop/bakery"
    assert "shop" in shop.kinds
    assert shop.source_id == f"node/{len(osm.nodes)}"
    assert segments(result, 0)[0] == pytest.approx([40, 880, 40, 880], abs=0.5)
    assert result.by_kind[STREET_KIND].tolist() == [1], "streets come last"


def test_a_building_with_a_house_number_has_its_address(tmp_path, osm) -> None:
    way = osm.ring(20, 40, building="yes", addr__housenumber="12a", addr__street="High Street")
    result = osm.load(tmp_path)
    house = result.objects[0]
    assert (house.number, house.street, house.names) == ("12a", "High Street", ())
    assert house.kinds == ("building",)
    assert house.source_id == f"way/{way}"
    assert result.is_area[0]
    assert result.middles_m[0] == pytest.approx([30, 30], abs=0.5)


def test_a_node_with_a_house_number_alone_is_an_address(tmp_path, osm) -> None:
    osm.node((5, 5), addr__housenumber="7", addr__street="High Street")
    osm.node((9, 9), addr__housenumber="8")
    result = osm.load(tmp_path)
    kinds = [words.kinds for words in result.objects]
    assert kinds == [(ADDRESS_KIND,), (STREET_KIND,), (WALKED_KIND,)], "a number without a street is no address"


def test_a_multipolygon_park_keeps_its_hole(tmp_path, osm) -> None:
    outer, inner = osm.ring(100, 300), osm.ring(150, 250)
    relation = osm.relation({outer: "outer", inner: "inner"}, type="multipolygon", leisure="park", name="Green Park")
    result = osm.load(tmp_path)
    assert result.objects[0].source_id == f"relation/{relation}"
    assert "leisure/park" in result.objects[0].kinds
    assert result.is_area[0]
    assert len(segments(result, 0)) == 8
    assert np.ptp(segments(result, 0)[:, 0]) == pytest.approx(200, abs=1)


@pytest.mark.parametrize(
    ("tags", "expected"),
    [
        ({"name": "Café Zoë"}, ("Café Zoë",)),
        ({"name": "Alt; Neu ;"}, ("Alt", "Neu")),
        ({"name": "Кафе", "name__en": "Cafe", "alt_name": "The Caff"}, ("Кафе", "Cafe", "The Caff")),
        ({"name": "Same", "name__en": "Same", "brand": "Same"}, ("Same",)),
        ({"name": "A", "name__fi": "B", "alt_name__sv": "C", "name__pronunciation": "ei"}, ("A", "C", "B")),
        ({"operator": "City Coffee"}, ("City Coffee",)),
        ({"name": "A", "operator": "City Coffee"}, ("A",)),
        ({}, ()),
    ],
)
def test_all_names_of_a_thing(tmp_path, osm, tags, expected) -> None:
    osm.node((1, 1), amenity="cafe", **tags)
    assert osm.load(tmp_path).objects[0].names == expected


def test_names_are_not_without_end(tmp_path, osm) -> None:
    osm.node((1, 1), amenity="cafe", name=";".join(f"Name {n}" for n in range(90)))
    result = osm.load(tmp_path).objects[0].names
    assert len(result) == MAX_NAMES
    assert result[0] == "Name 0"


def test_what_nobody_would_name_is_left_out(tmp_path, osm) -> None:
    osm.line((0, 0), (50, 0), highway="footway")
    osm.ring(20, 40, building="yes")
    osm.node((3, 3), source="survey")
    osm.relation({1: "forward"}, type="route", route="bus", name="Bus 12")
    assert names(osm.load(tmp_path)) == ["High Street"]


@pytest.mark.parametrize("state", ["proposed", "construction"])
def test_a_street_that_is_not_built_is_left_out(tmp_path, osm, state) -> None:
    osm.line((0, 9), (50, 9), highway=state, name="Someday Street")
    assert names(osm.load(tmp_path)) == ["High Street"]


def test_a_way_with_an_operator_alone_is_no_street(tmp_path, osm) -> None:
    osm.line((0, 0), (50, 0), highway="footway", operator="City Works")
    assert names(osm.load(tmp_path)) == ["High Street"]


def test_steps_without_a_name_are_kept_as_a_kind(tmp_path, osm) -> None:
    osm.line((0, 0), (10, 0), highway="steps")
    result = osm.load(tmp_path)
    assert result.objects[0].kinds[0] == "highway/steps"
    assert result.objects[0].names == ()
    assert not result.is_area[0]


def test_what_is_underground_can_be_named(tmp_path, osm) -> None:
    osm.node((1, 1), railway="station", station="subway", name="Deep Station", layer="-2", location="underground")
    assert "Deep Station" in names(osm.load(tmp_path))


def test_a_room_is_no_place_of_the_city(tmp_path, osm) -> None:
    osm.ring(20, 30, indoor="room", shop="kiosk", name="Room 5")
    assert names(osm.load(tmp_path)) == ["High Street"]


def test_a_broken_ring_keeps_its_name(tmp_path, osm) -> None:
    half = osm.line((0, 0), (50, 0), (50, 50))
    osm.relation({half: "outer"}, type="multipolygon", leisure="park", name="Half Park")
    bow = [osm.node(position) for position in ((0, 0), (50, 50), (50, 0), (0, 50))]
    osm.way([*bow, bow[0]], leisure="park", name="Crossed Park")
    osm.node((5, 5), shop="bakery", name="Rossi")
    result = osm.load(tmp_path)
    assert names(result) == ["Rossi", "Crossed Park", "Half Park", "High Street"]
    assert result.is_area.tolist()[:3] == [False, True, False]


def test_a_way_has_what_the_extract_has_of_it(tmp_path, osm) -> None:
    osm.way([9001, 9002], highway="residential", name="Lost Street")
    osm.way([1], highway="residential", name="Dot Street")
    assert names(osm.load(tmp_path)) == ["High Street", "Dot Street"]


def test_a_round_street_is_a_line_and_a_square_an_area(tmp_path, osm) -> None:
    osm.ring(0, 60, highway="residential", name="Ring Street")
    osm.ring(100, 160, place="square", name="Old Square")
    result = osm.load(tmp_path)
    area = {w.names[0]: bool(is_area) for w, is_area in zip(result.objects, result.is_area, strict=True) if w.names}
    assert area == {"Old Square": True, "High Street": False, "Ring Street": False}


def test_outlines_are_simplified_but_little(tmp_path, osm) -> None:
    corners = [(0.0, 0.0), (50.0, 0.2), (100.0, 0.0), (100.0, 80.0), (0.0, 80.0)]
    refs = [osm.node(position) for position in corners]
    osm.way([*refs, refs[0]], leisure="park", name="Park")
    assert len(segments(osm.load(tmp_path), 0)) == 4


def test_a_map_without_names_is_empty(tmp_path) -> None:
    osm = Map()
    osm.line((0, 0), (50, 0), highway="footway")
    result = osm.load(tmp_path)
    assert len(result) == 0
    assert result.corners_m.shape == (0, 2)


def test_all_that_people_walk_on_is_one_object(tmp_path, osm) -> None:
    osm.line((0, 0), (50, 0), highway="footway")
    osm.line((0, 30), (50, 30), highway="motorway")
    osm.line((0, 60), (50, 60), highway="footway", indoor="yes")
    result = osm.load(tmp_path)
    [walked] = result.by_kind[WALKED_KIND]
    assert sorted(segments(result, walked)[:, 1].round().tolist()) == [0, 900], "the footway and the street"
    assert not result.objects[walked].names


def test_a_map_without_streets(tmp_path) -> None:
    osm = Map()
    osm.node((5, 5), shop="bakery", name="Rossi")
    result = osm.load(tmp_path)
    assert names(result) == ["Rossi"]
    assert not len(result.corners_m)


@pytest.mark.parametrize("content", [None, b"no XML"])
def test_files_that_cannot_be_read_are_refused(tmp_path, content) -> None:
    path = tmp_path / "map.osm"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(MapError, match="cannot be read"):
        load_gazetteer(path, FRAME)


def test_the_made_up_town_has_its_streets(osm_file, city) -> None:
    result = load_gazetteer(osm_file, city.frame)
    streets = {result.objects[n].names[0] for n in result.by_kind[STREET_KIND]}
    assert streets == {f"East Street {n}" for n in range(6)} | {f"North Path {n}" for n in range(6)}
    assert 16 <= len(result.corner_streets) <= 36, "those at the edge may miss each other by a millimetre"
    assert {"amenity/bench", "highway/street_lamp", "natural/tree"} <= result.by_kind.keys()


def test_a_district_that_is_a_point_is_an_area(osm, tmp_path) -> None:
    osm.node((0, 0), place="neighbourhood", name="Kallio")
    osm.node((0, 50), amenity="cafe", name="Ekberg")
    gazetteer = osm.load(tmp_path)
    kallio, ekberg = (names(gazetteer).index(name) for name in ("Kallio", "Ekberg"))
    assert gazetteer.is_area[[kallio, ekberg]].tolist() == [True, False]
    assert np.hypot(*segments(gazetteer, kallio)[:, :2].T) == pytest.approx(300.0, rel=0.01)


def test_the_name_of_a_house_is_not_that_of_a_shop_in_it(osm, tmp_path) -> None:
    osm.node((0, 0), shop="toys", name="Kids Park", addr__housename="Stockmann")
    osm.ring(100, 120, building="yes", addr__housename="Argos")
    known = {name for words in osm.load(tmp_path).objects for name in words.names}
    assert {"Kids Park", "Argos"} <= known
    assert "Stockmann" not in known
