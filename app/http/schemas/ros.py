"""An answer as ROS has it: geometry_msgs/PoseWithCovarianceStamped, axes as REP-103 says (x east, y north, z up)."""

import math
import time
from typing import Final

from pydantic import BaseModel, Field

from index.answering.answers import Estimate

UNKNOWN_M2: Final = 1e4  # variance of a height that nobody told
UNKNOWN_RAD2: Final = math.pi**2 / 3  # of an angle that could be any


class Stamp(BaseModel):
    """builtin_interfaces/Time."""

    sec: int
    nanosec: int


class Header(BaseModel):
    """std_msgs/Header."""

    stamp: Stamp
    frame_id: str


class Vector(BaseModel):
    """geometry_msgs/Point."""

    x: float
    y: float
    z: float


class Quaternion(BaseModel):
    """geometry_msgs/Quaternion."""

    x: float
    y: float
    z: float
    w: float


class Pose(BaseModel):
    """geometry_msgs/Pose."""

    position: Vector
    orientation: Quaternion


class PoseWithCovariance(BaseModel):
    """geometry_msgs/PoseWithCovariance."""

    pose: Pose
    covariance: list[float] = Field(min_length=36, max_length=36, description="x, y, z, roll, pitch, yaw; row by row")


class PoseWithCovarianceStamped(BaseModel):
    """geometry_msgs/PoseWithCovarianceStamped; its heading is the identity, with a wide variance, if none was told."""

    header: Header
    pose: PoseWithCovariance


def pose_of(estimate: Estimate, frame_id: str, now_s: float | None = None) -> PoseWithCovarianceStamped:
    """An estimate as a pose.

    Args:
        estimate: metres, map frame.
        frame_id: of the map.
        now_s: seconds since 1970 when it was found; None: now.
    """
    seconds, rest = divmod(time.time() if now_s is None else now_s, 1)
    yaw, yaw_rad2 = 0.0, UNKNOWN_RAD2
    if estimate.heading is not None:
        yaw = math.radians(90.0 - estimate.heading.mean_deg)  # from east, counter-clockwise
        yaw_rad2 = min(math.radians(estimate.heading.spread_deg) ** 2, UNKNOWN_RAD2)
    covariance = [0.0] * 36
    (covariance[0], covariance[1]), (covariance[6], covariance[7]) = estimate.covariance
    covariance[14], covariance[21], covariance[28], covariance[35] = UNKNOWN_M2, UNKNOWN_RAD2, UNKNOWN_RAD2, yaw_rad2
    x, y = estimate.position
    pose = Pose(
        position=Vector(x=x, y=y, z=0.0),
        orientation=Quaternion(x=0.0, y=0.0, z=math.sin(yaw / 2), w=math.cos(yaw / 2)),
    )
    return PoseWithCovarianceStamped(
        header=Header(stamp=Stamp(sec=int(seconds), nanosec=int(rest * 1e9)), frame_id=frame_id),
        pose=PoseWithCovariance(pose=pose, covariance=covariance),
    )
