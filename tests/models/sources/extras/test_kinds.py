import pytest
import shapely

from models.errors import DataError
from models.sources.extras.kinds import ObjectKind

POINT, LINE, AREA = shapely.Point(0, 0), shapely.LineString([(0, 0), (1, 0)]), shapely.box(0, 0, 1, 1)


@pytest.mark.parametrize(
    ("text", "tags"),
    [
        ("waste_basket", {"amenity": "waste_basket"}),
        ("Trash cans", {"amenity": "waste_basket"}),
        ("benches", {"amenity": "bench"}),
        (" amenity = waste_basket ", {"amenity": "waste_basket"}),
        ("fountain", {"amenity": "fountain"}),
        ("hydrant", {"emergency": "fire_hydrant"}),
        ("church", {"amenity": "place_of_worship", "religion": "christian"}),
        ("hotel", {"tourism": "hotel"}),
    ],
)
def test_a_kind_is_a_value_a_tag_or_a_noun(text, tags) -> None:
    kind = ObjectKind.parse(text)
    assert (dict(kind.tags), kind.label) == (tags, None)


@pytest.mark.parametrize(("text", "label"), [("Parcel_Robot", "parcel robot"), ("wertstoffinsel", "wertstoffinsel")])
def test_another_word_becomes_a_label(text, label) -> None:
    kind = ObjectKind.parse(text)
    assert (dict(kind.tags), kind.label, str(kind)) == ({}, label, label)
    assert [kind.osm_class(shape).shape for shape in (POINT, LINE, AREA)] == ["box", "wall", "wall"]
    assert {kind.osm_class(shape).label for shape in (POINT, LINE, AREA)} == {label}


@pytest.mark.parametrize(
    "text", ["", "?", "x" * 60, "amenity=tardis", "walked", "street", "residential", "highway=path"]
)
def test_a_kind_that_nothing_can_have_is_refused_with_advice(text) -> None:
    with pytest.raises(DataError, match="give a"):
        ObjectKind.parse(text)


@pytest.mark.parametrize(
    ("text", "label", "shapes"),
    [
        ("waste_basket", "trash bin", ["box", "wall", "box"]),
        ("playground", "playground", ["box", "ground", "ground"]),
        ("street_lamp", "street lamp", ["column", "wall", "wall"]),
    ],
)
def test_a_class_fits_any_geometry(text, label, shapes) -> None:
    classes = [ObjectKind.parse(text).osm_class(shape) for shape in (POINT, LINE, AREA)]
    assert [row.shape for row in classes] == shapes
    assert {row.label for row in classes} == {label}


def test_a_shop_is_known_by_its_kind_alone() -> None:
    assert ObjectKind.parse("bakery").osm_class(POINT) is None
