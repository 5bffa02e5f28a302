import numpy as np
import pytest
import shapely

from index.answering.query import Reply
from index.asking.question_spec import OPEN_QUESTIONS, QuestionSpec
from index.evaluation import simulated_person as measured
from index.evaluation.simulated_person import MapTruth, SimulatedPerson
from tests.models.citymap.gazetteer.made_town import made_gazetteer

LABELS = ("tree", "bench", "bollard", "building")


@pytest.fixture(scope="module")
def truth(source):
    return MapTruth(source.geometry(), source.data.gallery, source.data.palette, source.gazetteer())


@pytest.fixture
def sure(truth, monkeypatch):
    """(position) -> a person there who errs in nothing."""
    for name in ("WRONG_SHARE", "UNKNOWN_SHARE", "DISTANCE_LOG_SIGMA", "BEARING_SIGMA_DEG"):
        monkeypatch.setattr(measured, name, 0.0)
    return lambda position: SimulatedPerson(truth, 0, position, np.random.default_rng(0))


@pytest.mark.parametrize("label", LABELS)
def test_the_truth_is_that_of_the_map(truth, city, data_and_queries, sure, label) -> None:
    pieces = city.pieces
    of_class = np.flatnonzero([city.instances[i].label == label for i in pieces.instance])
    for position in data_and_queries[1].positions_m[:40:8]:
        lines = shapely.shortest_line(shapely.Point(position), pieces.geometry(of_class))
        nearest = int(shapely.length(lines).argmin())
        east, north = np.diff(shapely.get_coordinates(lines[nearest]), axis=0)[0]
        metres, bearing, number = truth.nearest(0, position, label)
        assert metres == pytest.approx(np.hypot(east, north), abs=0.01)
        assert number == pieces.instance[of_class[nearest]] or metres == 0.0
        person = sure(position)
        near = "yes" if metres <= 10 else "no"
        assert person.reply(QuestionSpec("near", (label,)).question()).choice == near
        wind = ("north" if north > 0 else "south") if abs(north) > abs(east) else ("east" if east > 0 else "west")
        assert person.reply(QuestionSpec("way", (label,)).question()).choice == (wind if metres <= 15 else "none")
        assert bearing == pytest.approx(np.degrees(np.arctan2(east, north)), abs=0.5)


def test_people_name_the_street_they_are_on(truth, data_and_queries, sure) -> None:
    near = [(truth.names_near("street", position, 40.0), position) for position in data_and_queries[1].positions_m[:60]]
    position, name = next(
        (point, near_streets[0][1])
        for near_streets, point in near
        if len(near_streets) == 1 or near_streets[1][0] > near_streets[0][0] + 5
    )
    assert sure(position).reply(QuestionSpec("street").question()).choice == name


@pytest.fixture
def in_town(source, monkeypatch):
    """(x, y, seed) -> a person in the made-up town of names who errs in nothing."""
    for name in ("WRONG_SHARE", "UNKNOWN_SHARE", "DISTANCE_LOG_SIGMA"):
        monkeypatch.setattr(measured, name, 0.0)
    town = MapTruth(source.geometry(), source.data.gallery, source.data.palette, made_gazetteer())
    return lambda x, y, seed=0: SimulatedPerson(town, 0, np.array([x, y]), np.random.default_rng(seed))


def test_people_read_signs_that_are_near(in_town) -> None:
    question = QuestionSpec("name").question()
    choices = [in_town(60.0, 90.0, seed).reply(question).choice for seed in range(300)]
    assert set(choices) == {"Кафе Пушкин", "北京饭店"}
    assert np.mean([name == "Кафе Пушкин" for name in choices]) == pytest.approx((1 / 7) / (1 / 7 + 1 / 27), abs=0.06)
    assert in_town(60.0, 400.0).reply(question).choice == "unknown"


def test_people_know_the_nearest_street_that_crosses(in_town) -> None:
    question = QuestionSpec("corner").question()
    assert in_town(60.0, 82.0).reply(question).choice == "11th Avenue"
    assert in_town(120.0, 82.0).reply(question).choice == "10th Avenue"
    assert in_town(198.0, 30.0).reply(question).choice == "West 24th Street"
    either = {in_town(100.0, 80.0, seed).reply(question).choice for seed in range(20)}
    assert either == {"11th Avenue", "10th Avenue"}
    assert in_town(100.0, 420.0).reply(question).choice == "unknown"  # on a road that none crosses


def test_people_read_the_number_that_seems_nearest(in_town, monkeypatch) -> None:
    question = QuestionSpec("address").question()
    assert in_town(250.0, 84.0).reply(question).choice == "450 West 25th Street"
    assert in_town(250.0, 76.0).reply(question).choice == "449 West 25th Street"
    assert in_town(60.0, 80.0).reply(question).choice == "unknown"
    monkeypatch.setattr(measured, "DISTANCE_LOG_SIGMA", 0.25)
    choices = [in_town(250.0, 82.0, seed).reply(question).choice for seed in range(300)]
    assert 0.5 < np.mean([name == "450 West 25th Street" for name in choices]) < 0.95  # 13 m away, the other 17


@pytest.mark.parametrize("kind", OPEN_QUESTIONS)
def test_a_wrong_name_is_another_of_the_map(in_town, monkeypatch, kind) -> None:
    monkeypatch.setattr(measured, "WRONG_SHARE", 1.0)
    x = 250.0 if kind == "address" else 120.0
    names = {in_town(x, 90.0, seed).reply(QuestionSpec(kind).question()).choice for seed in range(200)}
    right = {
        "street": "West 25th Street",
        "name": "T-Optik",
        "corner": "10th Avenue",
        "address": "450 West 25th Street",
    }
    assert right[kind] not in names
    assert len(names) >= 4


def test_people_err_as_often_as_is_said(truth, data_and_queries) -> None:
    away = [truth.nearest(0, position, "building")[0] for position in data_and_queries[1].positions_m]
    position = data_and_queries[1].positions_m[int(np.argmax(away))]
    assert max(away) > 20, "far enough that nobody takes it for ten metres"
    person = SimulatedPerson(truth, 0, position, np.random.default_rng(0))
    question = QuestionSpec("near", ("building",)).question()
    replies = [person.reply(question) for _ in range(600)]
    assert np.mean([reply.choice == "unknown" for reply in replies]) == pytest.approx(0.2, abs=0.05)
    assert all(isinstance(reply, Reply) and reply.question == question.id for reply in replies)
    assert np.mean([reply.choice == "yes" for reply in replies]) == pytest.approx(0.08, abs=0.04)
