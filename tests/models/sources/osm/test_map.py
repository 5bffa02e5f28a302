import re
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
import shapely

from models.citymap.colours import parse_colour
from models.errors import MapError
from models.sources.osm.classes import OsmClass, find_class, load_classes
from models.sources.osm.extent import read_extent
from models.sources.osm.map import load_osm

HEADER = "<?xml version='1.0' encoding='UTF-8'?><osm version='0.6'>"
STREET = (
    '<node id="1" lat="60.0" lon="25.0"/><node id="2" lat="60.0" lon="25.001"/><node id="3" lat="60.0" lon="25.002"/>'
    '<way id="1"><nd ref="1"/><nd ref="2"/><tag k="highway" v="residential"/><tag k="name" v="High Street"/></way>'
)


def write(tmp_path: Path, body: str) -> Path:
    path = tmp_path / "map.osm"
    path.write_text(HEADER + STREET + body + "</osm>")
    return path


def instances(tmp_path: Path, body: str, label: str):
    return [i for i in load_osm(write(tmp_path, body)).instances if i.label == label]


def only(tmp_path: Path, body: str, label: str):
    """The one instance of a class, what it is made of, and its map."""
    city = load_osm(write(tmp_path, body))
    (result,) = (i for i in city.instances if i.label == label)
    return result, geometry_of(city, result), city


def test_reads_all_kinds_of_a_town(city) -> None:
    count = Counter(i.label for i in city.instances)
    assert count["building"] == 25
    assert count["road"] == 6, "streets of two ways are one instance each"
    assert set(count) == {
        "building",
        "road",
        "footpath",
        "street lamp",
        "tree",
        "bench",
        "bollard",
        "trash bin",
        "post box",
    }
    assert [i.id for i in city.instances] == list(range(len(city.instances)))
    assert city.frame.is_georeferenced
    assert {"building", "road", "footpath"} <= city.stuff
    assert "tree" not in city.stuff


BOX = '<bounds minlat="59.999" minlon="24.999" maxlat="60.005" maxlon="25.003"/>'


@pytest.mark.parametrize("box", [BOX, ""])
def test_the_frame_is_known_before_the_map_is_read(tmp_path, box) -> None:
    path = tmp_path / "map.osm"
    path.write_text(HEADER + box + STREET + "</osm>")
    assert read_extent(path).frame == load_osm(path).frame
    assert read_extent(path).frame.origin_lat == pytest.approx(60.002 if box else 60.0)
    assert read_extent(path).frame.origin_lon == pytest.approx(25.001 if box else 25.0005)


def labels(path: Path) -> set[str]:
    return {instance.label for instance in load_osm(path).instances}


def test_a_box_beside_the_map_is_ignored(tmp_path, caplog) -> None:
    path = tmp_path / "map.osm"
    path.write_text(HEADER + '<bounds minlat="50" minlon="24" maxlat="51" maxlon="25"/>' + STREET + "</osm>")
    assert labels(path) == {"road"}
    assert read_extent(path).frame.origin_lat == pytest.approx(60)
    assert "inside its bounds" in caplog.text


def test_objects_on_the_edge_of_the_box_are_inside(tmp_path) -> None:
    path = tmp_path / "map.osm"
    box = '<bounds minlat="60" minlon="25" maxlat="60.001" maxlon="25.001"/>'
    path.write_text(f'{HEADER}{box}{STREET}<node id="9" lat="60.001" lon="25.001">{BENCH}</node></osm>')
    assert labels(path) == {"road", "bench"}


BENCH = '<tag k="amenity" v="bench"/>'
STRAY = f'<node id="555" lat="0" lon="0">{BENCH}</node>'
ALL_OF_IT = '<bounds minlat="0" minlon="0" maxlat="60.01" maxlon="25.01"/>'


@pytest.mark.parametrize("box", ["", ALL_OF_IT])
@pytest.mark.parametrize(("lat", "lon"), [("0", "0"), ("0", "25"), ("60", "100"), ("60.001", "-155")])
def test_an_element_far_from_the_rest_is_left_out_and_named(tmp_path, caplog, lat, lon, box) -> None:
    path = tmp_path / "map.osm"
    stray = STRAY.replace('lat="0" lon="0"', f'lat="{lat}" lon="{lon}"')
    path.write_text(HEADER + box + STREET + stray + "</osm>")
    assert labels(path) == {"road"}
    assert read_extent(path).frame.origin_lat == pytest.approx(60, abs=0.001)
    assert f"map: left out what is more than 50 km from the rest, such as node/555 at latitude {lat}" in caplog.text


