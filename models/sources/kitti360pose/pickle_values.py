"""Inert stand-ins for the content of published pickles: records, arrays, dtypes, and the globals that make them."""

import math
import re
import weakref
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt

RECORD_MODULE = "datapreparation.kitti360pose.imports"
RECORD_CLASSES = ("Cell", "Object3d", "Pose", "DescriptionBestCell")
NUMBER_DTYPE = re.compile(r"b1|[iu][1248]|f[48]")  # dtypes of plain numbers, never "O"


class RefusedPickle(ValueError):
    """The pickle asks for something other than data; the message continues "the pickle ..."."""


@dataclass(slots=True, eq=False)
class PickledRecord:
    """A stand-in for an object of the reference package."""

    kind: str  # name of its class
    fields: dict[str, Any] = field(default_factory=dict)
    is_listed: bool = False  # whether a list holds it; a few bytes can refer to one object a million times


@dataclass(frozen=True, slots=True)
class StoredBytes:
    """A byte string that was left in the file."""

    offset: int
    size: int


@dataclass(slots=True, eq=False)
class StoredType:
    """A stand-in for a numpy dtype: its code, for example "f8", and its byte order."""

    code: str
    order: str = "="

    @property
    def dtype(self) -> np.dtype[Any]:
        """Return the dtype as stored."""
        return np.dtype(self.order + self.code)


@dataclass(slots=True, eq=False)
class StoredArray:
    """A stand-in for a numpy array, whose values are read on demand; `data` is None until it is built."""

    shape: tuple[int, ...] = ()
    dtype: np.dtype[Any] = field(default_factory=lambda: np.dtype("f8"))
    fortran: bool = False
    data: bytes | StoredBytes | None = None
    _alive: "weakref.ref[npt.NDArray[Any]] | None" = None

    def read(self, file: BinaryIO) -> npt.NDArray[Any]:
        """Return the array in native byte order; it is shared while in use, however often the pickle refers to it."""
        array = self._alive() if self._alive else None
        if array is None:
            if self.data is None:
                raise RefusedPickle("has an array without values")
            raw: bytes | bytearray = bytearray(self.data if isinstance(self.data, bytes) else b"")
            if isinstance(self.data, StoredBytes):
                file.seek(self.data.offset)
                raw = bytearray(self.data.size)
                if file.readinto(raw) != len(raw):  # type: ignore[attr-defined]  # every binary file has it
                    raise EOFError
            flat = np.frombuffer(raw, dtype=self.dtype)
            array = np.ascontiguousarray(flat.reshape(self.shape, order="F" if self.fortran else "C"))
            array = array.astype(self.dtype.newbyteorder("="), copy=False)
            self._alive = weakref.ref(array)
        return array


@dataclass(frozen=True, slots=True, eq=False)
class AllowedGlobal:
    """A global that a pickle may name, and the function that stands in for it."""

    name: str
    call: Callable[..., Any] | None = None


def fill_array(array: StoredArray, shape: Any, dtype: Any, fortran: Any, data: Any) -> StoredArray:
    """Set the content of an array, if its parts are consistent."""
    sized = type(shape) is tuple and len(shape) <= 2 and all(type(n) is int and n >= 0 for n in shape)
    if not sized or not isinstance(dtype, StoredType) or type(fortran) is not bool or array.data is not None:
        raise RefusedPickle("has an array that is not one of plain numbers")
    size = data.size if isinstance(data, StoredBytes) else len(data) if type(data) is bytes else -1
    if size != math.prod(shape) * dtype.dtype.itemsize:
        raise RefusedPickle("has an array whose values do not fit its shape")
    array.shape, array.dtype, array.fortran, array.data = shape, dtype.dtype, fortran, data
    return array


def _reconstruct(kind: Any, shape: Any, code: Any) -> StoredArray:
    if kind is not NDARRAY or shape != (0,) or code not in (b"b", "b"):
        raise RefusedPickle("has an array that is not one of plain numbers")
    return StoredArray()


def _dtype(code: Any, align: Any = False, copy: Any = True) -> StoredType:
    if not isinstance(code, str) or not NUMBER_DTYPE.fullmatch(code) or align not in (0, 1) or copy not in (0, 1):
        raise RefusedPickle("has a dtype that is not one of plain numbers")
    return StoredType(code)


def _scalar(dtype: Any, data: Any) -> Any:
    if not isinstance(dtype, StoredType) or type(data) is not bytes or len(data) != dtype.dtype.itemsize:
        raise RefusedPickle("has a scalar that is not a plain number")
    return np.frombuffer(data, dtype=dtype.dtype)[0].item()


def _frombuffer(data: Any, dtype: Any, shape: Any, order: Any) -> StoredArray:
    return fill_array(StoredArray(), shape, dtype, order == "F", data)


NDARRAY = AllowedGlobal("numpy.ndarray")
ALLOWED_GLOBALS = {
    ("numpy", "ndarray"): NDARRAY,
    ("numpy", "dtype"): AllowedGlobal("numpy.dtype", _dtype),
    **{(RECORD_MODULE, kind): AllowedGlobal(kind) for kind in RECORD_CLASSES},
    **{
        (f"numpy.{core}.multiarray", "_reconstruct"): AllowedGlobal("array", _reconstruct) for core in ("core", "_core")
    },
    **{(f"numpy.{core}.multiarray", "scalar"): AllowedGlobal("scalar", _scalar) for core in ("core", "_core")},
    **{(f"numpy.{core}.numeric", "_frombuffer"): AllowedGlobal("array", _frombuffer) for core in ("core", "_core")},
}
