import numpy as np
import pytest

from models.citymap.gazetteer.gazetteer import WALKED_KIND, build_gazetteer
from models.citymap.gazetteer.name_columns import GazetteerObject
from models.citymap.gazetteer.walkways import MAX_DISTANCE_M, Walkways
from tests.models.citymap.gazetteer.made_town import line, ring

LOW, HIGH = np.array([0.0, 0.0]), np.array([200.0, 200.0])


@pytest.fixture
def walkways() -> Walkways:
    town = build_gazetteer(
        [
            GazetteerObject((WALKED_KIND,)),
            GazetteerObject(("highway/pedestrian_area",)),
            GazetteerObject(("leisure/park",), ("Park",)),
        ],
        [line((0.0, 20.0), (200.0, 20.0)), ring(100, 100, 140, 140), ring(0, 150, 40, 190)],
        [False, True, True],
    )
    return Walkways(town, LOW, HIGH)


@pytest.mark.parametrize(
    ("position", "metres"),
    [
        ((50, 20), 0),
        ((50, 30), 10),
        ((120, 120), 0),
        ((150, 120), 10),
        ((20, 170), MAX_DISTANCE_M),
        ((1e6, 0), MAX_DISTANCE_M),
    ],
)
def test_metres_to_lines_and_squares(walkways, position, metres) -> None:
    assert walkways.distances_m(np.array([position], dtype=float))[0] == pytest.approx(metres, abs=1.5)


def test_many_positions_at_once(walkways) -> None:
    assert walkways.distances_m(np.zeros((0, 2))).shape == (0,)
    assert walkways.distances_m(np.random.default_rng(0).uniform(-500, 500, (1000, 2))).max() == MAX_DISTANCE_M
