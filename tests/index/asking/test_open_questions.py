import numpy as np
import pytest

from index.answering.query import Reply
from index.asking.open_questions import OpenQuestions
from index.asking.question_spec import OPEN_QUESTIONS, QuestionSpec
from models.errors import ReplyError
from models.posterior.places.landmarks import Landmarks
from models.posterior.questions import WRONG_REPLY_SHARE
from tests.models.citymap.gazetteer.made_town import made_gazetteer

CENTERS = np.array(
    [(100.0, 78.0), (190.0, 75.0), (200.0, 80.0), (120.0, 92.0), (215.0, 300.0), (100.0, 300.0), (250.0, 88.0)]
)
NAMES = {"street": 7, "name": 11, "corner": 7, "address": 5}


@pytest.fixture(scope="module")
def questions():
    return OpenQuestions(Landmarks.build(made_gazetteer(), CENTERS, ("shop", "amenity", "leisure")))


@pytest.mark.parametrize("kind", OPEN_QUESTIONS)
def test_what_can_be_said_is_what_the_rows_have(questions, kind):
    """A reply is as likely as the row of each cell has it, with errors."""
    rows, names = questions.rows(QuestionSpec(kind), np.arange(len(CENTERS)), [])
    assert names == NAMES[kind]
    total = np.zeros(len(CENTERS))
    for n in range(names):
        [name] = questions.likeliest_names(QuestionSpec(kind), np.eye(names)[n])
        chance = np.exp(questions.log_p([Reply(kind, name.upper())]))
        right = rows.toarray()[:, n]
        assert chance == pytest.approx((1 - WRONG_REPLY_SHARE) * right + WRONG_REPLY_SHARE * (1 - right) / (names - 1))
        total += chance
    here = rows.sum(axis=1)
    assert here.max() > 0.9
    # who has none to say does not know, but for errors
    assert total == pytest.approx(here + WRONG_REPLY_SHARE * (1 - here) * names / (names - 1))


def test_the_cross_street_is_of_the_street_that_was_said(questions):
    at_corner, on_west = 2, Reply("street", "W 25th St")
    crossing = {
        street: questions.log_p([on_west, Reply("corner", street)]) - questions.log_p([on_west])
        for street in ("10th Avenue", "West 25th Street")
    }
    assert np.exp(crossing["10th Avenue"][at_corner]) == pytest.approx(1 - WRONG_REPLY_SHARE, abs=0.01)
    wrong = WRONG_REPLY_SHARE / (NAMES["street"] - 1)
    assert np.exp(crossing["West 25th Street"][at_corner]) == pytest.approx(wrong, abs=0.01)
    rows, _ = questions.rows(QuestionSpec("corner"), np.array([at_corner]), [on_west])
    assert questions.likeliest_names(QuestionSpec("corner"), rows.toarray()[0])[0] == "10th Avenue"
    known = questions.likeliest_names(QuestionSpec("corner"), rows.toarray()[0], {"10th Avenue"})
    assert "10th Avenue" not in known


def test_what_is_unknown_or_closed_tells_nothing(questions):
    assert questions.log_p([]) is None
    assert questions.log_p([Reply("street", "unknown"), Reply("near:tree", "yes")]) is None


@pytest.mark.parametrize(
    ("kind", "what"), [("street", "street"), ("corner", "street"), ("name", "place"), ("address", "house")]
)
def test_a_name_that_the_map_has_not_is_refused_with_advice(questions, kind, what):
    with pytest.raises(ReplyError, match=rf"^answers\[1\]\.choice: is not a {what} .*description.*unknown") as raised:
        questions.log_p([Reply("near:tree", "yes"), Reply(kind, "Elm Street")])
    assert (raised.value.number, raised.value.field) == (1, "choice")


def test_a_map_without_names_asks_for_none():
    gazetteer = made_gazetteer()
    bare = OpenQuestions(Landmarks.build(gazetteer, CENTERS, ("aeroway",)))
    assert [bare.has(kind) for kind in OPEN_QUESTIONS] == [True, False, True, True]
