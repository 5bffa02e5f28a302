import pytest
import shapely

from models.sources.osm.classes import find_class
from models.sources.osm.features import STOREY_M, build_feature

SQUARE = shapely.box(0, 0, 10, 10)


def height_m(**tags) -> float:
    order, row = find_class({"building": "yes"})
    return build_feature(row, order, tags, "way/1", SQUARE).height_m


@pytest.mark.parametrize("text", ["12", "12 m", "12m", " 12.0M "])
def test_a_height_has_a_unit_or_none(text) -> None:
    assert height_m(height=text) == 12


@pytest.mark.parametrize("text", ["0", "-3", "1000", "39 ft", "tall", "nan", "inf"])
def test_a_height_that_no_building_has_is_ignored(text) -> None:
    default_m = height_m()
    assert height_m(height=text) == default_m
    assert height_m(**{"height": text, "building:levels": "5"}) == 5 * STOREY_M
    assert height_m(**{"building:levels": text}) == default_m
