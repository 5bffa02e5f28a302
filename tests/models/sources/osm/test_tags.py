from collections import namedtuple
from pathlib import Path

import numpy as np
import pytest

from models.sources.osm.gazetteer import load_gazetteer
from models.sources.osm.map import load_osm
from models.sources.osm.tags import one_line, read_tags

Tag = namedtuple("Tag", "k v")
NAMED = {"name": "Dead Meat", "name:fi": "Liha", "brand": "Meat"}
ADDRESS = {"addr:street": "Mill Street", "addr:housenumber": "7"}


def read(tags: dict[str, str]) -> dict[str, str]:
    return read_tags(Tag(*pair) for pair in tags.items())


@pytest.mark.parametrize("prefix", ["disused", "abandoned", "was", "demolished", "razed", "removed", "proposed"])
@pytest.mark.parametrize("tag", [("shop", "butcher"), ("amenity", "bank"), ("railway", "station"), ("building", "yes")])
def test_what_is_gone_takes_its_names_along(prefix, tag) -> None:
    assert read({f"{prefix}:{tag[0]}": tag[1], **NAMED, **ADDRESS}) == ADDRESS


@pytest.mark.parametrize(
    "tags",
    [
        {"shop": "vacant"},
        {"shop": "vacant", "disused:shop": "butcher"},
        {"shop": "butcher", "disused": "yes"},
        {"highway": "bus_stop", "disused": "yes"},
        {"building": "demolished"},
        {"building": "yes", "demolished": "yes"},
        {"railway": "abandoned", "abandoned:railway": "rail"},
        {"highway": "razed"},
        {"highway": "abandoned"},
    ],
)
def test_states_as_values_and_keys(tags) -> None:
    assert FEATURES.isdisjoint(read(tags | NAMED))
    assert NAMED.keys().isdisjoint(read(tags | NAMED))


FEATURES = {"shop", "highway", "building", "railway"}


@pytest.mark.parametrize(
    ("tags", "present"),
    [
        ({"building": "yes", "disused:amenity": "cinema"}, {"building": "yes"}),
        ({"building": "yes", "shop": "vacant"}, {"building": "yes"}),
        ({"building": "construction"}, {"building": "construction"}),
        ({"building": "abandoned"}, {"building": "abandoned"}),
        ({"highway": "footway", "disused": "yes"}, {"highway": "footway", "disused": "yes"}),
        ({"highway": "cycleway", "was:railway": "rail"}, {"highway": "cycleway"}),
        ({"landuse": "construction", "construction": "office"}, {"landuse": "construction", "construction": "office"}),
        ({"amenity": "cafe", "disused:website": "x", "was:name": "Old"}, {"amenity": "cafe"}),
        ({"highway": "residential", "lit": "disused"}, {"highway": "residential", "lit": "disused"}),
        ({"shop": "butcher", "demolished": "no"}, {"shop": "butcher", "demolished": "no"}),
        ({"disused:website": "x"}, {}),
        ({}, {}),
    ],
)
def test_what_is_there_keeps_its_names(tags, present) -> None:
    assert read(tags | NAMED) == present | NAMED


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("Le\nGrand\tCafé", "Le Grand Café"),
        ("  A\r\n\x00B\x85C\u2028D ", "A B C D"),
        ("\u200fשבת\u200e שבת\u202c", "שבת שבת"),
        ("Auf\u200clage", "Auf\u200clage"),  # a joiner is spelling
        ("🍕 Pizza 👨\u200d🍳", "🍕 Pizza 👨\u200d🍳"),
        ("\n", ""),
    ],
)
def test_names_are_one_line(text, line) -> None:
    assert one_line(text) == line
    assert read({"name": text}) == {"name": line}


HEADER = "<?xml version='1.0' encoding='UTF-8'?><osm version='0.6'>"
TOWN = """
<node id="1" lat="60.0" lon="25.0"/><node id="2" lat="60.0" lon="25.002"/>
<node id="3" lat="60.0001" lon="25.0002"><tag k="amenity" v="cafe"/><tag k="name" v="Blue&#10; Door&#9;"/></node>
<node id="4" lat="60.0001" lon="25.0004"><tag k="disused:amenity" v="cafe"/><tag k="name" v="Ghost"/></node>
<node id="5" lat="60.0001" lon="25.0006"><tag k="removed:amenity" v="bench"/></node>
<node id="6" lat="60.0001" lon="25.0008"><tag k="amenity" v="bench"/><tag k="name" v="&#10;"/></node>
<node id="7" lat="60.0001" lon="25.001"><tag k="addr:housenumber" v="7"/><tag k="addr:street" v="Mill&#10;Street"/>
<tag k="was:shop" v="bakery"/><tag k="name" v="Ghost"/></node>
<way id="1"><nd ref="1"/><nd ref="2"/><tag k="highway" v="residential"/><tag k="name" v="Mill&#9;Street"/></way>
<way id="2"><nd ref="1"/><nd ref="4"/><tag k="highway" v="proposed"/><tag k="name" v="Ghost"/></way>
<way id="3"><nd ref="1"/><nd ref="5"/><tag k="highway" v="abandoned"/><tag k="name" v="Ghost"/></way></osm>"""


def test_a_map_shows_what_is_on_the_ground(tmp_path) -> None:
    path = tmp_path / "town.osm"
    path.write_text(HEADER + TOWN)
    city = load_osm(path)
    assert {(i.label, i.name, i.source_id) for i in city.instances} == {
        ("road", "Mill Street", "way/1"),
        ("bench", None, "node/6"),
    }
    objects = {item.source_id: item for item in load_gazetteer(path, city.frame).objects if item.source_id}
    assert objects.keys() == {"node/3", "node/6", "node/7", "way/1"}
    assert objects["node/3"].names == ("Blue Door",)
    assert (objects["node/7"].names, objects["node/7"].street) == ((), "Mill Street")


def test_a_large_park_is_an_area_or_nothing(tmp_path) -> None:
    """It is not where the middle of its box is: there may be no park."""
    corners = [(60.0, 25.0), (60.0, 25.1), (60.04, 25.1), (60.04, 25.09), (60.01, 25.09), (60.01, 25.0)]
    nodes = "".join(f'<node id="{n}" lat="{lat}" lon="{lon}"/>' for n, (lat, lon) in enumerate(corners, 1))
    ring = "".join(f'<nd ref="{n}"/>' for n in (1, 2, 3, 4, 5, 6, 1))
    tags = '<tag k="type" v="multipolygon"/><tag k="leisure" v="park"/><tag k="name" v="Great Park"/>'
    relation = f'<relation id="1"><member type="way" ref="1" role="outer"/>{tags}</relation>'
    street = '<way id="2"><nd ref="1"/><nd ref="2"/><tag k="highway" v="residential"/></way>'
    path = Path(tmp_path / "park.osm")
    path.write_text(f'{HEADER}{nodes}<way id="1">{ring}</way>{street}{relation}</osm>')
    city = load_osm(path)
    gazetteer = load_gazetteer(path, city.frame)
    assert gazetteer.is_area[0]
    outline = gazetteer.segments_m[gazetteer.starts[0] : gazetteer.starts[1]]
    assert np.hypot(*(outline[:, 2:] - outline[:, :2]).T).min() > 500, "it has no point of its own"
    park = next(i for i in city.instances if i.label == "park")
    assert (city.pieces.instance == park.id).sum() > 100, "it is where its tiles are"
