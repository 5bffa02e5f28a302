"""A city's own data in a map from OpenStreetMap."""

import json

import pytest

from models.citymap.kinds.vocabulary import load_vocabulary
from models.language.mentions.lookup import Lookup
from models.sources.extras.layer import ExtraLayer
from models.sources.osm.extent import read_extent
from models.sources.osm.gazetteer import load_gazetteer
from models.sources.osm.map import load_osm

LAT_M, LON_M = 1 / 111_412.0, 1 / 55_800.0
POINT = {"type": "Point", "coordinates": [25.0 + 95 * LON_M, 60.0 + 95 * LAT_M]}
LINE = {
    "type": "LineString",
    "coordinates": [[25.0 + 90 * LON_M, 60.0 + 70 * LAT_M], [25.0 + 110 * LON_M, 60.0 + 70 * LAT_M]],
}
AREA = {
    "type": "Polygon",
    "coordinates": [
        [[25.0 + x * LON_M, 60.0 + y * LAT_M] for x, y in ((40, 40), (50, 40), (50, 50), (40, 50), (40, 40))]
    ],
}
LONG_NAME = "Käyttäjän pakettirobotit ja muut laitteet 2026.geojson"


@pytest.fixture
def layers(tmp_path, osm_file):
    features = [{"type": "Feature", "geometry": each, "properties": {"name": "Robo"}} for each in (POINT, LINE, AREA)]
    path = tmp_path / LONG_NAME
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    box = read_extent(osm_file).bounds
    (tmp_path / "bins.csv").write_text(f"lat,lon\n{60 + 30 * LAT_M},{25 + 30 * LON_M}\n10,10\n")
    kinds = (path, "parcel robot"), (tmp_path / "bins.csv", "waste_basket")
    return [ExtraLayer.read(*each).clip(box) for each in kinds]


def test_objects_become_instances_of_their_class(layers, osm_file, city) -> None:
    extended = load_osm(osm_file, extras=layers)
    robots = [one for one in extended.instances if one.label == "parcel robot"]
    assert {one.source_id for one in robots} == {f"{LONG_NAME}/{n}" for n in (1, 2, 3)}
    assert {(one.name, one.shape) for one in robots} == {("Robo", "box"), ("Robo", "wall")}
    [bin_] = [one for one in extended.instances if one.source_id == "bins.csv/2"]
    assert (bin_.label, bin_.shape) == ("trash bin", "box")
    others = {one.source_id for one in extended.instances} - {one.source_id for one in [*robots, bin_]}
    assert others == {one.source_id for one in city.instances}
    assert len(extended.locations_m) == len(city.locations_m)


def test_objects_join_the_gazetteer_with_their_names_and_kinds(layers, osm_file) -> None:
    frame = read_extent(osm_file).frame
    gazetteer = load_gazetteer(osm_file, frame, extras=layers)
    robots = gazetteer.by_kind["parcel robot"]
    assert [gazetteer.objects[n].source_id for n in robots] == [f"{LONG_NAME}/{n}" for n in (1, 2, 3)]
    assert gazetteer.is_area[robots].tolist() == [False, False, True]
    assert gazetteer.objects[int(robots[0])].names == ("Robo",)
    assert "bins.csv/2" in {gazetteer.objects[n].source_id for n in gazetteer.by_kind["amenity/waste_basket"].tolist()}
    plain = load_gazetteer(osm_file, frame)
    assert len(gazetteer) == len(plain) + 4
    assert len(gazetteer.corners_m) == len(plain.corners_m)


def test_a_label_of_its_own_is_a_noun(layers, osm_file) -> None:
    gazetteer = load_gazetteer(osm_file, read_extent(osm_file).frame, extras=layers)
    lookup = Lookup(gazetteer, load_vocabulary(), lambda _word: False)
    assert lookup.kinds(("parcel", "robots")) == {"parcel robot": 1.0}
    assert len(lookup.of_kinds({"parcel robot": 1.0}).objects) == 3
    assert "parcel robot" in lookup.phrases()
