"""A map does not depend on the strips that it was read in."""

from dataclasses import fields

import numpy as np
import pytest
import shapely

from models.city.osm.classes import load_classes
from models.city.osm.features import Feature
from models.city.osm.map import load_osm
from models.city.osm.strips import Instances, Strips


def feature(label, geometry, source):
    [(order, row)] = [(n, row) for n, row in enumerate(load_classes()) if row.label == label][:1]
    return Feature(label, row.shape, order, row.walkable, geometry, 0.0, 0.0, None, None, source)


def taken(tmp_path, features, monkeypatch, band):
    monkeypatch.setattr("models.city.osm.strips.BAND", band)
    directory = tmp_path / f"{band}"
    directory.mkdir()
    return Instances.of(Strips(directory, [features[:2], [], features[2:]]))


@pytest.mark.parametrize("band", [1, 2, 7])
def test_a_map_is_the_same_in_strips_of_any_width(band, osm_file, monkeypatch) -> None:
    monkeypatch.setattr("models.city.osm.strips.BAND", 10_000)
    whole = load_osm(osm_file)
    monkeypatch.setattr("models.city.osm.strips.BAND", band)
    some = load_osm(osm_file)
    assert len(some.instances) == len(whole.instances) > 20
    for one, other in zip(some.instances, whole.instances, strict=True):
        told = [
            (i.id, i.label, i.name, i.source_id, i.shape, None if i.rgb is None else i.rgb.tolist())
            for i in (one, other)
        ]
        assert told[0] == told[1]
    for field in fields(whole.pieces):
        assert np.array_equal(getattr(some.pieces, field.name), getattr(whole.pieces, field.name)), field.name
    assert np.array_equal(some.locations_m, whole.locations_m)
    assert some.outlines.encode() == whole.outlines.encode()


@pytest.mark.parametrize("band", [1, 3, 100])
def test_what_is_one_instance_is_so_across_strips(band, tmp_path, monkeypatch) -> None:
    features = [
        feature("road", shapely.box(0, 0, 95, 6), "way/1"),
        feature("road", shapely.box(90, 3, 300, 6), "way/2"),
        feature("road", shapely.box(0, 50, 300, 56), "way/3"),
        feature("crossing", shapely.box(104.2, 0, 110, 9), "way/4"),
        # in the strip to the west by less than a metre, where the way is not
        feature("crossing", shapely.Point(105.3, 5).buffer(1), "node/5"),
        feature("crossing", shapely.Point(103.6, 5).buffer(0.5), "node/6"),
        feature("traffic sign", shapely.Point(205.2, 20), "node/7"),
        feature("street lamp", shapely.Point(204.8, 20), "node/8"),
        feature("street lamp", shapely.Point(209, 20), "node/9"),
    ]
    found = taken(tmp_path, features, monkeypatch, band)
    alike = {}
    for number, instance in enumerate(found.of_feature.tolist()):
        alike.setdefault(instance, []).append(number)
    upright = sorted([6, 7], key=lambda n: features[n].order)[0]  # carries the other
    left_out = sorted({4, 6, 7} - {upright})
    assert sorted(alike.pop(-1)) == left_out
    assert sorted(alike.values()) == sorted([[0, 1], [2], [3], [5], [upright], [8]])
    order = [features[n].order for n in found.first]
    assert order == sorted(order)
    assert [features[n].order for n in np.argsort(found.place)] == sorted(each.order for each in features)
