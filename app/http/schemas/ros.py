"""Answers as ROS messages: geometry_msgs/PoseWithCovarianceStamped with the axes of REP-103 (x east, y north, z up)."""

import math
import time
from typing import Final

from pydantic import BaseModel, Field

from index.answering.answers import Estimate

UNKNOWN_M2: Final = 1e4  # variance of the unknown height
UNKNOWN_RAD2: Final = math.pi**2 / 3  # variance of an angle that is uniform on the circle


class RosTime(BaseModel):
    """builtin_interfaces/Time."""

    sec: int
    nanosec: int


class RosHeader(BaseModel):
    """std_msgs/Header."""

    stamp: RosTime
    frame_id: str


class RosPoint(BaseModel):
    """geometry_msgs/Point."""

    x: float
    y: float
    z: float


class RosQuaternion(BaseModel):
    """geometry_msgs/Quaternion."""

    x: float
    y: float
    z: float
    w: float


class RosPose(BaseModel):
    """geometry_msgs/Pose."""

    position: RosPoint
    orientation: RosQuaternion


class PoseWithCovariance(BaseModel):
    """geometry_msgs/PoseWithCovariance."""

    pose: RosPose
    covariance: list[float] = Field(min_length=36, max_length=36, description="x, y, z, roll, pitch, yaw; row by row")


class PoseWithCovarianceStamped(BaseModel):
    """geometry_msgs/PoseWithCovarianceStamped; an unknown heading is the identity with a wide variance."""

    header: RosHeader
    pose: PoseWithCovariance


def to_ros_pose(estimate: Estimate, frame_id: str, now_s: float | None = None) -> PoseWithCovarianceStamped:
    """Convert an estimate in metres, map frame, to a ROS pose; `now_s` is the Unix time, by default now."""
    seconds, rest = divmod(time.time() if now_s is None else now_s, 1)
    yaw, yaw_rad2 = 0.0, UNKNOWN_RAD2
    if estimate.heading is not None:
        yaw = math.radians(90.0 - estimate.heading.mean_deg)  # from east, counter-clockwise
        yaw_rad2 = min(math.radians(estimate.heading.spread_deg) ** 2, UNKNOWN_RAD2)
    covariance = [0.0] * 36
    (covariance[0], covariance[1]), (covariance[6], covariance[7]) = estimate.covariance
    covariance[14], covariance[21], covariance[28], covariance[35] = UNKNOWN_M2, UNKNOWN_RAD2, UNKNOWN_RAD2, yaw_rad2
    x, y = estimate.position
    pose = RosPose(
        position=RosPoint(x=x, y=y, z=0.0),
        orientation=RosQuaternion(x=0.0, y=0.0, z=math.sin(yaw / 2), w=math.cos(yaw / 2)),
    )
    return PoseWithCovarianceStamped(
        header=RosHeader(stamp=RosTime(sec=int(seconds), nanosec=int(rest * 1e9)), frame_id=frame_id),
        pose=PoseWithCovariance(pose=pose, covariance=covariance),
    )
