import numpy as np
import pytest

from models.posterior.places.landmarks import ON_STREET_M, Landmarks
from tests.models.city.gazetteer.made_town import made_gazetteer

CENTERS = np.array([(100.0, 78.0), (190.0, 75.0), (200.0, 80.0), (120.0, 92.0), (215.0, 300.0), (100.0, 300.0)])


@pytest.fixture(scope="module")
def landmarks():
    return Landmarks(made_gazetteer(), CENTERS, ("shop", "amenity"))


def test_who_is_in_a_street_says_so(landmarks):
    chance = landmarks.on_street.toarray()
    streets = list(landmarks.streets)
    assert [streets[n] for n in chance[[0, 3]].argmax(axis=1)] == ["West 25th Street"] * 2
    assert chance[0].max() > 0.99
    east, avenue = landmarks.streets["West 25th Street"], landmarks.streets["10th Avenue"]
    assert chance[2, [east, avenue]] == pytest.approx([0.5, 0.5])  # at the corner
    assert chance[1, east] > chance[1, avenue] > 0.2
    assert chance[5].sum() == 0.0  # farther than ON_STREET_M from any
    assert ON_STREET_M < 90
    assert (chance.sum(axis=1) < 1 + 1e-9).all()


def test_a_sign_is_read_from_near(landmarks):
    seen = landmarks.seen.toarray()[:, landmarks.names["T-Optik"]]
    assert seen[3] > 0.95  # at its door
    assert 0.6 < seen[0] < 0.9
    assert seen[4] == 0.0
    assert "London Terrace Gardens" not in landmarks.names  # a building has no sign


def test_cells_do_not_depend_on_which_others_there_are(landmarks):
    some = Landmarks(made_gazetteer(), CENTERS[[3, 1]], ("shop", "amenity"))
    assert some.seen.toarray() == pytest.approx(landmarks.seen.toarray()[[3, 1]])
    assert some.on_street.toarray() == pytest.approx(landmarks.on_street.toarray()[[3, 1]])
