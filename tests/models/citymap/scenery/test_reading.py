import numpy as np
import pytest
import shapely

from models.citymap.scenery.cloud import encode_cloud
from models.citymap.scenery.files import file_name, save_scenery
from models.citymap.scenery.reading import AREA, LINE, POINT, load_look, read_scenery
from models.citymap.scenery.shapes import NamedPoint, Outlines
from models.citymap.types import MapShape


def test_shapes_are_read_as_they_were_written(tmp_path) -> None:
    yard = shapely.Polygon([(0, 0), (20, 0), (20, 10), (0, 10)], [[(5, 2), (8, 2), (8, 5), (5, 5)]])
    shapes = [
        MapShape("tree", shapely.Point(-3.2, 4)),
        MapShape("building", yard, name="Kauppahalli"),
        MapShape("road", shapely.MultiLineString([[(0, 0), (100, 1)], [(200, 5), (300, 5)]]), width_m=6.5),
    ]
    save_scenery(tmp_path, [Outlines.from_shapes(shapes).encode([NamedPoint((1.0, -2.0), "Café Ö", "amenity/cafe")])])
    drawn = read_scenery(tmp_path / file_name(0))
    assert [(o.label, o.form, o.name, o.width_m) for o in drawn.outlines] == [
        ("tree", POINT, None, 0.0),
        ("building", AREA, "Kauppahalli", 0.0),
        ("road", LINE, None, 6.5),
    ]
    tree, house, road = drawn.outlines
    assert tree.paths[0].tolist() == [[-3.2, 4.0]]
    assert shapely.Polygon(house.paths[0], [house.paths[1]]).equals(yard)
    assert [path.tolist() for path in road.paths] == [[[0, 0], [100, 1]], [[200, 5], [300, 5]]]
    assert drawn.places == [NamedPoint((1.0, -2.0), "Café Ö", "amenity/cafe")]


def test_a_map_of_nothing_and_points_are_read(tmp_path) -> None:
    xyz = np.random.default_rng(0).uniform(-50, 50, (20, 3)).round(1)
    rgb = np.arange(60, dtype=np.uint8).reshape(20, 3)
    save_scenery(tmp_path, [Outlines.from_shapes([]).encode(), *encode_cloud(xyz, rgb)])
    assert read_scenery(tmp_path / file_name(0)).outlines == []
    drawn = read_scenery(tmp_path / file_name(1))
    order, read = np.lexsort(xyz.T), np.lexsort(drawn.xyz_m.T)
    assert drawn.xyz_m[read] == pytest.approx(xyz[order])
    assert drawn.rgb[read].tolist() == rgb[order].tolist()


def test_every_paint_of_a_label_has_a_colour_in_light_and_dark() -> None:
    given = load_look()
    assert set(given["light"]) == set(given["dark"])
    for kind in ("ground", "rising", "walls"):
        assert set(given[kind].values()) <= set(given["light"])
