"""Write the published pickles without the reference package.

The library's pickler would import that package, name array constructors that numpy before 1.26 does not know, and keep
all that it wrote in memory (400 cells with 600 MB of points: 1,215 MB, here 55). So it only writes plain values: a
pickle of protocol 3 is the operations that make its value, and those of records, lists and arrays are written here.
"""

import pickle
from collections.abc import Iterable, Iterator
from typing import Any, BinaryIO

import numpy as np

from models.sources.kitti360pose.pickle_values import RECORD_MODULE, PickledRecord
from models.sources.kitti360pose.records import PublishedCell, PublishedHint, PublishedObject, PublishedPose


def cell_record(cell: PublishedCell) -> PickledRecord:
    """Return a cell as the reference package's `Cell`."""
    objects = [_object_record(item) for item in cell.objects]
    fields = {"scene_name": cell.scene_name, "id": cell.id, "objects": objects}
    return PickledRecord("Cell", {**fields, "cell_size": cell.cell_size, "bbox_w": cell.bbox_w})


def pose_record(pose: PublishedPose) -> PickledRecord:
    """Return a pose as the reference package's `Pose`."""
    fields = {"pose": pose.pose, "pose_w": pose.pose_w, "cell_id": pose.cell_id}
    hints = [_hint_record(hint) for hint in pose.descriptions]
    return PickledRecord(
        "Pose", {**fields, "descriptions": hints, "scene_name": pose.scene_name, "described_by": pose.described_by}
    )


def _object_record(item: PublishedObject) -> PickledRecord:
    names = ("id", "instance_id", "xyz", "rgb", "label")
    return PickledRecord("Object3d", {name: getattr(item, name) for name in names})


def _hint_record(hint: PublishedHint) -> PickledRecord:
    fields = {name: getattr(hint, name) for name in PublishedHint.__slots__}
    return PickledRecord("DescriptionBestCell", {name: value for name, value in fields.items() if value is not None})


def write_records(file: BinaryIO, records: Iterable[PickledRecord]) -> None:
    """Write one pickle with the list of the records; each value is dropped once it is written."""
    file.write(pickle.PROTO + b"\x03" + pickle.EMPTY_LIST)
    for record in records:
        file.writelines(_operations(record))
        file.write(pickle.APPEND)
    file.write(pickle.STOP)


def _operations(value: Any) -> Iterator[bytes]:
    """Yield the operations that make a value: a record, a list, an array, or a plain one."""
    if isinstance(value, PickledRecord):
        yield _global(RECORD_MODULE, value.kind) + pickle.EMPTY_TUPLE + pickle.NEWOBJ + pickle.EMPTY_DICT + pickle.MARK
        for name, item in value.fields.items():
            yield _plain_value(name)
            yield from _operations(item)
        yield pickle.SETITEMS + pickle.BUILD
    elif isinstance(value, list):
        yield pickle.EMPTY_LIST + pickle.MARK
        for item in value:
            yield from _operations(item)
        yield pickle.APPENDS
    elif isinstance(value, np.ndarray):
        # As numpy does it, but under the name that every numpy from 1.x to 2.x knows.
        yield _global("numpy.core.multiarray", "_reconstruct") + _global("numpy", "ndarray")
        yield _plain_value((0,)) + _plain_value(b"b") + pickle.TUPLE3 + pickle.REDUCE
        yield _plain_value(value.__reduce__()[2])
        yield pickle.BUILD
    else:
        yield _plain_value(value.item() if isinstance(value, np.generic) else value)


def _global(module: str, name: str) -> bytes:
    return pickle.GLOBAL + f"{module}\n{name}\n".encode()


def _plain_value(value: Any) -> bytes:
    """Return the operations of a value, without the protocol and the stop."""
    return pickle.dumps(value, protocol=3)[2:-1]
