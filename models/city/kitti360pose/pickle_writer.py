"""Writing the published pickles, without the reference package: the operations of protocol 4, one value at a time."""

import pickle
import struct
from collections.abc import Callable, Iterable
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

from models.city.kitti360pose.pickle_values import RECORD_MODULE, Record
from models.city.kitti360pose.records import PublishedCell, PublishedHint, PublishedObject, PublishedPose

BATCH = 1000  # items between a mark and an append, as the library's pickler does
# Written under the old name: numpy from 1.x to 2.x loads it.
MULTIARRAY = "numpy.core.multiarray"


def cell_record(cell: PublishedCell) -> Record:
    """A cell as the reference package's `Cell`."""
    objects = [_object_record(item) for item in cell.objects]
    fields = {"scene_name": cell.scene_name, "id": cell.id, "objects": objects}
    return Record("Cell", {**fields, "cell_size": cell.cell_size, "bbox_w": cell.bbox_w})


def pose_record(pose: PublishedPose) -> Record:
    """A pose as the reference package's `Pose`."""
    fields = {"pose": pose.pose, "pose_w": pose.pose_w, "cell_id": pose.cell_id}
    hints = [_hint_record(hint) for hint in pose.descriptions]
    return Record(
        "Pose", {**fields, "descriptions": hints, "scene_name": pose.scene_name, "described_by": pose.described_by}
    )


def _object_record(item: PublishedObject) -> Record:
    names = ("id", "instance_id", "xyz", "rgb", "label")
    return Record("Object3d", {name: getattr(item, name) for name in names})


def _hint_record(hint: PublishedHint) -> Record:
    fields = {name: getattr(hint, name) for name in PublishedHint.__slots__}
    return Record("DescriptionBestCell", {name: value for name, value in fields.items() if value is not None})


class RecordPickler:
    """Writes lists of records; holds no value longer than it takes to write it."""

    def __init__(self, file: BinaryIO) -> None:
        self._write = file.write
        self._memo: dict[tuple[str, ...], int] = {}

    def dump(self, records: Iterable[Record]) -> None:
        """Write one pickle: the list of the records."""
        self._write(pickle.PROTO + b"\x04" + pickle.EMPTY_LIST)
        for record in records:
            self._value(record)
            self._write(pickle.APPEND)
        self._write(pickle.STOP)

    def _value(self, value: Any) -> None:
        if value is None or isinstance(value, bool | np.bool_):
            self._write(pickle.NONE if value is None else pickle.NEWTRUE if value else pickle.NEWFALSE)
        elif isinstance(value, str):
            self._once(("str", value), lambda: self._text(value))
        elif isinstance(value, int | np.integer):
            self._integer(int(value))
        elif isinstance(value, float | np.floating):
            self._write(pickle.BINFLOAT + struct.pack(">d", value))
        elif isinstance(value, np.ndarray):
            self._array(value)
        elif isinstance(value, Record):
            self._record(value)
        else:
            self._list(value)

    def _once(self, key: tuple[str, ...], write: Callable[[], object]) -> None:
        """Write a value the first time, a reference to it after that."""
        if key in self._memo:
            self._write(pickle.LONG_BINGET + struct.pack("<I", self._memo[key]))
            return
        write()
        self._memo[key] = len(self._memo)
        self._write(pickle.MEMOIZE)

    def _text(self, value: str) -> None:
        data = value.encode()
        self._write(pickle.BINUNICODE + struct.pack("<I", len(data)) + data)

    def _integer(self, value: int) -> None:
        if -(2**31) <= value < 2**31:
            self._write(pickle.BININT + struct.pack("<i", value))
        else:
            data = pickle.encode_long(value)
            self._write(pickle.LONG1 + bytes([len(data)]) + data)

    def _list(self, values: list[Any]) -> None:
        self._write(pickle.EMPTY_LIST)
        for start in range(0, len(values), BATCH):
            self._write(pickle.MARK)
            for value in values[start : start + BATCH]:
                self._value(value)
            self._write(pickle.APPENDS)

    def _global(self, module: str, name: str) -> None:
        def write() -> None:
            self._text(module)
            self._text(name)
            self._write(pickle.STACK_GLOBAL)

        self._once(("global", module, name), write)

    def _record(self, record: Record) -> None:
        self._global(RECORD_MODULE, record.kind)
        self._write(pickle.EMPTY_TUPLE + pickle.NEWOBJ + pickle.EMPTY_DICT + pickle.MARK)
        for name, value in record.fields.items():
            self._value(name)
            self._value(value)
        self._write(pickle.SETITEMS + pickle.BUILD)

    def _array(self, array: npt.NDArray[Any]) -> None:
        code = array.dtype.str[1:]
        array = np.ascontiguousarray(array, dtype="<" + code)
        self._global(MULTIARRAY, "_reconstruct")
        self._global("numpy", "ndarray")
        self._write(pickle.BININT1 + b"\0" + pickle.TUPLE1 + pickle.SHORT_BINBYTES + b"\x01b" + pickle.TUPLE3)
        self._write(pickle.REDUCE + pickle.MARK + pickle.BININT1 + b"\x01" + pickle.MARK)
        for n in array.shape:
            self._integer(n)
        self._write(pickle.TUPLE)
        self._once(("dtype", code), lambda: self._dtype(code))
        self._write(pickle.NEWFALSE + pickle.BINBYTES8 + struct.pack("<Q", array.nbytes))
        self._write(array.data)
        self._write(pickle.TUPLE + pickle.BUILD)

    def _dtype(self, code: str) -> None:
        self._global("numpy", "dtype")
        self._text(code)
        self._write(pickle.NEWFALSE + pickle.NEWTRUE + pickle.TUPLE3 + pickle.REDUCE + pickle.MARK)
        self._integer(3)
        self._text("<")
        self._write(pickle.NONE * 3)
        for number in (-1, -1, 0):
            self._integer(number)
        self._write(pickle.TUPLE + pickle.BUILD)
