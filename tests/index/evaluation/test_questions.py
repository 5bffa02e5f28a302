import numpy as np
import pytest

from index.answers import Reply
from index.asked import Asked
from index.evaluation import questions as measured
from index.evaluation.questions import Person, Truth, evaluate_questions, questions_table, vague_texts
from models.city.source import open_source
from models.errors import DataError

LABELS = ("tree", "bench", "bollard", "building")


@pytest.fixture(scope="module")
def truth(source):
    return Truth(source.bodies(), source.data.gallery, source.data.palette, source.gazetteer())


@pytest.fixture
def sure(truth, monkeypatch):
    """(position) -> a person there who errs in nothing."""
    for name in ("WRONG", "DO_NOT_KNOW", "IDEAS", "TURN"):
        monkeypatch.setattr(measured, name, 0.0)
    return lambda position: Person(truth, 0, position, np.random.default_rng(0))


@pytest.mark.parametrize("label", LABELS)
def test_the_truth_is_that_of_the_map(truth, city, asked, sure, label) -> None:
    for position in asked[1].positions_m[:40:8]:
        ways = [
            (instance, instance.points_m[:, :2] - position) for instance in city.instances if instance.label == label
        ]
        away = [np.hypot(*way.T).min() for _, way in ways]
        instance, way = ways[int(np.argmin(away))]
        east, north = way[np.hypot(*way.T).argmin()]
        metres, bearing, number = truth.nearest(0, position, label)
        assert metres == pytest.approx(min(away), abs=0.01)
        assert city.instances[number].source_id == instance.source_id
        person = sure(position)
        near = "yes" if metres <= 10 else "no"
        assert person.reply(Asked("near", (label,)).question()).choice == near
        wind = ("north" if north > 0 else "south") if abs(north) > abs(east) else ("east" if east > 0 else "west")
        assert person.reply(Asked("way", (label,)).question()).choice == (wind if metres <= 15 else "none")
        assert bearing == pytest.approx(np.degrees(np.arctan2(east, north)), abs=0.5)


def test_people_name_the_street_they_are_on(truth, asked, sure) -> None:
    near = [(truth.streets(position), position) for position in asked[1].positions_m[:60]]
    position, name = next((at, some[0][1]) for some, at in near if len(some) == 1 or some[1][0] > some[0][0] + 5)
    other, third = [f"East Street {n}" for n in range(6) if f"East Street {n}" != name][:2]
    assert sure(position).reply(Asked("street", (other, name)).question()).choice == name
    assert sure(position).reply(Asked("street", (other, third)).question()).choice == "other"


def test_people_err_as_often_as_is_said(truth, asked) -> None:
    position = asked[1].positions_m[0]
    person = Person(truth, 0, position, np.random.default_rng(0))
    question = Asked("near", ("building",)).question()
    metres = truth.nearest(0, position, "building")[0]
    replies = [person.reply(question) for _ in range(600)]
    assert np.mean([reply.choice == "unknown" for reply in replies]) == pytest.approx(0.2, abs=0.05)
    assert all(isinstance(reply, Reply) and reply.question == question.id for reply in replies)
    if metres > 30:
        assert np.mean([reply.choice == "yes" for reply in replies]) == pytest.approx(0.08, abs=0.04)


def test_vague_texts_have_two_hints(asked) -> None:
    rng = np.random.default_rng(0)
    [template] = vague_texts(asked[1], [0], rng, is_plain=False)
    [plain] = vague_texts(asked[1], [0], rng, is_plain=True)
    assert template.count("The pose is") == 2
    assert plain.startswith("There is a ")
    assert not any(wind in plain for wind in ("north", "east", "south", "west"))


@pytest.mark.slow
def test_the_report_tells_of_every_number_of_questions(localizer, source) -> None:
    report = evaluate_questions(localizer, source, 12, 0, lambda *_: None)
    assert report == evaluate_questions(localizer, source, 12, 0, lambda *_: None)
    after = report["after"]
    assert [row["questions"] for row in after] == [0, 1, 2, 3]
    assert sum(row["asked"] for row in after) == sum(report["kinds"].values()) > 0
    assert after[1]["asked"] >= after[2]["asked"] >= after[3]["asked"]
    assert all(0 <= row[name] <= 1 for row in after for name in ("within_10_m", "probability", "ok"))
    head, rows = questions_table(report)
    assert all(len(row) == len(head) for row in rows)


def test_the_index_must_be_of_the_data(localizer, osm_file) -> None:
    with pytest.raises(DataError, match="other cells"):
        evaluate_questions(localizer, open_source(osm_file, "val"), 1, 0, lambda *_: None)
