import numpy as np
import pytest

from models.citymap.gazetteer.gazetteer import build_gazetteer
from models.citymap.gazetteer.name_columns import GazetteerObject
from models.errors import IndexBroken
from models.posterior.places import landmarks as landmarks_module
from models.posterior.places.landmarks import FILE, Landmarks
from models.posterior.places.name_probabilities import ON_STREET_REACH_M
from tests.models.citymap.gazetteer.made_town import made_gazetteer, point

CENTERS = np.array([(100.0, 78.0), (190.0, 75.0), (200.0, 80.0), (120.0, 92.0), (215.0, 300.0), (100.0, 300.0)])


@pytest.fixture(scope="module")
def landmarks():
    return Landmarks.build(made_gazetteer(), CENTERS, ("shop", "amenity"))


def dense(table):
    """[N, K] all of a table."""
    return table.rows(np.arange(len(table.starts) - 1)).toarray()


def chance_of(table, names, name):
    """[N] chance of a name in each cell."""
    return table.probability(names.find(name))


def test_who_is_in_a_street_says_so(landmarks):
    chance = dense(landmarks.street_table)
    assert [landmarks.streets.shown[n] for n in chance[[0, 3]].argmax(axis=1)] == ["West 25th Street"] * 2
    assert chance[0].max() > 0.99
    east, avenue = (chance_of(landmarks.street_table, landmarks.streets, name) for name in ("w 25TH st", "10th Avenue"))
    assert (east[2], avenue[2]) == pytest.approx((0.5, 0.5))  # at the corner
    assert east[1] > avenue[1] > 0.2
    assert chance[5].sum() == 0.0  # farther than ON_STREET_REACH_M from any
    assert ON_STREET_REACH_M < 90
    assert (chance.sum(axis=1) < 1 + 1e-3).all()


def test_a_sign_is_said_from_near_rather_than_from_far(landmarks):
    chance = chance_of(landmarks.name_table, landmarks.names, "t optik")
    assert chance[3] > 0.9  # at its door
    assert 0.2 < chance[0] < 0.6  # two restaurants are farther, it is 24 m away
    assert chance[4] == 0.0
    assert (dense(landmarks.name_table).sum(axis=1) < 1 + 1e-3).all()
    assert not len(landmarks.names.find("London Terrace Gardens"))  # a building has no sign


def test_of_one_name_the_nearest_counts():
    here, there = point(8.0, 0.0), point(25.0, 0.0)
    chances = []
    for places in ([here, there], [there, here], [here], [there]):
        words = [GazetteerObject(("shop/bakery", "shop"), ("Rossi Bakery",))] * len(places)
        town = Landmarks.build(build_gazetteer(words, places, [False] * len(places)), np.zeros((1, 2)), ("shop",))
        chances.append(chance_of(town.name_table, town.names, "Rossi Bakery")[0])
    assert chances[0] == chances[1] == chances[2] > chances[3] > 0


def test_the_number_of_the_nearest_house_is_said():
    centers = np.array([(250.0, 88.0), (250.0, 80.0), (370.0, 95.0), (250.0, 300.0)])
    town = Landmarks.build(made_gazetteer(), centers, ("shop",))
    chance = chance_of(town.address_table, town.addresses, "450 W 25th St")
    assert chance[0] > 0.7  # 7 m away, that across the street 23 m
    assert chance[1] == pytest.approx(chance_of(town.address_table, town.addresses, "449 West 25th Street")[1])
    assert 0.8 < dense(town.address_table).sum(axis=1)[1] < 0.9
    assert chance_of(town.address_table, town.addresses, "402 W 25th")[2] == pytest.approx(
        chance_of(town.address_table, town.addresses, "410 W 25th")[2]
    )
    assert dense(town.address_table).sum(axis=1)[3] == 0.0


