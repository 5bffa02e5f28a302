"""Write the published pickles without the reference package.

`pickle` would import that package, name array constructors that numpy before 1.26 does not know, and keep all that it
wrote in memory (400 cells with 600 MB of points: 1,215 MB, here 55). So it only writes plain values here.
"""

import pickle
from collections.abc import Iterable, Iterator
from typing import Any, BinaryIO

import numpy as np

from models.sources.kitti360pose.pickle_values import RECORD_MODULE, PickledRecord
from models.sources.kitti360pose.records import PublishedCell, PublishedPose


def cell_record(cell: PublishedCell) -> PickledRecord:
    """Return a cell as the reference package's `Cell`."""
    return _record("Cell", cell, objects=[_record("Object3d", item) for item in cell.objects])


def pose_record(pose: PublishedPose) -> PickledRecord:
    """Return a pose as the reference package's `Pose`."""
    return _record("Pose", pose, descriptions=[_record("DescriptionBestCell", hint) for hint in pose.descriptions])


def _record(kind: str, published: Any, **parts: list[PickledRecord]) -> PickledRecord:
    """Return the fields that have a value as a record, with records of its parts."""
    fields = {name: getattr(published, name) for name in published.__slots__} | parts
    return PickledRecord(kind, {name: value for name, value in fields.items() if value is not None})


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
