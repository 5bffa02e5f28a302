"""A city's own data, read from the formats it comes in."""

import json

import pytest
import shapely

from models.errors import DataError
from models.sources.extras.layer import ExtraLayer

BOX = (25.0, 60.0, 25.01, 60.01)
POINT = {"type": "Point", "coordinates": [25.002, 60.004]}
LINE = {"type": "LineString", "coordinates": [[25.001, 60.001], [25.002, 60.001]]}
AREA = {"type": "Polygon", "coordinates": [[[25.003, 60.003], [25.004, 60.003], [25.004, 60.004], [25.003, 60.003]]]}
MANY = {"type": "MultiPoint", "coordinates": [[25.005, 60.005], [25.006, 60.006]]}


@pytest.fixture
def write(tmp_path):
    def write_file(name, content):
        path = tmp_path / name
        text = content if isinstance(content, str) else json.dumps(content)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write_file


def feature(geometry, **properties):
    return {"type": "Feature", "geometry": geometry, "properties": properties}


def collection(*features):
    return {"type": "FeatureCollection", "features": features}


def sources(layer):
    return [(item.source_id, item.geometry.geom_type) for item in layer.objects]


def test_features_are_numbered_and_keep_their_names(write) -> None:
    content = collection(
        feature(POINT, name="  Bin\n 1 ", Colour="green", type="x"),
        feature(None),
        feature(LINE, title="Row of bins"),
        feature(AREA, **{"name:fi": "Roskis", "addr:housenumber": 7}),
        feature(MANY),
    )
    layer = ExtraLayer.read(write("bins.geojson", content), "waste_basket")
    assert sources(layer) == [
        ("bins.geojson/1", "Point"),
        ("bins.geojson/3", "LineString"),
        ("bins.geojson/4", "Polygon"),
        *[("bins.geojson/5", "Point")] * 2,
    ]
    kind = {"amenity": "waste_basket"}
    assert layer.objects[0].tags == {"name": "Bin 1", "colour": "green", **kind}
    assert layer.objects[1].tags == {"name": "Row of bins", **kind}
    assert layer.objects[2].tags == {"name:fi": "Roskis", "addr:housenumber": "7", **kind}
    assert (layer.unplaced, str(layer)) == (1, "bins.geojson as amenity=waste_basket")


@pytest.mark.parametrize("content", [feature(POINT), POINT, {"type": "GeometryCollection", "geometries": [POINT]}])
def test_a_feature_or_a_geometry_alone_is_one_object(write, content) -> None:
    assert sources(ExtraLayer.read(write("one.JSON", content), "bench")) == [("one.JSON/1", "Point")]


@pytest.mark.parametrize(
    "text",
    [
        "lat,lon,name\n60.004,25.002,Bin 1\n,,nowhere\n\n60.1,25.2,Bin 2\n",
        "\ufeffName;Longitude;LATITUDE\nBin 1;25,002;60,004\n;;\nx; ;\nBin 2;25,2;60,1\n",
        'id\tx\ty\tname\n1\t25.002\t60.004\t"Bin\n 1"\n2\t\t\t\n3\t25.2\t60.1\tBin 2\n',
    ],
)
def test_a_table_has_a_point_per_row(write, text) -> None:
    layer = ExtraLayer.read(write("bins.csv", text), "waste_basket")
    first, second = layer.objects
    assert (first.geometry.x, first.geometry.y) == (25.002, 60.004)
    assert [item.tags["name"] for item in layer.objects] == ["Bin 1", "Bin 2"]
    assert (first.source_id, layer.unplaced) == ("bins.csv/2", 1)
    assert second.source_id in ("bins.csv/4", "bins.csv/5")


