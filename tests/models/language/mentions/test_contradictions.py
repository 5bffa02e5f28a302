"""Tests of statements about one object that contradict each other."""

from dataclasses import replace

import numpy as np
import pytest

from models.language.mentions.contradictions import contradictions
from models.language.mentions.cues import Cue
from models.language.mentions.mentions import Mention

MUSEUM = Mention("the Museum", 0, 10, "thing", np.array([4, 5]), np.ones(2), is_exact=True)
STREET = Mention("Mill Street", 0, 11, "street", np.array([9]), np.ones(1), is_exact=True)


def at_angle(mention: Mention, degrees: float) -> Mention:
    return replace(mention, cue=Cue("seen", degrees))


def in_the(mention: Mention, wind: float) -> Mention:
    return replace(mention, cue=Cue("wind", None, wind))


def test_left_and_right_of_one_thing_contradict() -> None:
    [phrase] = contradictions([at_angle(MUSEUM, -90.0), STREET, at_angle(MUSEUM, 90.0)])
    assert phrase == "'the Museum': on the left and on the right are both said, but cannot both be true"


def test_both_sides_of_a_street_contradict() -> None:
    [phrase] = contradictions([replace(STREET, side=0.0), replace(STREET, side=180.0)])
    assert "its north side and its south side" in phrase


def test_north_and_south_of_one_thing_contradict() -> None:
    [phrase] = contradictions([in_the(MUSEUM, 180.0), in_the(MUSEUM, 0.0)])
    assert "in the south and in the north" in phrase


@pytest.mark.parametrize(
    "mentions",
    [
        pytest.param([at_angle(MUSEUM, 0.0), at_angle(MUSEUM, 90.0)], id="a large thing is ahead and on the right"),
        pytest.param([at_angle(MUSEUM, -135.0), at_angle(MUSEUM, 180.0)], id="over the turn of the circle"),
        pytest.param([at_angle(STREET, 0.0), at_angle(STREET, 180.0)], id="a street goes on behind"),
        pytest.param([at_angle(MUSEUM, -90.0), MUSEUM], id="named again without a direction"),
        pytest.param(
            [at_angle(replace(MUSEUM, objects=np.arange(30)), angle) for angle in (-90.0, 90.0)], id="two of a chain"
        ),
        pytest.param(
            [at_angle(MUSEUM, -90.0), at_angle(replace(MUSEUM, objects=np.array([7])), 90.0)], id="two things"
        ),
        pytest.param([at_angle(replace(MUSEUM, objects=np.zeros(0, int)), a) for a in (-90.0, 90.0)], id="unknown"),
    ],
)
def test_what_may_be_true_is_no_contradiction(mentions) -> None:
    assert not list(contradictions(mentions))
