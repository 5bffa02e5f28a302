"""The records of KITTI360Pose under their published names (docs/formats.md, published layout).

Readers return these, preparation makes these, writers take these. The project's own types are made from them.
"""

from dataclasses import dataclass

from models.citymap.types import Floats


@dataclass(frozen=True, slots=True, eq=False)
class PublishedObject:
    """An instance inside a published cell (`Object3d`).

    Attributes:
        id: number inside the cell.
        instance_id: number in the scene, shared by the parts of a clipped instance.
        xyz: [P, 3] cell units, 0..1 inside the cell, may exceed it; float64 in the released set.
        rgb: [P, 3] 0..1; float32 in the released set, n / 255.
        label: class.
    """

    id: int
    instance_id: int
    xyz: Floats
    rgb: Floats
    label: str


@dataclass(frozen=True, slots=True, eq=False)
class PublishedCell:
    """A published cell (`Cell`).

    Attributes:
        id: "0003_00017".
        scene_name: "0003".
        objects: in stored order.
        cell_size: edge in metres.
        bbox_w: [6] smallest x y z, greatest x y z, world metres.
    """

    id: str
    scene_name: str
    objects: tuple[PublishedObject, ...]
    cell_size: float
    bbox_w: Floats


@dataclass(frozen=True, slots=True, eq=False)
class PublishedHint:
    """One hint of a published pose (`DescriptionBestCell`); None where nothing is stored.

    Attributes:
        object_id: number inside the best cell; None if the hint is not matched there.
        object_instance_id: number in the scene.
        object_label, object_color_text, direction: the words of the sentence.
        object_color_rgb: [3] 0..1, float32 in the released set.
        offset_center, offset_closest: [2 or 3] pose minus centre, or minus closest point, of the instance in the
            cell around the pose, cell units.
        closest_point: [2 or 3] of the instance in the cell around the pose, cell units.
        best_offset_center, best_offset_closest: the same offsets in the best cell, None if not matched.
        is_matched: whether the instance was found in the best cell.
    """

    object_id: int | None
    object_instance_id: int
    object_label: str
    object_color_rgb: Floats
    object_color_text: str
    direction: str
    offset_center: Floats
    offset_closest: Floats
    closest_point: Floats
    best_offset_center: Floats | None
    best_offset_closest: Floats | None
    is_matched: bool


@dataclass(frozen=True, slots=True, eq=False)
class PublishedPose:
    """A published position with its description (`Pose`).

    Attributes:
        pose: [3] in the best cell, 0..1.
        pose_w: [3] world metres.
        cell_id: the best cell.
        scene_name: "0003".
        described_by: strategy that chose the hints.
        descriptions: the hints.
    """

    pose: Floats
    pose_w: Floats
    cell_id: str
    scene_name: str
    described_by: str
    descriptions: tuple[PublishedHint, ...]
