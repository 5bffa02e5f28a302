import numpy as np
import pytest
import shapely

from models.city.gazetteer.gazetteer import NOTHING_NAMED, Words, build_gazetteer
from models.city.gazetteer.raster import MARGIN_M, Raster
from tests.models.city.gazetteer.made_town import MARKET, PARK, line, made_gazetteer, numbered, point

GRID_M = 10.0
CENTERS = np.stack(np.meshgrid(np.arange(-45, 446, GRID_M), np.arange(-45, 206, GRID_M)), axis=-1).reshape(-1, 2)


@pytest.fixture(scope="module")
def town():
    return made_gazetteer()


@pytest.fixture(scope="module")
def raster(town):
    return Raster(town, CENTERS, GRID_M)


def metres(shape: shapely.Geometry) -> np.ndarray:
    return np.asarray(shapely.distance(shape, shapely.points(CENTERS)))


@pytest.mark.parametrize(
    ("name", "shape"),
    [
        ("Bottino", shapely.Point(215, 92)),
        ("Whole Foods", shapely.box(*MARKET)),
        ("Chelsea Park", shapely.box(*PARK)),
        ("West 25th Street", shapely.LineString([(-50, 80), (450, 80)])),
        ("Harlem Road", shapely.LineString([(-50, 420), (450, 420)])),
    ],
)
def test_metres_are_true_to_the_grid(town, raster, name, shape) -> None:
    found = raster.metres_to(np.array([numbered(town, name)]))
    assert np.abs(found - metres(shape)).max() <= GRID_M


def test_the_nearest_of_several_counts(town, raster) -> None:
    objects = np.array([numbered(town, "Bottino"), numbered(town, "Elmo")])
    each = [raster.metres_to(objects[n : n + 1]) for n in range(2)]
    assert (raster.metres_to(objects) == np.minimum(*each)).all()


def test_lines_that_are_no_objects(raster) -> None:
    lines = np.concatenate([line((33, 7), (210, 160)), point(400, 5)])
    truth = np.minimum(metres(shapely.LineString([(33, 7), (210, 160)])), metres(shapely.Point(400, 5)))
    assert np.abs(raster.metres_to_lines(lines) - truth).max() <= GRID_M


def test_the_hole_of_an_area_is_not_in_it() -> None:
    holed = np.concatenate(
        [
            line((0, 0), (200, 0), (200, 200), (0, 200), (0, 0)),
            line((50, 50), (150, 50), (150, 150), (50, 150), (50, 50)),
        ]
    )
    courtyard = build_gazetteer([Words(("x",))], [holed], [True])
    centers = np.array([(100.0, 100.0), (25.0, 100.0)])
    middle, inside = Raster(courtyard, centers, 5.0).metres_to(np.array([0]))
    assert middle == pytest.approx(50, abs=5)
    assert inside <= 10


def test_what_is_off_the_grid_is_infinitely_far() -> None:
    far = build_gazetteer([Words(("x",))] * 2, [point(9000, 0), point(445 + MARGIN_M / 2, 0)], [False] * 2)
    raster = Raster(far, CENTERS, GRID_M)
    assert np.isinf(raster.metres_to(np.array([0]))).all()
    assert raster.metres_to(np.array([1])).min() == pytest.approx(MARGIN_M / 2, abs=GRID_M), "in the margin"
    assert np.isinf(raster.metres_to_lines(point(9000, 0))).all()


def test_a_map_where_nothing_is_named() -> None:
    raster = Raster(NOTHING_NAMED, CENTERS, GRID_M)
    assert raster.metres_to_lines(point(0, 0)).shape == (len(CENTERS),)


def test_asked_again_it_says_the_same(town, monkeypatch) -> None:
    monkeypatch.setattr("models.city.gazetteer.raster.KEPT_BYTES", 2 * 4 * len(CENTERS))
    raster = Raster(town, CENTERS, GRID_M)
    first = [raster.metres_to(np.array([n])).copy() for n in range(5)]
    assert len(raster._lately) == 2, "no more than was allowed"
    assert all((raster.metres_to(np.array([n])) == was).all() for n, was in enumerate(first))