def test_overpass_elements_keep_their_ids(write) -> None:
    corners = [{"lat": 60.001, "lon": 25.001}, {"lat": 60.001, "lon": 25.002}, {"lat": 60.002, "lon": 25.002}]
    elements = [
        {"type": "node", "id": 1, "lat": 60.004, "lon": 25.002, "tags": {"name": "Bin", "amenity": "bench"}},
        {"type": "way", "id": 2, "geometry": [*corners, corners[0]], "tags": {"name:sv": "Korg"}},
        {"type": "way", "id": 3, "geometry": [*corners, None]},
        {"type": "way", "id": 4, "center": corners[0]},
        {"type": "way", "id": 5, "nodes": [7, 8]},
        {"type": "relation", "id": 6, "members": [{"geometry": corners[:2]}, {"geometry": [*corners[1:], corners[0]]}]},
        *({"type": "node", "id": 7 + n, **corner} for n, corner in enumerate(corners[:2])),
    ]
    layer = ExtraLayer.read(write("bins.json", {"version": 0.6, "elements": elements}), "waste_basket")
    assert sources(layer) == [
        ("bins.json/node/1", "Point"),
        ("bins.json/way/2", "Polygon"),
        ("bins.json/way/3", "LineString"),
        ("bins.json/way/4", "Point"),
        ("bins.json/way/5", "LineString"),
        ("bins.json/relation/6", "Polygon"),
    ]
    assert layer.objects[0].tags == {"name": "Bin", "amenity": "waste_basket"}, "the kind that was given counts"


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("a.csv", "name,lat\nx,60\n", "row 1: no column is called lon, lng, long, longitude or x, only name, lat"),
        ("a.csv", "lat,lon\n60.1,25.1\n60.1,25.1E\n", "row 3: latitude '60.1' and longitude '25.1E' are not both"),
        ("a.csv", "lat,lon\n60.1,25.1\n6672800,25496700\n", r"row 3: .* in degrees; convert"),
        ("a.csv", "", "row 1: no column"),
        ("a.csv", "lat,lon\n,\n1,\n", "no object with a position"),
        ("a.geojson", collection(feature(POINT), feature({"type": "Point", "coordinates": [25496700, 6672800]})),
         "feature 2: .*ogr2ogr"),
        ("a.geojson", collection(feature({"type": "Point", "coordinates": [25.0, 160.0]})), "feature 1: "),
        ("a.geojson", collection(feature({"type": "Pint", "coordinates": [1, 2]})), "feature 1: its geometry"),
        ("a.geojson", collection("x"), "feature 1: not an object"),
        ("a.geojson", {"type": "FeatureCollection"}, "no list 'features'"),
        ("a.geojson", collection(), "no object with a position"),
        ("a.geojson", '{"type": ', "not JSON"),
        ("a.geojson", "[1]", "neither GeoJSON nor Overpass JSON"),
        ("a.json", {"elements": [{"type": "way", "id": 5, "nodes": [1, 2]}]}, "way/5: .*'out geom;'"),
        ("a.json", {"elements": 5}, "not a list"),
    ],
)  # fmt: skip
def test_an_error_names_the_file_the_row_and_the_cure(write, name, content, reason) -> None:
    path = write(name, content)
    with pytest.raises(DataError, match=reason) as error:
        ExtraLayer.read(path, "waste_basket")
    assert str(error.value).startswith(str(path))


def test_a_missing_a_large_or_a_latin_file_says_what_to_do(tmp_path, monkeypatch) -> None:
    with pytest.raises(DataError, match=r"cannot be read .*columns lat and lon"):
        ExtraLayer.read(tmp_path / "none.csv", "bench")
    (tmp_path / "latin.csv").write_bytes("lat,lon,name\n60,25,Töölö\n".encode("latin-1"))
    with pytest.raises(DataError, match="save it as UTF-8"):
        ExtraLayer.read(tmp_path / "latin.csv", "bench")
    monkeypatch.setattr("models.sources.extras.layer.MAX_BYTES", 10)
    with pytest.raises(DataError, match="larger than"):
        ExtraLayer.read(tmp_path / "latin.csv", "bench")


def test_objects_outside_the_map_are_counted_and_others_are_cut(write) -> None:
    line = {"type": "LineString", "coordinates": [[24.99, 60.001], [25.002, 60.001]]}
    far = {"type": "Point", "coordinates": [12.0, 45.0]}
    layer = ExtraLayer.read(write("bins.geojson", collection(feature(far), feature(line), feature(POINT))), "bench")
    inside = layer.clip(BOX)
    assert (len(inside.objects), inside.outside, layer.outside) == (2, 1, 0)
    assert inside.objects[0].geometry.bounds == pytest.approx((25.0, 60.001, 25.002, 60.001))


def test_a_file_without_an_object_on_the_map_says_where_its_objects_are(write) -> None:
    layer = ExtraLayer.read(write("bins.csv", "lat,lon\n25.002,60.004\n"), "bench")
    with pytest.raises(DataError, match=r"bins.csv: none of its 1 objects .* latitude 25.00200.* exchange them"):
        layer.clip(BOX)
    with pytest.raises(DataError, match="give data of this map"):
        layer.clip((1.0, 1.0, 2.0, 2.0))


def test_a_map_across_180_degrees_has_objects_on_both_sides(write) -> None:
    layer = ExtraLayer.read(write("bins.csv", "lat,lon\n0.5,179.9\n0.5,-179.9\n0.5,10\n"), "bench")
    inside = layer.clip((179.5, 0.0, 180.5, 1.0))
    assert [item.geometry.x for item in inside.objects] == pytest.approx([179.9, 180.1])


def test_a_crossed_polygon_becomes_valid(write) -> None:
    bow = {
        "type": "Polygon",
        "coordinates": [[[25.0, 60.0], [25.01, 60.01], [25.01, 60.0], [25.0, 60.01], [25.0, 60.0]]],
    }
    [item] = ExtraLayer.read(write("a.geojson", feature(bow)), "park").objects
    assert item.geometry.is_valid
    assert shapely.area(item.geometry) == pytest.approx(0.00005)