def test_of_a_way_with_one_node_far_away_the_rest_is_used(tmp_path, caplog) -> None:
    body = (
        '<node id="9" lat="-33.5" lon="151.25"/><way id="5"><nd ref="1"/><nd ref="9"/><tag k="barrier" v="wall"/></way>'
    )
    assert "road" in labels(write(tmp_path, body))
    assert "way/5 at latitude -33.5, longitude 151.25" in caplog.text


def test_halves_of_a_map_are_both_used_or_refused(tmp_path) -> None:
    near = '<node id="9" lat="62.0" lon="25"/><node id="10" lat="62.0" lon="25.001"/>'
    road = '<way id="5"><nd ref="9"/><nd ref="10"/><tag k="highway" v="residential"/></way>'
    path = write(tmp_path, near + road)
    assert read_extent(path).frame.origin_lat == pytest.approx(61, abs=0.001)
    path = write(tmp_path, near.replace("62.0", "-10.0") + road)
    with pytest.raises(MapError, match=r"(way/5 at latitude -10|way/1 at latitude 60), longitude 25.*: remove it"):
        load_osm(path)


def test_an_element_far_away_is_left_out_by_a_box(tmp_path) -> None:
    path = tmp_path / "map.osm"
    path.write_text(HEADER + BOX + STREET + STRAY + "</osm>")
    assert {i.label for i in load_osm(path).instances} == {"road"}


def shifted(body: str, east_deg: float) -> str:
    """A map's elements moved east, across 180 degrees."""
    return re.sub(r'lon="([\d.]+)"', lambda lon: f'lon="{(float(lon[1]) + east_deg + 180) % 360 - 180:.7f}"', body)


ACROSS_180 = '<bounds minlat="59.999" minlon="179.9985" maxlat="60.005" maxlon="-179.9975"/>'


@pytest.mark.parametrize(("box", "across"), [(BOX, ACROSS_180), ("", "")])
def test_a_map_across_180_degrees_is_as_it_would_be_elsewhere(tmp_path, box, across) -> None:
    tree = '<node id="9" lat="60.001" lon="25.0015"><tag k="natural" v="tree"/></node>'
    here, there = tmp_path / "here.osm", tmp_path / "there.osm"
    here.write_text(HEADER + box + STREET + tree + "</osm>")
    there.write_text(HEADER + across + shifted(STREET + tree, 154.9995) + "</osm>")
    cities = [load_osm(path) for path in (here, there)]
    one, other = ([(i.label, i.name, shapely.bounds(geometry_of(city, i))) for i in city.instances] for city in cities)
    assert [each[:2] for each in one] == [each[:2] for each in other]
    np.testing.assert_allclose([each[2] for each in one], [each[2] for each in other], atol=0.02)
    lat, lon = cities[1].frame.to_wgs84(cities[1].locations_m)
    assert (np.abs(lat - 60) < 1e-3).all()
    assert lon.min() < -179.9 < 179.9 < lon.max()


def geometry_of(city, instance):
    pieces = city.pieces
    return shapely.union_all(pieces.geometry(np.flatnonzero(pieces.instance == instance.id)))


def size_of(city, instance):
    west, south, east, north = geometry_of(city, instance).bounds
    return east - west, north - south


def test_geometry_is_metric(city) -> None:
    building = next(i for i in city.instances if i.label == "building")
    assert size_of(city, building) == pytest.approx([18, 18], abs=0.1)
    assert np.ptp(city.pieces.heights_m[city.pieces.instance == building.id]) == pytest.approx(3 * 3.2, abs=0.7)
    road = next(i for i in city.instances if i.label == "road")
    assert size_of(city, road) == pytest.approx([300, 6], abs=0.1)


def test_ground_is_not_shared(city) -> None:
    every = city.pieces.geometry(np.arange(len(city.pieces.instance)))
    ground = every[shapely.area(every) > 0]
    assert shapely.area(ground).sum() == pytest.approx(shapely.area(shapely.union_all(ground)), rel=1e-6)


def test_colour_comes_from_tags_or_is_unknown(city) -> None:
    words = Counter((i.label, None if i.rgb is None else city.palette.word(i.rgb)) for i in city.instances)
    assert words["bench", "green"] == sum(v for (label, _), v in words.items() if label == "bench")
    assert words["road", "gray"] == 6
    assert words["tree", None] == sum(v for (label, _), v in words.items() if label == "tree")
    assert {c for label, c in words if label == "building"} == {"red", "white", "brown", None}


