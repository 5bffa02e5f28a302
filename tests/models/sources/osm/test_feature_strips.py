"""A map does not depend on the strips that it was read in."""

from dataclasses import fields

import numpy as np
import pytest
import shapely

from models.sources.osm import feature_strips
from models.sources.osm.classes import load_classes
from models.sources.osm.feature_strips import FeatureInstances, FeatureStrips
from models.sources.osm.features import Feature
from models.sources.osm.imported_map import ImportedMap
from models.sources.osm.map import load_osm


def feature(label, geometry, source, height_m=0.0):
    [(order, row)] = [(n, row) for n, row in enumerate(load_classes()) if row.label == label][:1]
    return Feature(label, row.shape, order, row.walkable, geometry, height_m, 0.0, None, None, source)


def filed(tmp_path, features, monkeypatch, band):
    monkeypatch.setattr(feature_strips, "TILE_COLUMNS_PER_BAND", band)
    return FeatureStrips(tmp_path, [features[:2], [], features[2:]])


@pytest.mark.parametrize("band", [1, 2, 7])
def test_a_map_is_the_same_in_strips_of_any_width(band, osm_file, monkeypatch) -> None:
    monkeypatch.setattr(feature_strips, "TILE_COLUMNS_PER_BAND", 10_000)
    whole = load_osm(osm_file)
    monkeypatch.setattr(feature_strips, "TILE_COLUMNS_PER_BAND", band)
    part = load_osm(osm_file)
    assert len(part.instances) == len(whole.instances) > 20
    for one, other in zip(part.instances, whole.instances, strict=True):
        facts = [
            (i.id, i.label, i.name, i.source_id, i.shape, None if i.rgb is None else i.rgb.tolist())
            for i in (one, other)
        ]
        assert facts[0] == facts[1]
    for field in fields(whole.pieces):
        assert np.array_equal(getattr(part.pieces, field.name), getattr(whole.pieces, field.name)), field.name
    assert np.array_equal(part.locations_m, whole.locations_m)
    drawn, wanted = part.outlines.encode(), whole.outlines.encode()
    assert drawn.metadata == wanted.metadata
    assert [*drawn.tensors] == [*wanted.tensors]
    for name, tensor in drawn.tensors.items():
        assert tensor.tobytes() == wanted.tensors[name].tobytes(), name


@pytest.mark.parametrize("band", [1, 3, 100])
def test_what_is_one_instance_is_so_across_strips(band, tmp_path, monkeypatch) -> None:
    features = [
        feature("road", shapely.box(0, 0, 95, 6), "way/1"),
        feature("road", shapely.box(90, 3, 300, 6), "way/2"),
        feature("road", shapely.box(0, 50, 300, 56), "way/3"),
        feature("crossing", shapely.box(106.2, 0, 112, 9), "way/4"),
        # touches the next one in a strip to the west, where the way is not
        feature("crossing", shapely.Point(105.8, 5).buffer(1), "node/5"),
        feature("crossing", shapely.Point(104.4, 5).buffer(0.5), "node/6"),
        feature("traffic sign", shapely.Point(205.2, 20), "node/7"),
        feature("street lamp", shapely.Point(204.8, 20), "node/8"),
        feature("street lamp", shapely.Point(209, 20), "node/9"),
    ]
    result = FeatureInstances.join(filed(tmp_path, features, monkeypatch, band))
    alike = {}
    for number, instance in enumerate(result.feature_instance.tolist()):
        alike.setdefault(instance, []).append(number)
    upright = sorted([6, 7], key=lambda n: features[n].order)[0]  # carries the other
    left_out = sorted({4, 6, 7} - {upright})
    assert sorted(alike.pop(-1)) == left_out
    assert sorted(alike.values()) == sorted([[0, 1], [2], [3], [5], [upright], [8]])
    order = [features[n].order for n in result.first]
    assert order == sorted(order)
    assert [features[n].order for n in np.argsort(result.rank)] == sorted(each.order for each in features)


@pytest.mark.parametrize("band", [1, 100])
def test_an_instance_is_as_high_as_its_first_feature_in_every_strip(band, tmp_path, monkeypatch) -> None:
    features = [
        feature("wall", shapely.LineString([(200, 0), (300, 0)]), "way/1", 3.0),
        feature("wall", shapely.LineString([(0, 0), (200, 0)]), "way/2", 1.5),
    ]
    result = ImportedMap.from_strips(filed(tmp_path, features, monkeypatch, band))
    assert len(result.instances) == 1
    assert len(result.pieces.heights_m) == 31
    assert np.ptp(result.pieces.heights_m[:, 1]) == 0
    assert result.pieces.heights_m[0, 1] > 2.5
    tops = dict(zip(result.outlines.tensors["source"].tolist(), result.outlines.tensors["top"].tolist(), strict=True))
    assert tops == {4 * 1 + 1: 30, 4 * 2 + 1: 15}, "each as it is drawn"


@pytest.mark.parametrize("band", [1, 100])
def test_what_is_drawn_side_by_side_is_in_order_across_strips(band, tmp_path, monkeypatch) -> None:
    features = [
        feature("tree", shapely.Point(x, 5), f"node/{n}", 8.0) for n, x in enumerate([106.3, 105.7, 106.1, 105.9], 1)
    ]
    result = ImportedMap.from_strips(filed(tmp_path, features, monkeypatch, band))
    assert result.outlines.tensors["source"].tolist() == [4, 8, 12, 16]
