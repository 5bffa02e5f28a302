"""Read the published records from unpickled values, field by field; every error names file and field."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from models.citymap.types import DIRECTIONS, Floats
from models.errors import DataError
from models.sources.kitti360pose.pickle_reader import ADVICE
from models.sources.kitti360pose.pickle_values import PickledRecord, RefusedPickle, StoredArray
from models.sources.kitti360pose.records import PublishedCell, PublishedHint, PublishedObject, PublishedPose

MAX_COORDINATE = 1e9  # a larger coordinate is an error: UTM coordinates are below 1e7 m
MIN_SIZE_M, MAX_SIZE_M = 1e-3, 1e6


@dataclass(frozen=True, slots=True)
class PickleFile:
    """The open file that records come from."""

    path: Path
    file: BinaryIO

    def error(self, field: str, problem: str) -> DataError:
        """Return the error for a field of this file."""
        return DataError(f"{self.path}: {field} {problem}; {ADVICE}")

    def read_records(self, value: Any, field: str, kind: str) -> "list[Fields]":
        """Return the records in a value that should be a list of one kind of them; raise DataError otherwise."""
        if type(value) is not list:
            raise self.error(field, f"is not a list of {kind}, but {_describe_type(value)}")
        for n, item in enumerate(value):
            if not isinstance(item, PickledRecord) or item.kind != kind:
                raise self.error(f"{field}[{n}]", f"is not a {kind}, but {_describe_type(item)}")
            if item.is_listed:
                raise self.error(f"{field}[{n}]", "is the same object as an earlier one")
            item.is_listed = True
        return [Fields(self, f"{field}[{n}]", item.fields) for n, item in enumerate(value)]


@dataclass(frozen=True, slots=True)
class Fields:
    """The attributes of one record, and its place in the file; each method raises DataError."""

    pickle: PickleFile
    where: str
    fields: dict[str, Any]

    def error(self, name: str, problem: str) -> DataError:
        """Return the error for an attribute."""
        return self.pickle.error(f"{self.where}.{name}", problem)

    def value(self, name: str) -> Any:
        """Return an attribute as it is."""
        if name not in self.fields:
            raise self.error(name, "is missing")
        return self.fields[name]

    def text(self, name: str) -> str:
        """Return a word or name."""
        value = self.value(name)
        if type(value) is not str or not value or not value.isprintable():
            raise self.error(name, f"is not printable text, but {_describe_type(value)}")
        return value

    def integer(self, name: str) -> int:
        """Return a number that fits 64 bits."""
        value = self.value(name)
        if type(value) is not int or not -(2**63) <= value < 2**63:
            raise self.error(name, f"is not a whole number of 64 bits, but {_describe_type(value)}")
        return value

    def flag(self, name: str) -> bool:
        """Return True or False."""
        value = self.value(name)
        if type(value) is not bool:
            raise self.error(name, f"is neither True nor False, but {_describe_type(value)}")
        return value

    def length(self, name: str) -> float:
        """Return a length in metres."""
        value = self.value(name)
        if type(value) not in (int, float) or not MIN_SIZE_M <= value <= MAX_SIZE_M:
            raise self.error(name, f"is not a length in metres, but {_describe_type(value)}")
        return float(value)

    def array(self, name: str) -> npt.NDArray[Any]:
        """Return an array of finite numbers, dtype as stored."""
        stored = self.value(name)
        if not isinstance(stored, StoredArray):
            raise self.error(name, f"is not an array, but {_describe_type(stored)}")
        try:
            values = stored.read(self.pickle.file)
        except (RefusedPickle, EOFError, OSError) as error:
            raise self.error(name, "has no values that can be read") from error
        if values.dtype.kind not in "fiu":
            raise self.error(name, f"has dtype {values.dtype}, not numbers")
        # A comparison with NaN is false, so this finds NaN and infinities as well.
        if not ((values >= -MAX_COORDINATE) & (values <= MAX_COORDINATE)).all():
            raise self.error(name, f"holds a number that is NaN, infinite or beyond {MAX_COORDINATE:g}")
        return values

    def vector(self, name: str, sizes: Sequence[int]) -> Floats:
        """Return a float64 vector of one of some sizes."""
        values = self.array(name)
        if values.ndim != 1 or len(values) not in sizes:
            wanted = " or ".join(str(size) for size in sizes)
            raise self.error(name, f"has shape {list(values.shape)}, not [{wanted}]")
        return values.astype(np.float64)

    def optional_vector(self, name: str, sizes: Sequence[int]) -> Floats | None:
        """Return a vector, or None if nothing is stored."""
        return None if self.fields.get(name) is None else self.vector(name, sizes)

    def colour(self, name: str) -> Floats:
        """Return a colour [3] in 0..1, float32 or float64 as stored."""
        values = self.array(name)
        if values.shape != (3,) or values.dtype.kind != "f":
            raise self.error(name, f"has shape {list(values.shape)} and dtype {values.dtype}, not [3] of floats")
        return self.check_unit_range(name, values)

    def points(self, name: str) -> Floats:
        """Return at least one point [P, 3], float32 or float64 as stored."""
        values = self.array(name)
        if values.ndim != 2 or values.shape[1] != 3 or values.dtype.kind != "f":
            raise self.error(name, f"has shape {list(values.shape)} and dtype {values.dtype}, not [P, 3] of floats")
        if not len(values):
            raise self.error(name, "is empty; an instance has at least one point")
        return values

    def check_unit_range(self, name: str, values: Floats) -> Floats:
        """Return colours if they are in 0..1."""
        if values.min() < 0 or values.max() > 1:
            raise self.error(name, f"holds {values.min():g}..{values.max():g}; colours are 0..1")
        return values


def read_cell(cell: Fields) -> PublishedCell:
    """Read and check a cell with its points."""
    box = cell.vector("bbox_w", (6,))
    if not (box[:3] < box[3:]).all():
        raise cell.error("bbox_w", "is not a box: smallest x y z, then greatest x y z")
    records = cell.pickle.read_records(cell.value("objects"), f"{cell.where}.objects", "Object3d")
    objects = [read_object(item) for item in records]
    numbers = [item.id for item in objects]
    if len(set(numbers)) != len(numbers):
        raise cell.error("objects", "has two objects of one id")
    if not objects:
        raise cell.error("objects", "is empty; a cell has at least one object")
    return PublishedCell(cell.text("id"), cell.text("scene_name"), tuple(objects), cell.length("cell_size"), box)


def read_object(item: Fields) -> PublishedObject:
    """Read and check an instance with its points."""
    xyz, rgb = item.points("xyz"), item.check_unit_range("rgb", item.points("rgb"))
    if len(xyz) != len(rgb):
        raise item.error("rgb", f"has {len(rgb)} points, xyz has {len(xyz)}")
    return PublishedObject(item.integer("id"), item.integer("instance_id"), xyz, rgb, item.text("label"))


def read_pose(pose: Fields) -> PublishedPose:
    """Read and check a pose with its hints."""
    value = pose.value("descriptions")
    hints = pose.pickle.read_records(value, f"{pose.where}.descriptions", "DescriptionBestCell")
    if not hints:
        raise pose.error("descriptions", "is empty; a pose has at least one hint")
    return PublishedPose(
        pose=pose.vector("pose", (3,)),
        pose_w=pose.vector("pose_w", (3,)),
        cell_id=pose.text("cell_id"),
        scene_name=pose.text("scene_name"),
        described_by=pose.text("described_by"),
        descriptions=tuple(read_hint(hint) for hint in hints),
    )


def read_hint(hint: Fields) -> PublishedHint:
    """Read and check a hint."""
    direction, is_matched = hint.text("direction"), hint.flag("is_matched")
    if direction not in DIRECTIONS:
        raise hint.error("direction", f"is '{direction[:20]}', not one of {', '.join(DIRECTIONS)}")
    best = hint.vector if is_matched else hint.optional_vector
    has_id = is_matched or hint.fields.get("object_id") is not None
    return PublishedHint(
        object_id=hint.integer("object_id") if has_id else None,
        object_instance_id=hint.integer("object_instance_id"),
        object_label=hint.text("object_label"),
        object_color_rgb=hint.colour("object_color_rgb"),
        object_color_text=hint.text("object_color_text"),
        direction=direction,
        offset_center=hint.vector("offset_center", (2, 3)),
        offset_closest=hint.vector("offset_closest", (2, 3)),
        closest_point=hint.vector("closest_point", (2, 3)),
        best_offset_center=best("best_offset_center", (2, 3)),
        best_offset_closest=best("best_offset_closest", (2, 3)),
        is_matched=is_matched,
    )


def _describe_type(value: Any) -> str:
    """Return the type of a value for a message, never its content, which may be long or not printable."""
    if isinstance(value, PickledRecord):
        return f"a {value.kind}"
    return {"NoneType": "None", "StoredArray": "an array"}.get(type(value).__name__, f"a {type(value).__name__}")