def test_a_road_in_pieces_is_one_and_keeps_its_name(tmp_path) -> None:
    piece = '<way id="2"><nd ref="2"/><nd ref="3"/><tag k="highway" v="residential"/><tag k="name" v="{}"/></way>'
    (road,) = instances(tmp_path, piece.format("High Street"), "road")
    assert road.name == "High Street"
    assert road.source_id == "way/1"
    assert len(instances(tmp_path, piece.format("Low Street"), "road")) == 2


def test_a_lamp_that_carries_a_sign_is_one(tmp_path) -> None:
    lamp = '<node id="9" lat="60.0001" lon="25.0"><tag k="highway" v="street_lamp"/></node>'
    sign = '<node id="10" lat="60.000104" lon="25.0"><tag k="traffic_sign" v="FI:372"/></node>'
    assert len(instances(tmp_path, lamp + sign, "street lamp")) == 1
    assert not instances(tmp_path, lamp + sign, "traffic sign")
    far = sign.replace("60.000104", "60.0002")
    assert len(instances(tmp_path, lamp + far, "traffic sign")) == 1


@pytest.mark.parametrize(
    "tag", ['k="layer" v="-1"', 'k="indoor" v="yes"', 'k="location" v="underground"', 'k="level" v="2"']
)
def test_what_cannot_be_seen_is_left_out(tmp_path, tag) -> None:
    bench = '<node id="9" lat="60.0001" lon="25.0"><tag k="amenity" v="bench"/>{}</node>'
    assert len(instances(tmp_path, bench.format(""), "bench")) == 1
    assert not instances(tmp_path, bench.format(f"<tag {tag}/>"), "bench")


def test_a_closed_path_is_a_loop_and_a_closed_square_an_area(tmp_path) -> None:
    ring = "".join(
        f'<node id="{n}" lat="{lat}" lon="{lon}"/>'
        for n, (lat, lon) in enumerate([(60.001, 25.0), (60.001, 25.001), (60.0016, 25.001), (60.0016, 25.0)], 20)
    )
    refs = "".join(f'<nd ref="{n}"/>' for n in (20, 21, 22, 23, 20))
    path = f'<way id="5">{refs}<tag k="highway" v="footway"/></way>'
    square = f'<way id="5">{refs}<tag k="highway" v="pedestrian"/><tag k="area" v="yes"/></way>'
    _, loop, _ = only(tmp_path, ring + path, "footpath")
    _, filled, _ = only(tmp_path, ring + square, "square")
    assert filled.area > 5 * loop.area


def test_a_multipolygon_keeps_its_hole(tmp_path) -> None:
    def ring(first: int, low: float, high: float) -> str:
        corners = [(low, low), (low, high), (high, high), (high, low)]
        return "".join(f'<node id="{first + n}" lat="{60 + a}" lon="{25 + b}"/>' for n, (a, b) in enumerate(corners))

    def way(number: int, first: int) -> str:
        return f'<way id="{number}">' + "".join(f'<nd ref="{first + n}"/>' for n in (0, 1, 2, 3, 0)) + "</way>"

    relation = (
        '<relation id="7"><member type="way" ref="31" role="outer"/><member type="way" ref="32" role="inner"/>'
        '<tag k="type" v="multipolygon"/><tag k="leisure" v="park"/></relation>'
    )
    body = ring(30, 0.001, 0.003) + ring(40, 0.0015, 0.0025) + way(31, 30) + way(32, 40) + relation
    park, geometry, _ = only(tmp_path, body, "park")
    assert shapely.distance(geometry, geometry.centroid) > 20
    assert park.source_id == "relation/7"


