import json

import numpy as np
import pytest
import shapely
import shapely.affinity

from models.citymap.scenery import shapes as shapes_module
from models.citymap.scenery.shapes import OSM_TYPES, DrawnObjects, NamedPoint, Outlines, OutlinesBuilder
from models.citymap.types import MapShape
from models.sources.osm.map import load_osm

HOUSE = shapely.Polygon([(0, 0), (20, 0), (20, 10), (0, 10)], [[(5, 2), (8, 2), (8, 5), (5, 5)]])


def decoded(part):
    tensors, facts = part
    xy = tensors["steps"].cumsum(axis=0) / 10
    paths = np.split(xy, tensors["size"].cumsum()[:-1])
    owner = np.repeat(np.arange(len(tensors["label"])), tensors["paths"])
    objects = [[p for p, o in zip(paths, owner, strict=True) if o == n] for n in range(len(tensors["label"]))]
    return {key: json.loads(value) if key != "kind" else value for key, value in facts.items()}, tensors, objects


def test_shapes_are_what_was_encoded() -> None:
    outlines = Outlines.from_shapes(
        [
            MapShape("tree", shapely.Point(-3.21, 4), top_m=8.06, source_id="node/7"),
            MapShape("building", HOUSE, 3, 21.5, name="Kauppahalli", source_id="relation/9"),
            MapShape("road", shapely.MultiLineString([[(0, 0), (100, 1)], [(200, 5), (300, 5)]]), width_m=6.5),
            MapShape("tree", shapely.Point(), source_id="node/8"),
        ]
    )
    facts, tensors, objects = decoded(outlines.encode([NamedPoint((1.04, -2.0), "Café Ö", "amenity/cafe")]))
    assert facts["labels"] == ["tree", "building", "road"]
    assert [facts["labels"][n] for n in tensors["label"]] == ["tree", "building", "road"], (
        "what has no place is left out"
    )
    assert tensors["form"].tolist() == [0, 2, 1]
    assert tensors["top"].tolist() == [81, 215, 0]
    assert tensors["base"].tolist() == [0, 30, 0]
    assert tensors["width"].tolist() == [0, 0, 65]
    assert tensors["source"].tolist() == [28, 9 * 4 + 2, -1]
    assert objects[0][0].tolist() == [[-3.2, 4]]
    rings = objects[1]
    assert tensors["hole"].tolist() == [0, 0, 1, 0, 0]
    assert shapely.Polygon(rings[0], [rings[1]]).equals(HOUSE)
    assert [line.tolist() for line in objects[2]] == [[[0, 0], [100, 1]], [[200, 5], [300, 5]]]
    assert facts["names"] == {"1": "Kauppahalli"}
    assert facts["places"] == [[10, -20, "Café Ö", "amenity/cafe"]]


def test_what_a_clip_leaves_over_is_not_drawn() -> None:
    left_over = shapely.GeometryCollection([HOUSE, shapely.Point(50, 50), shapely.LineString([(0, 0), (9, 9)])])
    _, tensors, objects = decoded(Outlines.from_shapes([MapShape("building", left_over)]).encode())
    assert tensors["paths"].tolist() == [2]
    assert shapely.Polygon(objects[0][0]).area == 200


def test_neighbours_stand_together() -> None:
    rng = np.random.default_rng(0)
    trees = [MapShape("tree", shapely.Point(*rng.uniform(-900, 900, 2))) for _ in range(500)]
    _, tensors, _ = decoded(Outlines.from_shapes(trees).encode())
    apart = np.hypot(*tensors["steps"][1:].T / 10)
    assert np.median(apart) < 100, "in the order in which they came it is 900 m"


@pytest.mark.parametrize("at_once", [1, 7, 1000])
def test_what_is_drawn_a_part_at_a_time_is_the_same(at_once, monkeypatch) -> None:
    rng = np.random.default_rng(0)
    shapes = [
        MapShape(label, geometry, name=f"{label} {n}" if n % 3 == 0 else None, source_id=f"way/{n}")
        for n, position in enumerate(rng.uniform(-900, 900, (40, 2)))
        for label, geometry in (
            ("tree", shapely.Point(position)),
            ("building", shapely.affinity.translate(HOUSE, *position)),
        )
    ]
    shapes.sort(key=lambda shape: shape.label)
    expected = Outlines.from_shapes(shapes)
    monkeypatch.setattr(shapes_module, "ROWS_PER_BLOCK", at_once)
    drawings, order = OutlinesBuilder(["building", "tree"]), rng.permutation(len(shapes))
    for part in np.array_split(order, 5):
        drawings.add(DrawnObjects.from_shapes([shapes[n] for n in part], part))
    result = drawings.build()
    assert (result.labels, result.names) == (expected.labels, expected.names)
    assert list(result.names) == sorted(result.names)
    for name, column in expected.tensors.items():
        assert np.array_equal(result.tensors[name], column), name
        assert result.tensors[name].dtype == column.dtype


def test_nothing_is_a_map_too() -> None:
    facts, tensors, _ = decoded(Outlines.from_shapes([]).encode())
    assert facts["labels"] == []
    assert len(tensors["steps"]) == 0


@pytest.mark.parametrize(("label", "form"), [("building", 2), ("road", 1), ("tree", 0)])
def test_a_map_from_openstreetmap_has_its_geometry(osm_file, label, form) -> None:
    city_map = load_osm(osm_file)
    assert city_map.outlines is not None
    tensors = city_map.outlines.tensors
    of_label = tensors["label"] == city_map.outlines.labels.index(label)
    assert set(tensors["form"][of_label].tolist()) == {form}
    ids = {i.source_id for i in city_map.instances if i.label == label and i.source_id}
    numbers = {4 * int(number) + OSM_TYPES.index(kind) for kind, number in (owner.split("/") for owner in ids)}
    assert numbers <= set(tensors["source"][of_label].tolist())
    if label == "road":
        assert (tensors["width"][of_label] > 0).all()
        assert (tensors["top"][of_label] == 0).all()
    else:
        assert (tensors["top"][of_label] > 0).all()
