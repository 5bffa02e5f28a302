import json
from pathlib import Path

import numpy as np
import osmium
import pytest

import models
from models.errors import MapError
from models.sources.osm.extract import Region, extract, extracted_file
from models.sources.osm.map import load_osm

SHIPPED_PATH = Path(models.__file__).parent / "maps" / "helsinki.osm.pbf"
BOX = "24.9440,60.1690,24.9500,60.1720"


@pytest.fixture(scope="module")
def taken(tmp_path_factory):
    out = tmp_path_factory.mktemp("taken") / "part.osm.pbf"
    extract(SHIPPED_PATH, Region.parse(BOX, SHIPPED_PATH), out)
    return out


def elements(path):
    return {(e.type_str(), e.id): dict(e.tags) for e in osmium.FileProcessor(str(path))}


def test_a_region_has_all_that_has_a_node_in_it_whole(taken) -> None:
    west, south, east, north = map(float, BOX.split(","))
    part, whole, inside = elements(taken), elements(SHIPPED_PATH), set()
    assert 0 < len(part) < len(whole) / 2
    for node in osmium.FileProcessor(str(SHIPPED_PATH), osmium.osm.NODE):
        if west <= node.lon <= east and south <= node.lat <= north:
            inside.add(node.id)
            assert part["n", node.id] == whole["n", node.id]
    for way in osmium.FileProcessor(str(SHIPPED_PATH), osmium.osm.WAY):
        refs = [node.ref for node in way.nodes]
        if inside & set(refs):
            assert part["w", way.id] == whole["w", way.id]
            assert all(("n", ref) in part for ref in refs if ("n", ref) in whole)
    areas = 0
    for relation in osmium.FileProcessor(str(taken), osmium.osm.RELATION):
        ways = [("w", member.ref) for member in relation.members if member.type == "w"]
        if relation.tags.get("type") == "multipolygon" and any(way in part for way in ways):
            areas += 1
            assert all(way in part for way in ways if way in whole), "an area is whole or not there"
    assert areas
    box = osmium.io.Reader(str(taken)).header().box()
    assert (box.bottom_left.lon, box.top_right.lat) == pytest.approx((west, north))
    assert [path.name for path in taken.parent.iterdir()] == ["part.osm.pbf"]


def test_a_map_of_a_region_is_that_part_of_the_map(taken) -> None:
    part, whole = load_osm(taken), load_osm(SHIPPED_PATH)
    extent = np.ptp(part.locations_m, axis=0)
    assert extent[0] < 360
    assert extent[1] < 360
    sources = {instance.source_id for instance in whole.instances}
    mine = [instance.source_id for instance in part.instances]
    assert len(mine) > 100
    assert np.mean([source in sources for source in mine]) > 0.9, "what is joined may be named by another part of it"


def test_a_polygon_leaves_out_what_is_beside_it(taken, tmp_path) -> None:
    west, south, east, north = map(float, BOX.split(","))
    triangle = {"type": "Polygon", "coordinates": [[[west, south], [east, south], [west, north], [west, south]]]}
    feature = {"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {}, "geometry": triangle}]}
    file = tmp_path / "part.geojson"
    file.write_text(json.dumps(feature))
    region = Region.parse(str(file), SHIPPED_PATH)
    assert region.shape.bounds == pytest.approx((west, south, east, north))
    with extracted_file(SHIPPED_PATH, region) as path:
        assert path.name == "helsinki.osm.pbf"
        part, all_of = elements(path), elements(taken)
    assert set(part) < set(all_of)
    assert len(part) < 0.8 * len(all_of)
    assert not path.exists()


@pytest.mark.parametrize(
    "text",
    [
        "",
        "here",
        "1,2,3",
        "1,2,3,4,5",
        "3,2,1,4",
        "1,4,3,2",
        "1,2,1,4",
        "nan,1,2,3",
        "170,0,190,1",
        "no/such/file.geojson",
    ],
)
def test_what_is_no_region_says_what_one_is(text) -> None:
    with pytest.raises(MapError, match=r"west,south,east,north"):
        Region.parse(text, SHIPPED_PATH)


@pytest.mark.parametrize(
    "content", ["{", "[]", '{"type": "Point", "coordinates": [1, 2]}', '{"type": "Feature"}', "\x00"]
)
def test_a_file_without_a_polygon_is_no_region(content, tmp_path) -> None:
    (tmp_path / "x.geojson").write_text(content)
    with pytest.raises(MapError, match=r"GeoJSON"):
        Region.parse(str(tmp_path / "x.geojson"), SHIPPED_PATH)


def test_where_nothing_is_and_what_is_no_map_is_said(tmp_path) -> None:
    with (
        pytest.raises(MapError, match="nothing in the region"),
        extracted_file(SHIPPED_PATH, Region.parse("1,1,2,2", SHIPPED_PATH)),
    ):
        pass
    with (
        pytest.raises(MapError, match="needs an OpenStreetMap file"),
        extracted_file(tmp_path, Region.parse("1,1,2,2", SHIPPED_PATH)),
    ):
        pass
    (tmp_path / "bad.osm.pbf").write_bytes(b"no" * 100)
    with (
        pytest.raises(MapError, match="download it again"),
        extracted_file(tmp_path / "bad.osm.pbf", Region.parse(BOX, SHIPPED_PATH)),
    ):
        pass