def test_the_street_that_crosses_is_the_nearest(landmarks):
    streets, none = landmarks.streets, np.zeros(0, np.int64)
    tenth, west = streets.find("10th Avenue"), streets.find("West 25th Street")
    on_west = landmarks.crossings.probability(tenth, west)
    assert on_west[[1, 2]].min() > 0.99
    assert on_west[0] == pytest.approx(0.5)  # half way between two
    assert landmarks.crossings.probability(tenth, none)[2] == pytest.approx(
        0.5, abs=0.01
    )  # or on it, and 25th Street crosses
    assert (
        landmarks.crossings.probability(tenth, streets.find("Harlem Road"))[3]
        == landmarks.crossings.probability(tenth, none)[3]
    )
    assert landmarks.has_corners


@pytest.mark.parametrize("street_names", [(), ("West 25th Street",), ("Harlem Road", "10th Avenue")])
def test_rows_and_columns_of_crossings_agree(landmarks, street_names):
    on = np.concatenate([np.zeros(0, np.int64), *(landmarks.streets.find(name) for name in street_names)])
    rows = landmarks.crossings.rows(np.arange(len(CENTERS)), on).toarray()
    for n in range(len(landmarks.streets)):
        assert rows[:, n] == pytest.approx(landmarks.crossings.probability(np.array([n]), on))
    assert rows.sum(axis=1)[:4] == pytest.approx(np.ones(4))


def test_cells_do_not_depend_on_which_others_there_are(landmarks):
    subset = Landmarks.build(made_gazetteer(), CENTERS[[3, 1]], ("shop", "amenity"))
    assert dense(subset.name_table) == pytest.approx(dense(landmarks.name_table)[[3, 1]])
    assert dense(subset.street_table) == pytest.approx(dense(landmarks.street_table)[[3, 1]])
    crossings = [dense(one.crossings.pairs) for one in (subset, landmarks)]
    assert crossings[0] == pytest.approx(crossings[1][[3, 1]])


@pytest.mark.parametrize("cells_per_block", [1, 4])
def test_landmarks_are_the_same_of_however_many_cells_cells_per_block(cells_per_block, landmarks, monkeypatch):
    monkeypatch.setattr(landmarks_module, "CELLS_PER_LANDMARK_BLOCK", cells_per_block)
    subset = Landmarks.build(made_gazetteer(), CENTERS, ("shop", "amenity"))
    for name in ("street_table", "name_table", "address_table"):
        assert (dense(getattr(subset, name)) == dense(getattr(landmarks, name))).all()
    assert (dense(subset.crossings.pairs) == dense(landmarks.crossings.pairs)).all()
    assert subset.crossings.on.tolist() == landmarks.crossings.on.tolist()
    assert subset.crossings.other.tolist() == landmarks.crossings.other.tolist()


def test_what_is_saved_is_loaded(landmarks, tmp_path):
    landmarks.save(tmp_path)
    loaded = Landmarks.load(tmp_path)
    tables = [
        (getattr(landmarks, name), getattr(loaded, name)) for name in ("street_table", "name_table", "address_table")
    ]
    for was, loaded_table in [*tables, (landmarks.crossings.pairs, loaded.crossings.pairs)]:
        assert (dense(was) == dense(loaded_table)).all()
        assert dense(loaded_table).any()
    for name in ("on", "other"):
        assert (getattr(landmarks.crossings, name) == getattr(loaded.crossings, name)).all()
    assert loaded.crossings.streets == landmarks.crossings.streets
    for name in ("25th", "W 25th St"):
        assert loaded.streets.find(name).tolist() == landmarks.streets.find(name).tolist() != []
    assert loaded.addresses.find("402").tolist() == landmarks.addresses.find("402").tolist() != []
    assert list(loaded.names.shown) == list(landmarks.names.shown)


@pytest.mark.parametrize("content", [None, b"", b"{}"])
def test_a_missing_or_broken_file_is_refused(landmarks, tmp_path, content):
    if content is not None:
        (tmp_path / FILE).write_bytes(content)
    with pytest.raises(IndexBroken, match="hereabouts index"):
        Landmarks.load(tmp_path)
