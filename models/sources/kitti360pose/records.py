"""The records of KITTI360Pose under their published names (docs/formats.md, published layout).

Readers return these, preparation makes these, writers take these. The project's own types are made from them.
"""

from dataclasses import dataclass

from models.citymap.types import Floats


@dataclass(frozen=True, slots=True, eq=False)
class PublishedObject:
    """An instance inside a published cell (`Object3d`)."""

    id: int  # number inside the cell
    instance_id: int  # number in the scene, shared by the parts of a clipped instance
    xyz: Floats  # [P, 3] cell units, 0..1 inside the cell, may exceed it; float64 in the released set
    rgb: Floats  # [P, 3] 0..1; float32 in the released set, n / 255
    label: str


@dataclass(frozen=True, slots=True, eq=False)
class PublishedCell:
    """A published cell (`Cell`)."""

    id: str  # "0003_00017"
    scene_name: str
    objects: tuple[PublishedObject, ...]  # in stored order
    cell_size: float  # edge in metres
    bbox_w: Floats  # [6] smallest x y z, greatest x y z, world metres


@dataclass(frozen=True, slots=True, eq=False)
class PublishedHint:
    """One hint of a published pose (`DescriptionBestCell`); None where nothing is stored."""

    object_id: int | None  # number inside the best cell; None if the hint is not matched there
    object_instance_id: int  # number in the scene
    object_label: str
    object_color_rgb: Floats  # [3] 0..1, float32 in the released set
    object_color_text: str
    direction: str
    # [2 or 3] pose minus centre or closest point of the instance in the cell around the pose, cell units
    offset_center: Floats
    offset_closest: Floats
    closest_point: Floats  # [2 or 3] of the instance in the cell around the pose, cell units
    best_offset_center: Floats | None  # the same offsets in the best cell, None if not matched
    best_offset_closest: Floats | None
    is_matched: bool  # whether the instance was found in the best cell


@dataclass(frozen=True, slots=True, eq=False)
class PublishedPose:
    """A published position with its description (`Pose`)."""

    pose: Floats  # [3] in the best cell, 0..1
    pose_w: Floats  # [3] world metres
    cell_id: str  # the best cell
    scene_name: str
    described_by: str  # strategy that chose the hints
    descriptions: tuple[PublishedHint, ...]
