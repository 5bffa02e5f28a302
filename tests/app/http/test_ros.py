import math
from dataclasses import replace

import numpy as np
import pytest
from fake_localizer import FakeLocalizer

from app.http.schemas.ros import UNKNOWN_RAD2, to_ros_pose
from index.answering.answers import Estimate, Heading, Radius

ESTIMATE = Estimate((3.0, -4.0), "posterior", ((9.0, 2.0), (2.0, 4.0)), Radius(2.0, 4.0), {}, 0.5, None)


@pytest.mark.parametrize(
    ("heading", "forward"),
    [(0, (0, 1)), (90, (1, 0)), (180, (0, -1)), (270, (-1, 0)), (45, (2**-0.5, 2**-0.5)), (359, (-0.01745, 0.99985))],
)
def test_heading_turns_x_to_where_the_speaker_looks(heading, forward):
    pose = to_ros_pose(replace(ESTIMATE, heading=Heading(heading, 10.0)), "map").pose
    q = pose.pose.orientation
    assert q.x == q.y == 0
    assert (1 - 2 * q.z**2, 2 * q.z * q.w) == pytest.approx(forward, abs=1e-4)
    assert pose.covariance[35] == pytest.approx(math.radians(10) ** 2)


def test_covariance_is_of_the_plane_and_wide_in_what_nobody_told():
    message = to_ros_pose(ESTIMATE, "town", now_s=1234.25)
    matrix = np.array(message.pose.covariance).reshape(6, 6)
    assert matrix[:2, :2].tolist() == [[9.0, 2.0], [2.0, 4.0]]
    assert np.array_equal(matrix, matrix.T)
    assert np.linalg.eigvalsh(matrix).min() > 0
    assert matrix[5, 5] == UNKNOWN_RAD2
    assert (message.pose.pose.position.x, message.pose.pose.position.y) == (3.0, -4.0)
    assert message.pose.pose.orientation.w == 1.0
    assert (message.header.stamp.sec, message.header.stamp.nanosec, message.header.frame_id) == (
        1234,
        250_000_000,
        "town",
    )


def test_it_is_given_to_who_asks(settings, start):
    with start(settings, FakeLocalizer()) as api:
        assert api.post("/localize", json={"description": "a tree"}).json()["ros"] is None
        answer = api.post("/localize", json={"description": "a tree", "ros": True}).json()
        assert answer["ros"]["pose"]["covariance"][0] == 100.0
        assert answer["ros"]["header"]["frame_id"] == answer["crs"]["frame_id"]
        assert api.post("/localize", json={"description": "nowhere", "ros": True}).json()["ros"] is None