def test_names_heights_and_widths_are_read(tmp_path) -> None:
    ring = "".join(
        f'<node id="{n}" lat="{lat}" lon="{lon}"/>'
        for n, (lat, lon) in enumerate([(60.001, 25.0), (60.001, 25.001), (60.0016, 25.001), (60.0016, 25.0)], 20)
    )
    refs = "".join(f'<nd ref="{n}"/>' for n in (20, 21, 22, 23, 20))
    tags = '<tag k="building" v="yes"/><tag k="height" v="6 m"/><tag k="name" v="Talo"/><tag k="name:en" v="House"/>'
    house, _, city = only(tmp_path, f'{ring}<way id="5">{refs}{tags}</way>', "building")
    assert house.name == "House"
    assert city.pieces.heights_m[city.pieces.instance == house.id].max() == pytest.approx(6, abs=0.7)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("gone.osm.pbf", None, "no such file"),
        ("empty.osm.pbf", b"", "empty"),
        ("noise.osm.pbf", b"\x00\x00\x00\x0d\x0a\x09OSMHeaderjunk" * 50, "cannot be read"),
        ("noise.osm", b"this is no XML", "cannot be read"),
        ("box.osm", (HEADER + '<bounds minlat="x"/></osm>').encode(), "wrong format for coordinate.*; correct it"),
        ("map.txt", b"hello", "not an OpenStreetMap file"),
        ("bare.osm", (HEADER + "</osm>").encode(), "no building, street"),
        (
            "nostreet.osm",
            (HEADER + '<node id="1" lat="60" lon="25"><tag k="natural" v="tree"/></node></osm>').encode(),
            "no street",
        ),
    ],
)
def test_bad_files_say_what_is_wrong(tmp_path, name, content, message) -> None:
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(MapError, match=message):
        load_osm(path)


def test_a_truncated_pbf_is_refused(tmp_path) -> None:
    whole = (Path(__file__).parents[4] / "models/maps/alexanderplatz.osm.pbf").read_bytes()
    path = tmp_path / "cut.osm.pbf"
    path.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(MapError, match="cut short"):
        load_osm(path)


@pytest.mark.parametrize(("lat", "lon"), [("95.0", "25.0"), ("60.0", "185.0")])
def test_coordinates_out_of_range_are_left_out(tmp_path, caplog, lat, lon) -> None:
    path = write(tmp_path, f'<node id="9" lat="{lat}" lon="{lon}"><tag k="natural" v="tree"/></node>')
    assert labels(path) == {"road"}
    assert "map: left out 1 elements with coordinates out of range, such as node/9" in caplog.text


@pytest.mark.parametrize(("lat", "lon"), [("nan", "25.0"), ("60.0", "725.0")])
def test_coordinates_that_are_no_numbers(tmp_path, lat, lon) -> None:
    path = write(tmp_path, f'<node id="9" lat="{lat}" lon="{lon}"><tag k="natural" v="tree"/></node>')
    with pytest.raises(MapError, match=r"map\.osm: cannot be read"):
        load_osm(path)


def test_a_way_without_its_nodes_is_left_out(tmp_path) -> None:
    body = '<way id="5"><nd ref="900"/><nd ref="901"/><tag k="highway" v="residential"/><tag k="name" v="Lost"/></way>'
    assert [i.name for i in instances(tmp_path, body, "road")] == ["High Street"]


def test_the_table_is_well_formed() -> None:
    rows = load_classes()
    assert len(rows) > 60
    assert all(row.height_m > 0 for row in rows if row.shape not in ("ground",))
    assert any(row.walkable for row in rows)


def test_tag_conditions() -> None:
    row = OsmClass("x", "ground", ("highway=footway|path", "name=*", "!area=yes"))
    assert row.matches({"highway": "path", "name": "a"})
    assert not row.matches({"highway": "path"})
    assert not row.matches({"highway": "road", "name": "a"})
    assert not row.matches({"highway": "path", "name": "a", "area": "yes"})


@pytest.mark.parametrize(
    ("text", "rgb"),
    [("#ff0000", (1, 0, 0)), ("white;red", (1, 1, 1)), ("light_grey", (211 / 255,) * 3), ("shiny", None), ("", None)],
)
def test_written_colours(text, rgb) -> None:
    assert parse_colour(text) == (None if rgb is None else pytest.approx(rgb))


def test_the_class_of_tags_is_the_first_row_that_they_match() -> None:
    rows, rng = load_classes(), np.random.default_rng(0)
    conditions = [condition for row in rows for condition in (*row.required, *row.forbidden)]
    result = set()
    for _ in range(3000):
        part = [conditions[n] for n in rng.integers(len(conditions), size=rng.integers(6))]
        tags = {key: str(rng.choice(sorted(values or {"yes"}))) for key, values in part}
        expected = next(((n, row) for n, row in enumerate(rows) if row.matches(tags)), None)
        assert find_class(tags) == expected
        result.add(expected and expected[0])
    assert len(result) > len(rows) / 2
